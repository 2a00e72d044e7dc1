# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen: a mark is dragged in the view, whose body is planned anew; undo, redo and Save scene.

    test_edit.py PARAVIEW XVFB PLUGINS MODULES"""
import itertools
import json
import pathlib
import re
import sys
import tempfile
import unittest

from window import play

NUMBERS = r"-?[0-9.]+(e-?[0-9]+)?"


class EditTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.status, cls.printed, notes = play("edit.xml", pathlib.Path(folder), "watch_edit.py", ends=False)
        # Of each state of the edits what it came to; before that it may be seen with the flight that there was.
        cls.flown = [list(group)[-1] for _, group in itertools.groupby((note for note in notes if "bodies" in note), lambda note: note["edits"])]
        cls.saved = notes[-1]

    def test_it_ends_without_a_complaint(self):
        self.assertEqual(self.status, 0, self.printed)
        for sign in ("ERR|", "FATL|", "Traceback", "critical:"):
            self.assertNotIn(sign, self.printed)

    def test_a_drag_moves_its_body_and_no_other(self):
        first, dragged = self.flown[:2]
        self.assertEqual([a == b for a, b in zip(first["bodies"], dragged["bodies"])], [True, False, True])
        edit, = dragged["edits"]
        self.assertEqual((edit["op"], edit["path"]), ("replace", "/constraints/1/value"))
        x, y, z = edit["value"]
        self.assertGreater(x, 0.2, "to the right")
        self.assertAlmostEqual(y, 0.1, places=3, msg="as far away as before")
        self.assertGreater(z, 1.95, "and up")
        for own, wanted in zip(dragged["at"], edit["value"]):
            self.assertAlmostEqual(own, wanted, delta=1e-6)

    def test_undo_and_redo_fly_it_back_and_again(self):
        first, dragged, undone, again = self.flown[:4]
        self.assertEqual(undone["edits"], [])
        for own, wanted in zip(undone["at"], first["at"]):
            self.assertAlmostEqual(own, wanted, delta=1e-6)
        for others in (undone, again):
            self.assertEqual((first["bodies"][0], first["bodies"][2]), (others["bodies"][0], others["bodies"][2]))
        self.assertEqual((again["edits"], again["bodies"]), (dragged["edits"], dragged["bodies"]))

    def test_a_corner_makes_its_box_larger(self):
        edits = self.flown[4]["edits"]
        self.assertEqual(edits[:1], self.flown[3]["edits"])
        self.assertEqual((len(edits), edits[1]["op"], edits[1]["path"]), (2, "replace", "/obstacles/0/max"))
        x, y, z = edits[1]["value"]
        self.assertTrue(1.5 < x <= 2 and 1 < z < 2, (x, z))
        self.assertAlmostEqual(y, 1.5, places=3)

    def test_the_scene_is_saved_in_its_own_words(self):
        wanted = self.saved["was"]
        for was, edit in zip(("[0.1, 0.1, 1.90]", "[1.5, 1.5, 1]"), self.flown[4]["edits"]):
            wanted = wanted.replace(was, str(edit["value"]))
        self.assertEqual(json.loads(self.saved["saved"]), json.loads(wanted))
        self.assertEqual(re.sub(NUMBERS, "", self.saved["saved"]), re.sub(NUMBERS, "", wanted), "blanks and comments as well")
        for kept in ("2e-1", "-0.60", "1.8]", "[1.2, 1.2, 0]"):
            self.assertIn(kept, self.saved["saved"])
        self.assertEqual((self.flown[5]["edits"], self.flown[5]["bodies"]), ([], self.flown[4]["bodies"]), "nothing is flown again")


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.exit(0 if done.result.wasSuccessful() else 1)
