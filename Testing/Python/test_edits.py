# SPDX-License-Identifier: BSD-3-Clause
"""Edits of a scene in a Waft Animation: whom they touch flies anew, the others keep their bytes, and the file gets what was changed."""
import hashlib
import json
import pathlib
import tempfile
import unittest

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import waft

FRAMES = 90
# As a hand writes it: a comment, blanks and numbers of its own.
SCENE = """{
  "waft": 1, "_why": "three leaves,   each to its mark",
  "seed": 5,
  "time": {"frames": 90, "framesPerSecond": 30},
  "shapes": {"m": {"builtin": "maple", "size": 2e-1}},
  "objects": [{"shape": "m", "positions": [[-0.60, -0.5, 2.6], [0.4, 0.3, 2.8], [0.8, -0.6, 2.7]]}],
  "obstacles": [{"kind": "box", "min": [1.2, 1.2, 0], "max": [1.5, 1.5, 1]}],
  "constraints": [
    {"kind": "position", "object": 0, "frame": 70, "value": [-0.5, -0.3, 1.8]},
    {"kind": "position", "object": 1, "frame": 70, "value": [0.1, 0.1, 1.90], "radius": 0.02, "_note": "soft"},
    {"kind": "position", "object": 2, "frame": 70, "value": [0.6, -0.2, 1.7]}
  ]
}
"""


def bodies(animation):
    """Of each body, its poses as bytes, and where it is at frame 70."""
    waft.update(animation)
    poses = animation.GetClientSideObject().GetOutputDataObject(1)
    places = vtk_to_numpy(poses.GetPoints().GetData()).reshape(-1, FRAMES, 3)
    turns = vtk_to_numpy(poses.GetPointData().GetArray("Orientation")).reshape(-1, FRAMES, 4)
    return ([hashlib.sha256(place.tobytes() + turn.tobytes()).hexdigest() for place, turn in zip(places, turns)],
            [place[70].tolist() for place in places])


def replace(path, value):
    return {"op": "replace", "path": path, "value": value}


class EditTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name, "s.waft.json")
        self.file.write_text(SCENE, encoding="utf-8")
        self.animation = simple.WaftAnimation(FileName=str(self.file))
        self.addCleanup(simple.Delete, self.animation)

    def edit(self, *operations):
        self.animation.Edits = json.dumps(operations) if operations else ""
        return bodies(self.animation)

    def apply(self, *operations):
        """Nothing flies."""
        self.animation.StopAfter = "Plan"
        self.animation.Edits = json.dumps(operations)
        waft.update(self.animation)
        return self.animation.GetClientSideObject().GetOutputDataObject(self.animation["PlannedTracks"].Port).GetNumberOfLines()

    def failure(self, *operations):
        with self.assertRaises(waft.BadInput) as raised:
            self.edit(*operations)
        return str(raised.exception)

    def test_a_mark_moves_one_body_alone(self):
        before, _ = bodies(self.animation)
        after, places = self.edit(replace("/constraints/1/value", [-0.6, 0.9, 2.4]))
        self.assertEqual([a == b for a, b in zip(before, after)], [True, False, True])
        for axis, wanted in enumerate((-0.6, 0.9, 2.4)):
            self.assertAlmostEqual(places[1][axis], wanted, delta=0.021)
        self.assertEqual(self.file.read_text(encoding="utf-8"), SCENE, "not saved yet")
        source = self.animation.GetClientSideObject()
        self.assertEqual(source.GetWantsNewAir(), 1, "that air does not go there")
        self.animation.SMProxy.InvokeCommand("LetGo")
        self.animation.SMProxy.MarkModified(self.animation.SMProxy)
        again, places = bodies(self.animation)
        self.assertEqual(source.GetWantsNewAir(), 0, "it was drawn for this scene")
        self.assertNotEqual(again[0], before[0], "another air takes the others elsewhere")
        self.assertLess(max(abs(own - wanted) for own, wanted in zip(places[1], (-0.6, 0.9, 2.4))), 0.021)

    def test_a_start_and_a_new_mark_do_as_well(self):
        before, _ = bodies(self.animation)
        after, _ = self.edit(replace("/objects/0/positions/2", [0.7, -0.4, 2.6]))
        self.assertEqual([a == b for a, b in zip(before, after)], [True, True, False])
        row = {"kind": "position", "object": 0, "frame": 40, "value": [-0.55, -0.4, 2.2]}
        more, _ = self.edit(replace("/objects/0/positions/2", [0.7, -0.4, 2.6]), {"op": "add", "path": "/constraints/-", "value": row})
        self.assertEqual([a == b for a, b in zip(after, more)], [False, True, True])

    def test_handles_follow_the_edits(self):
        self.apply(replace("/constraints/1/value", [0.3, 0.2, 1.6]))
        self.animation.SMProxy.UpdatePropertyInformation()
        scene = json.loads(self.animation.SMProxy.GetProperty("Handles").GetElement(0))
        kinds = [handle["kind"] for handle in scene["handles"]]
        self.assertEqual(kinds, 3 * ["start"] + 3 * ["mark"] + ["obstacle"] + 2 * ["corner of obstacle"])
        self.assertEqual(scene["handles"][4]["place"], [0.3, 0.2, 1.6])

    def test_regions_vortices_and_winds_are_moved_and_saved(self):
        written = SCENE.replace('"positions": [[-0.60, -0.5, 2.6], [0.4, 0.3, 2.8], [0.8, -0.6, 2.7]]',
                                '"count": 3, "region": {"min": [-1, -1, 2.50], "max": [1, 1, 3.5]}')
        written = written.replace('"obstacles"', '"vortices": [{"p1": [0, 0, 1.0], "p2": [0, 0, 3], "strength": 2, "centerTime": 1, "duration": 1, '
                                  '"coreRadius": 0.2}],\n  "winds": [{"direction": [1, 0, 0], "strength": 1, "center": [0, 1, 2], "radius": 1, '
                                  '"centerTime": 1, "duration": 1}],\n  "obstacles"')
        self.file.write_text(written, encoding="utf-8")
        self.animation.StopAfter = "Plan"
        waft.update(self.animation)
        starts = [self.animation.GetClientSideObject().GetOutputDataObject(3).GetPoint(k) for k in range(3)]
        self.animation.Edits = json.dumps([replace("/objects/0/region/max", [-0.5, -0.5, 3.0]), replace("/vortices/0/p1", [0.5, 0, 1]),
                                           replace("/winds/0/center", [0, -1, 2])])
        waft.update(self.animation)
        moved = [self.animation.GetClientSideObject().GetOutputDataObject(3).GetPoint(k) for k in range(3)]
        self.assertGreater(max(max(start[:2]) for start in starts), -0.5)
        self.assertLessEqual(max(max(start[:2]) for start in moved), -0.5)
        self.animation.SMProxy.UpdatePropertyInformation()
        handles = json.loads(self.animation.SMProxy.GetProperty("Handles").GetElement(0))["handles"]
        places = {kind: [handle["place"] for handle in handles if handle["kind"] == kind] for kind in
                  ("region", "corner of region", "vortex", "end of vortex", "wind")}
        self.assertEqual(places, {"region": [[-0.75, -0.75, 2.75]], "corner of region": [[-1, -1, 2.5], [-0.5, -0.5, 3]],
                                  "vortex": [[0.25, 0, 2]], "end of vortex": [[0.5, 0, 1], [0, 0, 3]], "wind": [[0, -1, 2]]})
        self.animation.SMProxy.InvokeCommand("SaveScene")
        self.assertEqual(self.file.read_text(encoding="utf-8"),
                         written.replace('"max": [1, 1, 3.5]', '"max": [-0.5, -0.5, 3.0]').replace('"p1": [0, 0, 1.0]', '"p1": [0.5, 0, 1]')
                         .replace('"center": [0, 1, 2]', '"center": [0, -1, 2]'))

    def test_saving_changes_what_was_edited_alone(self):
        after, _ = self.edit(replace("/constraints/1/value", [0.3, 0.2, 1.6]))
        self.animation.SMProxy.InvokeCommand("SaveScene")
        self.assertEqual(self.file.read_text(encoding="utf-8"), SCENE.replace("[0.1, 0.1, 1.90]", "[0.3, 0.2, 1.6]"))
        again, _ = self.edit()
        self.assertEqual(again, after, "nothing is flown again")
        source, other = self.animation.GetClientSideObject(), self.file.with_name("other.waft.json")
        self.apply(replace("/constraints/1/value", [0.3, 0.2, 1.7]))
        self.assertFalse(source.SaveSceneAs(str(self.file.with_name("no folder") / "s.waft.json")))
        self.assertTrue(source.SaveSceneAs(str(other)))
        self.assertEqual(other.read_text(encoding="utf-8"), SCENE.replace("[0.1, 0.1, 1.90]", "[0.3, 0.2, 1.7]"))
        self.assertEqual(self.file.read_text(encoding="utf-8"), SCENE.replace("[0.1, 0.1, 1.90]", "[0.3, 0.2, 1.6]"))

    def test_a_file_that_was_changed_since_is_not_written_over(self):
        self.apply(replace("/constraints/1/value", [0.3, 0.2, 1.6]))
        other = SCENE.replace("three leaves", "3 leaves")
        self.file.write_text(other, encoding="utf-8")
        self.animation.SMProxy.InvokeCommand("SaveScene")
        self.assertEqual(self.file.read_text(encoding="utf-8"), other)
        self.animation.SMProxy.UpdatePropertyInformation()
        self.assertIn("/constraints/1/value", self.animation.SMProxy.GetProperty("EditsInUse").GetElement(0), "the edits are kept")

    def test_edits_that_cannot_be_say_so(self):
        self.assertIn("s.waft.json: Edits: /0/path: expected a place that the scene has", self.failure(replace("/constraints/7/value", [0, 0, 1])))
        self.assertIn("s.waft.json: /constraints/1/value: expected a vector", self.failure(replace("/constraints/1/value", "there")))
        self.assertEqual(self.apply(), 3, "and without them all is well")

    def test_another_file_has_no_edits(self):
        self.apply(replace("/constraints/1/value", [0.3, 0.2, 1.6]))
        other = self.file.with_name("t.waft.json")
        other.write_text(SCENE, encoding="utf-8")
        self.animation.FileName = str(other)
        waft.update(self.animation)
        self.assertEqual(self.animation.Edits, "")


if __name__ == "__main__":
    unittest.main()
