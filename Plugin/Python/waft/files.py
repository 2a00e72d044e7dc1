# SPDX-License-Identifier: BSD-3-Clause
"""Files that appear whole or not at all."""
import contextlib
import csv
import json
import os
import pathlib
import shutil
import tempfile
import xml.etree.ElementTree as ElementTree

from waft.failures import BadInput


class OutputFolder:
    """Gathers a run's files beside the folder they are for, and moves them in when all are there.

    Old results stay as they were until commit(); names that the run did not write are left alone.
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self._staging = pathlib.Path(tempfile.mkdtemp(prefix=".waft-", dir=self.folder))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self._staging, ignore_errors=True)

    def path(self, name):
        """Where to write the file of this name for now."""
        return str(self._staging / name)

    def commit(self):
        _move_in(self._staging, self.folder)


def _move_in(staging, folder):
    """What is in `staging` takes the place of entries of the same names in `folder`."""
    for entry in sorted(staging.iterdir()):
        target = folder / entry.name
        if target.is_dir() and not target.is_symlink():
            shutil.rmtree(target)
        os.replace(entry, target)


def check_folder(folder):
    """Raises BadInput unless files can be written in the folder, or it can be made; makes nothing."""
    place = pathlib.Path(folder).absolute()
    while not place.exists() and place != place.parent:
        place = place.parent
    if not place.is_dir():
        raise BadInput(f"{place}: expected a folder for the results, found a file")
    if not os.access(place, os.W_OK | os.X_OK):
        raise BadInput(f"{place}: expected a folder that may be written in")


def check_blocks(path, what):
    """Raises BadInput when a file is no multi-block data set (VTK's reader crashes on some of those) or the file of one
    of its blocks is missing. what: names the file's content in the message."""
    path = pathlib.Path(path)
    if not path.is_file():
        raise BadInput(f"{path}: no such {what} file")
    try:
        for _, entry in ElementTree.iterparse(path, events=("start",)):
            if entry.tag == "VTKFile" and entry.get("type") != "vtkMultiBlockDataSet":
                raise BadInput(f"{path}: expected a {what} (vtkMultiBlockDataSet), found {entry.get('type')}")
            if entry.tag == "AppendedData":
                break
            if entry.get("file") and not (path.parent / entry.get("file")).is_file():
                raise BadInput(f"{path}: block {entry.get('name')}: no such file as {entry.get('file')}")
    except ElementTree.ParseError as error:
        raise BadInput(f"{path}: expected a {what} (.vtm), found no XML: {error}") from error


def number(value):
    """A double with 17 significant digits, which reads back bit for bit."""
    return format(value, ".17g")


def write_csv(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def write_json(path, content):
    with open(path, "w", encoding="utf-8") as stream:
        json.dump(content, stream, indent=2)
        stream.write("\n")


def write_xml(data, path):
    """A VTK data set in its XML format, compressed; raises OSError when it could not be written."""
    from vtkmodules.vtkIOXML import (vtkXMLImageDataWriter, vtkXMLMultiBlockDataWriter,
                                     vtkXMLPolyDataWriter)

    writers = {".vtp": vtkXMLPolyDataWriter, ".vti": vtkXMLImageDataWriter,
               ".vtm": vtkXMLMultiBlockDataWriter}
    writer = writers[pathlib.Path(path).suffix]()
    writer.SetInputDataObject(data)
    writer.SetFileName(str(path))
    if writer.Write() != 1:
        raise OSError(f"{path}: could not be written")


def write_pvd(path, entries):
    """A ParaView collection of (time, file) entries, files relative to it."""
    with open(path, "w", encoding="utf-8") as stream:
        stream.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n')
        for time, file in entries:
            stream.write(f'    <DataSet timestep="{number(time)}" part="0" file="{file}"/>\n')
        stream.write("  </Collection>\n</VTKFile>\n")


def table_rows(table):
    """Header and rows of a vtkTable, doubles with 17 digits."""
    header = [table.GetColumnName(c) for c in range(table.GetNumberOfColumns())]
    rows = []
    for r in range(table.GetNumberOfRows()):
        row = []
        for c in range(table.GetNumberOfColumns()):
            value = table.GetValue(r, c)
            row.append(number(value.ToDouble()) if value.IsDouble() or value.IsFloat()
                       else value.ToString())
        rows.append(row)
    return header, rows


@contextlib.contextmanager
def _staged(path):
    """A path of the same name in a temporary folder beside a path; all that is there in the end is moved beside it when
    the block ends well."""
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    staging = pathlib.Path(tempfile.mkdtemp(prefix=".waft-", dir=path.parent))
    try:
        yield staging / path.name
        _move_in(staging, path.parent)
    finally:
        shutil.rmtree(staging, ignore_errors=True)


@contextlib.contextmanager
def replaced(path):
    """A temporary path beside a file, moved onto it when the block ends well."""
    with _staged(path) as made:
        yield str(made)


@contextlib.contextmanager
def replaced_folder(path):
    """A temporary folder beside a folder, which takes its place when the block ends well."""
    with _staged(path) as made:
        made.mkdir()
        yield made
