# SPDX-License-Identifier: BSD-3-Clause
"""A stage of the pipeline by itself: made small, run for a short time, and its outputs looked at."""
import math
import tempfile
import time

# Before any of their classes is met as a proxy, which would pass as its base class from then on.
from waft import vtkWaftFilters, vtkWaftSources

LONGEST = 1.5  # s; then a stage is asked to stop

ABSTRACT = ("vtkChainStageAlgorithm", "vtkKeptPolyDataAlgorithm", "vtkPaintedShapeSource", "vtkSlicedPolyDataAlgorithm", "vtkThinShapeSource")

# So that a test takes no longer than it must.
SMALL = {
    "vtkAirAssimilationFilter": {"Resolution": 16, "LatticeResolution": 8, "Candidates": 1, "Starts": 0, "Rounds": 1,
                                 "WindRounds": 1},
    "vtkSPHSpacetimeFilter": {"NumberOfGasParticles": 200, "MaximumNumberOfIterations": 5, "LeashIterations": 2},
    "vtkGridSmokeSource": {"NumberOfFrames": 5, "Resolution": (8, 8, 8)},
    "vtkMotionDatabaseSource": {"NumberOfSimulations": 1, "NumberOfFrames": 20, "Resolution": 8},
}


def classes():
    """{name: class} of all that the two modules have and that can be made."""
    from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

    return {name: made for module in (vtkWaftSources, vtkWaftFilters) for name, made in vars(module).items()
            if isinstance(made, type) and issubclass(made, vtkAlgorithm) and name not in ABSTRACT}


def stage_of(name):
    algorithm = classes()[name]()
    for setting, value in SMALL.get(name, {}).items():
        getattr(algorithm, f"Set{setting}")(value)
    return algorithm


def listen(algorithm):
    """A list that the errors come into, in place of the console."""
    errors = []

    def take(_caller, _event, text):
        errors.append(text)
    take.CallDataType = "string0"
    algorithm.AddObserver("ErrorEvent", take)
    algorithm.GetExecutive().AddObserver("ErrorEvent", take)
    return errors


def update(algorithm, longest=LONGEST):
    """Runs a stage, or asks it to stop after a while [s]; returns its errors."""
    errors = listen(algorithm)
    began = time.monotonic()

    def stop(*_):
        if time.monotonic() - began > longest:
            algorithm.SetAbortExecute(1)
    algorithm.AddObserver("ProgressEvent", stop)
    if hasattr(algorithm, "Write"):
        with tempfile.TemporaryDirectory() as folder:
            if hasattr(algorithm, "SetFileName"):
                suffix = {"vtkMotionAnimationWriter": ".glb", "vtkVDBWriter": ".vdb"}.get(algorithm.GetClassName(), ".waft.json")
                algorithm.SetFileName(f"{folder}/written{suffix}")
            algorithm.Write()
    else:
        algorithm.Update()
    return errors


def _leaves(data):
    if data is None:
        return
    if data.IsA("vtkMultiBlockDataSet"):
        for i in range(data.GetNumberOfBlocks()):
            yield from _leaves(data.GetBlock(i))
    else:
        yield data


def _size(data):
    return data.GetNumberOfRows() if data.IsA("vtkTable") else data.GetNumberOfPoints()


def _is_finite(array):
    return array is None or array.GetDataTypeAsString() not in ("double", "float") or all(
        math.isfinite(end) and abs(end) < 1e30 for c in range(array.GetNumberOfComponents()) for end in array.GetRange(c)
    ) and not _has_nan(array)


def _has_nan(array):
    # A range passes NaN over.
    return any(math.isnan(array.GetComponent(i, c)) for i in range(min(array.GetNumberOfTuples(), 5000))
               for c in range(array.GetNumberOfComponents()))


def wrong_with(algorithm, errors):
    """A sentence on what is wrong with the outputs of a stage that ran, or nothing."""
    for port in range(algorithm.GetNumberOfOutputPorts()):
        for leaf in _leaves(algorithm.GetOutputDataObject(port)):
            if errors and _size(leaf) > 0:
                return f"output {port} has {_size(leaf)} points or rows beside the error {errors[0][-150:]}"
            if leaf.IsA("vtkTable") or _size(leaf) == 0:
                continue
            if leaf.IsA("vtkPointSet") and not _is_finite(leaf.GetPoints().GetData()):
                return f"output {port}: its points are not finite"
            for holder in (leaf.GetPointData(), leaf.GetCellData()):
                for i in range(holder.GetNumberOfArrays()):
                    if not _is_finite(holder.GetArray(i)):
                        return f"output {port}: array {holder.GetArrayName(i)} is not finite"
    return ""
