# SPDX-License-Identifier: BSD-3-Clause
"""Installs the build into an empty prefix, moves it, and uses it from there: by PV_PLUGIN_PATH, by
`import waft`, by its command, and from another CMake project. Nothing of it may lead back to the build.

    python3 test_install.py BUILD SOURCE WORK"""

import glob
import math
import os
import re
import shutil
import subprocess
import sys
import textwrap
import unittest
import zipfile

BUILD, SOURCE, WORK = (os.path.realpath(path) for path in sys.argv[1:4])
HERE = os.path.dirname(os.path.abspath(__file__))
PREFIX = os.path.join(WORK, "moved")
PACKAGES = os.path.join(PREFIX, "lib", "python3", "dist-packages")
NOISE = re.compile(r"ERR\||FATL\||Traceback")


def environment(**extra):
    """This process's, without what points to some Waft."""
    kept = {k: v for k, v in os.environ.items()
            if k not in ("PYTHONPATH", "PV_PLUGIN_PATH", "LD_LIBRARY_PATH", "WAFT_DATA")}
    return {**kept, "PYTHONDONTWRITEBYTECODE": "1", "WAFT_DEFAULTS": "off", **extra}


def run(command, **extra):
    done = subprocess.run(command, env=environment(**extra), cwd=WORK, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


class InstallTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        first = os.path.join(WORK, "prefix")
        status, text = run(["cmake", "--install", BUILD, "--prefix", first])
        if status != 0:
            raise RuntimeError(text)
        # What works after a move does not lean on the place that it was installed to.
        os.rename(first, PREFIX)

    def check_run(self, command, **extra):
        status, text = run(command, **extra)
        self.assertEqual(status, 0, text)
        self.assertIsNone(NOISE.search(text), text)
        return text

    def test_libraries_do_not_lead_back_to_the_build(self):
        libraries = [path for path in glob.glob(os.path.join(PREFIX, "**", "*.so*"), recursive=True)
                     if not os.path.islink(path)]
        self.assertGreaterEqual(len(libraries), 5, libraries)
        for path in libraries:
            status, text = run(["readelf", "-d", path])
            self.assertEqual(status, 0, text)
            for line in text.splitlines():
                if "PATH)" in line or "NEEDED" in line:
                    for place in re.search(r"\[(.*)\]", line).group(1).split(":"):
                        self.assertFalse(place.startswith("/"), f"{path}: {line}")

    def test_no_file_names_the_build(self):
        for folder, _, names in os.walk(PREFIX):
            for name in names:
                if name.endswith((".py", ".cmake", ".xml", ".json", ".txt")):
                    with open(os.path.join(folder, name), encoding="utf-8") as file:
                        text = file.read()
                    for place in (BUILD, SOURCE):  # as a path that begins there: a clone may be at /waft
                        self.assertNotRegex(text, rf"(?m)(?:^|[\s\"'=:;,(\[]){re.escape(place)}(?:[/\s\"':;,)\]]|$)", name)

    def test_by_plugin_path(self):
        places = glob.glob(os.path.join(PREFIX, "lib*", "paraview-*", "plugins"))
        self.assertEqual(len(places), 1, places)
        self.check_run(["pvpython", os.path.join(HERE, "use_installed.py"), PREFIX, "path"],
                       PV_PLUGIN_PATH=places[0])

    def test_by_import(self):
        self.check_run(["pvpython", os.path.join(HERE, "use_installed.py"), PREFIX, "package"],
                       PYTHONPATH=PACKAGES)

    def test_by_both(self):
        places = glob.glob(os.path.join(PREFIX, "lib*", "paraview-*", "plugins"))
        self.check_run(["pvbatch", os.path.join(HERE, "use_installed.py"), PREFIX, "package"],
                       PYTHONPATH=PACKAGES, PV_PLUGIN_PATH=places[0])

    def test_command(self):
        command = os.path.join(PREFIX, "bin", "waft")
        text = self.check_run([command, "--help"])
        for word in ("synthesize", "render", "page", "database", "demo"):
            self.assertIn(word, text)
        status, text = run([command, "fly"])
        self.assertEqual(status, 2, text)
        status, text = run([command, "synthesize", "missing.waft.json", "--output", "out"])
        self.assertEqual(status, 2, text)
        self.assertIn("missing.waft.json", text)
        self.assertFalse(os.path.exists(os.path.join(WORK, "out")))

    def test_command_through_a_link(self):
        link = os.path.join(WORK, "waft-link")
        os.symlink(os.path.join(PREFIX, "bin", "waft"), link)
        self.assertIn("synthesize", self.check_run([link, "--help"]))

    def test_version_is_one(self):
        with open(os.path.join(SOURCE, "CMakeLists.txt"), encoding="utf-8") as file:
            version = re.search(r"^project\(Waft VERSION (\S+)", file.read(), re.M).group(1)
        self.assertEqual(self.check_run([os.path.join(PREFIX, "bin", "waft"), "--version"]), f"waft {version}\n")

    def test_another_version_of_a_part_is_reported(self):
        other = os.path.join(WORK, "other")
        shutil.copytree(PREFIX, other, symlinks=True)
        with open(os.path.join(other, "share", "waft", "VERSION"), "w", encoding="utf-8") as file:
            file.write("9.8.7\n")
        packages = os.path.join(other, "lib", "python3", "dist-packages")
        status, text = run([os.path.join(other, "bin", "waft"), "--version"])
        self.assertEqual(status, 1, text)
        self.assertRegex(text, rf"^waft: the command is of Waft \S+, the package {packages}/waft of Waft 9\.8\.7: install both anew")
        place = glob.glob(os.path.join(PREFIX, "lib*", "paraview-*", "plugins"))[0]
        _, text = run(["pvpython", "-c", f"import sys; sys.path.insert(0, {packages!r}); import waft"], PV_PLUGIN_PATH=place)
        self.assertRegex(text, rf"ImportError: the plugin {place}/Waft/Waft\.so is of Waft \S+, the package {packages}/waft of Waft 9\.8\.7")

    def test_manual_has_every_option_and_no_mistake(self):
        manual = os.path.join(PREFIX, "share", "man", "man1", "waft.1")
        with open(manual, encoding="utf-8") as file:
            text = file.read().replace("\\-", "-")
        for command in ("synthesize", "measure", "database"):
            for option in set(re.findall(r"--[a-z-]+", self.check_run([os.path.join(PREFIX, "bin", "waft"), command, "--help"]))):
                self.assertIn(option, text, command)
        if shutil.which("groff"):
            self.assertEqual(run(["groff", "-man", "-Tutf8", "-ww", "-z", manual]), (0, ""))

    def test_completion_of_bash(self):
        path = os.path.join(PREFIX, "share", "bash-completion", "completions", "waft")
        for typed, offered in (("waft syn", ["synthesize"]), ("waft --", ["--help", "--version"]), ("waft synthesize --qual", ["--quality"]),
                               ("waft synthesize --quality p", ["preview", "paper"]), ("waft render out", [])):
            script = f'source "{path}"; COMP_WORDS=({typed}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _waft; echo "${{COMPREPLY[*]}}"'
            self.assertEqual(self.check_run(["bash", "-c", script]).split(), offered, typed)

    def test_completion_of_zsh_is_read(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not there")
        self.check_run(["zsh", "-n", os.path.join(PREFIX, "share", "zsh", "vendor-completions", "_waft")])

    def test_paraview_beside_it_would_find_the_plugin(self):
        self.assertTrue(os.path.isfile(os.path.join(PREFIX, "bin", "plugins", "Waft", "Waft.so")))

    def test_the_parts_of_the_page_came_along(self):
        parts = os.listdir(os.path.join(SOURCE, "Plugin", "Python", "waft", "page"))
        self.assertEqual(sorted(os.listdir(os.path.join(PACKAGES, "waft", "page"))), sorted(parts))

    def test_the_addon_came_along(self):
        addon = os.path.join(PREFIX, "share", "blender", "scripts", "addons", "waft_addon")
        parts = glob.glob(os.path.join(SOURCE, "Plugin", "Blender", "waft", "*.py"))
        self.assertEqual(sorted(os.listdir(addon)), sorted(map(os.path.basename, parts)))
        archive = os.path.join(WORK, "addon.zip")
        self.check_run([os.path.join(PREFIX, "bin", "waft"), "blender-addon", archive])
        with zipfile.ZipFile(archive) as content:
            for path in parts:
                with open(path, "rb") as file:
                    self.assertEqual(content.read(f"waft_addon/{os.path.basename(path)}"), file.read())

    def test_data_came_along(self):
        data = os.path.join(PREFIX, "share", "waft", "Data")
        self.assertTrue(os.path.isdir(data))
        for kind in ("Scenes", "Shapes", "Database"):
            for path in glob.glob(os.path.join(SOURCE, "Data", kind, "*")):
                self.assertTrue(os.path.exists(os.path.join(data, kind, os.path.basename(path))), path)

    def test_another_project_builds_with_it(self):
        if not glob.glob(os.path.join(PREFIX, "lib", "cmake", "waft", "WaftConfig.cmake")):
            self.skipTest("this build installs no CMake package")
        build = os.path.join(WORK, "downstream")
        self.check_run(["cmake", "-S", os.path.join(HERE, "Downstream"), "-B", build,
                        f"-DCMAKE_PREFIX_PATH={PREFIX}", "-DCMAKE_BUILD_TYPE=Release"])
        self.check_run(["cmake", "--build", build])
        status, text = run([os.path.join(build, "uses-waft")])
        self.assertEqual(status, 0, text)
        text = self.check_run([os.path.join(build, "fly-scene"), os.path.join(HERE, "Core", "feather-box.waft.json"), "75"])
        lines = [line.split() for line in text.splitlines() if re.fullmatch(r"[-+.e\d\s]+", line)]  # the rest are remarks
        places = [[float(number) for number in line] for line in lines]
        for place, mark in zip(places, ((0.7, 0.1, 1.1), (0.6, 0.2, 1.3)), strict=True):
            self.assertLess(math.dist(place, mark), 0.021, "the scene's mark, and as it was moved")

    def test_a_folder_flown_from_another_project_is_that_of_the_command(self):
        build, scene = os.path.join(WORK, "run"), os.path.join(HERE, "Core", "feather-box.waft.json")
        self.check_run(["cmake", "-S", os.path.join(HERE, "Run"), "-B", build, f"-DCMAKE_PREFIX_PATH={PREFIX}", "-DCMAKE_BUILD_TYPE=Release"])
        self.check_run(["cmake", "--build", build])
        flown, ours = os.path.join(WORK, "flown"), os.path.join(WORK, "ours")
        text = self.check_run([os.path.join(build, "fly-folder"), scene, flown], WAFT_DATA=os.path.join(PREFIX, "share", "waft", "Data"))
        self.assertEqual(["Paths are planned from mark to mark out of the motion database", "all met"], [text.splitlines()[0], text.splitlines()[-1]])
        self.check_run([os.path.join(PREFIX, "bin", "waft"), "synthesize", scene, "--output", ours, "--preview"])
        for name in ("poses.csv", "planned.vtp", "optimized.vtp", "animation.glb"):
            with open(os.path.join(flown, name), "rb") as one, open(os.path.join(ours, name), "rb") as other:
                self.assertEqual(one.read(), other.read(), name)

    def test_the_page_shows_these_programs(self):
        with open(os.path.join(SOURCE, "Documentation", "UseFromCpp.md"), encoding="utf-8") as file:
            page = file.read()
        for name in ("CMakeLists.txt", "fly_scene.cxx"):
            with open(os.path.join(HERE, "Downstream", name), encoding="utf-8") as file:
                text = re.sub(r"\A(?:(?://|#) .*\n)+", "", file.read())
            self.assertIn(textwrap.indent(text, "    ", lambda line: line.strip()), page, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
