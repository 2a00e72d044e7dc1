# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView while an event script plays: gives each Waft Animation that the menu made the file of one scene, in a quality
that takes long, and lets the script go on when all that was applied flies by itself; notes, a line a look, which of them fly, and what
the process takes of the machine."""
import gc
import os
import pathlib
import time

from paraview import simple
from watching import SCENE, wait_until, watch, write

import waft

FULL, PAPER = 2, 3  # of Quality
PAGE = os.sysconf("SC_PAGE_SIZE")
scene = waft.Scene(seed=5)
scene.set_time(240)
scene.add_objects("feather", positions=[(-0.6, 0, 2.6)])
scene.add_position(0, 120, (0.3, 0, 2.1))
scene.save(SCENE)


def flights():
    return [source for source in simple.GetSources().values() if source.SMProxy.GetXMLName() == "WaftAnimation"]


def at_work():
    """What was applied and has not ended."""
    stages = [flight.GetClientSideObject() for flight in flights()]
    return [stage for stage in stages if stage.GetWorkState() != stage.NO_WORK]


def megabytes():
    """That the process has of the machine's."""
    return int(pathlib.Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * PAGE / 2 ** 20


def look():
    for flight in flights():
        if not flight.FileName:  # for Apply to push
            flight.SMProxy.GetProperty("FileName").SetElement(0, SCENE)
            flight.SMProxy.GetProperty("Quality").SetElement(0, FULL)
    wait_until(lambda: all(stage.GetWorkState() == stage.BESIDE for stage in at_work()))
    databases = [source.GetClientSideObject() for source in simple.GetSources().values()
                 if source.SMProxy.GetXMLName() == "MotionDatabaseSource"]
    gc.collect()  # a script's own hands on what was deleted
    stages = at_work()
    write({"flights": len(flights()), "wall": time.monotonic(), "processor": time.process_time(), "megabytes": megabytes(),
           "databases": [database.GetWorkState() for database in databases],
           "threads": len(os.listdir("/proc/self/task")), "is_paper": [stage.GetQuality() == PAPER for stage in stages],
           "beside": len(stages), "work": [stage.GetWorkDone() for stage in stages]})


watch(look)
