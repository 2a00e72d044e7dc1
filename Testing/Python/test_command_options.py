# SPDX-License-Identifier: BSD-3-Clause
"""What the command says, and where: -q, -v, --log, --json; and what a user says once for all: waft.toml and WAFT_*.

    test_command_options.py WAFT SOURCE       WAFT: the command of the build or of an installed tree
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

WAFT = sys.argv.pop(1)
SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(pathlib.Path(WAFT).resolve().parents[1] / "lib/python3/dist-packages"))

from waft import marks  # noqa: E402
from waft.run.takes import fly_takes  # noqa: E402
from waft.scene import _schema  # noqa: E402

ANSWERS = json.loads((SOURCE / "Documentation" / "command.schema.json").read_text(encoding="utf-8"))
SCENE = {
    "waft": 1, "title": "Two leaves", "time": {"frames": 31}, "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "positions": [[-0.6, -0.5, 2.6], [0.6, 0.4, 2.8]]}],
    "obstacles": [{"kind": "sphere", "center": [0.9, -0.9, 1.5], "radius": 0.3}],
    "constraints": [{"kind": "position", "object": 0, "frame": 30, "value": [-0.5, -0.4, 2.4]},
                    {"kind": "position", "object": 1, "frame": 20, "value": [0.9, -0.9, 1.5]}],
}
MESSAGE = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z (error  |warning|note   |detail |record ) \S.*")


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.home = self.folder / "home"
        (self.home / ".config").mkdir(parents=True)

    def scene(self, name="scene.waft.json", **changed):
        (self.folder / name).write_text(json.dumps({**SCENE, **changed}), encoding="utf-8")
        return name

    def run_waft(self, *arguments, status=0, **variables):
        kept = {name: value for name, value in os.environ.items() if not name.startswith(("WAFT_", "XDG_"))}
        environment = {**kept, "WAFT_CACHE": str(self.folder / "cache"), "HOME": str(self.home), **variables}
        done = subprocess.run([WAFT, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False, env=environment)
        self.assertEqual(status, done.returncode, done.stderr)
        return done

    def document(self, done):
        document = json.loads(done.stdout)
        with mock.patch.object(_schema, "schema", lambda: ANSWERS):
            self.assertIsNone(_schema.fault(document, ANSWERS, ""))
        self.assertEqual(done.returncode, document["status"])
        return document

    def log(self, name="run.log"):
        """The messages of a log that is whole, as (kind, words)."""
        first, *lines, last = (self.folder / name).read_text(encoding="utf-8").splitlines()
        self.assertRegex(first, r"^waft \d+\.\d+\.\d+: waft ")
        self.assertTrue(marks.is_marked_text(self.folder / name), last)
        for line in lines:
            self.assertRegex(line, MESSAGE)
        return [(line.split()[1], line.split(maxsplit=2)[2]) for line in lines]


class Said(Case):
    def test_as_much_as_is_asked_for(self):
        shown = "one.waft.json: 60 objects"
        self.assertIn(shown, self.run_waft("new", "one.waft.json").stderr)
        self.assertEqual("", self.run_waft("new", "two.waft.json", "-q", "--log", "run.log").stderr)
        self.assertIn(("note", "two.waft.json: 60 objects"), [(kind, words[:25]) for kind, words in self.log()])
        self.assertIn("two.waft.json", self.run_waft("new", "two.waft.json", "--quiet", status=2).stderr, "errors are shown")
        self.assertIn("not allowed with", self.run_waft("new", "three.waft.json", "-q", "-v", status=2).stderr)

    def test_a_check_in_full_and_its_log(self):
        scene = self.scene()
        plain = self.run_waft("check", scene, "-q", status=3)
        self.assertEqual("", plain.stderr)
        told = self.run_waft("check", scene, "-v", "--log", "run.log", status=3)
        self.assertEqual(plain.stdout, told.stdout)
        messages = self.log()
        self.assertEqual(told.stderr.splitlines(), [words for kind, words in messages if kind != "record"])
        self.assertEqual(told.stdout.splitlines(), [words for kind, words in messages if kind == "record"][:-1])
        self.assertEqual(("record", "waft: ends with status 3"), messages[-1])

    def test_what_a_log_may_replace(self):
        scene = self.scene()
        path = self.folder / "run.log"
        self.run_waft("info", scene, "--log", "run.log")
        first = path.read_bytes()
        self.run_waft("info", scene, "--log", "run.log", "--json")
        self.assertNotEqual(first, path.read_bytes(), "of the second command")
        log = path.read_bytes()
        for content in (b"mine", b"", log + b"a note\n", log.replace(b"info", b"inf0"), log[:log.rindex(b"written by")]):
            path.write_bytes(content)
            for command in ("info", "check"):
                done = self.run_waft(command, scene, "--log", "run.log", status=2)
                self.assertIn("run.log: Waft did not write it, or it was changed since, and stays as it is", done.stderr)
                self.assertEqual(("", content), (done.stdout, path.read_bytes()))
        path.unlink()
        path.symlink_to(self.folder / scene)
        self.run_waft("info", scene, "--log", "run.log", status=2)
        self.run_waft("info", scene, "--log", scene, status=2)
        self.run_waft("info", scene, "--log", "none/run.log", status=2)
        self.run_waft("info", scene, "--log", ".", status=2)
        self.assertEqual(SCENE, json.loads((self.folder / scene).read_text(encoding="utf-8")))
        self.assertEqual({scene, "run.log", "home"}, set(os.listdir(self.folder)) - {"cache"})

    def test_errors_and_names_in_a_log(self):
        done = self.run_waft("check", "\u202egone\n.json", "--log", "run.log", status=2)
        self.assertEqual([("error", done.stderr.strip()), ("record", "waft: ends with status 2")], self.log())
        self.assertIn("\\u202egone\\n.json", (self.folder / "run.log").read_text(encoding="utf-8").splitlines()[0])

    def test_a_log_on_a_full_disk(self):
        """A limit on the size of files stands for it."""
        limited = ("import resource, sys; from waft import cli; import waft.results.describing, waft.scene.describing; cli.parser(); "
                   "resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024)); sys.exit(cli.main(sys.argv[1:]))")

        def info(scene, *options):
            return subprocess.run([sys.executable, "-B", "-c", limited, "info", scene, "--log", "run.log", *options], cwd=self.folder,
                                  capture_output=True, text=True, check=False, env={**os.environ, "PYTHONPATH": sys.path[0]})
        scene = self.scene(shapes={"leaf": {"builtin": "leaf"}, **{f"s{n}": {"mesh": f"gone{n}.obj"} for n in range(60)}})
        done = info(scene, *["-q"] * 600)
        self.assertEqual((1, "waft: run.log: could not be written: File too large\n"), (done.returncode, done.stderr))
        self.assertFalse((self.folder / "run.log").exists())
        done = info(scene)
        self.assertEqual((0, "waft: warning: nothing more is written to the log: File too large\n"), (done.returncode, done.stderr))
        self.assertIn("gone59.obj: no such file", done.stdout)
        self.assertFalse(marks.is_marked_text(self.folder / "run.log"))

    def test_a_stop_is_in_the_log_and_in_the_document(self):
        scene = self.scene()
        child = subprocess.Popen([WAFT, "synthesize", scene, "--output", "out", "--log", "run.log", "--json"], cwd=self.folder, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, "WAFT_CACHE": str(self.folder)})
        while not (self.folder / "run.log").exists():
            self.assertIsNone(child.poll())
        child.send_signal(signal.SIGTERM)
        stdout, stderr = child.communicate()
        self.assertEqual(4, child.returncode, stderr)
        self.assertIn("stopped", self.document(subprocess.CompletedProcess([], 4, stdout, stderr))["error"])
        kinds = self.log()
        self.assertEqual(("error", stderr.strip()), kinds[-2])
        self.assertEqual(("record", "waft: ends with status 4"), kinds[-1])


class Answers(Case):
    def test_errors_are_documents(self):
        self.scene("bad.waft.json", objects=[])
        for arguments in (("check", "none.waft.json"), ("check", "bad.waft.json"), ("synthesize", "bad.waft.json", "--output", "out"),
                          ("page", "none"), ("render", "none"), ("info", "none")):
            with self.subTest(arguments):
                done = self.run_waft(*arguments, "--json", "-q", status=2)
                self.assertEqual(done.stderr, f"waft: {self.document(done)['error']}\n")
        done = self.run_waft("check", "--json", status=2)
        self.assertEqual("", done.stdout)
        for more in (("--watch",), ("--progress", "json")):
            self.assertIn("--json: expected neither", self.run_waft("synthesize", "s", "--output", "o", "--json", *more, status=2).stderr)

    def test_a_flight_by_settings_its_check_its_page_and_its_pictures(self):
        scene = self.scene()
        (self.home / ".config" / "waft.toml").write_text('threads = 1\nquality = "paper"\noutput = "flown"\n', encoding="utf-8")
        done = self.run_waft("synthesize", scene, "--json", status=3, WAFT_QUALITY="preview")
        held = self.document(done)["result"]
        self.assertEqual(("flown", "preview", 1), (held["folder"], held["quality"], held["constraints"]["infeasible"]))
        taken = {"threads": {"value": 1, "from": "waft.toml"}, "quality": {"value": "preview", "from": "WAFT_QUALITY"},
                 "output": {"value": "flown", "from": "waft.toml"}}
        self.assertEqual(taken, held["defaults"])
        self.assertEqual(taken, json.loads((self.folder / "flown" / "report.json").read_text(encoding="utf-8"))["defaults"])
        for words in ("threads 1, by waft.toml", "quality preview, by WAFT_QUALITY", "row 1 target 0", "1 of 2 constraints met"):
            self.assertIn(words, done.stderr)
        info = self.document(self.run_waft("info", "flown", "--json"))["result"]
        self.assertEqual(held, info)
        self.assertTrue(info["whole"] and info["goesOn"]["edit"]["possible"])

        found = self.document(self.run_waft("check", scene, "--json", status=3))
        self.assertEqual((scene, 2, 2), (found["scene"], found["objects"], found["constraints"]))
        lost = [finding for finding in found["findings"] if not finding["possible"]]
        self.assertEqual([(1, 0)], [(finding["row"], finding["target"]) for finding in lost])
        self.assertIsInstance(lost[0]["frame"], int)
        self.assertEqual(3, len(lost[0]["place"]))

        drawn = self.document(self.run_waft("render", "flown", "--frames", "0:20:20", "--size", "64x48", "--views", "side", "--json"))
        self.assertEqual(["frames/side_0000.png", "frames/side_0020.png"], drawn["files"])
        page = self.run_waft("page", "flown", "--json", "-q")
        shown = self.document(page)
        self.assertEqual(("flown/page.html", ""), (shown["page"], page.stderr))
        self.assertEqual(shown["bytes"], (self.folder / "flown" / "page.html").stat().st_size)
        commands = {file["name"]: file["command"] for file in self.document(self.run_waft("info", "flown", "--json"))["result"]["files"]}
        self.assertEqual(("page", "render"), (commands["page.html"], commands["frames/"]))


class Settings(Case):
    def settings(self, text, folder=".config"):
        (self.home / folder).mkdir(exist_ok=True)
        (self.home / folder / "waft.toml").write_text(text, encoding="utf-8")

    def said(self, *arguments, **variables):
        """What a flight of a scene that is not there says, a line each but for that."""
        lines = self.run_waft("synthesize", "s.waft.json", *arguments, status=2, **variables).stderr.splitlines()
        return [line for line in lines if line != "waft: s.waft.json: no such scene file"]

    def test_who_goes_before_whom(self):
        self.assertEqual([], self.said("--output", "o"))
        self.settings('# mine\nquality = "assimilated"\noutput = "there"\nthreads = 3\n')
        by_file = {f"waft: {words}, by waft.toml" for words in ("quality air", "output there", "threads 3")}
        self.assertEqual(by_file, set(self.said()))
        self.assertEqual({"waft: output there, by waft.toml", "waft: threads 5, by WAFT_THREADS"},
                         set(self.said("--preview", WAFT_THREADS="5", WAFT_QUALITY="paper", WAFT_OUTPUT="")))
        self.assertEqual([], self.said("--output", "o", "--quality", "full", "--threads", "2", WAFT_THREADS="5"))
        self.assertEqual([], self.said("--output", "o", WAFT_DEFAULTS="off", WAFT_THREADS="5"))
        self.settings("threads = 7\n", "elsewhere")
        self.assertEqual(["waft: threads 7, by waft.toml"], self.said("--output", "o", XDG_CONFIG_HOME=str(self.home / "elsewhere")))
        self.assertEqual(by_file, set(self.said(XDG_CONFIG_HOME="elsewhere")), "no whole path: ignored")
        self.assertEqual([], self.said("--output", "o", HOME=""))

    def test_what_is_wrong_is_refused_by_file_line_and_key(self):
        where = re.escape(str(self.home / ".config" / "waft.toml"))
        for text, words in (
                ("threads = 2\nquality = 'fast'\n", "line 2: quality: expected one of preview, air, full, paper, found 'fast'"),
                ("\nthreads = 0", "line 2: threads: expected a whole number from 1 to 1024, found '0'"),
                ("threads = '4'", "line 1: threads: expected a whole number, found '4'"),
                ("threads = true", "line 1: threads: expected a whole number, found true"),
                ("threads = 2.5", "line 1: threads: expected a whole number, found 2.5"),
                ("# a\n\n'output' = 7", "line 3: output: expected a text in quotes, found 7"),
                ("output = ''", "line 1: output: expected a path"),
                ("threads = 1\nseed = 7", "line 2: seed: expected one of threads, quality, output, found a key of another name"),
                ("threads = 1\n[synthesize]\nthreads = 2", "line 2: synthesize: expected one of"),
                ("threads = 1\na.b = 2", "line 2: a: expected one of"),
                ("quality = [\n'full',\n]", "line 1: quality: expected a text in quotes, found [ 'full' ]"),
                ("quality = 1979-05-27", "line 1: quality: expected a text in quotes, found 1979-05-27"),
                ("threads = 1\nquality = preview\n", "line 2: quality: expected TOML such as quality = \"preview\": Error while parsing"),
                ("threads = 1\nthreads = 2\n", "line 2: threads: expected TOML"),
                ("threads", "line 1: threads: expected TOML"),
                ("# " + "x" * 20000, "expected a file of at most 16384 bytes")):
            with self.subTest(text[:40]):
                self.settings(text)
                self.assertRegex(self.said("--output", "o")[0], f"^waft: {where}: {re.escape(words)}")
        (self.home / ".config" / "waft.toml").write_bytes(b"quality = '\xff'\n")
        self.assertRegex(self.said("--output", "o")[0], f"^waft: {where}: line 1: quality: expected TOML.*utf-8")
        for make in (os.mkfifo, os.mkdir):
            (self.home / "odd").mkdir(exist_ok=True)
            make(self.home / "odd" / "waft.toml")
            said = self.said("--output", "o", XDG_CONFIG_HOME=str(self.home / "odd"))
            self.assertRegex(said[0], "odd/waft.toml: expected a file of TOML, found a (pipe|folder)")
            shutil.rmtree(self.home / "odd")
        self.settings("")
        for name, value, words in (("WAFT_THREADS", "many", "expected a whole number from 1 to 1024, found 'many'"),
                                   ("WAFT_QUALITY", "fast", "expected one of preview, air, full, paper, found 'fast'")):
            self.assertEqual([f"waft: {name}: {words}"], self.said("--output", "o", **{name: value}))
        self.assertIn("expected --output DIR, the variable WAFT_OUTPUT, or output in", self.said()[0])

    def test_it_is_refused_at_once_and_asked_of_flights_alone(self):
        self.settings("speed = 3\n")
        scene = self.scene()
        done = self.run_waft("synthesize", scene, "--output", "out", "--json", status=2, PATH="")
        self.assertIn("waft.toml: line 1: speed: expected one of", done.stderr)
        self.assertIn("speed", self.document(done)["error"])
        self.assertFalse((self.folder / "out").exists())
        self.run_waft("synthesize", "--help", PATH="")
        self.run_waft("info", scene, PATH="")
        self.run_waft("new", "more.waft.json", PATH="")

    def test_takes_do_without(self):
        self.settings("speed = 3\n")
        self.scene(constraints=[{"kind": "position", "object": 0, "frame": 31, "value": [0, 0, 2]}])  # which a flight alone finds
        with mock.patch.dict(os.environ, {"HOME": str(self.home), "WAFT_THREADS": "many"}):
            os.environ.pop("WAFT_DEFAULTS", None)
            said = []
            status, _ = fly_takes(str(self.folder / "scene.waft.json"), [1], str(self.folder / "takes"), "preview", log=said.append)
        self.assertEqual(2, status)
        self.assertRegex(" ".join(said), "/constraints/0/frame")


if __name__ == "__main__":
    unittest.main()
