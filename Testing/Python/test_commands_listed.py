#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every command is one for the script `waft` of a checkout, for the parser, the completions and the manual page.

    PYTHONPATH=PACKAGE test_commands_listed.py SOURCE        nothing is built: what the script would set up is there
"""
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE / "CMake"))

import describe_command  # noqa: E402
from waft import Scene, cli, takes  # noqa: E402
from waft.run._chain import word_in_keys  # noqa: E402

OWN = {"packages", "build", "test", "package"}  # of the script alone


def _read(terminal):
    try:
        return terminal.read1()
    except OSError:  # nobody holds its other end any more
        return b""


class Listed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "bin").mkdir()
        (self.folder / "build.ninja").touch()
        for name, words in (("dpkg-query", "echo install ok installed"), ("cmake", ":"), ("ninja", ":"), ("ctest", "echo ctest"),
                            ("bin/waft", 'echo "built $*"')):
            (self.folder / name).write_text(f"#!/bin/sh\n{words}\n", encoding="utf-8")
            (self.folder / name).chmod(0o755)

    def script(self, *arguments, stderr=subprocess.PIPE):
        environment = {**os.environ, "WAFT_BUILD_DIR": str(self.folder), "PATH": f"{self.folder}:{os.environ['PATH']}"}
        return subprocess.run([SOURCE / "waft", *arguments], stdout=subprocess.PIPE, stderr=stderr, text=True, check=False,
                              env=environment)

    def test_every_command_is_known_to_all(self):
        usage = self.script("--help").stdout
        listed = re.findall(r"^  ([\w-]+)  ?", usage, re.MULTILINE)
        main = cli.parser()
        known = [command.name for command in describe_command.commands(main)]
        self.assertEqual(OWN | set(known), set(listed))
        self.assertEqual(len(listed), len(set(listed)))
        for name in listed:
            with self.subTest(name):
                done = self.script(name, "a b")
                self.assertEqual(0, done.returncode, done.stderr)
                self.assertEqual("" if name in OWN - {"test"} else "ctest\n" if name == "test" else f"built {name} a b\n", done.stdout)
        manual, bash, zsh = (made(main) for made in (describe_command.manual, describe_command.completion_of_bash,
                                                     describe_command.completion_of_zsh))
        for name in known:
            with self.subTest(name):
                self.assertIn(f"\n.SS {describe_command._roff(name)}\n", manual)
                self.assertIn(f"\n        {name}) words=", bash)
                self.assertIn(f"\n  '{name}:", zsh)
                self.assertIn(f"\n    {name}) _arguments ", zsh)

    def test_a_build_says_how_far_it_is(self):
        steps = "echo $*; for step in 1 2 3 4; do echo \"[$step/4] Building\"; done"
        (self.folder / "ninja").write_text(f"#!/bin/sh\n{steps}\n", encoding="utf-8")
        logged = self.script("build").stderr.splitlines()
        self.assertEqual(["waft: [1/4]", "waft: [2/4]", "waft: [3/4]", "waft: [4/4]"], [line for line in logged if "/4]" in line])
        self.assertNotIn("WaftTests", (self.folder / "build.log").read_text(encoding="utf-8"), "tests are for who tests")
        self.script("test")
        self.assertIn("all WaftTests", (self.folder / "build.log").read_text(encoding="utf-8"))
        ours, terminal = pty.openpty()
        with os.fdopen(ours, "rb") as shown:
            self.script("build", stderr=terminal)
            os.close(terminal)
            text = b"".join(iter(lambda: _read(shown), b"")).decode()
        self.assertIn("\rwaft: [1/4]\x1b[K\rwaft: [2/4]\x1b[K", text, "one line that rewrites itself")

    def test_a_quality_is_named_by_what_it_was_called_before_as_well(self):
        main = cli.parser()
        scene = self.folder / "one.waft.json"
        Scene(seed=1).save(scene)
        digests = set()
        for word in ("air", "assimilated"):
            options = main.parse_args(["takes", "--seeds", "1", str(scene), "--output", "out", "--quality", word])
            self.assertEqual("air", options.quality)
            digests.add(takes._Flight(scene, self.folder, word, 1, None).key)
        self.assertEqual(1, len(digests))
        self.assertEqual("assimilated", word_in_keys("air"), "as in the keys of runs from before")
        for made in (describe_command.manual, describe_command.completion_of_bash, describe_command.completion_of_zsh):
            self.assertRegex(made(main), "preview[ ,]air[ ,]full[ ,]paper")
        shown = {command.name: command.parser.format_help() for command in describe_command.commands(main)}
        for name in ("synthesize", "takes"):
            self.assertIn("--quality {preview,air,full,paper}", shown[name])

    def test_what_is_no_command_is_said_in_a_line(self):
        for word, shown in (("fly", "fly"), ("x" * 100000, "x" * 60), ("\x1b[31m", "$'\\E[31m'"), ("a\nb", "$'a\\nb'")):
            done = self.script(word)
            self.assertEqual(2, done.returncode)
            self.assertEqual(f"waft: unknown command: {shown}", done.stderr.splitlines()[0])
            self.assertLess(len(done.stderr), 2000)


if __name__ == "__main__":
    unittest.main()
