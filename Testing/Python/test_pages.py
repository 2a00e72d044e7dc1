# SPDX-License-Identifier: BSD-3-Clause
"""What the pages say to type works: commands, Python, scenes and programs in README.md, CONTRIBUTING.md and Documentation.

    pvpython test_pages.py SOURCE BUILD         without a display

Blocks of a page run in their order, in a folder that has a small scene under the names that they fly. A command that draws,
waits or goes on for minutes is parsed; a line of usage is compared with the parser; an excerpt of a script has its calls
bound. Everything else stands in LEFT with its reason: a block that is new and none of these fails, and so does an entry
for a block that is gone.
"""
import ast
import contextlib
import functools
import glob
import inspect
import io
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
from unittest import mock

from paraview import simple

import waft
from waft import cli, synthesis

SOURCE, BUILD = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
sys.path.insert(0, str(SOURCE / "CMake"))

import describe_command  # noqa: E402

SCENE = "Data/Scenes/feather-waypoints.waft.json"
COARSE = {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 1}  # an air for tests of the course
SHORT = {"NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6}  # an optimisation, likewise

RUN = ("blender-addon", "check", "export", "info", "measure", "new", "page")  # each a second or two; the other commands are parsed
OWN = ("build", "package", "packages", "test")  # of the script `waft` alone: Python.CommandsListed calls it

FORMULA = "a formula"
BUILDS = "installs, builds or packs: CI and Install do it"
NIGHTLY = "takes minutes, and tools that a build does without"
PROJECT = "Install.Core builds it and compares it with the page"
PROJECT_OF_VTK = "a project, which Install builds and runs; it compares the texts"
EXCERPT = "an excerpt, simplified, of Data/Scenes/examples/make_examples.py, which test_examples.py runs: its calls are bound"
BY_HAND = "Python.SixStages runs it on a coarse grid, and compares what a page quotes of it"
LEFT = {
    ("README.md", "pvpython Documentation/examples/six_stages.py"): BY_HAND,
    ("CONTRIBUTING.md", "ninja -C build WaftTestGrid"): BUILDS,
    ("CONTRIBUTING.md", "cmake --preset sanitize"): NIGHTLY,
    ("CONTRIBUTING.md", "./waft package && cmake"): BUILDS,
    ("CONTRIBUTING.md", "cmake --preset tidy"): NIGHTLY,
    ("CONTRIBUTING.md", "PYTHONPATH=build/lib/python3/dist-packages xvfb-run"): "draws the pictures that Python.Render compares",
    ("Command.md", "threads = 2"): "Python.CommandOptions goes by it",
    ("Core.md", "cmake --preset core-only"): BUILDS,
    ("Core.md", "cmake_minimum_required"): PROJECT,
    ("Core.md", "#include"): PROJECT,
    ("Core.md", '{\n  "waft": 1'): PROJECT,
    ("Export.md", "import numpy; numpy.bool = bool"): "typed in Blender; Python.Blender imports animation.glb there",
    ("Hardening.md", "cd build && ctest -R Python.Bad -N"): "lists and repeats single cases of Python.BadInput",
    ("Hardening.md", "./waft test -R 'Python.Limits'"): "its second line is Python.Limits with all scenes, for minutes",
    ("Hardening.md", "apt-get install clang"): NIGHTLY,
    ("Hardening.md", "cmake --preset sanitize"): NIGHTLY,
    ("Hardening.md", "valgrind --suppressions"): NIGHTLY,
    ("Hardening.md", "./waft package && cmake"): BUILDS,
    ("HowTheAirIsFound.md", "-2 log p(a | d)"): FORMULA,
    ("HowTheAirIsFound.md", "Du/Dt = -grad p"): FORMULA,
    ("HowTheAirIsFound.md", "S2(r) = <"): FORMULA,
    ("HowTheAirIsFound.md", "(1 - e) c_k"): FORMULA,
    ("HowTheAirIsFound.md", "c_k = v_k"): FORMULA,
    ("HowTheAirIsFound.md", "given      u(x, t)"): FORMULA,
    ("HowTheAirIsFound.md", "kept = min("): FORMULA,
    ("HowTheAirIsFound.md", "u_k := c_k"): FORMULA,
    ("HowTheAirIsFound.md", "minimise  1/2 sum"): FORMULA,
    ("HowTheAirIsFound.md", "minimise over x"): FORMULA,
    ("ManyMachines.md", "mpiexec -n N waft"): "the usage; Python.Processes runs both",
    ("ManyMachines.md", "#!/bin/sh"): "scripts for a cluster's queue; Python.Processes runs them",
    ("Measure.md", "python3 Testing/Python/motion_checks.py"): "its usage; Python.MotionChecks runs it",
    ("Obstacles.md", "z = surface height"): FORMULA,
    ("Paper.md", "pvpython Documentation/scripts/paper_table.py"): "Python.SixStages runs it on a small result",
    ("Paper.md", "pvpython Documentation/scripts/paper_switches.py"): "Python.SixStages flies each switch of it on a small scene, by night",
    ("Performance.md", "python3 Testing/Python/test_scale.py"): "flies eleven scenes; Python.Scale does so at night",
    ("Performance.md", "Testing/Benchmarks/all"): "benchmarks, for an hour",
    ("Performance.md", "Testing/Benchmarks/growth"): "flights of all sizes, for hours",
    ("Pipeline.md", "pvpython Documentation/examples/six_stages.py"): BY_HAND,
    ("RotationRefineFilter.md", "X = F a b^2"): FORMULA,
    ("RotationRefineFilter.md", "w = v + D r"): FORMULA,
    ("RotationRefineFilter.md", "dF = -1/2 cd"): FORMULA,
    ("RotationRefineFilter.md", "F_c = 1/2 C"): FORMULA,
    ("RotationRefineFilter.md", "dP/dt = s ("): FORMULA,
    ("SPHSpacetimeFilter.md", "frames (2 F + R)"): FORMULA,
    ("SPHSpacetimeTheory.md", "E = c1 Ex"): FORMULA,
    ("SPHSpacetimeTheory.md", "rx = x' - x"): FORMULA,
    ("SPHSpacetimeTheory.md", "W = sigma q^4"): FORMULA,
    ("SPHSpacetimeTheory.md", "a_o += - g' z"): FORMULA,
    ("SPHSpacetimeTheory.md", "E(c) = sum c2 m"): FORMULA,
    ("SPHSpacetimeTheory.md", "w = v - (U("): FORMULA,
    ("Systems.md", "docker build"): "builds an image on the network; Testing/Systems builds in bare roots",
    ("Systems.md", "Testing/Systems/run"): "a bare root each, on the network, for half an hour",
    ("Takes.md", "seed  outcome"): "what `waft takes` prints; Python.Takes compares the form",
    ("Takes.md", "#!/bin/sh"): "a script for a cluster's queue; its command is parsed",
    ("UserGuide.md", "cmake -S . -B build"): BUILDS,
    ("UserGuide.md", "plan = simple.StylisticPlannerFilter("): BY_HAND,
    ("UserGuide.md", "from waft.render import render"): "draws, which takes a display; Python.Render does",
    ("UseFromCpp.md", "cmake_minimum_required"): PROJECT_OF_VTK,
    ("UseFromCpp.md", "#include"): PROJECT_OF_VTK,
    ("VortexFitFilter.md", "f(x, t) = exp("): FORMULA,
    ("VortexFitFilter.md", "minimise  sum_i"): FORMULA,
    ("bubbles-curve.md", "for number, bubble in"): EXCERPT,
    ("feather-hand.md", "hand = scene.add_mesh("): EXCERPT,
    ("leaves-gate.md", "scene.add_box("): EXCERPT,
    ("paper-desk.md", "scene.add_shape("): EXCERPT,
    ("petals-logo.md", "scene.add_shape("): EXCERPT,
    ("snow-name.md", "scene.add_shape("): EXCERPT,
}


def pages():
    return [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md"] + [
        pathlib.Path(name) for name in sorted(glob.glob(str(SOURCE / "Documentation" / "**" / "*.md"), recursive=True))]


def blocks(text):
    """(number of its first line, language, text) of each block of code; "" is the language of an indented one."""
    lines = text.splitlines()
    number = 0
    while number < len(lines):
        first, number = number, number + 1
        if lines[first].startswith("```"):
            while not lines[number].startswith("```"):
                number += 1
            yield first + 2, lines[first][3:] or "text", "\n".join(lines[first + 1:number])
            number += 1
        elif lines[first].startswith("    ") and (first == 0 or not lines[first - 1].strip()):
            while number < len(lines) and (lines[number].startswith("    ") or not lines[number].strip()):
                number += 1
            yield first + 1, "", textwrap.dedent("\n".join(lines[first:number])).strip()


def command_lines(text):
    """The lines of a block as they are typed: without comments, and what is indented put to the line above."""
    joined = re.sub(r"\s*\\?\n[ \t]+", " ", text)
    return [line for line in (re.sub(r"\s+# .*", "", line).strip() for line in joined.splitlines()) if line]


def is_command(line):
    return re.match(r"(\./)?waft [a-z-]+( |$)", line) is not None


def is_usage(words):
    return any("[" in word or "$" in word or word.split(".")[0] in ("SCENE", "DIR", "FILE") for word in words)


@functools.lru_cache(None)
def known():
    return {command.name: command for command in describe_command.commands(cli.parser())}


@functools.lru_cache(None)
def names_of_tests():
    listed = json.loads(subprocess.check_output(["ctest", "--show-only=json-v1"], cwd=BUILD, text=True))
    return [(test["name"], next((entry["value"] for entry in test["properties"] if entry["name"] == "LABELS"), []))
            for test in listed["tests"]]


class PagesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.small = waft.Scene("A feather past a mark", seed=3)
        cls.small.set_time(46)
        cls.small.add_shape("feather", "feather", size=0.25, settling_speed=0.35)
        cls.small.add_object("feather", (0, 0, 2.5))
        cls.small.add_position(0, 36, (0.1, 0.1, 2.2), radius=0.2)
        flown = tempfile.TemporaryDirectory()
        cls.addClassCleanup(flown.cleanup)
        cls.flown = pathlib.Path(flown.name, "out")
        waft.synthesize(cls.small, output=cls.flown, quality="air")
        presets = json.loads((SOURCE / "CMakePresets.json").read_text(encoding="utf-8"))
        cls.presets = {preset["name"] for kind in ("configurePresets", "testPresets") for preset in presets[kind]}

    def folder(self):
        """A folder to be in, with the scene under each name that a page flies, and a result."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        os.makedirs(os.path.dirname(SCENE))
        for name in (SCENE, "feather.waft.json"):
            self.small.save(name)
        shutil.copytree(self.flown, "out")

    def waft(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = cli.main(list(words))
        self.assertEqual(0, status, said.getvalue())

    def usage(self, words):
        """Options of a line of usage are the parser's, and so are their choices where it lists them."""
        command = known()[words[0]]
        options = {name: option for option in command.options for name in option.option_strings}
        for name, choices in re.findall(r"(--[a-z-]+)(?: ([\w|]+))?", " ".join(words[1:])):
            self.assertIn(name, options)
            if "|" in choices:
                self.assertEqual(list(options[name].choices), choices.split("|"), name)

    def chosen_tests(self, words):
        """Each of the patterns that the line chooses tests by finds one."""
        for option, pattern in zip(words, words[1:]):
            for part in pattern.split("|") if option in ("-R", "-L") else ():
                self.assertTrue(any(re.search(part, text) for name, labels in names_of_tests()
                                    for text in ([name] if option == "-R" else labels)), part)

    def command(self, line, runs):
        for name in re.findall(r"(?<![\w/.-])(?:Data|Documentation|Testing)/[\w./-]+", line):
            self.assertTrue((SOURCE / name).exists(), name)
        words = shlex.split(line)[1:]
        if words[0] in OWN:
            self.chosen_tests(words)
        elif is_usage(words):
            self.usage(words)
        elif runs and (words[0] in RUN or words[0] == "synthesize" and SCENE in words):
            self.waft(*words)
        else:
            cli.parser().parse_args(words)

    def excerpt(self, text):
        """Calls of a scene's methods have the arguments that these take."""
        for call in ast.walk(ast.parse(text)):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and ast.unparse(call.func.value) == "scene":
                inspect.signature(getattr(waft.Scene, call.func.attr)).bind(
                    None, *call.args, **{keyword.arg: keyword.value for keyword in call.keywords})

    def left(self, page, text):
        """The entry of LEFT for a block, None where there is none."""
        return next((key for key in LEFT if key[0] == page.name and text.startswith(key[1])), None)

    def try_block(self, language, text, names):
        if language == "json":
            pathlib.Path("page.waft.json").write_text(text, encoding="utf-8")
            self.waft("check", "page.waft.json")
        elif language == "python" or text.startswith(("from paraview", "smoke = ")):
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(text, "page", "exec"), names)
        elif language == "" and all(map(is_command, command_lines(text))):
            for line in command_lines(text):
                self.command(line, True)
        else:
            self.fail("neither tried nor left with a reason")

    def test_blocks(self):
        found = set()
        for page in pages():
            text = page.read_text(encoding="utf-8")
            self.folder()
            names = {**vars(simple), "waft": waft, "simple": simple}
            for number, language, block in blocks(text):
                with self.subTest(page=page.name, line=number):
                    key = self.left(page, block)
                    if key is None:
                        self.try_block(language, block, names)
                        continue
                    found.add(key)
                    if LEFT[key] == EXCERPT:
                        self.excerpt(block)
                    for line in command_lines(block) if LEFT[key] != BUILDS else ():
                        for command in re.findall(r"(?:\./waft|exec waft) [^&]+", line):
                            self.command(command.removeprefix("exec "), False)
                        for preset in re.findall(r"--preset (\S+)", line):
                            self.assertIn(preset, self.presets)
        self.assertEqual(set(LEFT), found)

    def test_commands_within_sentences(self):
        count = 0
        for page in pages():
            for line in re.findall(r"`((?:\./)?waft [a-z][^`]*)`", page.read_text(encoding="utf-8")):
                line = " ".join(line.split())
                with self.subTest(page=page.name, line=line):
                    words = shlex.split(line)[1:]
                    self.assertIn(words[0], {*known(), *OWN})
                    if words[0] in OWN:
                        self.chosen_tests(words)
                    else:
                        self.usage(words)
                    count += 1
        self.assertGreater(count, 50)

    def test_what_is_found(self):
        text = "A:\n\n    ./waft check a  # b\n\n    ./waft x \\\n      y\n\n```python\nz\n```\n"
        self.assertEqual([(3, "", "./waft check a  # b\n\n./waft x \\\n  y"), (9, "python", "z")], list(blocks(text)))
        self.assertEqual(["./waft check a", "./waft x y"], command_lines(list(blocks(text))[0][2]))
        for block in ("int main() {}", "make coffee"):
            with self.assertRaises(AssertionError):
                self.try_block("cpp" if "main" in block else "", block, {})
        for wrong in ("./waft measure DIR [--tracks optimized|poses]", "./waft measure DIR [--track poses]",
                      "./waft test -R NoSuch", "./waft render out --style none", "./waft page out --measure Data/none"):
            with self.assertRaises((AssertionError, SystemExit)), contextlib.redirect_stderr(io.StringIO()):
                self.command(wrong, False)


def main():
    os.environ.pop("DISPLAY", None)
    from waft.loading import load_plugin

    load_plugin()
    short = functools.partial(waft.synthesize, _settings={"Assimilation": COARSE, "Spacetime": SHORT})
    with mock.patch.object(waft, "synthesize", short), mock.patch.object(synthesis, "synthesize", short):
        unittest.main(argv=sys.argv[:1])


if __name__ == "__main__":
    main()
