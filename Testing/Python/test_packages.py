# SPDX-License-Identifier: BSD-3-Clause
"""The packages within the package waft: modules by the names that they had before, and what the command may load before ParaView.

    python3 test_packages.py MODULES         MODULES: the folder with the package waft
"""
import importlib
import subprocess
import sys
import unittest

MODULES = sys.argv[1]
sys.path.insert(0, MODULES)
FORMER = {"blenderaddon": "cli", "cleaning": "results", "repeating": "run", "starting": "scene", "store": "results", "takes": "run"}


class Packages(unittest.TestCase):
    def test_a_module_has_its_former_name_too(self):
        for name, package in FORMER.items():
            with self.subTest(name):
                module = importlib.import_module(f"waft.{name}")
                self.assertIs(importlib.import_module(f"waft.{package}.{name}"), module)
                self.assertEqual(f"waft.{package}.{name}", module.__name__)
                self.assertIs(getattr(importlib.import_module("waft"), name), module)

    def test_names_of_packages(self):
        from waft.cli import main
        from waft.results import ResultPlace
        from waft.scene import Scene

        self.assertEqual(("main", "ResultPlace", "Scene"), (main.__name__, ResultPlace.__name__, Scene.__name__))
        import waft.render
        with self.assertRaisesRegex(AttributeError, "module 'waft.render' has no attribute 'Stages'"):
            waft.render.Stages

    def test_the_command_is_read_without_vtk(self):
        told = subprocess.run([sys.executable, "-c", "import sys, waft.cli, waft.takes; waft.cli.parser(); "
                               "print([name for name in sys.modules if name.startswith(('paraview', 'vtk', 'numpy'))])"],
                              check=True, capture_output=True, text=True, env={"PYTHONPATH": MODULES}).stdout
        self.assertEqual("[]\n", told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
