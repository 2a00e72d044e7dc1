# SPDX-License-Identifier: BSD-3-Clause
"""Installs the .deb into a root of Debian that has nothing else, and uses it there as a user does.

    python3 test_package.py BUILD WORK       as root; exit status 77 (skipped) where that cannot be

debootstrap makes the root, from the archive that this machine's own list of sources names: some 2 GB in WORK, and some
minutes. A root that is there already is taken as it is; Waft is installed into it anew.
"""
import os
import pathlib
import re
import shutil
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Systems"))
import bare_root  # noqa: E402

# What ParaView made known by itself, in a process that was told nothing of Waft.
AUTOLOAD = """
from paraview import servermanager, simple
plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
for i in range(plugins.GetNumberOfPlugins()):
    print(plugins.GetPluginName(i), plugins.GetPluginVersion(i), plugins.GetPluginFileName(i))
simple.StylisticPlannerFilter
import waft
print("package", waft.__version__, waft.__file__)
from waft import vtkSPHSpacetimeFilter
"""


def lack():
    """Why the package cannot be tried here; empty when it can."""
    if PACKAGE is None:
        return f"there is no waft_*.deb in {sys.argv[1]} (./waft package makes it)"
    return bare_root.lack()


class PackageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = cls.enterClassContext(bare_root.BareRoot(ROOT, bare_root.codename()))
        shutil.copy(PACKAGE, ROOT / "tmp" / PACKAGE.name)
        cls.root.run("apt-get update -q && apt-get purge -y -q waft || true")
        status, text = cls.root.run(f"apt-get install -y -q --no-install-recommends /tmp/{PACKAGE.name}")
        if status != 0:
            raise RuntimeError(text)

    def check_run(self, command):
        status, text = self.root.run(command)
        self.assertEqual(status, 0, text)
        self.assertIsNone(re.search(r"ERR\||FATL\||Traceback", text), text)
        return text

    def test_the_command_tells_its_version(self):
        version = PACKAGE.name.split("_")[1]
        self.assertEqual(self.check_run("waft --version"), f"waft {version}\n")
        self.assertIn(version, self.check_run("dpkg-query -W waft"))

    def test_flies_a_scene_of_its_own(self):
        self.check_run("cd /tmp && rm -rf own* && waft new own.waft.json --text I --count 3 && "
                       "waft synthesize own.waft.json --output own --preview --threads 1; test $? -eq 0 -o $? -eq 3")
        for name in ("poses.csv", "animation.glb", "report.json"):
            self.assertTrue((ROOT / "tmp/own" / name).is_file(), name)
        self.check_run("cd /tmp && waft render own --frames 0:0:1 --size 160x90 --loop && waft page own")
        self.assertGreater((ROOT / "tmp/own/page.html").stat().st_size, 100000)

    def test_paraview_finds_the_plugin_by_itself(self):
        (ROOT / "tmp/autoload.py").write_text(AUTOLOAD, encoding="utf-8")
        for program in ("pvpython", "pvbatch"):
            text = self.check_run(f"{program} /tmp/autoload.py")
            self.assertRegex(text, r"Waft \S+ /usr/bin/plugins/Waft/Waft\.so")
            self.assertIn("/usr/lib/python3/dist-packages/waft/__init__.py", text)

    def test_the_window_has_the_plugin(self):
        text = self.check_run("PARAVIEW_LOG_PLUGIN_VERBOSITY=INFO xvfb-run -a -s '-screen 0 1280x1024x24' paraview --dr --exit 2>&1")
        self.assertRegex(text, r"Importing plugin: \*\*Waft\*\*")

    def test_manual_completion_and_addon_came_along(self):
        for path in ("man/man1/waft.1", "bash-completion/completions/waft", "zsh/vendor-completions/_waft", "doc/waft/copyright",
                     "doc/waft/Documentation/scene.schema.json", "blender/scripts/addons/waft_addon/__init__.py"):
            self.assertTrue((ROOT / "usr/share" / path).is_file(), path)
        self.assertTrue((ROOT / "usr/include/waft/vtkMotionSceneReader.h").is_file())

    def test_removing_it_leaves_nothing(self):
        self.addCleanup(self.root.run, f"apt-get install -y -q --no-install-recommends /tmp/{PACKAGE.name}")
        self.check_run("apt-get purge -y -q waft")
        self.assertEqual(self.check_run("find / -xdev -ipath '*waft*' -not -path '/tmp/*' -not -path '/var/*' -not -path '/proc/*'"), "")


if __name__ == "__main__":
    PACKAGE = max(pathlib.Path(sys.argv[1]).resolve().glob("waft_*.deb"), key=os.path.getmtime, default=None)
    ROOT = pathlib.Path(sys.argv[2]).resolve() / "root"
    if lack():
        print(f"the package was not tried in a bare root: {lack()}")
        sys.exit(77)
    ROOT.parent.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
