# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window on a virtual screen: the first picture of a Waft Animation by numbers, and Play.

    test_play.py PARAVIEW XVFB PLUGINS MODULES"""
import pathlib
import tempfile

from window import WindowTest, main, play

FRAMES, RATE = 40, 30  # of the scene that watch_play.py makes
LEAST_SHARE = 0.002    # of the picture that two leaves of 25 cm on ways of a metre take
LEAST_CONTRAST = 60.0  # of 255, against what is behind them


class PlayTest(WindowTest):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.status, cls.printed, notes = play("play.xml", pathlib.Path(folder), "watch_play.py", ends=False)
        cls.first = next((note for note in notes if "share" in note), None)
        cls.drawn = [note for note in notes if "time" in note]
        cls.films = [note["film"] for note in notes if "film" in note]

    def test_it_ends_without_a_complaint(self):
        self.check_run(self.status, self.printed)

    def test_apply_says_what_a_check_says(self):
        self.assertEqual(self.printed.count("cannot be met: row 2 target 0 (object 1, frame 38, position)"), 1, self.printed)
        self.assertIn("2 objects, 3 constraints, 1 of them cannot be met", self.printed)

    def test_one_sentence_where_no_file_was_chosen(self):
        with tempfile.TemporaryDirectory() as folder:
            _, printed, _ = play("nofile.xml", pathlib.Path(folder))
        self.assertEqual(printed.count("FileName: expected a scene file, found no name"), 1, printed)
        self.assertEqual((printed.count("ERR|"), printed.count("missing")), (1, 0), printed)

    def test_bodies_are_seen_in_the_first_picture(self):
        self.assertGreater(self.first["share"], LEAST_SHARE, self.first)
        self.assertGreater(self.first["contrast"], LEAST_CONTRAST, self.first)
        red, green, blue = self.first["color"]
        self.assertGreater(red, 2 * max(green, blue), "the scene's own colour")
        self.assertEqual(self.first["bars"], 0, "there is nothing to measure by colour")
        self.assertEqual(self.first["looks"], ["Skins", "Faint Paths", "Scenery", "Rings"])
        self.assertEqual(self.first["background"], "Gradient")

    def test_the_camera_is_that_of_a_script(self):
        for own, wanted in zip(self.first["camera"], self.first["shown"]):
            for a, b in zip(own, wanted):
                self.assertAlmostEqual(a, b, places=3)
        self.assertEqual(self.first["camera"][2], [0, 0, 1])

    def test_what_the_window_sets_by_itself_is_no_step(self):
        taken_back = {step for note in self.drawn for step in note["steps"]}
        self.assertTrue(taken_back)
        self.assertEqual({step for step in taken_back if "RenderView" in step or "Representation" in step}, set())

    def test_the_window_knows_the_frames(self):
        self.assertEqual(self.first["steps"], FRAMES)
        self.assertAlmostEqual(self.first["end"], (FRAMES - 1) / RATE)

    def test_play_goes_at_the_pace_of_the_scene(self):
        played = [note for note in self.drawn if note["time"] > 0]
        times, clock = ([note[of] for note in played] for of in ("time", "clock"))
        self.assertEqual(times, sorted(times))
        self.assertAlmostEqual(times[-1], (FRAMES - 1) / RATE)
        longest = max([after - before for before, after in zip(clock, clock[1:])], default=0.0)
        wanted = (times[-1] - times[0]) / times[-1] * self.first["duration"]
        self.assertAlmostEqual(clock[-1] - clock[0], wanted, delta=max(0.2, 2 * longest))
        self.assertEqual(self.drawn[-1]["mode"], "Snap To TimeSteps", "steps, and films, go from frame to frame")

    def test_a_film_has_every_frame(self):
        self.assertEqual(self.films, [[f"film.{frame:04d}.png" for frame in range(FRAMES)]])

    def test_its_pictures_are_of_other_places(self):
        early, late = (note["columns"] for note in (self.drawn[0], self.drawn[-1]))
        self.assertGreater(max(abs(a - b) for a, b in zip(early, late)), 0.3, "bodies have moved across the picture")


if __name__ == "__main__":
    main()
