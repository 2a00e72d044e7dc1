# SPDX-License-Identifier: BSD-3-Clause
"""Writes, at the end of each stage's page, the table of the arrays that its outputs have: port, name, type, components, unit.

    pvpython make_array_tables.py PAGES [--check]

PAGES is the folder Documentation. The arrays are those of the chain's table, which has to have those that the stages give for a small
scene of all kinds of rows, flown here; of the other stages those that they give. With --check nothing is written, and the exit status
is 1 where a page has another table. An array whose unit is not known is an error."""
import pathlib
import sys
import tempfile

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkTable

import waft
from waft.run._chain import STAGES

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
TABLE = {stage["proxy"]: stage["arrays"] for stage in STAGES.values()}
# Of the stages that the chain's table does not have, by name where it has none of that name. What is counted, numbered, named or a
# share has none.
UNITS = {name: unit for unit, names in {
    "m": "Translation Mean Coefficients Radius",
    "m/s": "TopSpeed MeanWind",
    "m/s^2": "WindForce",
    "1/s": "Vorticity",
    "w, x, y, z": "Rotation",
    NONE: "Density Obstacle Simulation Window Rank RelativeError Basis Medoid FirstChild NumberOfChildren NumberOfSegments Before After "
          "IsConnectible Key Value",
}.items() for name in names.split()}
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


def known_units():
    """{array: unit} of the table's outputs, the first that has it, and of the others."""
    units = dict(UNITS)
    for arrays in (arrays for stage in TABLE.values() for arrays in stage.values()):
        for _, array, _, _, unit in arrays:
            units.setdefault(array, unit or NONE)
    return units


def given_by(stage):
    """{port: [[of what, array, type, components]]} of what a stage gave."""
    ports = {}
    client = stage.GetClientSideObject()
    for port in range(client.GetNumberOfOutputPorts()):
        name = stage.SMProxy.GetOutputPortName(port)
        for part, data in parts_of(client.GetOutputDataObject(port)):
            where = f"{name}, `{part}`" if name == "Database" else name  # blocks of other names are the scene's own
            for kind, array in arrays_of(data):
                row = [kind, array.GetName(), TYPES[array.GetDataTypeAsString()], components_of(array.GetName(), array)]
                if row not in ports.setdefault(where, []):
                    ports[where].append(row)
    return ports


def rows_of(stage, name):
    """Cells of a table's lines; KeyError where an array has no unit, ValueError where a stage gives others than the chain's table has."""
    given = given_by(stage)
    if name not in TABLE:
        units = known_units()
        return [(port, of, array, kind, count, units[array]) for port, rows in given.items() for of, array, kind, count in rows]
    told = {port: [row[:4] for row in rows] for port, rows in TABLE[name].items()}
    for port in {**told, **given}:
        here, there = told.get(port, []), given.get(port, [])
        other = [row for row in here + there if row not in here or row not in there]
        if other:
            raise ValueError(f"{name}, {port}: in the chain's table or in what the stage gave, not in both: {other}")
    return [(port, *row) for port, rows in TABLE[name].items() for row in rows]


def components_of(name, array):
    return "rank" if name in ("Coefficients", "Basis") else array.GetNumberOfComponents()


def table_of(made, names):
    """A page's section on arrays."""
    lines = [BEGIN, "## Arrays of the outputs", "",
             "Of points, of cells, of a table's rows or of the whole (field data), in world axes, z up. Without a unit (`-`) are",
             "numbers, names, shares and the like. All outputs have the field data `Bounds` [m], `NumberOfFrames`,",
             "`FramesPerSecond` [1/s], `AirDensity` [kg/m^3] and `Seed` besides, and `Open` (int[3]: x, y, top) where sides are,",
             "`Breeze` (double[3]) [m/s] where one blows, `Loops` (int) where the last frame leads on to the first.", ""]
    lines += ["| port | array | of | type | components | unit |", "|---|---|---|---|---|---|"]
    lines += [f"| {port} | `{array}` | {of} | {kind} | {count} | {unit or NONE} |"
              for name in names for port, of, array, kind, count, unit in rows_of(made[name], name)]
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
