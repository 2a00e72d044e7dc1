# SPDX-License-Identifier: BSD-3-Clause
"""What the command makes of the shell that calls it: names of any kind, locales, lists of folders, a full disk behind stdout, readers
that have gone, a folder that is gone.

    test_guard.py WAFT       WAFT: the command of the build or of an installed tree
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

WAFT = sys.argv.pop(1)
sys.path.insert(0, str(pathlib.Path(WAFT).resolve().parents[1] / "lib/python3/dist-packages"))

from waft import guard, texts, watching  # noqa: E402
from waft.failures import BadInput  # noqa: E402

SCENE = {"waft": 1, "objects": [{"shape": "leaf", "position": [0, 0, 2]}], "shapes": {"leaf": {"builtin": "leaf"}}}


def run(*arguments, **options):
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
    return subprocess.run([WAFT, *arguments], check=False, **options)


class Guard(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def scene(self, name="scene.waft.json"):
        path = self.folder / name
        path.write_text(json.dumps(SCENE), encoding="utf-8")
        return path

    def test_a_name_gives_no_orders(self):
        reading, writing = os.pipe()
        reports = guard.Reports(reading)
        names = ["D\nlimit 0.1", "E\nlimit x", "F\nwords ", 'G"]\n["limit", 1', "\udcff\n", "H\r\0\u2028" + "x" * 5000]
        os.environ["WAFT_GUARD"] = str(writing)
        try:
            for name in names:
                watching.report_to_guard("words", pathlib.Path(name))
                reports.read()
                self.assertEqual(name, reports.words)
            watching.report_to_guard("words", "")
        finally:
            del os.environ["WAFT_GUARD"]
        reports.read()
        os.close(writing)
        os.close(reading)
        self.assertEqual("", reports.words)

    def test_names_of_any_kind_in_any_locale(self):
        self.scene("é\u05d0.waft.json")
        done = run("check", "é\u05d0.waft.json", cwd=self.folder, env={**os.environ, "LC_ALL": "C"})
        self.assertEqual((0, b""), (done.returncode, done.stderr))
        self.assertIn("é\u05d0.waft.json: 1 objects", done.stdout.decode())
        for name in (b"\xff.waft.json", b"a/\xe9/b"):
            done = run("check", name, cwd=self.folder)
            self.assertEqual(2, done.returncode, done.stderr)
            self.assertIn(b"expected a path in UTF-8", done.stderr)
            self.assertNotIn(b"Traceback", done.stderr)

    def test_what_cannot_be_seen_is_reported_as_an_escape(self):
        raw = "\x1b[31m\x07\x9b\u202e\u2066\n"
        for arguments in (("check", f"{raw}.waft.json"), ("new", f"{raw}.json"), ("check", "s", "--database", raw * 90), (raw,),
                          ("takes", raw, "--seeds", raw, "--output", "o")):
            with self.subTest(arguments):
                done = run(*arguments, cwd=self.folder)
                self.assertEqual(2, done.returncode, done.stderr)
                said = (done.stderr + done.stdout).decode()
                self.assertFalse(set(raw[:-1]) & set(said.replace("[31m", "")) - set("[31m"), said)
                self.assertIn("\\u202e", said)
        self.assertEqual("שלום ☘ ü\\n", texts.line("שלום ☘ ü\n"))
        self.assertEqual("a\\u202eb", str(BadInput("a\u202eb")))
        done = run("x" * 100000)
        self.assertEqual(2, done.returncode)
        self.assertLess(len(done.stderr), 3000)

    def test_a_cell_of_a_table_is_no_formula(self):
        for text, shown in (("=1+1", "'=1+1"), ("@SUM(A1)", "'@SUM(A1)"), ("-x", "'-x"), ("-1.5e-3", "-1.5e-3"), ("nan", "nan"),
                            ("a=b", "a=b")):
            self.assertEqual(shown, texts.cell(text))

    def test_texts_in_html_and_xml(self):
        text = 'a<b>&"\x01\ufffe\ud800\u202e'
        self.assertEqual("a&lt;b&gt;&amp;&quot;\\x01\\ufffe\\ud800\\u202e", texts.in_html(text))
        element = ElementTree.fromstring(f"<a b={texts.in_xml(text)}/>")
        self.assertEqual('a<b>&"\\x01\\ufffe\\ud800\\u202e', element.get("b"))

    def test_a_full_disk_behind_stdout(self):
        scene = self.scene()
        for arguments in (("--help",), ("takes", "--help"), ("check", scene)):
            with self.subTest(arguments), open("/dev/full", "wb") as full:
                done = run(*arguments, stdout=full)
                self.assertEqual((1, b"waft: stdout: could not be written: No space left on device\n"), (done.returncode, done.stderr))
        done = subprocess.run(["sh", "-c", '"$0" --help >&-', WAFT], capture_output=True, check=False)
        self.assertEqual((1, b"waft: stdout: could not be written: Bad file descriptor\n"), (done.returncode, done.stderr))
        with open("/dev/full", "wb") as full:  # what is told is not the work
            self.assertEqual(0, run("new", self.folder / "new.waft.json", stderr=full).returncode)

    def test_a_reader_that_has_gone(self):
        for arguments in (("--help",), ("check", self.scene())):
            reading, writing = os.pipe()
            os.close(reading)
            done = run(*arguments, stdout=writing)
            os.close(writing)
            self.assertEqual((-signal.SIGPIPE, b""), (done.returncode, done.stderr))

    def test_empty_entries_of_lists_of_folders_are_none(self):
        trap = self.folder / "ran"
        for name in ("pathlib", "sitecustomize", "argparse", "numpy"):
            (self.folder / f"{name}.py").write_text(f"open({str(trap)!r}, 'w')\n", encoding="utf-8")
        (self.folder / "pvpython").write_text(f"#!/bin/sh\ntouch {trap}\n", encoding="utf-8")
        (self.folder / "pvpython").chmod(0o755)
        done = run("check", self.scene(), cwd=self.folder,
                   env={**os.environ, "PYTHONPATH": "/x:", "PATH": f":{os.environ['PATH']}", "LD_LIBRARY_PATH": ""})
        self.assertEqual((0, b""), (done.returncode, done.stderr))
        self.assertFalse(trap.exists())

    def test_another_python_of_the_shell_is_none_of_its_own(self):
        for name in ("base/lib/python3.11/site-packages", "path", "bin"):
            (self.folder / name).mkdir(parents=True)
        for name in ("base/lib/python3.11/site-packages/numpy.py", "path/numpy.py", "path/json.py", "path/sitecustomize.py"):
            (self.folder / name).write_text("raise ImportError('compiled by another NumPy')\n", encoding="utf-8")
        (self.folder / "bin/python3").write_text("#!/bin/sh\necho \"No module named 'tomllib'\" >&2\nexit 1\n", encoding="utf-8")
        (self.folder / "bin/python3").chmod(0o755)
        theirs = {"PYTHONHOME": "/opt/other", "PYTHONUSERBASE": str(self.folder / "base"), "PYTHONPATH": str(self.folder / "path"),
                  "PYTHONWARNINGS": "error", "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        done = run("check", self.scene(), env={**os.environ, **theirs})
        self.assertEqual((0, b""), (done.returncode, done.stderr))
        for name in ("PYTHONHOME", "PYTHONUSERBASE"):  # each hides the others
            done = run("check", self.scene(), env={**os.environ, name: theirs[name]})
            self.assertEqual((0, b""), (done.returncode, done.stderr), name)

    def test_a_working_folder_that_is_gone_is_reported(self):
        gone = self.folder / "gone"
        gone.mkdir()
        for command in ("new a.waft.json", "check a.waft.json"):
            done = subprocess.run(["sh", "-c", f'cd "$1"; rm -rf "$1"; exec "$0" {command}', WAFT, gone], capture_output=True, check=False)
            gone.mkdir()
            self.assertEqual(1, done.returncode)
            self.assertEqual("waft: the working folder is gone: expected to be called in one that is there", done.stderr.decode().splitlines()[-1])


if __name__ == "__main__":
    unittest.main(verbosity=2)
