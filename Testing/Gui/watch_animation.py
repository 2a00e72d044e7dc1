# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a small scene; notes, a
line a change, which of its outputs are to be seen, as what, what stands in the pipeline browser, where the names of its
outputs end, and its open eyes."""
import os

import screen
from paraview import simple
from watching import SCENE, animation_of_the_menu, has_bodies, is_in_the_air, view, wait_until, watch, write_change

import waft

os.mkdir(os.path.join(os.path.dirname(SCENE), "flight"))  # that its flight is saved to
EYES, NAMES = (0, 160, 30, 640), (66, 160, 284, 640)  # of outputs, the part of the screen that has them

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", count=2, region={"min": (-0.5, -0.5, 2.5), "max": (0.5, 0.5, 3)})
scene.add_position(0, 15, (0.2, 0.1, 2.5), radius=0.1)
scene.add_position(1, 15, (0, 0, 9), radius=0.1)  # outside of the volume
scene.save(SCENE)


def look():
    animation = animation_of_the_menu()
    if animation is None:
        return
    if has_bodies(animation):
        wait_until(lambda: not is_in_the_air())
    shown = {}
    for name in (animation.SMProxy.GetOutputPortName(i) for i in range(animation.SMProxy.GetNumberOfOutputPorts())):
        found = simple.GetRepresentation(animation[name], view) if view.SMProxy.FindRepresentation(
            animation.SMProxy, animation[name].Port) else None
        if found is not None and found.Visibility:
            shown[name] = found.SMProxy.GetXMLName()
    write_change({"shown": shown, "views": len(simple.GetViews()), "sources": sorted(name for name, _ in simple.GetSources()),
                  "ends": screen.ends_of_lines(*NAMES), "eyes": len(screen.ends_of_lines(*EYES))})


watch(look)
