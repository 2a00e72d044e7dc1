# SPDX-License-Identifier: BSD-3-Clause
"""Texts of others, such as names, titles and messages, where they leave Waft: on a line, in a cell of a table, in HTML, in XML."""
import html
import os
import re
from xml.sax import saxutils

from waft import messages

# What a terminal, an editor or a browser acts on instead of showing it: controls, those of direction among them, ends of lines,
# halves of letters, and what is no letter at all.
_UNSEEN = re.compile("[\0-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\ufff9-\ufffb\ufffe\uffff\ud800-\udfff]")
_FORMULA = re.compile(r"[=+\-@\t\r]")


def line(text):
    """A text as one line that looks like what it is: what cannot be seen is written as an escape, such as \\n or \\u202e."""
    return _UNSEEN.sub(lambda found: found[0].encode("unicode_escape").decode(), str(text))


def shortened(text, most=1800):
    """A text without its middle where it is longer than most letters."""
    text = str(text)
    return text if len(text) <= most else f"{text[:most // 2]} ... {text[-most // 2:]}"


def cell(text):
    """A text as a cell of a table that programs for tables take for a text: one that begins as a formula does gets an apostrophe."""
    return f"'{text}" if _FORMULA.match(text) and not _is_number(text) else text


def in_html(text):
    """A text within HTML."""
    return html.escape(line(text))


def in_xml(text):
    """A text as the value of an attribute in XML, with its quotes. XML cannot hold what cannot be seen: it is written as on a line."""
    return saxutils.quoteattr(line(text))


def is_utf8(path):
    """Whether the name of a file is UTF-8; ParaView takes no other, and ends the process where it is given one."""
    try:
        os.fsencode(path).decode("utf-8")
    except UnicodeDecodeError:
        return False
    return True


def _is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def say(text, kind="note"):
    """A message, a line: "error", "warning" or "note"; "detail" is shown where more is asked for, "record" stands in the log alone."""
    messages.emit(line(text), kind)


def warn(text):
    say(f"waft: warning: {text}", "warning")
