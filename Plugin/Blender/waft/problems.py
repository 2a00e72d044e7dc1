# SPDX-License-Identifier: BSD-3-Clause
"""What stands against a flight, or came of one: sentences, each with the object that it is about."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Problem:
    """text: a sentence. object: the full name of the object that it is about, or "". is_error: whether nothing flies with it.
    others: full names of more objects of which it is true."""

    text: str
    object: str = ""
    is_error: bool = True
    others: tuple = ()


class Problems(list):
    """Problems in the order in which they were found. title: what came of all, in a line; "" for nothing yet."""

    def __init__(self, *problems):
        super().__init__(*problems)
        self.title = ""

    def put(self, title, problems=()):
        """Says this in the place of what was said."""
        self.title = title
        self[:] = problems

    def error(self, text, about=None):
        self.append(Problem(text, about.name_full if about else ""))

    def warn(self, text, about=None):
        self.append(Problem(text, about.name_full if about else "", False))

    @property
    def is_fatal(self):
        return any(problem.is_error for problem in self)
