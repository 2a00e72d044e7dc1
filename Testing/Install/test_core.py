# SPDX-License-Identifier: BSD-3-Clause
"""A project of somebody else flies a feather with the Core of an installed Waft, without VTK.

    python3 test_core.py BUILD SOURCE WORK [options of cmake...]"""

import math
import os
import re
import shutil
import subprocess
import sys
import textwrap
import unittest

BUILD, SOURCE, WORK = (os.path.realpath(path) for path in sys.argv[1:4])
OPTIONS = sys.argv[4:]
PROJECT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "Core")
PREFIX = os.path.join(WORK, "moved")
OWN = os.path.join(WORK, "build")


def run(*command):
    done = subprocess.run(command, cwd=WORK, text=True, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def run_well(*command):
    status, text = run(*command)
    if status != 0:
        raise RuntimeError(text)
    return text


def configure(source, build):
    return run("cmake", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={PREFIX}", "-DCMAKE_BUILD_TYPE=Release", *OPTIONS)


class CoreTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        first = os.path.join(WORK, "prefix")
        run_well("cmake", "--install", BUILD, "--prefix", first)
        os.rename(first, PREFIX)  # what works after a move does not lean on the place that it was installed to
        status, text = configure(PROJECT, OWN)
        if status != 0:
            raise RuntimeError(text)
        run_well("cmake", "--build", OWN)

    def fly(self, *database):
        status, text = run(os.path.join(OWN, "fly-feather"), os.path.join(PROJECT, "feather-box.waft.json"), *database)
        self.assertEqual(status, 0, text)
        reported = re.fullmatch(r"mark 0: met, at +(\S+) +(\S+) +(\S+)\n", text)
        self.assertIsNotNone(reported, text)
        self.assertLess(math.dist(map(float, reported.groups()), (0.7, 0.1, 1.1)), 0.021)

    def test_flies_with_the_database_that_comes_along(self):
        if not os.path.isfile(os.path.join(PREFIX, "share", "waft", "Database", "embedded.motions")):
            self.skipTest("a build of Core alone has no reader of it")
        self.fly()

    def test_flies_with_a_database_of_its_own(self):
        database = os.path.join(WORK, "own.motions")
        run_well(os.path.join(OWN, "make-database"), database)
        self.fly(database)

    def test_a_file_that_is_no_database_is_refused(self):
        scene = os.path.join(PROJECT, "feather-box.waft.json")
        status, text = run(os.path.join(OWN, "fly-feather"), scene, scene)
        self.assertEqual(status, 1)
        self.assertIn(f"{scene}: expected a motion database", text)

    def test_another_component_is_refused_in_words(self):
        source = os.path.join(WORK, "other")
        os.makedirs(source)
        with open(os.path.join(source, "CMakeLists.txt"), "w", encoding="utf-8") as file:
            file.write("cmake_minimum_required(VERSION 3.18)\nproject(Other LANGUAGES C CXX)\nfind_package(Waft REQUIRED COMPONENTS Cor)\n")
        status, text = configure(source, os.path.join(source, "build"))
        self.assertNotEqual(status, 0)
        self.assertIn("Core or Run, found: Cor", " ".join(text.split()))

    def test_the_page_shows_this_program(self):
        with open(os.path.join(SOURCE, "Documentation", "Core.md"), encoding="utf-8") as file:
            page = file.read()
        for name in ("CMakeLists.txt", "fly_feather.cxx", "feather-box.waft.json"):
            with open(os.path.join(PROJECT, name), encoding="utf-8") as file:
                text = re.sub(r"\A(?:(?://|#) .*\n)+", "", file.read())
            self.assertIn(textwrap.indent(text, "    "), page, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
