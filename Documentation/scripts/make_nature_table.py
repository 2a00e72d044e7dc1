# SPDX-License-Identifier: BSD-3-Clause
"""Writes into the page of the rotation what discs and strips come to by the plate's law, as the tests `Nature` print it.

    make_nature_table.py BUILD PAGES        PAGES: the folder Documentation"""
import pathlib
import subprocess
import sys

BEGIN, END = "<!-- nature: by make_nature_table.py -->", "<!-- end of nature -->"


def main(build, pages):
    tests = [pathlib.Path(build, "bin", "WaftTestRotation"), "--gtest_filter=Nature.*"]
    done = subprocess.run(tests, capture_output=True, text=True, check=True)
    tables, rows = [], []
    for line in done.stdout.splitlines():
        if line.startswith("|"):
            rows.append(line)
        elif rows:
            tables.append("\n".join(rows))
            rows = []
    page = pathlib.Path(pages, "RotationRefineFilter.md")
    before, _, rest = page.read_text(encoding="utf-8").partition(BEGIN)
    _, _, after = rest.partition(END)
    page.write_text(before + BEGIN + "\n\n" + "\n\n".join(tables) + "\n\n" + END + after, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
