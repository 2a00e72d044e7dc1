# SPDX-License-Identifier: BSD-3-Clause
"""VTK's files and pictures, read with a look at them first: VTK's readers trust what they are given."""
import os
import pathlib

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkPolyData

from waft.failures import BadInput


def read_surface(path):
    """A .vtp as vtkPolyData; raises BadInput that names the file and the lack, as all here do."""
    return _read("ReadSurface", path, vtkPolyData())


def read_blocks(path):
    """A .vtm of surfaces and tables as vtkMultiBlockDataSet."""
    return _read("ReadBlocks", path, vtkMultiBlockDataSet())


def read_picture(path):
    """A .png, .jpg, .tif or .bmp as vtkImageData."""
    return _read("ReadPicture", path, vtkImageData())


def check_blocks(path, what):
    """Looks at a .vtm and the files of its blocks, without reading their values. what: names the content in the
    message."""
    if not os.path.isfile(path):
        raise BadInput(f"{path}: no such {what} file")
    _call("CheckBlocks", path)


def has_appended_blocks(path):
    """Whether files of a .vtm keep their values behind their elements, which VTK 9.1 cannot read with Expat 2.6, nor with the
    fixes of 2.5 that Debian 12 has; read_blocks can."""
    folder = pathlib.Path(path).with_suffix("")
    return folder.is_dir() and any(b"<AppendedData" in file.read_bytes() for file in folder.iterdir() if file.is_file())


def _read(function, path, data):
    _call(function, path, data)
    return data


def _call(function, path, *data):
    from waft.vtkWaftSources import vtkCheckedFiles

    lack = getattr(vtkCheckedFiles, function)(os.fsencode(path), *data)
    if lack:
        raise BadInput(f"{path}: {lack}")


def dynamics(tracks):
    """How far optimised tracks are a motion of the optimiser's model, as they say themselves (SPHSpacetimeFilter): {name: number},
    without what cannot be had; nothing of others."""
    names = ("ReplayError", "GasReplayError", "GasHiddenHand", "RepairedFraction", "LargestRepair")
    arrays = {name: tracks.GetFieldData().GetArray(name) for name in names}
    return {name: array.GetValue(0) for name, array in arrays.items() if array is not None and array.GetValue(0) >= 0.0}
