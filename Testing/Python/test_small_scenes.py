# SPDX-License-Identifier: BSD-3-Clause
"""Small scenes flown by the command: the rows of `waft measure` are about what they were. Motion that gets worse fails.

    pvpython test_small_scenes.py WAFT SCENES NAME...       WAFT: the command of the build; SCENES: the folder Data/Scenes
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from datafiles import write_xml
from waft.reading import read_surface

SCENES = pathlib.Path(sys.argv.pop(2))
WAFT = sys.argv.pop(1)

# What the rows came to. Motion is the same to the bit from run to run and from system to system, so that the margin of a
# fifth is for changes that are meant to change it a little. One that is meant to change it more writes its figures here,
# and shows them.
MARGIN = 1.2
FIGURES = {
    "feather-maze": {
        "private_hand": 0.0206, "replay": 0.0575, "life_velocity": 1.14, "life_acceleration": 0.9, "band_0.1": 1.26,
        "band_0.3": 0.535, "band_0.6": 0.608, "band_1.2": 0.768, "start": 1.19, "witnesses_life_velocity": 0.606,
        "witnesses_life_acceleration": 0.641, "witnesses_one_air_along": 0.688},
    "leaves-letters": {
        "private_hand": 0.0315, "replay": 0.0248, "life_velocity": 1.22, "life_acceleration": 1.09, "band_0.1": 1.32,
        "band_0.3": 1.2, "band_0.6": 1.03, "band_1.2": 1.1, "start": 1.14, "witnesses_life_velocity": 0.83,
        "witnesses_life_acceleration": 0.855, "witnesses_one_air_along": 0.655, "landing": 0.799},
    "bubbles-stairs": {
        "private_hand": 0.0132, "replay": 0.00973, "life_velocity": 3.62, "life_acceleration": 7.95, "band_0.1": 3.69,
        "band_0.3": 3.63, "band_0.6": 3.47, "band_1.2": 5.94, "start": 0.729, "witnesses_life_velocity": 1.56,
        "witnesses_life_acceleration": 2.08, "witnesses_one_air_along": 0.61},
}
# Of the others less is a fault as more is: what does not stir is no better than what trembles.
LESS_IS_BETTER = ("private_hand", "replay", "start", "landing")
EXACT = 1e-9


def _maze(scene):
    """One feather through the first two of four windows, in half of the time."""
    scene["obstacles"] = scene["obstacles"][:8]
    scene["time"]["frames"] = 150
    scene["constraints"][0].update(frame=149, value=[0.4, 0, 2])


def _letters(scene):
    """Twelve leaves that spell one letter, in six seconds."""
    scene["time"]["frames"] = 180
    for some in scene["objects"]:
        some["count"] = 4
    scene["constraints"][0]["frame"] = 150
    scene["constraints"][0]["targets"].update(text="W", width=1.5)


def _stairs(scene):
    """Twelve bubbles in four seconds; the ball swings as often as in ten."""
    scene["time"] = {"frames": 120, "framesPerSecond": 30}
    scene["objects"][0]["count"] = 12
    scene["constraints"] = scene["constraints"][::3]
    for number, entry in enumerate(scene["constraints"]):
        entry.update(object=number, frame=110)
    for place in scene["obstacles"][-1]["motion"]:
        place["frame"] = round(place["frame"] * 119 / 299)


SMALL = {name: {"feather-maze": _maze, "leaves-letters": _letters, "bubbles-stairs": _stairs}[name] for name in sys.argv[1:]}


def measured(*folders):
    """{name of a folder: {key of a row: value}}"""
    done = subprocess.run([WAFT, "measure", *map(str, folders), "--json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        raise AssertionError(f"waft measure: {done.returncode}: {done.stderr}")
    return {pathlib.Path(run["folder"]).name: {row["key"]: row["value"] for row in run["rows"]}
            for run in json.loads(done.stdout)}


def worse(name, rows):
    """Sentences: which rows are not what they were."""
    found = []
    for key, figure in FIGURES[name].items():
        low, high = 0.0 if key in LESS_IS_BETTER else figure / MARGIN, figure * MARGIN
        value = rows[key]
        if value is None or not low <= value <= high:
            found.append(f"{name}: {key}: {value} is not in {low:.3g} to {high:.3g}")
    if not rows["exact"] <= EXACT:
        found.append(f"{name}: exact: {rows['exact']} is more than {EXACT}")
    return found


class SmallScenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        for name, make_small in SMALL.items():
            scene = json.loads((SCENES / f"{name}.waft.json").read_text(encoding="utf-8"))
            make_small(scene)
            for shape in scene["shapes"].values():
                shape.pop("texture", None)
            path = cls.folder / f"{name}.waft.json"
            path.write_text(json.dumps(scene), encoding="utf-8")
            done = subprocess.run([WAFT, "synthesize", str(path), "--preview", "--output", str(cls.folder / name)],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise AssertionError(f"{name}: {done.returncode}: {done.stderr}")

    def worse_after(self, change, names):
        """What is said of copies of results whose motion is another."""
        with tempfile.TemporaryDirectory() as parent:
            copies = {name: pathlib.Path(parent) / name for name in names}
            for name, copy in copies.items():
                shutil.copytree(self.folder / name, copy)
                change(copy)
            rows = measured(*copies.values())
        return "\n".join(text for name in names for text in worse(name, rows[name]))

    def test_rows_are_what_they_were(self):
        rows = measured(*(self.folder / name for name in SMALL))
        self.assertEqual([], [text for name in SMALL for text in worse(name, rows[name])])

    def test_plans_that_no_air_carries_are_worse(self):
        said = self.worse_after(lambda folder: shutil.copy(folder / "planned.vtp", folder / "optimized.vtp"), SMALL)
        for name in SMALL:
            for key in ("private_hand", "replay"):
                self.assertIn(f"{name}: {key}: ", said)

    def test_a_tremor_of_half_a_millimetre_is_worse(self):
        def shake(folder):
            tracks = read_surface(str(folder / "optimized.vtp"))
            points = vtk_to_numpy(tracks.GetPoints().GetData())
            points += 0.0005 * np.random.RandomState(1).standard_normal(points.shape)
            write_xml(tracks, str(folder / "optimized.vtp"))

        still = [name for name in SMALL if not name.startswith("leaves")]  # those flutter by centimetres
        said = self.worse_after(shake, still)
        for name in still:
            for key in ("life_acceleration", "exact"):
                self.assertIn(f"{name}: {key}: ", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
