# SPDX-License-Identifier: BSD-3-Clause
"""What a client of a server sees: the picture of a session without one, pixel by pixel.

    pvpython test_remote.py PVSERVER         on a screen"""
import pathlib
import sys
import tempfile
import unittest

import numpy as np
import waft
from paraview import simple
from picture import read
from serving import server

PVSERVER = sys.argv[1]
SIZE = 600, 400
TIME = 0.5  # s


def picture_of(scene, folder):
    """The first picture of an animation in this session, at a time between two marks; [row, column, red green blue]."""
    animation = simple.WaftAnimation(FileName=str(scene), Quality="Preview")
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
            flown = waft.Scene(seed=7)
            flown.set_time(31)
            flown.add_object("feather", (0, 0, 2.5))
            flown.add_position(0, 25, (0.1, 0.1, 2.1))
            flown.save(folder / "scene.waft.json")
            here = picture_of(folder / "scene.waft.json", folder)
            simple.Connect("localhost", port)
            try:
                there = picture_of(folder / "scene.waft.json", folder)
            finally:
                simple.Disconnect()
                simple.Connect()
        self.assertGreater(np.ptp(here, axis=(0, 1)).max(), 100)  # something is seen
        self.assertEqual(0, np.abs(here - there).max())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
