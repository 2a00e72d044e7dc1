# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own tracers in the air of a flight: let go where the bodies start, they come to the bodies' first marks.

    waft synthesize Data/Scenes/bubbles-two-marks.waft.json --quality air --keep air -o out
    pvpython Documentation/examples/follow_air.py out [PICTURE]

prints how far each tracer is from its body at these marks. Of bodies that sink straight down with one settling speed, as
bubbles do, and start in flight. Nothing of Waft is loaded; a Calculator adds the settling to the velocity."""
import csv
import pathlib
import statistics
import sys

from paraview import servermanager, simple


def first_marks(folder):
    """Their frame, and {ObjectId: row of constraints.csv}."""
    with open(folder / "constraints.csv", encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["Kind"] == "position"]
    frame = min(int(row["Frame"]) for row in rows)
    return frame, {int(row["ObjectId"]): row for row in rows if int(row["Frame"]) == frame}


def tracers(folder, frame):
    """ParticlePath in the air of a folder, from where its bodies start to a frame."""
    bodies = simple.XMLPolyDataReader(FileName=[str(folder / "objects.vtp")])
    bodies.UpdatePipeline()
    settling = bodies.PointData["SettlingSpeed"].GetRange()[1]
    air = simple.PVDReader(FileName=str(folder / "air.pvd"))
    air.UpdatePipelineInformation()
    drift = simple.Calculator(Input=air, ResultArrayName="Drift", Function=f"Velocity - {settling!r} * kHat")
    paths = simple.ParticlePath(Input=drift, SeedSource=bodies, StaticSeeds=1, SelectInputVectors=["POINTS", "Drift"],
                                TerminationTime=air.TimestepValues[frame])
    paths.UpdatePipeline(paths.TerminationTime)
    return paths


def ends(folder, paths, frame):
    """{ObjectId: (where its tracer is at a frame, where itself)}, and the width of the volume."""
    ways = servermanager.Fetch(simple.XMLPolyDataReader(FileName=[str(folder / "assimilated.vtp")]))
    found = servermanager.Fetch(paths)
    seeds, steps = (found.GetPointData().GetArray(name) for name in ("InjectedPointId", "SimulationTimeStep"))
    last = {int(seeds.GetValue(i)): found.GetPoint(i) for i in range(found.GetNumberOfPoints()) if steps.GetValue(i) == frame}
    ids = ways.GetCellData().GetArray("ObjectId")
    both = {int(ids.GetValue(cell)): (last[cell], ways.GetPoint(ways.GetCell(cell).GetPointId(frame))) for cell in last}
    bounds = ways.GetFieldData().GetArray("Bounds")
    return both, bounds.GetValue(1) - bounds.GetValue(0)


def show(paths, both, picture):
    """The tracers' ways by their age, and the bodies that they come to."""
    view = simple.CreateView("RenderView", ViewSize=[900, 640], OrientationAxesVisibility=0, UseColorPaletteForBackground=0,
                             Background=[1, 1, 1])
    ways = simple.Show(simple.Tube(Input=paths, Radius=0.005), view)
    simple.ColorBy(ways, ("POINTS", "ParticleAge"))
    ways.SetScalarBarVisibility(view, False)
    for _, body in both.values():
        bubble = simple.Show(simple.Sphere(Center=body, Radius=0.03, ThetaResolution=24, PhiResolution=24), view)
        bubble.DiffuseColor = bubble.AmbientColor = [0.95, 0.75, 0.2]
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [1.6, -3.6, 2.6], [0, 0, 1.05], [0, 0, 1]
    simple.SaveScreenshot(str(picture), view)


def misses(folder, picture=None):
    """How far each tracer is from its body at the first marks, over the width of the volume, the nearest first."""
    frame, marks = first_marks(folder)
    paths = tracers(folder, frame)
    both, width = ends(folder, paths, frame)
    if picture:
        show(paths, both, picture)
    return sorted(sum((a - b) ** 2 for a, b in zip(*both[body])) ** 0.5 / width for body in marks)


if __name__ == "__main__":
    each = misses(pathlib.Path(sys.argv[1]), *sys.argv[2:3])
    print(f"{len(each)} tracers are off their marks by {statistics.median(each):.2g} widths of the volume in the median, "
          f"{each[int(0.9 * (len(each) - 1))]:.2g} in the 90th percentile")
