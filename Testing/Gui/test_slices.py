# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen: Apply returns and the work flies on beside; Stop, Go on, few pictures, and the same motion
in the end.

    test_slices.py PARAVIEW XVFB PLUGINS MODULES"""
import pathlib
import tempfile

from window import WindowTest, main, play

IDLE = 0.3      # s of the processor at most in a second from Stop to Go on
PICTURES = 2.0  # a second at most
DRAWING = 0.15  # of the time at most: a tenth, where all of them take as long as the first


class SliceTest(WindowTest):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.status, cls.printed, cls.notes = play("slices.xml", pathlib.Path(folder), "watch_slices.py", ends=False)
        cls.looks = [note for note in cls.notes if "complete" in note]

    def the(self, key):
        return next(note for note in self.notes if key in note)

    def test_it_ends_without_a_complaint(self):
        self.check_run(self.status, self.printed)

    def test_apply_returns_with_a_first_picture(self):
        first = self.looks[0]
        self.assertEqual((first["complete"], first["points"], first["flagged"]), (0, 1440, 1), first)
        self.assertGreater(first["bodies"], 0)

    def test_the_motion_so_far_is_shown_until_it_is_whole(self):
        self.assertGreater(len({note["work"] for note in self.looks}), 3, "it goes on")
        self.assertTrue(all(note["points"] in (1440, 60) and note["bodies"] > 0 for note in self.looks))
        self.assertEqual([note["complete"] for note in self.looks].count(1), 1)
        self.assertFalse(self.looks[-1]["flagged"])

    def test_what_is_saved_meanwhile_is_one_motion(self):
        saved = {note["save"]: note for note in self.notes if "save" in note}
        self.assertEqual({"film", "data"}, saved.keys())
        for name, note in saved.items():
            self.assertEqual(len(note["motions"]), 1, name)

    def test_stop_holds_the_work(self):
        rest = self.the("rested")
        self.assertEqual(rest["before"], rest["after"])
        self.assertLess(rest["used"], IDLE * (1.0 + rest["rested"]))

    def test_few_pictures_are_drawn_meanwhile(self):
        counted = self.the("counted")
        self.assertLessEqual(counted["pictures"] - 1, PICTURES * counted["counted"])
        self.assertLess(counted["seconds"] / counted["counted"], DRAWING)

    def test_the_work_says_how_long_it_takes(self):
        counted = self.the("counted")
        self.assertGreater(counted["left"], 0.0)
        self.assertNotIn(counted["message"], ("", "done"))

    def test_it_comes_to_the_same_bytes_as_all_at_once(self):
        end = self.notes[-1]
        self.assertEqual(end["slices"], [0.2, 0.0], "of the window's source and of a script's")
        self.assertEqual(end["saved"], 0.0)
        self.assertEqual(end["flown"], end["once"])
        self.assertEqual(end["text"], "done")


if __name__ == "__main__":
    main()
