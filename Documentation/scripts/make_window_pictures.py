# SPDX-License-Identifier: BSD-3-Clause
"""Takes the pictures of the page on ParaView's window, gallery/window_*.png: of the real one, on a virtual screen, as hands use it.

    python3 Documentation/scripts/make_window_pictures.py PARAVIEW XVFB PLUGINS MODULES

PARAVIEW and XVFB are the programs, PLUGINS and MODULES the folders of the build with Waft's plugins and its Python package.
"""
import os
import pathlib
import shutil
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "Testing" / "Gui"))

from window import play  # noqa: E402

SIZE = (1600, 1000)
PICTURES = 5  # of watch_flight.py
FILES = ("Scenes/feather-waypoints.waft.json", "Shapes/feather-barred.png")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        text = (ROOT / "Data" / FILES[0]).read_text(encoding="utf-8")
        (folder / "feather.waft.json").write_text(text.replace("../Shapes/", ""), encoding="utf-8")
        shutil.copy(ROOT / "Data" / FILES[1], folder)
        gallery = ROOT / "Documentation" / "gallery"
        for before in gallery.glob("window_*.png"):
            before.unlink()
        os.environ.update(WAFT_GUI_PICTURES=str(gallery), WAFT_GUI_MODULES=str(ROOT / "Testing" / "Gui"))
        status, printed, _ = play(HERE / "window" / "flight.xml", folder, HERE / "window" / "watch_flight.py", size=SIZE)
    if status != 0 or len(list(gallery.glob("window_*.png"))) != PICTURES:
        sys.exit(printed)


if __name__ == "__main__":
    main()
