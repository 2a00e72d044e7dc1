# SPDX-License-Identifier: BSD-3-Clause
"""What Core says of the options of its stages: options.json, which is written when Waft is built (Filters/Programs)."""
import dataclasses
import functools
import numbers
import pathlib
from typing import Any, Dict, List

from waft.failures import InputError
from waft.reading import read_json


@dataclasses.dataclass(frozen=True)
class Option:
    """A number. unset: what its low end stands for, which is said by leaving the option out; "": that is a number as others.
    of: whose it is, where the one who reads of it has to be told."""

    sentence: str
    default: float
    low: float
    high: float
    is_whole: bool
    unset: str
    of: str = ""

    @property
    def clause(self) -> str:
        """The sentence and the default, as help and lists have them."""
        whose = f"of {self.of}: " if self.of else ""
        said = self.sentence[0].lower() + self.sentence[1:].rstrip(".")
        return f"{whose}{said} (default: {self.unset or f'{self.default:g}'})"

    @property
    def expected(self) -> str:
        if self.is_whole:
            return f"a whole number from {int(self.low) + bool(self.unset)} to {int(self.high)}"
        return f"a number {'above' if self.unset else 'from'} {self.low:g}{', at most' if self.unset else ' to'} {self.high:g}"

    def accepts(self, value: Any) -> bool:
        return isinstance(value, numbers.Integral if self.is_whole else numbers.Real) and self._holds(value)

    def _holds(self, value: Any) -> bool:
        return self.low <= value <= self.high and not (self.unset and value == self.low)

    def check(self, name: str, value: Any) -> None:
        if not self.accepts(value):
            raise InputError(f"{name}: expected {self.expected}, found {value!r}")


@functools.lru_cache(maxsize=None)
def _classes() -> Dict[str, List[Dict[str, Any]]]:
    return read_json(pathlib.Path(__file__).parents[1] / "options.json")


def option(owner: str, name: str, of: str = "") -> Option:
    """That of a class of the pipeline."""
    said = next(field for field in _classes()[owner] if field["name"] == name)
    low, high = said["range"]
    return Option(said["sentence"], said["default"], low, high, said["type"] == "whole", said.get("unset", ""), of)
