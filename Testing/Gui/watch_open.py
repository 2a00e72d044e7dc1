# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: makes a scene and a folder of results; notes, a line a change, what stands in the
pipeline browser."""
import os
import pathlib
import sys

from paraview import simple
from watching import SCENE, watch, write_change

import waft

sys.path.insert(0, os.environ["WAFT_GUI_SAMPLES"])
import sample_folder  # noqa: E402

scene = waft.Scene(seed=5)
scene.set_time(20)
scene.add_objects("maple", positions=[(0, 0, 2)])
scene.save(SCENE)
flight = pathlib.Path(SCENE).with_name("flight")
sample_folder.write(str(flight))
(flight / "report.json").write_text("{}", encoding="utf-8")

watch(lambda: write_change(sorted(source.SMProxy.GetXMLName() for source in simple.GetSources().values())))
