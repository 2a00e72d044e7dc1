# SPDX-License-Identifier: BSD-3-Clause
"""What the tables (.csv) of a results folder hold, looked at before it is used."""
import math

from waft.failures import InputError

_EXPECTED = {int: "a whole number", float: "a number", str: "a text"}


def columns_of(rows, columns, place):
    """The rows of a table with these columns ({name: int, float or str}) as what they are: a number that is not finite is None. Raises
    InputError that names the file, the line, the column, what was expected and what was found."""
    return [{name: _value(row.get(name), kind, f"{place}: row {number}: column {name}") for name, kind in columns.items()}
            for number, row in enumerate(rows)]


def _value(cell, kind, place):
    if isinstance(cell, str):
        if kind is str:
            return cell
        try:
            value = float(cell)
        except ValueError:
            value = None
        if value is not None and kind is float:
            return value if math.isfinite(value) else None
        if value is not None and abs(value) <= 2.0 ** 53 and value == int(value):
            return int(value)
    raise InputError(f"{place}: expected {_EXPECTED[kind]}, found {'nothing' if cell is None else repr(cell[:80])}")
