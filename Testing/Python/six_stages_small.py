# SPDX-License-Identifier: BSD-3-Clause
"""The stages of Documentation/examples/six_stages.py on a coarse grid with few particles, and a scene for them."""
import functools
import runpy
import sys
from unittest import mock

from paraview import simple

import waft

AIR = {"Resolution": [16, 16, 16], "NumberOfFrames": 60, "NumberOfObstacles": 1}
SHORT = {"NumberOfGasParticles": 216, "LeashIterations": 2, "MaximumNumberOfIterations": 6}


def make_scene(path, seed=5):
    """Three leaves, each with a mark to pass and then to lie down."""
    scene = waft.Scene("Three leaves", seed=seed)
    scene.set_time(61)
    scene.add_objects("maple", count=3, region={"min": (-0.6, -0.6, 1.2), "max": (0.6, 0.6, 1.5)})
    for leaf in range(3):
        scene.add_position(leaf, 36, (0.5 * leaf - 0.5, 0.1, 1.0), radius=0.1)
    scene.save(path)


def join(script, scene, folder):
    """{name: stage} of the script, with what it writes in a folder."""
    made = {name: functools.partial(getattr(simple, name), **settings)
            for name, settings in (("GridSmokeSource", AIR), ("SPHSpacetimeFilter", SHORT))}
    with mock.patch.multiple(simple, **made), mock.patch.object(sys, "argv", [script.name, str(scene), str(folder)]):
        return runpy.run_path(str(script))
