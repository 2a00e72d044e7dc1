# SPDX-License-Identifier: BSD-3-Clause
"""The whole chain in pvbatch: every stage a proxy by its name, numbers asserted, one picture compared.

    pvbatch test_chain.py BASELINE.png FOLDER [--update]     FOLDER: for the scene and the pictures
"""
import json
import os
import shutil
import sys

from paraview import simple

import baseline
import waft

BASELINE, FOLDER = sys.argv[1], sys.argv[2]
FRAMES = 61
MARK = [0.35, -0.2, 1.9]
SCENE = {
    "waft": 1,
    "title": "Three leaves",
    "time": {"frames": FRAMES},
    "shapes": {"leaf": {"builtin": "maple", "size": 0.35}},
    "objects": [{"shape": "leaf", "positions": [[-0.5, -0.4, 2.6], [0.6, 0.5, 2.7], [-0.3, 0.7, 2.4]]}],
    "constraints": [{"kind": "position", "object": 0, "frame": FRAMES - 1, "value": MARK}],
}


def check(condition, text):
    if not condition:
        raise AssertionError(text)
    print("ok:", text)


def build():
    os.makedirs(FOLDER, exist_ok=True)
    scene = os.path.join(FOLDER, "chain.waft.json")
    with open(scene, "w", encoding="utf-8") as stream:
        json.dump(SCENE, stream)
    reader = simple.MotionSceneReader(FileName=scene)
    reader.UpdatePipeline()
    objects, constraints, obstacles, shapes = (simple.OutputPort(reader, i) for i in range(4))
    database = simple.XMLMultiBlockDataReader(FileName=[waft.data_file("Database/embedded.vtm")])
    planner = simple.StylisticPlannerFilter(
        Database=database, Objects=objects, Constraints=constraints, Obstacles=obstacles)
    spacetime = simple.SPHSpacetimeFilter(
        Tracks=simple.OutputPort(planner, 0), Objects=objects, Constraints=simple.OutputPort(planner, 3),
        Obstacles=obstacles, Vortices=simple.OutputPort(planner, 4))
    spacetime.NumberOfGasParticles = 400
    rotation = simple.RotationRefineFilter(
        Tracks=simple.OutputPort(spacetime, 0), Objects=objects, Shapes=shapes, Obstacles=obstacles,
        Constraints=simple.OutputPort(planner, 3))
    return reader, planner, spacetime, rotation


def check_numbers(planner, spacetime, rotation):
    rotation.UpdatePipeline()
    turner = rotation.GetClientSideObject()
    poses = turner.GetOutputDataObject(1)
    check(poses.GetNumberOfPoints() == 3 * FRAMES, "poses have a point an object and a frame")
    for name in ("Frame", "Time", "Velocity", "ForceType", "VortexId", "Force", "AirVelocity", "SPHVelocity",
                 "Orientation", "AngularVelocity", "Torque"):
        check(poses.GetPointData().HasArray(name), f"poses carry {name}")
    for track, start in enumerate(SCENE["objects"][0]["positions"]):
        check(max(abs(a - b) for a, b in zip(poses.GetPoint(track * FRAMES), start)) <= 4e-9, f"object {track} starts at its place")
    check(max(abs(a - b) for a, b in zip(poses.GetPoint(FRAMES - 1), MARK)) <= 4e-9, "the mark is hit exactly")
    turned = poses.GetPointData().GetArray("Orientation")
    norms = [sum(c * c for c in turned.GetTuple4(i)) for i in range(turned.GetNumberOfTuples())]
    check(max(abs(n - 1.0) for n in norms) < 1e-9, "quaternions are unit")
    report = turner.GetOutputDataObject(2)
    check([report.GetColumnName(c) for c in range(report.GetNumberOfColumns())]
          == ["Row", "Target", "ObjectId", "Frame", "Kind", "Residual", "Status", "Message", "TouchDown", "Settled",
              "Arrival", "Release", "Leave"],
          "the report of orientations has the columns of the other reports")

    convergence = spacetime.GetClientSideObject().GetOutputDataObject(4)
    stages = [convergence.GetColumnByName("Stage").GetValue(r) for r in range(convergence.GetNumberOfRows())]
    energies = [convergence.GetColumnByName("E").GetValue(r) for r in range(convergence.GetNumberOfRows())]
    passes = [convergence.GetColumnByName("Pass").GetValue(r) for r in range(convergence.GetNumberOfRows())]
    check((stages[0], stages[-1]) == ("initial", "final"), "convergence runs from initial to final")
    check(energies[-1] < 0.5 * energies[0], f"E falls from {energies[0]:.4g} to {energies[-1]:.4g}")
    rises = sum(energies[i] > energies[i - 1] for i in range(1, len(stages))
                if (stages[i], passes[i]) == (stages[i - 1], passes[i - 1]))
    check(rises == 0, "E never grows within a stage")
    report = spacetime.GetClientSideObject().GetOutputDataObject(5)
    check([report.GetColumnByName("Status").GetValue(r) for r in range(report.GetNumberOfRows())] == ["met"],
          "the report says met")
    tracks = planner.GetClientSideObject().GetOutputDataObject(0)
    check(tracks.GetNumberOfCells() == 3, "one planned track an object")


def check_frames_come_from_the_cache(spacetime, rotation):
    """Playing runs no stage again: what each output shows was computed once."""
    runs = []
    spacetime.GetClientSideObject().AddObserver("ProgressEvent", lambda *_: runs.append(1))
    shown = set()
    for frame in (0, 30, 12, 60, 30):
        rotation.UpdatePipeline(frame / 30.0)
        meshes = rotation.GetClientSideObject().GetOutputDataObject(0)
        shown.add(meshes.GetPoint(0))
    check(not runs, "serving frames does not run the optimiser")
    check(len(shown) == 4, "each frame shows its own pose, in any order")


def write_whirl(path):
    """Air that turns about the vertical with 2 rad/s, as a wind's file."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
    import numpy

    image = vtkImageData()
    image.SetDimensions(9, 9, 2)
    image.SetOrigin(-2.0, -2.0, 0.0)
    image.SetSpacing(0.5, 0.5, 4.0)
    places = numpy.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    air = numpy.stack([-2.0 * places[:, 1], 2.0 * places[:, 0], 0.0 * places[:, 2]], axis=1)
    velocity = numpy_to_vtk(air.astype(numpy.float32), deep=True)
    velocity.SetName("Velocity")
    image.GetPointData().AddArray(velocity)
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def check_wind():
    """What synthesize builds lets the objects feel the scene's wind: a level disc is taken round by it."""
    write_whirl(os.path.join(FOLDER, "whirl.vti"))
    scene = os.path.join(FOLDER, "wind.waft.json")
    with open(scene, "w", encoding="utf-8") as stream:
        json.dump({"waft": 1, "time": {"frames": 31}, "winds": [{"file": "whirl.vti"}],
                   "shapes": {"disc": {"builtin": "disc"}},
                   "objects": [{"shape": "disc", "position": [0.0, 0.0, 2.5]}]}, stream)
    run = waft.synthesize(scene, preview=True, _settings={"Assimilation": {"Resolution": 16, "LatticeResolution": 12}})
    run.assimilation.Glide = 0.0  # else paths bring the poses that they were found with

    ports = {name: simple.OutputPort(run.reader, place) for place, name in ((0, "Objects"), (2, "Obstacles"), (3, "Shapes"))}
    still = simple.RotationRefineFilter(
        Tracks=simple.OutputPort(run.assimilation, 0), Constraints=simple.OutputPort(run.planner, 3), **ports)
    still.Seed = run.rotation.Seed

    def turned(rotation):
        rotation.UpdatePipeline()
        poses = rotation.GetClientSideObject().GetOutputDataObject(1)
        return [poses.GetPointData().GetArray("Orientation").GetTuple4(k) for k in range(31)]

    check(turned(run.rotation) != turned(still), "the objects of a scene turn in its wind")


def take_picture(rotation, frame, name):
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewTime = frame / 30.0
    view.ViewSize = [320, 240]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.1, 0.1, 0.15]
    view.CameraPosition = [0.0, -2.2, 4.8]
    view.CameraFocalPoint = [0.05, 0.1, 2.2]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraViewAngle = 16.0
    shown = simple.Show(simple.OutputPort(rotation, 0), view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor = [0.9, 0.5, 0.2]
    path = os.path.join(FOLDER, name)
    simple.SaveScreenshot(path, view)
    return path


def check_picture(rotation):
    seen = take_picture(rotation, 30, "chain.png")
    later = take_picture(rotation, 31, "chain-later.png")
    if "--update" in sys.argv:
        shutil.copyfile(seen, BASELINE)
    check(baseline.agree(seen, BASELINE), f"the picture agrees with {os.path.basename(BASELINE)}")
    error = baseline.error(later, BASELINE)
    check(error > 2.0 * baseline.THRESHOLD, f"the picture one frame later is rejected, by {error:.3g}")


def main():
    _, planner, spacetime, rotation = build()
    check_numbers(planner, spacetime, rotation)
    check_frames_come_from_the_cache(spacetime, rotation)
    check_picture(rotation)
    check_wind()
    print("all checks passed")


main()
