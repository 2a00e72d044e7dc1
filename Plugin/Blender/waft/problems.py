# SPDX-License-Identifier: BSD-3-Clause
"""What stands against a flight, or came of one: sentences, each with the object that it is about."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Problem:
    """text: a sentence. object: the name of the object that it is about, or "". is_error: whether nothing flies with it."""

    text: str
    object: str = ""
    is_error: bool = True


class Problems(list):
    """Problems in the order in which they were found."""

    def error(self, text, about=None):
        self.append(Problem(text, about.name if about else ""))

    def warn(self, text, about=None):
        self.append(Problem(text, about.name if about else "", False))

    @property
    def is_fatal(self):
        return any(problem.is_error for problem in self)
