# SPDX-License-Identifier: BSD-3-Clause
"""Writes, at the end of each stage's page, the table of the arrays that its outputs have: port, name, type, components, unit.

    pvpython make_array_tables.py PAGES [--check]

PAGES is the folder Documentation. The arrays are those that the stages give for a small scene of all kinds of rows, which is flown
here. With --check nothing is written, and the exit status is 1 where a page has another table. An array whose unit is not said below
is an error."""
import pathlib
import sys
import tempfile

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkTable

import waft

BEGIN, END = "<!-- arrays: by make_array_tables.py -->", "<!-- end of arrays -->"
EVERYWHERE = {"Bounds", "NumberOfFrames", "FramesPerSecond", "AirDensity", "Seed", "Authored", "Complete"}
PAGES = {  # whose arrays a page tells of: stages by the names that they have below
    "MotionSceneWriter": ["MotionSceneReader"],
    "GridSmokeSource": ["GridSmokeSource"],
    "TrajectoryTraceFilter": ["TrajectoryTraceFilter"],
    "TrajectoryClusterFilter": ["TrajectoryClusterFilter"],
    "StylisticPlannerFilter": ["StylisticPlannerFilter"],
    "AirAssimilationFilter": ["AirAssimilationFilter"],
    "SPHSpacetimeFilter": ["SPHSpacetimeFilter"],
    "RotationRefineFilter": ["RotationRefineFilter"],
    "VortexFitFilter": ["VortexFitFilter"],
}
NONE = "-"
# By name, where a port gives no other. What is counted, numbered, named or a share has none.
UNITS = {name: unit for unit, names in {
    "m": "CoreRadius ClearanceRadius RestHeight Shift Thickness Leash MaxViolation LargestRepair Translation Mean Coefficients Radius Ground",
    "m/s": "Velocity AirVelocity SPHVelocity Slip SettlingSpeed Control ControlRms ControlMedian FlowRms WindRms TopSpeed MeanWind "
           "BroadsideSpeed Speed",
    "m/s^2": "Force VortexAcceleration WindAcceleration VortexForce WindForce ResidualForce Residual Wind",
    "m^2/s^2": "Strength",
    "s": "Time CenterTime Duration Seconds",
    "1/s": "Vorticity Damping Follow",
    "rad/s": "AngularVelocity",
    "N m": "Torque",
    "kg": "Mass SlippingMass",
    "kg/m^2": "AreaDensity",
    "Pa": "Pressure",
    "dx": "PositionResidual",
    "dx a frame": "VelocityResidual",
    "w, x, y, z": "Orientation Rotation",
    "red, green, blue": "Color Tint",
    NONE: "Frame Free ForceType VortexId ObjectId ObjectIdGiven VelocityGiven OrientationGiven TouchDown Settled LiftOff Until Confidence "
          "ObjectCount Kind Row Target Group ClassId ShapeId ObstacleId Status Message Stage Candidate Span Tree Parent Segment Cost Take Met Rows "
          "CurvatureDistance AccelerationDistance Score Reached RetimingFactor Branches Planned Opacity Texture TextureCoordinates Normals DragCoefficient "
          "ReplayError GasReplayError GasHiddenHand RepairedFraction ParticleId Pass Iteration E Ex Ev Ec Clearance Approach Contact "
          "Separation EvObjects Fields E2 ShareVortices ShareWind ShareGas ShareDrag ShareLanding ShareNone Explained ExplainedLeftOut "
          "Density Obstacle Simulation Window Rank RelativeError Basis Medoid FirstChild NumberOfChildren NumberOfSegments Before After "
          "IsConnectible Key Facing FaceUp Lift RotationalLift PressureShift Pace",
    "rad": "FacingTolerance Spin",
    "degrees": "Agreement",
    "degrees a frame": "TurningLimit",
}.items() for name in names.split()}
OF_THE_KIND = "of the kind"  # m, m/s, m/s^2 or rad, as the row's Kind says
PORT_UNITS = {("Constraints", "Value"): OF_THE_KIND, ("Constraints", "Radius"): OF_THE_KIND, ("Report", "Residual"): OF_THE_KIND,
              ("Particles", "Density"): "kg/m^3", ("Convergence", "Control"): NONE, ("Database", "Value"): NONE}
TYPES = {"double": "double", "float": "float", "int": "int", "vtkIdType": "int 64", "long": "int 64", "long long": "int 64",
         "unsigned char": "byte", "signed char": "byte", "char": "byte", "string": "text", "unsigned int": "int", "short": "int 16",
         "unsigned short": "int 16", "unsigned long": "int 64", "unsigned long long": "int 64"}


def scene_file(folder):
    """Bodies of two shapes, each kind of row, an obstacle, a wind and a vortex."""
    scene = waft.Scene("Arrays", seed=5)
    scene.set_time(40)
    scene.add_shape("red", builtin="maple", size=0.15, color=(0.9, 0.15, 0.1))
    scene.add_objects("red", positions=[(-0.6, -0.5, 2.0), (0.4, 0.3, 2.2)])
    scene.add_position(0, 20, (-0.4, -0.3, 1.7), radius=0.1)
    scene.add_orientation(1, 25, (1, 0, 0, 0))
    scene.add_rest(1, 38, (0.6, 0.2, 0))
    scene.add_box((1.2, 1.2, 0), (1.5, 1.5, 1))
    scene.add_wind((1, 0, 0), 0.2, center=(0, 0, 1.5), radius=1, center_time=0.6, duration=0.4)
    scene.add_vortex((0, 0, 1), (0, 0, 2), 0.2, center_time=0.6, duration=0.4, core_radius=0.3)
    file = pathlib.Path(folder, "arrays.waft.json")
    scene.save(str(file))
    return str(file)


def stages(folder):
    """One of each that has a page, made and run."""
    animation = simple.WaftAnimation(FileName=scene_file(folder), Quality="Full")
    made = {stage.SMProxy.GetXMLName(): stage for stage in waft.unfold(animation).values()}
    air, gas = made["AirAssimilationFilter"], made["SPHSpacetimeFilter"]
    air.Resolution, air.LatticeResolution, air.Rounds = 16, 16, 1
    gas.NumberOfGasParticles, gas.Passes, gas.MaximumNumberOfIterations = 300, 1, 4
    smoke = made["GridSmokeSource"] = simple.GridSmokeSource(NumberOfFrames=40, Resolution=[16, 16, 16], NumberOfObstacles=1, WarmUpSeconds=0)
    tracks = made["TrajectoryTraceFilter"] = simple.TrajectoryTraceFilter(
        Input=smoke, Vortices=simple.OutputPort(smoke, "Vortices"), Obstacles=simple.OutputPort(smoke, "Obstacles"), SeedStride=4)
    made["TrajectoryClusterFilter"] = simple.TrajectoryClusterFilter(Input=tracks, Vortices=simple.OutputPort(smoke, "Vortices"))
    for stage in made.values():
        waft.update(stage)
    return made


def parts_of(data):
    """(name, data set or table) of each part; the name of a whole is empty."""
    if not isinstance(data, vtkCompositeDataSet):
        return [("", data)]
    parts = []
    iterator = data.NewIterator()
    while not iterator.IsDoneWithTraversal():
        info = iterator.GetCurrentMetaData()
        name = info.Get(vtkCompositeDataSet.NAME()) if info is not None else None
        parts.append((name or "", iterator.GetCurrentDataObject()))
        iterator.GoToNextItem()
    return parts


def arrays_of(data):
    """(of what, array) of a data set or table."""
    kinds = [("rows", "GetRowData")] if isinstance(data, vtkTable) else [("points", "GetPointData"), ("cells", "GetCellData")]
    for kind, getter in [*kinds, ("whole", "GetFieldData")]:
        held = getattr(data, getter)()
        for index in range(held.GetNumberOfArrays()):
            array = held.GetAbstractArray(index)
            if array.GetName() not in EVERYWHERE:
                yield kind, array


def rows_of(stage):
    """Cells of a table's lines; KeyError where an array has no unit."""
    rows = []
    client = stage.GetClientSideObject()
    for port in range(client.GetNumberOfOutputPorts()):
        name = stage.SMProxy.GetOutputPortName(port)
        for part, data in parts_of(client.GetOutputDataObject(port)):
            where = f"{name}, `{part}`" if name == "Database" else name  # blocks of other names are the scene's own
            for kind, array in arrays_of(data):
                own = array.GetName()
                unit = PORT_UNITS[name, own] if (name, own) in PORT_UNITS else UNITS[own]
                row = (where, f"`{own}`", kind, TYPES[array.GetDataTypeAsString()], str(components_of(own, array)), unit)
                if row not in rows:
                    rows.append(row)
    return rows


def components_of(name, array):
    return "rank" if name in ("Coefficients", "Basis") else array.GetNumberOfComponents()


def table_of(made, names):
    """A page's section on arrays."""
    lines = [BEGIN, "## Arrays of the outputs", "",
             "Of points, of cells, of a table's rows or of the whole (field data), in world axes, z up. Without a unit (`-`) are",
             "numbers, names, shares and the like. All outputs have the field data `Bounds` [m], `NumberOfFrames`,",
             "`FramesPerSecond` [1/s], `AirDensity` [kg/m^3] and `Seed` besides.", ""]
    lines += ["| port | array | of | type | components | unit |", "|---|---|---|---|---|---|"]
    lines += ["| " + " | ".join(row) + " |" for name in names for row in rows_of(made[name])]
    return "\n".join([*lines, END]) + "\n"


def main(folder, is_check):
    """Status: 1 where a page has another table than it should, and that is all that was asked."""
    with tempfile.TemporaryDirectory() as scratch:
        made = stages(scratch)
        stale = []
        for page, names in PAGES.items():
            file = pathlib.Path(folder, page + ".md")
            text = file.read_text(encoding="utf-8")
            before, _, rest = text.partition(BEGIN)
            _, _, after = rest.partition(END + "\n")
            wanted = before.rstrip("\n") + "\n\n" + table_of(made, names) + after
            if wanted != text:
                stale.append(file.name)
                if not is_check:
                    file.write_text(wanted, encoding="utf-8")
        if is_check and stale:
            print("other arrays than these pages have:", ", ".join(stale), "; pvpython make_array_tables.py PAGES writes them anew")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--check" in sys.argv[2:]))
