# SPDX-License-Identifier: BSD-3-Clause
"""What a client of a server sees: the picture of a session without one, pixel by pixel.

    pvpython test_remote.py PVSERVER SCENES         on a screen"""
import pathlib
import sys
import tempfile
import unittest

import numpy as np
import waft
from paraview import simple
from picture import read
from serving import server

PVSERVER, SCENES = sys.argv[1:3]
SIZE = 600, 400
TIME = 4.0  # s


def picture_of(name, folder):
    """The first picture of an animation in this session, at a time between two marks; [row, column, red green blue]."""
    animation = simple.WaftAnimation(FileName=f"{SCENES}/{name}.waft.json", Quality="Preview")
    view = simple.CreateRenderView(ViewSize=SIZE)
    waft.show(animation, view)
    simple.GetAnimationScene().AnimationTime = TIME
    simple.Render(view)
    file = folder / "seen.png"
    simple.SaveScreenshot(str(file), view)
    simple.Delete(view)
    simple.Delete(animation)
    return read(str(file))


class RemoteTest(unittest.TestCase):
    def test_first_pictures_are_those_of_a_session_without_a_server(self):
        with tempfile.TemporaryDirectory() as name, server(PVSERVER) as port:
            folder = pathlib.Path(name)
            here = picture_of("feather-waypoints", folder)
            simple.Connect("localhost", port)
            try:
                there = picture_of("feather-waypoints", folder)
            finally:
                simple.Disconnect()
                simple.Connect()
        self.assertGreater(np.ptp(here, axis=(0, 1)).max(), 100)  # something is seen
        self.assertEqual(0, np.abs(here - there).max())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
