# SPDX-License-Identifier: BSD-3-Clause
"""The pages: every link leads to a file, files that are named are there, the index lists every page, lines are at most
120 columns wide, and figures of time and memory say when they were taken.

    test_documents.py SOURCE"""

import glob
import os
import re
import sys
import unittest

SOURCE = sys.argv[1]
DOCUMENTATION = os.path.join(SOURCE, "Documentation")
LINK = re.compile(r"\]\(([^)#]+)(?:#[^)]*)?\)")
DATE = re.compile(r"\b20\d\d-\d\d-\d\d\b")
TAKEN = re.compile(r"\d (?:s|ms|MB|GB) [|]|CPU s|^[|] seconds [|]")
LIMITS = {"Bad inputs", "Rows"}  # tables of what is allowed or wanted, none of what was measured
WIDTH = 120  # columns; tables and code blocks may be wider


def pages():
    return [os.path.join(SOURCE, name) for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")] + sorted(
        glob.glob(os.path.join(DOCUMENTATION, "**", "*.md"), recursive=True))


def wide_lines(text):
    """Numbers of the lines over WIDTH that are no table and no code."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        fenced ^= line.lstrip().startswith("```")
        if len(line) > WIDTH and not fenced and not line.startswith(("|", "    ")):
            yield number


def cut_tables(text):
    """Numbers of the lines where a table begins that has no head: rows after a blank line are no table."""
    fenced, before = False, ""
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        fenced ^= line.lstrip().startswith("```")
        if line.startswith("|") and not before.startswith("|") and not fenced:
            if number == len(lines) or not re.fullmatch(r"\|[-:| ]+\|", lines[number]):
                yield number
        before = line


def undated(text):
    """Headings of sections whose tables have figures of a machine's time or memory, and that do not say when these were
    taken. A date in the words before the first section is one for all; a page that a script writes keeps it in its data."""
    lead, *sections = re.split(r"^##+ ", text, flags=re.MULTILINE)
    if DATE.search(lead) or "Written by [make_" in lead:
        return
    for section in sections:
        rows = [line for line in section.splitlines() if line.startswith("|")]
        if any(TAKEN.search(row) for row in rows) and not DATE.search(section):
            yield section.partition("\n")[0]


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class DocumentsTest(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in pages():
            for target in LINK.findall(text_of(page)):
                if "://" not in target:
                    with self.subTest(page=os.path.relpath(page, SOURCE), target=target):
                        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(page), target)))

    def test_files_that_are_named_are_there(self):
        count = 0
        for page in pages():
            for name in re.findall(r"`((?:CMake|Data|Documentation|Filters|Plugin|Sources|Testing)/[\w./-]+)`", text_of(page)):
                with self.subTest(page=os.path.relpath(page, SOURCE), name=name):
                    there = glob.glob(os.path.join(SOURCE, name.replace("GROUP", "*")) + ("" if "." in name else "*"))
                    self.assertNotEqual([], there)
                    count += 1
        self.assertGreater(count, 50)

    def test_the_readme_opens_with_an_animation_that_loads_soon(self):
        first = LINK.findall(text_of(os.path.join(SOURCE, "README.md")))[0]
        with open(os.path.join(SOURCE, first), "rb") as file:
            content = file.read()
        self.assertEqual((b"RIFF", b"WEBP", b"VP8X"), (content[:4], content[8:12], content[12:16]))
        width, height = (1 + int.from_bytes(content[at:at + 3], "little") for at in (24, 27))
        self.assertEqual((960, 540), (width, height))
        self.assertEqual(0, int.from_bytes(content[content.index(b"ANIM") + 12:][:2], "little"))  # without an end
        self.assertGreater(content.count(b"ANMF"), 60)
        self.assertLess(len(content), 3e6)

    def test_lines_are_not_wide(self):
        wide = "word " * 30
        self.assertEqual([1], list(wide_lines(f"{wide}\n| {wide} |\n```\n{wide}\n```\nnarrow\n")))
        for page in pages():
            with self.subTest(page=os.path.relpath(page, SOURCE)):
                self.assertEqual([], list(wide_lines(text_of(page))))

    def test_tables_are_whole(self):
        self.assertEqual([5], list(cut_tables("| a |\n|---|\n| 1 |\n\n| 2 |\n| 3 |\n")))
        for page in pages():
            with self.subTest(page=os.path.relpath(page, SOURCE)):
                self.assertEqual([], list(cut_tables(text_of(page))))

    def test_figures_say_when_they_were_taken(self):
        table = "| a | time |\n|---|---|\n| b | 3 s |\n"
        self.assertEqual(["Old"], list(undated(f"# A\n\n## New\n\n2026-11-26:\n\n{table}\n## Old\n\n{table}")))
        self.assertEqual([], list(undated(f"# A\n\nOf 2026-11-26.\n\n## Old\n\n{table}")))
        for page in pages():
            with self.subTest(page=os.path.relpath(page, SOURCE)):
                self.assertEqual(set(), set(undated(text_of(page))) - LIMITS)

    def test_nothing_of_the_paper_is_without_a_row(self):
        """Paper.md has a row for each section, equation and figure, and the folders and tests that it names are there."""
        rows = [[cell.strip() for cell in line.strip("| ").split(" | ")]
                for line in text_of(os.path.join(DOCUMENTATION, "Paper.md")).splitlines() if line.startswith("| ")]
        rows = [row for row in rows if len(row) == 6 and row[1] != "stage"]
        firsts = [row[0] for row in rows]
        sections = ("Abstract", "1 ", "1.1 ", "2 ", "3 ", "3.1 ", "3.2 ", "4 ", "5 ", "6 ", "7 ", "8 ",
                    *(f"Appendix {letter} " for letter in "ABC"))
        for name in (*sections, *(f"Eq. {number} " for number in range(1, 14)), *(f"Fig. {number} " for number in range(1, 10))):
            self.assertTrue(any(first.startswith(name) for first in firsts), name)
        tests = {".".join(found) for path in glob.glob(os.path.join(SOURCE, "Testing", "*", "**", "*.cxx"), recursive=True)
                 for found in re.findall(r"^TEST(?:_[FP])?\((\w+), (\w+)\)", text_of(path), re.MULTILINE)}
        tests |= {f"Python.{name}" for name in re.findall(
            r"waft_python_test\((\w+)", text_of(os.path.join(SOURCE, "Testing", "Python", "CMakeLists.txt")))}
        qualities = {"all", "air", "database", "full", "none", "paper", "preview", "-"}
        for first, stages, folders, named, run_by, why in rows:
            with self.subTest(row=first):
                for folder in folders.split(", "):
                    self.assertTrue(folder == "-" or os.path.isdir(os.path.join(SOURCE, "Filters", "Core", folder)), folder)
                self.assertEqual(set(), set(re.findall(r"`([\w.]+)`", named)) - tests)
                if run_by.startswith("none: "):  # the properties that switch it on
                    proxies = "".join(text_of(os.path.join(SOURCE, "Plugin", "XML", f"{stage}.xml")) for stage in stages.split(", "))
                    switches = re.findall(r"`(\w+)`", run_by)
                    self.assertTrue(switches and all(f'name="{switch}"' in proxies for switch in switches), run_by)
                else:
                    self.assertLessEqual(set(run_by.split(", ")), qualities)
                    self.assertTrue(run_by != "none" or "left out for good" in why)
                self.assertGreater(len(why), 10)

    def test_every_page_is_in_the_index(self):
        listed = LINK.findall(text_of(os.path.join(DOCUMENTATION, "README.md")))
        for page in glob.glob(os.path.join(DOCUMENTATION, "*.md")):
            if os.path.basename(page) != "README.md":
                self.assertIn(os.path.basename(page), listed)

    def test_a_clone_installs_what_the_package_depends_on(self):
        listed = re.search(r"^packages=\((.*?)^\)", text_of(os.path.join(SOURCE, "waft")), re.MULTILINE | re.DOTALL).group(1)
        all_have, *systems = re.split(r"^\s*\S+:", listed, flags=re.MULTILINE)
        depends = re.search(r"^set\(CPACK_DEBIAN_PACKAGE_DEPENDS (.*?)\)$",
                            text_of(os.path.join(SOURCE, "CMake", "WaftPackage.cmake")), re.MULTILINE | re.DOTALL).group(1)
        named = {(quoted or plain).split()[0] for quoted, plain in re.findall(r'"([^"]+)"|([^\s"]+)', depends)}
        self.assertIn("libqt5svg5", named, "without which ParaView's tool bars are blank")
        self.assertGreaterEqual(len(systems), 2)
        for system in systems:
            installed = {re.sub("^qt6-svg-plugins$", "libqt5svg5", package) for package in (all_have + system).split()}
            self.assertEqual(named - installed, set(), system)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
