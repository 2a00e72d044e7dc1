# SPDX-License-Identifier: BSD-3-Clause
"""Installs the .deb into a root of Debian that has nothing else, and uses it there as a user does.

    python3 test_package.py BUILD WORK       as root; exit status 77 (skipped) where that cannot be

debootstrap makes the root, from the archive that this machine's own list of sources names: some 2 GB in WORK, and some
minutes. A root that is there already is taken as it is; Waft is installed into it anew.
"""
import glob
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

SOURCES = ("/etc/apt/sources.list", "/etc/apt/sources.list.d/*.sources", "/etc/apt/sources.list.d/*.list")
MOUNTS = {"proc": ["-t", "proc", "proc"], "dev": ["--bind", "/dev"], "dev/shm": ["-t", "tmpfs", "tmpfs"]}

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


def suite_and_mirror():
    """The name of this Debian and the archive that it takes its packages from; no mirror: None."""
    release = dict(line.rstrip().split("=", 1) for line in open("/etc/os-release", encoding="utf-8") if "=" in line)
    suite = release.get("VERSION_CODENAME", "").strip('"')
    for pattern in SOURCES:
        for path in sorted(glob.glob(pattern)):
            found = re.search(r"^(?:URIs:\s*|deb\s+(?:\[.*?\]\s*)?)(\S+)", pathlib.Path(path).read_text(encoding="utf-8"), re.M)
            if found:
                return suite, found.group(1)
    return suite, None


def lack():
    """Why there can be no bare root here; empty when there can."""
    if os.geteuid() != 0:
        return "this is not root"
    if shutil.which("debootstrap") is None:
        return "debootstrap is not there (package debootstrap)"
    if PACKAGE is None:
        return f"there is no waft_*.deb in {sys.argv[1]} (./waft package makes it)"
    if suite_and_mirror()[1] is None:
        return "no list of sources names an archive of Debian"
    return ""


class PackageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        suite, mirror = suite_and_mirror()
        if not (ROOT / "etc/debian_version").exists():
            subprocess.run(["debootstrap", "--variant=minbase", suite, str(ROOT), mirror], check=True)
        for path in ("/etc/resolv.conf", "/etc/hosts"):
            shutil.copy(path, str(ROOT) + path)
        for path in glob.glob("/etc/apt/apt.conf.d/*") + [path for pattern in SOURCES for path in glob.glob(pattern)]:
            shutil.copy(path, str(ROOT) + path)
        for place, options in MOUNTS.items():
            subprocess.run(["mount", *options, str(ROOT / place)], check=True)
            cls.addClassCleanup(subprocess.run, ["umount", "--lazy", str(ROOT / place)], check=True)
        shutil.copy(PACKAGE, ROOT / "tmp" / PACKAGE.name)
        cls.run_there(cls, "apt-get update -q && apt-get purge -y -q waft || true")
        status, text = cls.run_there(cls, f"DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends /tmp/{PACKAGE.name}")
        if status != 0:
            raise RuntimeError(text)

    def run_there(self, command):
        """Exit status and text of a shell's command in the root, with an environment of its own."""
        done = subprocess.run(["chroot", str(ROOT), "env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "HOME=/root", "LC_ALL=C.UTF-8",
                               "sh", "-c", command], text=True, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def check_run(self, command):
        status, text = self.run_there(command)
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
        self.addCleanup(self.run_there, f"apt-get install -y -q --no-install-recommends /tmp/{PACKAGE.name}")
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
