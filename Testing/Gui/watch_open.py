# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: makes a scene and a folder of results; notes, a line a change, what stands in the
pipeline browser, that nothing of it flies before it is applied, and what of the flight is shown."""
import os
import pathlib
import sys

from paraview import simple
from watching import SCENE, view, watch, write_change

import waft

sys.path.insert(0, os.environ["WAFT_GUI_SAMPLES"])
import sample_folder  # noqa: E402

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", positions=[(0, 0, 2)])
scene.save(SCENE)
flight = pathlib.Path(SCENE).with_name("flight")
sample_folder.write(str(flight))
(flight / "report.json").write_text('{"scene": "autumn.waft.json"}', encoding="utf-8")


def kind_of(source):
    """Of a scene whose bodies were asked for: flown."""
    name = source.SMProxy.GetXMLName()
    poses = source.GetClientSideObject().GetOutputDataObject(1) if name == "WaftAnimation" else None
    return f"{name}, flown" if poses and poses.GetNumberOfPoints() else name


def look():
    named = {name: source for (name, _), source in simple.GetSources().items()}
    flown = next((source for source in named.values() if source.SMProxy.GetXMLName() == "MotionResultsReader"), None)
    shown = [one.SMProxy.GetXMLName() for one in view.Representations if one.Visibility and one.Input.SMProxy == flown.SMProxy] if flown else []
    write_change([{name: kind_of(source) for name, source in named.items()}, sorted(shown)])


watch(look)
