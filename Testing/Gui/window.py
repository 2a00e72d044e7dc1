# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen, for tests that are started with PARAVIEW XVFB PLUGINS MODULES."""
import json
import os
import pathlib
import subprocess
import sys
import unittest

PARAVIEW, XVFB, PLUGINS, MODULES = sys.argv[1:5]
HERE = pathlib.Path(__file__).parent
PANEL = ("pqClientMainWindow/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/"
         "scrollAreaWidgetContents/PropertiesFrame/ProxyPanel")
VIEW = ("pqClientMainWindow/centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget/MultiViewWidget1/"
        "Container/Frame.0/CentralWidgetFrame/Viewport")


class Screen:
    """An X server of its own; it names its display once clients may come, and keeps what it shows in a file of the folder
    (screen.py reads it)."""

    def __init__(self, folder, size=(1400, 1000)):
        self.folder = folder
        self.size = f"{size[0]}x{size[1]}x24"

    def __enter__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen([XVFB, "-displayfd", str(write), "-screen", "0", self.size, "-noreset",
                                        "-fbdir", str(self.folder)],
                                       pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as stream:
            number = stream.readline().strip()
        if not number:
            raise RuntimeError("Xvfb: expected a display, found none")
        return ":" + number

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def run_paraview(folder, arguments, size=None, frames=0):
    """ParaView's exit status and what it printed; with a size its window fills the screen. frames: of scenes that scripts shorten."""
    with Screen(folder, size) if size else Screen(folder) as display:
        environment = {**os.environ, "DASHBOARD_TEST_FROM_CTEST": "1",  # no question of ParaView's own
                       "DISPLAY": display, "HOME": str(folder), "XDG_RUNTIME_DIR": str(folder),
                       "PV_PLUGIN_PATH": PLUGINS, "PYTHONPATH": f"{MODULES}{os.pathsep}{HERE}", "WAFT_GUI_LOG": str(folder / "log"),
                       "WAFT_GUI_SCENE": str(folder / "kept.waft.json"), "WAFT_GUI_SAMPLES": str(HERE.parent / "Python"),
                       "WAFT_GUI_SCREEN": str(folder / "Xvfb_screen0"), "WAFT_GUI_FRAMES": str(frames)}
        whole = ["-qwindowgeometry", f"{size[0]}x{size[1]}+0+0"] if size else []
        done = subprocess.run([PARAVIEW, "--dr", *whole, *arguments], env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


def play(events, folder, watch="watch_widgets.py", ends=True, size=None, frames=0):
    """Exit status, what was printed, and what a script noted while an event script played; with `ends` ParaView ends after
    the events, else the script ends it."""
    script = folder / "events.xml"
    text = (HERE / events).read_text(encoding="utf-8")
    for name, value in (("@PANEL@", PANEL), ("@VIEW@", VIEW), ("@FOLDER@", str(folder))):
        text = text.replace(name, value)
    script.write_text(text, encoding="utf-8")
    status, printed = run_paraview(folder, [f"--script={HERE / watch}", f"--test-directory={folder}",
                                            f"--test-script={script}", *(["--exit"] if ends else [])], size, frames)
    return status, printed, [json.loads(line) for line in (folder / "log").read_text(encoding="utf-8").splitlines()]


class WindowTest(unittest.TestCase):
    def check_run(self, status, printed, signs=("ERR|", "FATL|", "Traceback", "critical:")):
        self.assertEqual(status, 0, printed)
        for sign in signs:
            self.assertNotIn(sign, printed)


def main():
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.exit(0 if done.result.wasSuccessful() else 1)
