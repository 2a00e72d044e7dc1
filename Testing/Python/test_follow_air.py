# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own tracers come to the marks of a flight (Documentation/examples/follow_air.py).

    pvpython test_follow_air.py SOURCE"""

import pathlib
import runpy
import statistics
import subprocess
import sys
import tempfile
import unittest

from waft.loading import command

SOURCE = pathlib.Path(sys.argv[1])


class FollowAirTest(unittest.TestCase):
    def test_tracers_come_to_marks(self):
        example = runpy.run_path(str(SOURCE / "Documentation" / "examples" / "follow_air.py"))
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name) / "out"
            subprocess.run([command(), "synthesize", str(SOURCE / "Data" / "Scenes" / "bubbles-two-marks.waft.json"),
                            "--quality", "preview", "--keep", "air", "-o", str(folder), "-q"], check=True)
            each = example["misses"](folder)
        self.assertEqual(len(each), 30)
        self.assertLess(statistics.median(each), 2e-3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
