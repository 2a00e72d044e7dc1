# SPDX-License-Identifier: BSD-3-Clause
"""The paper's six stages, joined by hand: what `waft synthesize SCENE --quality paper --database FOLDER/air.vtm` does.

pvpython six_stages.py SCENE FOLDER        SCENE: without winds and vortices of its own; FOLDER: one that is there
"""
import sys

from paraview import simple
from paraview.simple import OutputPort

import waft

scene, folder = sys.argv[1:3]

# 1. Smoke in random air.
smoke = simple.GridSmokeSource(Seed=1)

# 2. Paths that it carries, cut, compressed and clustered: the motion database.
tracers = simple.TrajectoryTraceFilter(Input=smoke, Vortices=OutputPort(smoke, 1), Obstacles=OutputPort(smoke, 2))
database = simple.TrajectoryClusterFilter(Input=tracers, Vortices=OutputPort(smoke, 1))
simple.SaveData(f"{folder}/air.vtm", proxy=database, DataMode="Binary")

# 3. Pieces of them, joined from mark to mark.
reader = simple.MotionSceneReader(FileName=scene)
waft.update(reader)
seed = reader.GetPropertyValue("SceneSeed")
objects, rows, obstacles, shapes = (OutputPort(reader, port) for port in range(4))
plan = simple.StylisticPlannerFilter(Database=database, Objects=objects, Constraints=rows, Obstacles=obstacles, Seed=seed)
marks = OutputPort(plan, 3)  # the rows, each with its object

# 4. Objects and gas at all frames at once, winds and vortices in turns with them.
whirls = OutputPort(plan, 4)
gas = simple.SPHSpacetimeFilter(Tracks=plan, Objects=objects, Constraints=marks, Obstacles=obstacles, Vortices=whirls)

# 5. The vortices that explain what the objects feel now.
fit = simple.VortexFitFilter(Input=gas, Vortices=OutputPort(gas, 2))

# 6. Bodies, turned by the air along their paths.
turn = simple.RotationRefineFilter(Tracks=gas, Objects=objects, Shapes=shapes, Obstacles=obstacles, Constraints=marks, Seed=seed)

for file in (f"{folder}/poses.csv", f"{folder}/animation.glb"):
    waft.update(simple.MotionAnimationWriter(
        Poses=OutputPort(turn, 1), Objects=objects, Shapes=shapes, Constraints=marks, FileName=file))
waft.update(fit)
