# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen: what is in the air is changed, deleted, flown twice, reset and left by quitting; nothing
hangs, nothing breaks, and what it took is given back.

    test_rough.py PARAVIEW XVFB PLUGINS MODULES"""
import itertools
import os
import pathlib
import tempfile

from window import WindowTest, main, play

IDLE = 0.3      # s of the processor at most in a second without a flight
LEFT = 160.0    # MB at most that two flights at once leave beyond what one did: buffers of threads and pictures
SETTLES = 0.5   # s


class RoughTest(WindowTest):
    @classmethod
    def setUpClass(cls):
        os.environ["DASHBOARD_TEST_FROM_CTEST"] = "1"  # ParaView does not ask whether one is sure
        with tempfile.TemporaryDirectory() as folder:
            cls.status, cls.printed, cls.notes = play("rough.xml", pathlib.Path(folder), "watch_rough.py")
        cls.parts = [list(part) for _, part in itertools.groupby(cls.notes, key=lambda note: note["flights"])]
        cls.empty = [part for part in cls.parts if part[0]["flights"] == 0]

    def test_it_ends_without_a_complaint(self):
        self.check_run(self.status, self.printed)

    def test_a_database_was_made_when_the_session_was_reset(self):
        beside = [note["databases"] for note in self.parts[0]]
        self.assertIn([2], beside, "it works beside the window")
        self.assertEqual(beside[-1], [])

    def test_all_of_it_was_done_in_the_air(self):
        self.assertEqual([part[0]["flights"] for part in self.parts], [0, 1, 0, 1, 2, 0, 1])
        for part in self.parts:
            self.assertEqual(max(note["beside"] for note in part), part[0]["flights"], part[-1])
        self.assertLess(self.parts[-1][-1]["work"][0], 1.0, "it flew when ParaView was left")

    def test_what_was_changed_flies_again(self):
        flown = [note["is_paper"] for note in self.parts[1] if note["beside"] == 1]
        self.assertIn([False], flown)
        self.assertEqual(flown[-1], [True])

    def test_nothing_works_on_without_a_source(self):
        for part in self.empty[1:]:
            rest = [note for note in part if note["wall"] - part[0]["wall"] > SETTLES]
            self.assertGreater(len(rest), 1, part)
            wall, used = (rest[-1][key] - rest[0][key] for key in ("wall", "processor"))
            self.assertLess(used, IDLE * (1.0 + wall))

    def test_memory_is_given_back(self):
        self.assertLess(self.empty[2][-1]["megabytes"] - self.empty[1][-1]["megabytes"], LEFT)


if __name__ == "__main__":
    main()
