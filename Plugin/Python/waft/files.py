# SPDX-License-Identifier: BSD-3-Clause
"""The formats of files that are written and read."""
import contextlib
import json
import math
import os
import shutil

from waft.failures import InputError
from waft.reading import open_stream
from waft.renaming import move_new
from waft.temporary import temporary_file


def number(value):
    """A double with 17 significant digits, which reads back bit for bit."""
    return format(value, ".17g")


def check_target(path, is_own=None):
    """Raises InputError unless a file can be written under a name. What is there stays, unless is_own(path) says that Waft wrote it
    and nobody changed it since."""
    folder = os.path.dirname(os.path.abspath(path))
    if not os.path.isdir(folder):
        raise InputError(f"{path}: expected a folder that is there")
    if os.path.isdir(path):
        raise InputError(f"{path}: expected the name of a file, found a folder")
    if os.path.lexists(path) and (is_own is None or os.path.islink(path) or not is_own(path)):
        raise InputError(f"{path}: {'it is there' if is_own is None else _NOT_OURS}, and stays as it is: choose another name")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise InputError(f"{folder}: expected a folder that may be written in")


@contextlib.contextmanager
def whole_file(path, is_own=None):
    """A name to write to; what was written takes the place of `path` when all went well, else nothing is left and what was there
    stays. Raises InputError where something is there that may not be replaced, see check_target."""
    check_target(path, is_own)
    with temporary_file(os.path.dirname(path) or ".") as (part, descriptor):
        yield part
        os.fsync(descriptor)
        if is_own is not None and os.path.lexists(path):
            check_target(path, is_own)
            os.replace(part, path)
            return
        try:
            move_new(part, path)
        except FileExistsError as error:  # it came there meanwhile
            raise InputError(f"{path}: it is there, and stays as it is: choose another name") from error


_NOT_OURS = "Waft did not write it, or it was changed since"


def write_bytes(path, content):
    with open(path, "wb") as stream:
        stream.write(content)


def write_text(path, text):
    """Lines end as they are."""
    write_bytes(path, text.encode())


def appending(path):
    """A descriptor of a file that is there, no link, to write on at its end and to read."""
    return os.open(path, os.O_RDWR | os.O_APPEND | os.O_NOFOLLOW | os.O_CLOEXEC)


def copy_file(source, path):
    """The bytes of a file that may be anybody's, piece by piece."""
    with open_stream(source) as content, open(path, "wb") as stream:
        shutil.copyfileobj(content, stream)


def write_json(path, content):
    with open(path, "w", encoding="utf-8") as stream:
        json.dump(content, stream, indent=2)
        stream.write("\n")
        stream.flush()
        os.fsync(stream.fileno())


def table_rows(table):
    """Header and rows of a vtkTable, doubles with 17 digits; what is no number is empty."""
    header = [table.GetColumnName(c) for c in range(table.GetNumberOfColumns())]
    rows = []
    for r in range(table.GetNumberOfRows()):
        row = []
        for c in range(table.GetNumberOfColumns()):
            value = table.GetValue(r, c)
            if value.IsDouble() or value.IsFloat():
                row.append("" if math.isnan(value.ToDouble()) else number(value.ToDouble()))
            else:
                row.append(value.ToString())
        rows.append(row)
    return header, rows
