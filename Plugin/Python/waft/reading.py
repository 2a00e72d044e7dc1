# SPDX-License-Identifier: BSD-3-Clause
"""Files that are read, with a look at them first. What this package reads goes through here, or through beneath.py: only regular
files, nothing is waited for, no more than a bound; VTK's readers, which trust what they are given, come after Waft's own look."""
import csv
import io
import json
import math
import os
import pathlib
import stat
import xml.etree.ElementTree as ElementTree

from waft.failures import InputError

MOST = 1 << 30  # bytes of a file that is read whole, unless its reader says less
MOST_TEXT = 1 << 28  # of a scene, a table, a report
LOOK = os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC  # a pipe without a writer is not waited for
_KINDS = {stat.S_IFDIR: "a folder", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket", stat.S_IFCHR: "a device",
          stat.S_IFBLK: "a device", stat.S_IFLNK: "a link", stat.S_IFREG: "a file"}


def found_in_words(about):
    """What there is, by its os.stat_result."""
    return _KINDS.get(stat.S_IFMT(about.st_mode), "something else")


def kind_of(about):
    """What there is in place of a file; empty of a regular file."""
    return "" if stat.S_ISREG(about.st_mode) else found_in_words(about)


def open_file(path, what="a file"):
    """A descriptor of a regular file, to be read; raises InputError that names the file and what was found, as all here do. what:
    is named as expected."""
    try:
        return regular(os.open(path, LOOK), path, what)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}; expected {what}") from error
    except ValueError as error:
        raise InputError(f"{path!r}: {error}; expected {what}") from error


def regular(descriptor, path, what):
    """A descriptor of what a path leads to, which is closed unless that is a regular file."""
    found = kind_of(os.fstat(descriptor))
    if found:
        os.close(descriptor)
        raise InputError(f"{path}: expected {what}, found {found}")
    return descriptor


def check_scene_file(path, lack="no such scene file"):
    """Raises InputError where a path is none of a regular file; lack: what is said where nothing is there. `-` is what other programs call
    their input, which is no file that others could be beside."""
    try:
        found = kind_of(os.stat(path))
    except (OSError, ValueError) as error:
        if str(path) != "-":
            raise InputError(f"{path}: {lack}") from error
        found = "a pipe"
    if found:
        raise InputError(f"{path}: expected a regular file, found {found}")


def open_stream(path, what="a file"):
    """A binary stream of a regular file, for one that is read piece by piece."""
    return open(open_file(path, what), "rb")


def _pieces(stream, most):
    """Up to so many bytes, of which none are asked for before they are there: a read of all at once takes the memory at once."""
    while most > 0 and (piece := stream.read(min(most, 1 << 20))):
        most -= len(piece)
        yield piece


def content_of(descriptor, path, most=MOST):
    """All bytes behind a descriptor of open_file, which is closed."""
    with open(descriptor, "rb") as stream:
        size = os.fstat(descriptor).st_size
        try:
            content = b"".join(_pieces(stream, most + 1 if size <= most else 0))
        except OSError as error:
            raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    if max(size, len(content)) > most:  # one of /proc has the size 0
        raise InputError(f"{path}: expected a file of at most {most} bytes, found one of {max(size, len(content))} or more")
    return content


def text_of(content, path, what="a text"):
    """Bytes as text; a mark of the byte order is left out."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected {what} in UTF-8: {error}") from error


def json_of(text, path, parse_constant=None):
    """What a text of JSON holds."""
    try:
        return json.loads(text, parse_constant=parse_constant)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: expected JSON in UTF-8: {error}") from error


def rows_of(text, path, what="a table"):
    """The rows of a text of comma-separated values, as dictionaries by the names in its first line."""
    try:
        return list(csv.DictReader(io.StringIO(text, newline="")))
    except csv.Error as error:
        raise InputError(f"{path}: expected {what}: {error}") from error


def read_bytes(path, most=MOST, what="a file"):
    """A file's content."""
    return content_of(open_file(path, what), path, most)


def read_text(path, most=MOST_TEXT, what="a text"):
    """The same as text."""
    return text_of(read_bytes(path, most, what), path, what)


def read_json(path, most=MOST_TEXT, what="a file of JSON", parse_constant=None):
    """The same as what it holds."""
    return json_of(read_text(path, most, what), path, parse_constant)


def read_rows(path, most=MOST_TEXT, what="a table"):
    """The rows of a .csv."""
    return rows_of(read_text(path, most, what), path, what)


def steps_of(text, path):
    """[(time in seconds, name of a file)] of the text of a ParaView collection, growing time."""
    try:
        steps = [(float(step.get("timestep")), step.get("file")) for step in ElementTree.fromstring(text).iter("DataSet")]
    except (ElementTree.ParseError, TypeError, ValueError) as error:
        raise InputError(f"{path}: not a collection with a timestep and a file each: {error}") from error
    if not all(math.isfinite(time) and name for time, name in steps):
        raise InputError(f"{path}: not a collection with a timestep and a file each")
    return sorted(steps)


def blocks_of(text, path):
    """Names of the files in the text of a .vtm."""
    try:
        return [name for name in (element.get("file") for element in ElementTree.fromstring(text).iter()) if name]
    except ElementTree.ParseError as error:
        raise InputError(f"{path}: expected a whole VTK XML file of blocks, found no XML: {error}") from error


def read_surface(path):
    """A .vtp as vtkPolyData."""
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    return _read("ReadSurface", path, vtkPolyData())


def read_blocks(path):
    """A .vtm of surfaces and tables as vtkMultiBlockDataSet."""
    from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

    return _read("ReadBlocks", path, vtkMultiBlockDataSet())


def read_image(path):
    """A .vti as vtkImageData."""
    from vtkmodules.vtkCommonDataModel import vtkImageData

    return _read("ReadImage", path, vtkImageData())


def read_picture(path):
    """A .png, .jpg, .tif or .bmp as vtkImageData."""
    from vtkmodules.vtkCommonDataModel import vtkImageData

    return _read("ReadPicture", path, vtkImageData())


def has_appended_blocks(path):
    """Whether files of a .vtm keep their values behind their elements, which VTK 9.1 cannot read with Expat 2.6, nor with the
    fixes of 2.5 that Debian 12 has; read_blocks can."""
    folder = pathlib.Path(path).with_suffix("")
    return folder.is_dir() and any(b"<AppendedData" in read_bytes(file) for file in folder.iterdir() if file.is_file())


def _read(function, path, data):
    _call(function, path, data)
    return data


def _call(function, path, *data):
    from waft.vtkWaftSources import vtkCheckedFiles

    lack = getattr(vtkCheckedFiles, function)(os.fsencode(path), *data)
    if lack:
        raise InputError(f"{path}: {lack}")


def dynamics(tracks):
    """How far optimised tracks are a motion of the optimiser's model, as they say themselves (SPHSpacetimeFilter): {name: number},
    without what cannot be had; nothing of others."""
    names = ("ReplayError", "GasReplayError", "GasHiddenHand", "RepairedFraction", "LargestRepair")
    arrays = {name: tracks.GetFieldData().GetArray(name) for name in names}
    return {name: array.GetValue(0) for name, array in arrays.items()
            if array is not None and array.GetNumberOfValues() == 1 and 0.0 <= array.GetValue(0) < math.inf}
