# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen: Apply returns and goes on in slices; Stop, Go on, and the same motion in the end.

    test_slices.py PARAVIEW XVFB PLUGINS MODULES"""
import pathlib
import sys
import tempfile
import unittest

from window import play

APPLY = 2.0  # s of the processor, on all threads
HELD = 1.0   # s in which nothing is done after Stop
IDLE = 0.3   # s of the processor at most in these


class SliceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.status, cls.printed, cls.notes = play("slices.xml", pathlib.Path(folder), "watch_slices.py", ends=False)
        cls.looks = [note for note in cls.notes if "complete" in note]

    def test_it_ends_without_a_complaint(self):
        self.assertEqual(self.status, 0, self.printed)
        for sign in ("ERR|", "FATL|", "Traceback", "critical:"):
            self.assertNotIn(sign, self.printed)

    def test_apply_returns_with_a_first_picture(self):
        applied = [note for note in self.notes if "waits" in note][-1]
        first = self.looks[0]
        self.assertEqual((first["complete"], first["points"], first["flagged"]), (0, 120, 1), first)
        self.assertGreater(first["bodies"], 0)
        self.assertLess(first["processor"] - applied["processor"], APPLY)

    def test_the_motion_so_far_is_shown_until_it_is_whole(self):
        self.assertGreater(len({note["work"] for note in self.looks}), 5, "slices")
        self.assertTrue(all(note["points"] == 120 and note["bodies"] > 0 for note in self.looks))
        self.assertEqual([note["complete"] for note in self.looks].count(1), 1)
        self.assertFalse(self.looks[-1]["flagged"])

    def test_what_is_saved_meanwhile_is_one_motion(self):
        saved = {note["save"]: note for note in self.notes if "save" in note}
        self.assertEqual({"film", "data"}, saved.keys())
        for name, note in saved.items():
            self.assertEqual(note["before"], note["after"], name)
            self.assertLessEqual(len(note["played"]), 1, name)

    def test_stop_holds_the_work(self):
        for k, begin in enumerate(self.looks):
            held = [note for note in self.looks[k:] if note["work"] == begin["work"]]
            if not begin["complete"] and held[-1]["wall"] - begin["wall"] > HELD \
                    and held[-1]["processor"] - begin["processor"] < IDLE:
                return
        self.fail("no rest in the work")

    def test_it_comes_to_the_same_bytes_as_all_at_once(self):
        end = self.notes[-1]
        self.assertEqual(end["slices"], [0.2, 0.0], "of the window's source and of a script's")
        self.assertEqual(end["saved"], 0.0)
        self.assertEqual(end["sliced"], end["once"])
        self.assertEqual(end["text"], "done")


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False)
    sys.exit(0 if done.result.wasSuccessful() else 1)
