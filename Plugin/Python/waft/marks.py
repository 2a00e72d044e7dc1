# SPDX-License-Identifier: BSD-3-Clause
"""How a single file says that Waft wrote it: by a digest in it of all the rest, which tells, too, whether it was changed since."""
import hashlib
import json
import struct
import zlib

from waft.failures import InputError
from waft.reading import read_bytes, read_json

_COMMENT = b"written by waft, sha256:"
_PNG_END = struct.pack(">I4sI", 0, b"IEND", zlib.crc32(b"IEND"))


def _digest(content):
    return hashlib.sha256(content).hexdigest().encode()


def marked_png(content):
    """A picture with its mark, a text before its end."""
    text = b"tEXtWaft\0" + _COMMENT + _digest(content)
    return content[:-len(_PNG_END)] + struct.pack(">I", len(text) - 4) + text + struct.pack(">I", zlib.crc32(text)) + _PNG_END


def is_marked_png(path):
    content = _content(path)
    size = len(marked_png(_PNG_END)) - len(_PNG_END)
    return content == marked_png(content[:-size - len(_PNG_END)] + _PNG_END)


def marked_zip(content):
    """An archive (.zip, .npz) without a comment, with its mark as the comment."""
    comment = _COMMENT + _digest(content)
    return content[:-2] + struct.pack("<H", len(comment)) + comment


def is_marked_zip(path):
    content = _content(path)
    size = len(_COMMENT) + len(_digest(b""))
    return content == marked_zip(content[:-size - 2] + b"\0\0")


def mark_of_text(content):
    """The last line of a text that Waft wrote, whose lines before it are given."""
    return _COMMENT + _digest(content) + b"\n"


def is_marked_text(path):
    content = _content(path)
    size = len(mark_of_text(b""))
    return len(content) > size and content[-size:] == mark_of_text(content[:-size])


def marked_html(content):
    """A page with its mark, a comment at its end."""
    return content + b"<!-- " + _COMMENT + _digest(content) + b" -->\n"


def is_marked_html(path):
    content = _content(path)
    return content == marked_html(content[:-len(marked_html(b""))])


def marked_rows(rows):
    """A list of dictionaries that is to be written as JSON, with the mark in the first."""
    bare = [{name: value for name, value in row.items() if name != "digest"} for row in rows]
    return [{**row, "digest": f"sha256:{_digest(json.dumps(bare).encode()).decode()}"} if row is bare[0] else row for row in bare]


def is_marked_json(path):
    try:
        rows = read_json(path)
    except InputError:
        return False
    return isinstance(rows, list) and bool(rows) and all(isinstance(row, dict) for row in rows) and rows == marked_rows(rows)


def _content(path):
    try:
        return read_bytes(path)
    except InputError:
        return b""
