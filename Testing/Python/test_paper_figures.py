# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the page on the paper, made anew: a scene of Fig. 4 is flown at full size in both qualities, and
Documentation/scripts/make_paper_figures.py draws and measures it into a copy of the page.

    pvbatch test_paper_figures.py SOURCE FOLDER [RESULTS]        RESULTS: a folder with paper/SCENE and full/SCENE, not flown then
"""
import json
import pathlib
import re
import shutil
import sys
import unittest

import waft
import picture

SOURCE, FOLDER = map(pathlib.Path, sys.argv[1:3])
SCENE = "feather-waypoints-a"
sys.path.insert(0, str(SOURCE / "Documentation" / "scripts"))

import make_paper_figures  # noqa: E402
import paper_table  # noqa: E402

PAGE = (SOURCE / "Documentation" / "Paper.md").read_text(encoding="utf-8")


class PaperFiguresTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        (FOLDER / "gallery").mkdir(parents=True)
        (FOLDER / "Paper.md").write_text(PAGE, encoding="utf-8")
        cls.results = {quality: (pathlib.Path(sys.argv[3]) if sys.argv[3:] else FOLDER) / quality / SCENE
                       for quality in make_paper_figures.QUALITIES}
        for quality, folder in cls.results.items():
            if not sys.argv[3:]:
                waft.synthesize(SOURCE / "Data" / "Scenes" / f"{SCENE}.waft.json", quality=quality, output=folder)
        make_paper_figures.main(["--into", str(FOLDER), *map(str, cls.results.values())])
        cls.page = (FOLDER / "Paper.md").read_text(encoding="utf-8")
        cls.kept = json.loads((FOLDER / "gallery" / "figures.json").read_text(encoding="utf-8"))[SCENE]

    def test_both_qualities_have_their_picture(self):
        drawn = []
        for quality in make_paper_figures.QUALITIES:
            self.assertIn(f"| {SCENE}, `{quality}` | ![{SCENE} in {quality}](gallery/figure_{SCENE}_{quality}.png) |", self.page)
            drawn.append(picture.read(str(FOLDER / "gallery" / f"figure_{SCENE}_{quality}.png")))
        self.assertEqual(drawn[0].shape, drawn[1].shape)
        self.assertGreater(picture.differing(*drawn), picture.FRACTION, "two flights look alike")

    def test_rows_are_those_of_measure(self):
        for quality, folder in self.results.items():
            for row in waft.measure(folder)[0].rows:
                kept = self.kept[quality]["rows"][row.key]
                self.assertEqual(kept, {"value": row.as_json()["value"], "met": row.met})
            self.assertEqual(self.kept[quality]["rows"]["exact"]["met"], True, "marks are met exactly")
            self.assertRegex(self.page, rf"\n\| {SCENE}, `{quality}` \| 1 \| ")

    def test_what_the_optimiser_changed_is_told(self):
        moved = re.search(rf"\n\| {SCENE} \| (\d) of 1, ([\d.]+) mm \| ([\d.]+), ([\d.]+) \| ", self.page)
        beside = self.kept["full"]["beside"]
        self.assertEqual(int(moved.group(1)), int(beside["farthest"] > make_paper_figures.MOVED))
        self.assertAlmostEqual(float(moved.group(2)), 1000.0 * beside["farthest"], delta=0.051)
        self.assertIn(f"\n| {SCENE}, `air` | 1 | ", self.page)
        self.assertRegex(self.page, rf"\n\| {SCENE} \| 0\.\d+, 0\.\d+, [\d.]+ \| 0\.\d+, - \| ")

    def test_a_row_is_worse_where_it_misses_by_more_than_it_did(self):
        for wanted, met, value, was, expected in (([0.0, 0.2], True, 0.19, 0.01, False), ([0.0, 0.2], False, 0.21, 0.1, True),
                                                  ([0.0, 0.2], False, 0.31, 0.30, False), ([0.0, 0.2], False, 0.31, 0.29, True),
                                                  ([0.7, 1.4], False, 0.6, 0.62, False), ([0.7, 1.4], False, 0.6, 0.8, True),
                                                  ([None, 1.0], False, 1.2, None, True), ([0.3, None], False, 0.1, 0.2, True)):
            row = {"wanted": wanted, "met": met, "value": value}
            self.assertEqual(make_paper_figures.is_worse(row, {"value": was}), expected, (wanted, value, was))
        for value, expected in ((0.82, False), (0.84, True)):  # AUC is never below a half
            row = {"key": "told_apart", "wanted": [0.0, 0.75], "met": False, "value": value}
            self.assertEqual(make_paper_figures.is_worse(row, {"value": 0.8}), expected)

    def test_both_qualities_are_let_go_in_the_air_alone(self):
        """An optimised motion says of itself what its gas does besides, and an assimilated one has none."""
        rows = [{"key": "replay", "value": 0.2, "met": True, "wanted": [0.0, 0.25]}, {"key": "drift", "value": 0.4, "met": None, "wanted": [None, None]}]
        of_air = {"replay": {"key": "replay", "value": 0.39, "met": False, "wanted": [0.0, 0.15]}}
        replay, = make_paper_figures.like_air(rows, of_air)
        self.assertEqual((replay["key"], replay["value"], replay["met"]), ("replay", 0.4, False))
        self.assertFalse(make_paper_figures.is_worse(replay, of_air["replay"]))

    def test_the_table_is_that_of_its_script(self):
        for line in paper_table.lines([(SCENE, paper_table.column(self.results["paper"])[1])]):
            self.assertIn(f"\n{line}\n", self.page)

    def test_every_figure_has_its_caption_and_its_scenes(self):
        for page in (PAGE, self.page):
            self.assertEqual(re.findall(r"^\*(Fig\. \d.*)\*$", page, re.MULTILINE), [caption for caption, _ in make_paper_figures.FIGURES])
            for scene in make_paper_figures.SCENES:
                self.assertEqual(len(re.findall(rf"^\| {scene}, `\w+` \| (?:!|-)", page, re.MULTILINE)), 2)

    def test_nothing_else_of_the_page_changes(self):
        sections = {name for name in (make_paper_figures.PICTURES, make_paper_figures.MEASURES, make_paper_figures.TABLE)}
        for before, after in zip(*(re.split(r"^#+ ", page, flags=re.MULTILINE) for page in (PAGE, self.page))):
            if before.partition("\n")[0] not in sections:
                self.assertEqual(before, after)

    def test_other_results_are_refused(self):
        wrong = FOLDER / "wrong"
        wrong.mkdir()
        for values, text in (({"quality": "air"}, f"expected a scene of Figs. 4 to 9 in quality paper or full, found {SCENE} in air"),
                             ({"quality": "full", "stoppedEarly": True}, "expected a run that went to its end, found one that was stopped")):
            (wrong / "report.json").write_text(json.dumps({"scene": f"{SCENE}.waft.json", **values}), encoding="utf-8")
            with self.assertRaises(SystemExit) as caught:
                make_paper_figures.main(["--into", str(FOLDER), str(wrong)])
            self.assertIn(text, str(caught.exception))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
