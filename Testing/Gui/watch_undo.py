# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a small scene, of which
only a plan is to be made; notes, a line a change, how many stages it was unfolded into."""
from paraview import simple
from watching import SCENE, animation_of_the_menu, watch, write_change

import waft

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", count=2, region={"min": (-0.5, -0.5, 2.5), "max": (0.5, 0.5, 3)})
scene.save(SCENE)


def look():
    if animation_of_the_menu(StopAfter=1) is not None:
        write_change(len(simple.GetSources()) - 1)


watch(look)
