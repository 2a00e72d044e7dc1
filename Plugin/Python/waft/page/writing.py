# SPDX-License-Identifier: BSD-3-Clause
"""One page that shows a result in a browser, with all that it needs in it: see Documentation/Page.md."""
import base64
import hashlib
import json
import os
import pathlib
import re
from typing import Union

from waft.failures import InputError, WaftError
from waft.files import whole_file, write_bytes, write_text
from waft.marks import is_marked_html, marked_html
from waft.page import _pagedata
from waft.reading import read_text
from waft.results import ResultPlace
from waft.texts import in_html

NAME = "page.html"
STAMP = "page.watch.js"
THREE = "/usr/share/javascript/three/three.min.js"
Path = Union[str, "os.PathLike[str]"]
_PARTS = pathlib.Path(__file__).resolve().parent
_FILE = re.compile(r'<link rel="stylesheet" href="([^"]+)">|<script src="([^"]+)"></script>')


def write_page(folder: Path, measured: Union[Path, bool, None] = None, is_watched: bool = False) -> str:
    """Writes FOLDER/page.html and its manifest, FOLDER/page.json; returns the page's path.

    folder:     what `waft synthesize` wrote
    measured:   a file of `waft measure --json`, or True to measure now; FOLDER/measure.json is taken where there is one
    is_watched: the page looks at FOLDER/page.watch.js, which is written too, and loads itself again when it was written anew

    Raises InputError on a bad folder or file, and where a page.html is in the way that Waft did not write or that was changed
    since; WaftError where three.js is not installed.
    """
    if not os.path.isdir(folder):
        raise InputError(f"{folder}: no such folder; `waft synthesize` makes it")
    with ResultPlace(folder, "page.json") as place:
        place.check([NAME, STAMP] if is_watched else [NAME])
        page = _page(*_pagedata.describe(folder, measured))
        if is_watched:
            stamp = hashlib.sha256(page.encode()).hexdigest()
            page = _watched(page, stamp)
            write_text(place.path(STAMP), f'waftWritten("{stamp}");\n')
        write_text(place.path(NAME), page)
        place.commit({})
    return os.path.join(folder, NAME)


def page_of(folder: Path) -> str:
    """The page of a folder as a text."""
    return _page(*_pagedata.describe(folder))


def write_text_of_page(page: str, path: str) -> str:
    """Writes a page under a name, with Waft's mark; returns the name. Raises InputError where something is in the way that is no page of
    Waft's, or was changed since."""
    with whole_file(path, is_marked_html) as part:
        write_bytes(part, marked_html(page.encode()))
    return path


def _page(run, animation):
    """The template with its files, and what is shown, put into it."""
    text = _FILE.sub(lambda found: _style(found[1]) if found[1] else _script(found[2]), read_text(_PARTS / "page.html"))
    # In a script's text `<` could end it, or begin a comment.
    inside = {'id="run">': json.dumps(run, separators=(",", ":")).replace("<", "\\u003c"),
              'id="animation">': base64.b64encode(animation).decode(),
              "<title>": in_html(run["title"])}
    for before, content in inside.items():
        head, _, tail = text.partition(before)
        text = head + before + content + tail
    return text


def _watched(page, stamp):
    """A page that may ask for the file with its newest stamp."""
    policy = "script-src 'unsafe-inline'"
    head, _, tail = page.partition(policy)
    body, end, rest = tail.rpartition("</body>")
    return f'{head}{policy} file:{body}{_script("watch.js")}\n<script>watchPage("{stamp}", "{STAMP}");</script>\n{end}{rest}'


def _style(name):
    return f"<style>\n{read_text(_PARTS / name)}</style>"


def _script(name):
    code = _read_three() if name == os.path.basename(THREE) else read_text(_PARTS / name)
    return f"<script>\n{code}</script>"


def _read_three():
    if not os.path.isfile(THREE):
        raise WaftError(f"{THREE}: no such file; three.js draws the page: apt-get install libjs-three")
    return read_text(THREE)
