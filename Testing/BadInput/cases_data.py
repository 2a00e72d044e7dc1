# SPDX-License-Identifier: BSD-3-Clause
"""Every stage given damaged data, input by input: an error and nothing in the outputs, or outputs that are finite."""
import functools
import json
import pathlib
import tempfile

from case import LEAF, Case
from stages import LONGEST, stage_of, update, wrong_with

SCENE = LEAF | {
    "constraints": [{"kind": "position", "object": 0, "frame": 30, "value": [0.0, 0.0, 1.6], "radius": 0.1}],
    "obstacles": [{"kind": "sphere", "center": [1.0, 1.0, 1.0], "radius": 0.3}],
    "vortices": [{"p1": [0.0, 0.0, 1.0], "p2": [0.0, 0.0, 2.0], "strength": 0.1, "centerTime": 0.5, "duration": 0.5,
                  "coreRadius": 0.2}],
    "winds": [{"direction": [1.0, 0.0, 0.0], "strength": 0.2, "center": [0.0, 0.0, 2.0], "radius": 1.0, "centerTime": 0.5,
               "duration": 0.5}],
}
# Inputs by port; None: nothing is connected.
STAGES = {
    "vtkStylisticPlannerFilter": ("database", "objects", "constraints", "obstacles", "guides"),
    "vtkAirAssimilationFilter": ("tracks", "objects", "constraints", "obstacles", "wind", "vortices"),
    "vtkSPHSpacetimeFilter": ("tracks", "objects", "constraints", "obstacles", "vortices", "wind", "air"),
    "vtkVortexFitFilter": ("flown", "vortices"),
    "vtkRotationRefineFilter": ("tracks", "objects", "shapes", "obstacles", "wind", "constraints", "air"),
    "vtkTrajectoryTraceFilter": ("flow", "vortices", "obstacles"),
    "vtkTrajectoryClusterFilter": ("flown", "vortices"),
    "vtkGridSmokeSource": (None, "obstacles", "wind", "vortices"),
    "vtkMotionAnimationWriter": ("poses", "objects", "shapes", "constraints"),
    "vtkMotionSceneWriter": ("objects", "constraints", "obstacles", "shapes", "vortices", "wind"),
    "vtkVDBWriter": ("flow",),
    "vtkMotionSceneFileWriter": ("scene",),
    "vtkObjectSource": (None, "shapes"),
    "vtkShapeKeyframeSource": ("obstacles", "objects"),
}
# What is damaged beside being put into blocks; the others take the same data by the same functions.
DAMAGED = [stage for stage in STAGES if stage not in ("vtkMotionSceneFileWriter", "vtkObjectSource", "vtkShapeKeyframeSource")]
# How a message calls an input whose name is not that of its data.
CALLED = {("vtkTrajectoryTraceFilter", "flow"): "Input", ("vtkVDBWriter", "flow"): "Input", ("vtkVortexFitFilter", "flown"): "Input",
          ("vtkTrajectoryClusterFilter", "flown"): "Input", ("vtkMotionSceneFileWriter", "scene"): "Input",
          ("vtkShapeKeyframeSource", "obstacles"): "Input"}
JOINED = ("tracks", "flown", "poses", "obstacles", "vortices")  # whose cells say what belongs together


@functools.lru_cache(maxsize=None)
def good():
    """The data that stages pass on, of one small run."""
    from vtkmodules.vtkCommonCore import vtkFloatArray
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from waft import data_file, synthesize
    from waft.reading import read_blocks

    places = {"objects": ("reader", 0), "obstacles": ("reader", 2), "shapes": ("reader", 3), "vortices": ("reader", 4),
              "wind": ("reader", 5), "tracks": ("planner", 0), "constraints": ("planner", 3),
              "flown": ("assimilation", 0), "poses": ("rotation", 1)}
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "scene.waft.json"
        path.write_text(json.dumps(SCENE), encoding="utf-8")
        run = synthesize(str(path), preview=True, threads=1)
        made = {name: _copy(run.output(*place)) for name, place in places.items()}
    flow = vtkImageData()
    flow.SetDimensions(4, 4, 4)
    flow.SetOrigin(-2.0, -2.0, 0.0)
    flow.SetSpacing(4.0 / 3.0, 4.0 / 3.0, 4.0 / 3.0)
    velocity = vtkFloatArray()
    velocity.SetName("Velocity")
    velocity.SetNumberOfComponents(3)
    velocity.SetNumberOfTuples(64)
    velocity.Fill(0.1)
    flow.GetPointData().AddArray(velocity)
    database = read_blocks(data_file("Database/embedded.vtm"))
    made |= {"flow": flow, "air": flow, "database": _copy(database), "guides": _copy(made["tracks"])}
    return made | {"scene": _gathered(made)}


def _gathered(data):
    """The output of a scene writer."""
    writer = stage_of("vtkMotionSceneWriter")
    for port, name in enumerate(STAGES["vtkMotionSceneWriter"]):
        writer.SetInputDataObject(port, data[name])
    writer.Update()
    return _copy(writer.GetOutputDataObject(0))


def _copy(data):
    copy = data.NewInstance()
    copy.DeepCopy(data)
    return copy


def _with_id(number):
    """Makes a point's number in the last cell of each kind another one."""
    def damage(surface):
        from vtkmodules.vtkCommonCore import vtkIdList
        from vtkmodules.vtkCommonDataModel import vtkCellArray

        for kind in ("Lines", "Polys"):
            cells = getattr(surface, f"Get{kind}")()
            made = vtkCellArray()
            ids = vtkIdList()
            for cell in range(cells.GetNumberOfCells()):
                cells.GetCellAtId(cell, ids)
                if cell == cells.GetNumberOfCells() - 1:
                    ids.SetId(ids.GetNumberOfIds() - 1, number)
                made.InsertNextCell(ids)
            getattr(surface, f"Set{kind}")(made)
    return damage


def _empty(data):
    data.Initialize()


def _without_points(surface):
    from vtkmodules.vtkCommonCore import vtkPoints

    surface.SetPoints(vtkPoints())


def _points_at(value):
    def damage(surface):
        if surface.GetNumberOfPoints() > 0:
            surface.GetPoints().SetPoint(surface.GetNumberOfPoints() // 2, value, 0.0, 0.0)
    return damage


def _arrays_of(value):
    """A number of each array of floating point numbers is another one."""
    def damage(data):
        for holder in (data.GetPointData(), data.GetCellData()):
            for i in range(holder.GetNumberOfArrays()):
                array = holder.GetArray(i)
                if array is not None and array.GetDataTypeAsString() in ("double", "float") and array.GetNumberOfTuples() > 0:
                    array.SetComponent(array.GetNumberOfTuples() // 2, 0, value)
    return damage


def _field_of(name, *values):
    def damage(data):
        from vtkmodules.vtkCommonCore import vtkDoubleArray

        array = vtkDoubleArray()
        array.SetName(name)
        for value in values:
            array.InsertNextValue(value)
        data.GetFieldData().AddArray(array)
    return damage


def _call(name, *values):
    return lambda image: getattr(image, name)(*values)


NAN = float("nan")
# name: (damage, whether every stage has to refuse it)
SURFACES = {
    "nothing in it": (_empty, False),
    "cells without points": (_without_points, False),
    "points at NaN": (_points_at(NAN), True),
    "points at 1e308": (_points_at(1e308), True),
    "NaN in its arrays": (_arrays_of(NAN), False),
    "1e308 in its arrays": (_arrays_of(1e308), False),
}
CELLS = {
    "a point's number beyond its points": (_with_id(10 ** 6), True),
    "a point's number below 0": (_with_id(-1), True),
}
SCENES = {
    "1e300 frames a second": (_field_of("FramesPerSecond", 1e300), False),
    "air of density NaN": (_field_of("AirDensity", NAN), False),
    "bounds turned over": (_field_of("Bounds", 2.0, -2.0, 2.0, -2.0, 4.0, 0.0), False),
}
IMAGES = {
    "nothing in it": (_empty, False),
    "spacing 0": (_call("SetSpacing", 0.0, 0.0, 0.0), True),
    "spacing NaN": (_call("SetSpacing", NAN, NAN, NAN), True),
    "spacing -1": (_call("SetSpacing", -1.0, -1.0, -1.0), True),
    "origin NaN": (_call("SetOrigin", NAN, 0.0, 0.0), True),
    "a turned direction": (_call("SetDirectionMatrix", 0, -1, 0, 1, 0, 0, 0, 0, 1), True),
    "NaN in its arrays": (_arrays_of(NAN), True),
    "1e308 in its arrays": (_arrays_of(3e38), False),
}


def _of_block(damage):
    return lambda blocks: damage(blocks.GetBlock(0))


def _damages(name, port):
    if name in ("wind", "flow", "air"):
        return IMAGES
    if name == "shapes":
        return {damage: (_of_block(what), must) for damage, (what, must) in (SURFACES | CELLS).items()
                if "arrays" not in damage} | {"nothing in it": (_empty, False), "no block": (lambda b: b.SetBlock(0, None), False)}
    if name == "database":
        return {"nothing in it": (_empty, True), "no block": (lambda b: b.SetBlock(0, None), True)}
    return SURFACES | (CELLS if name in JOINED else {}) | (SCENES if port == 0 else {})


def _act(stage, port, change, must_fail):
    def act():
        inputs = [None if name is None else _copy(good()[name]) for name in STAGES[stage]]
        if change:
            change(inputs[port])
        algorithm, errors = _run(stage, inputs)
        if must_fail and not errors:
            return "taken without a word"
        return wrong_with(algorithm, errors)
    return act


def _group(*blocks):
    from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

    group = vtkMultiBlockDataSet()
    for number, block in enumerate(blocks):
        group.SetBlock(number, block)
    return group


def _collection(data):
    from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSetCollection

    collection = vtkPartitionedDataSetCollection()
    for number in range(data.GetNumberOfBlocks() if data.IsA("vtkMultiBlockDataSet") else 1):
        is_list = data.IsA("vtkMultiBlockDataSet")
        collection.SetPartition(number, 0, data.GetBlock(number) if is_list else data)
        if is_list and data.HasMetaData(number):
            collection.GetMetaData(number).Copy(data.GetMetaData(number))
    return collection


def _partitions(data):
    from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSet

    parts = vtkPartitionedDataSet()
    parts.SetPartition(0, data)
    return parts


def _points():
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.InsertNextPoint(0.0, 0.0, 1.0)
    grid.SetPoints(points)
    return grid


def _table():
    from vtkmodules.vtkCommonCore import vtkIntArray
    from vtkmodules.vtkCommonDataModel import vtkTable

    table = vtkTable()
    column = vtkIntArray()
    column.SetName("ObjectId")
    column.InsertNextValue(0)
    table.AddColumn(column)
    return table


# Words for what is wrong between inputs, where each by itself is right.
_BESIDE = ("Tracks: no ", "Constraints: row 0", "the guide of object 0", "ShapeId: ", "shape 0 of 0", "an object of this id and its shape")
_SHORT = 0.2  # s that a stage may run whose input is taken
# One data set is as by itself in these ...
AS_ONE = {
    "in a group": _group,
    "in a group of a group, with empty ones": lambda data: _group(_group(data, data.NewInstance()), None),
    "in a partitioned collection": _collection,
}
# ... and these are put together, or refused by the input's name.
OTHERWISE = {
    "in partitions": _partitions,
    "twice in a group": lambda data: _group(data, data),
    "with a grid beside it": lambda data: _group(data, _points()),
    "an empty group": lambda data: _group(),
    "a group of nothing": lambda data: _group(None, data.NewInstance()),
    "a grid": lambda data: _points(),
    "a table": lambda data: _table(),
}
LISTS = ("shapes", "database", "scene")  # which are blocks themselves, and stay what they are when one more group is round them


def _run(stage, inputs, longest=LONGEST):
    algorithm = stage_of(stage)
    if stage == "vtkShapeKeyframeSource":
        algorithm.SetShape(2)  # the surface that comes in
    for number, data in enumerate(inputs):
        if data is not None:
            algorithm.SetInputDataObject(number, data)
    return algorithm, update(algorithm, longest)


def _said(errors):
    """The first message without where it comes from."""
    return errors[0].partition("): ")[2].strip() if errors else ""


@functools.lru_cache(maxsize=None)
def _said_of_good(stage):
    """What a stage refuses of the good inputs as they are: the fit wants forces, which drifting bodies have none of."""
    return _said(_run(stage, [name and _copy(good()[name]) for name in STAGES[stage]], _SHORT)[1])


def _all_as_one(stage, form):
    def act():
        def formed(name):
            data = _copy(good()[name])
            is_itself = name in LISTS and "empty" in form or name == "scene" and "collection" in form  # of lists of lists
            return data if is_itself else AS_ONE[form](data)
        algorithm, errors = _run(stage, [name and formed(name) for name in STAGES[stage]], _SHORT)
        is_same = _said(errors) == _said_of_good(stage)
        return wrong_with(algorithm, errors) if is_same else f"said: {_said(errors)[-300:]}"
    return act


def _one_otherwise(stage, port):
    def wrong_in(form):
        inputs = [name and _copy(good()[name]) for name in STAGES[stage]]
        inputs[port] = OTHERWISE[form](inputs[port])
        algorithm, errors = _run(stage, inputs, _SHORT)
        name = STAGES[stage][port]
        called = CALLED.get((stage, name), name.capitalize())
        names = (f"{called}: ", "motion database: ", "the scene: ", *_BESIDE)
        if errors and _said(errors) != _said_of_good(stage) and not any(known in errors[0] for known in names):
            return f"{form}: does not name {called}: {errors[0][-300:]}"
        if not errors and form in ("a grid", "a table", "with a grid beside it"):
            return f"{form}: taken without a word"
        wrong = wrong_with(algorithm, errors)
        return wrong and f"{form}: {wrong}"
    is_list = STAGES[stage][port] in LISTS  # a list of blocks is no partition
    return lambda: next(filter(None, map(wrong_in, [form for form in OTHERWISE if not (is_list and form == "in partitions")])), "")


def cases():
    good()
    for stage, inputs in STAGES.items():
        for form in AS_ONE:
            yield Case("data", f"{stage}: all {form}", act=_all_as_one(stage, form))
        for port, name in enumerate(inputs):
            if name is not None:
                yield Case("data", f"{stage}: {name}: otherwise", act=_one_otherwise(stage, port))
    for stage in DAMAGED:
        inputs = [name for name in STAGES[stage] if name not in ("guides", "air")]
        yield Case("data", f"{stage}: all right", act=_act(stage, 0, None, False))
        for port, name in enumerate(inputs):
            if name is not None:
                for damage, (change, must_fail) in _damages(name, port).items():
                    yield Case("data", f"{stage}: {name}: {damage}", act=_act(stage, port, change, must_fail))
