# SPDX-License-Identifier: BSD-3-Clause
"""The package where only the plugin was loaded: by PV_PLUGIN_PATH, or by LoadPlugin in a shell that knows nothing of Waft.

    python3 test_plugin_alone.py PVPYTHON PLUGINS_FOLDER PACKAGE_FOLDER"""
import os
import pathlib
import subprocess
import sys
import unittest

PVPYTHON, PLUGINS, PACKAGE = sys.argv[1:4]
LOOK = """
import waft
from waft import vtkSPHSpacetimeFilter
from paraview import simple
print(waft.__file__, vtkSPHSpacetimeFilter().GetClassName(), callable(waft.show), callable(simple.WaftAnimation))
"""
LOAD = """
try:
    import waft
    print("it is there before")
except ImportError:
    pass
from paraview import simple
simple.LoadPlugin({!r}, remote=False, ns=globals())
"""


class PluginAloneTest(unittest.TestCase):
    def look(self, script, **environment):
        clean = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PV_PLUGIN_PATH")}
        done = subprocess.run([PVPYTHON, "-c", script], env={**clean, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(done.stdout.strip(),
                         f"{pathlib.Path(PACKAGE).resolve() / '__init__.py'} vtkSPHSpacetimeFilter True True")

    def test_by_the_plugins_path(self):
        self.look(LOOK, PV_PLUGIN_PATH=PLUGINS)

    def test_by_load_plugin(self):
        self.look(LOAD.format(str(pathlib.Path(PLUGINS) / "Waft" / "Waft.so")) + LOOK)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
