# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside ParaView: makes a scene, plans it and keeps it, with each stage's panel open for a while; then writes what came
out to the file that WAFT_GUI_LOG names, and ends ParaView."""
from paraview import simple
from watching import SCENE, end, view, watch, write

import waft

made = {}


def show(name, proxy, port=0):
    made[name] = proxy
    simple.SetActiveSource(proxy)
    simple.UpdatePipeline(proxy=proxy)
    if port is not None:
        simple.Show(simple.OutputPort(proxy, port), view)
    simple.Render(view)


def database():
    reader = simple.XMLMultiBlockDataReader(FileName=[waft.data_file("Database/embedded.vtm")])
    reader.TimeArray = "None"
    show("database", reader, None)


def ground():
    slab = simple.Box(XLength=6, YLength=6, ZLength=1, Center=[0, 0, -0.5])
    show("ground", simple.Clean(Input=simple.Triangulate(Input=slab)))


def planner():
    show("planner", simple.StylisticPlannerFilter(
        Database=made["database"], Objects=made["object"], Constraints=made["rows"], Obstacles=made["ground"],
        Guides=made["guide"]))


def writer():
    show("writer", simple.MotionSceneWriter(
        Objects=made["object"], Constraints=made["rows"], Obstacles=made["ground"]), None)
    simple.SaveData(SCENE, proxy=made["writer"])


def stages():
    """Those of an animation, which are joined already; nothing of it runs."""
    animation = simple.WaftAnimation(FileName=SCENE, Quality="Full")
    waft.unfold(animation)


def look_at(name):
    return lambda: simple.SetActiveSource(simple.FindSource(name))


def finish():
    data = {name: proxy.GetClientSideObject().GetOutputDataObject(0) for name, proxy in made.items()}
    report = made["planner"].GetClientSideObject().GetOutputDataObject(2)
    result = {"tracks": data["planner"].GetNumberOfLines(),
              "statuses": [report.GetValueByName(row, "Status").ToString() for row in range(report.GetNumberOfRows())]}
    write(result)
    end()


STEPS = [
    lambda: show("object", simple.ObjectSource(Position=[-1, 0, 3])),
    lambda: show("way", simple.ConstraintSource(Frame=100, LastFrame=200, UseWaypoints=1)),
    lambda: show("rest", simple.ShapeKeyframeSource(Frame=270, NumberOfTargets=1, Width=0.5)),
    lambda: show("rows", simple.AppendGeometry(Input=[made["way"], made["rest"]])),
    lambda: show("guide", simple.PolyLineSource(Points=[-1, 0, 3, -0.8, 0.5, 2.5, -0.5, 0, 2])),
    ground, database, planner, writer, lambda: show("leaf", simple.LeafShapeSource(), None),
    lambda: simple.SetActiveSource(simple.GridSmokeSource()), stages, *map(look_at, ("Assimilation", "Spacetime", "Rotation")),
    finish]
steps = iter(STEPS)
watch(lambda: next(steps)(), between=300)
