# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives the Waft Animation that the menu made the file of a small scene; notes, a
line a change, which of its outputs are to be seen, as what, and what stands in the pipeline browser; and how long the bar of the work
is, as the screen shows it, while the stages fly that it was unfolded to."""
from paraview import simple
from watching import SCENE, animation_of_the_menu, is_in_the_air, view, wait_until, watch, write, write_change

import screen
import waft

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", count=2, region={"min": (-0.5, -0.5, 2.5), "max": (0.5, 0.5, 3)})
scene.add_position(0, 15, (0.2, 0.1, 2.5), radius=0.1)
scene.save(SCENE)


def bar():
    """Its length in pixels: the longest row of the colour of what is chosen or done."""
    red, green, blue = (screen.pixels()[..., channel].astype(int) for channel in range(3))
    is_done = (red < 90) & (green > 100) & (green < 200) & (blue > 150)
    return int(is_done.sum(axis=1).max())


def look():
    animation = animation_of_the_menu()
    if animation is None:
        return
    shown = {}
    for name in (animation.SMProxy.GetOutputPortName(i) for i in range(animation.SMProxy.GetNumberOfOutputPorts())):
        found = simple.GetRepresentation(animation[name], view) if view.SMProxy.FindRepresentation(
            animation.SMProxy, animation[name].Port) else None
        if found is not None and found.Visibility:
            shown[name] = found.SMProxy.GetXMLName()
    write_change({"shown": shown, "views": len(simple.GetViews()), "sources": sorted(name for name, _ in simple.GetSources())})
    if simple.FindSource("Rotation") is not None:
        lengths = []
        wait_until(lambda: lengths.append(bar()) or not is_in_the_air())
        write({"bar": lengths})


watch(look)
