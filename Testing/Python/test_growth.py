# SPDX-License-Identifier: BSD-3-Clause
"""The last runs of many in one process take no more memory than those before: what a run leaves behind would add up in a long session.

    pvpython test_growth.py [RUNS]        8 of them, or 30; the last third is held against the others
"""
import gc
import json
import pathlib
import sys
import tempfile
import unittest

import waft

SCENE = {
    "waft": 1,
    "time": {"frames": 11},
    "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "position": [0.0, 0.0, 2.0]}],
    "constraints": [{"kind": "position", "object": 0, "frame": 10, "value": [0.0, 0.0, 1.8], "radius": 0.1}],
}
RUNS = int(sys.argv.pop(1)) if len(sys.argv) > 1 else 8
LAST = RUNS // 3
COARSE = {"Assimilation": {"Resolution": 16, "LatticeResolution": 8, "Candidates": 1, "Starts": 0}}
MOST_GROWTH = 0.02


def resident():
    """Megabytes of this process in memory."""
    pages = int(pathlib.Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages / 256.0


def growth(act):
    """By which fraction the process was larger in the last times than ever before, act(number) each: what is kept of a
    run adds up, while the C library now and then holds some megabytes more or less."""
    sizes = []
    for number in range(RUNS):
        act(number)
        gc.collect()
        sizes.append(resident())
    before = max(sizes[:-LAST])
    return (max(sizes[-LAST:]) - before) / before, sizes


class Growth(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def scene(self, **changes):
        path = self.folder / "scene.waft.json"
        path.write_text(json.dumps(SCENE | changes), encoding="utf-8")
        return str(path)

    def expect_flat(self, act):
        fraction, sizes = growth(act)
        self.assertLess(fraction, MOST_GROWTH, f"megabytes after each run: {[round(size, 1) for size in sizes]}")

    def test_one_pipeline_again_and_again(self):
        run = waft.synthesize(self.scene(), preview=True, threads=1, _settings=COARSE)

        def again(number):
            run.planner.Seed = 100 + number
            run.rotation.UpdatePipeline()
        self.expect_flat(again)

    def test_a_pipeline_of_its_own_each_time(self):
        def anew(number):
            waft.synthesize(self.scene(seed=number + 1), preview=True, threads=1, _settings=COARSE).delete()
        self.expect_flat(anew)

    def test_refused_scenes(self):
        def refuse(number):
            with self.assertRaises(Exception):
                waft.synthesize(self.scene(seed=number + 1, objects=[{"shape": "none"}]), preview=True, threads=1)
        self.expect_flat(refuse)


if __name__ == "__main__":
    done = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2)
    sys.exit(0 if done.result.wasSuccessful() else 1)
