# SPDX-License-Identifier: BSD-3-Clause
"""The formats of files that are written and read."""
import contextlib
import csv
import json
import math
import os
import pathlib
import re
import shutil

from waft.failures import BadInput
from waft.reading import open_stream
from waft.renaming import move_new
from waft.temporary import temporary_file
from waft.texts import cell, in_xml


def number(value):
    """A double with 17 significant digits, which reads back bit for bit."""
    return format(value, ".17g")


def check_target(path, is_own=None):
    """Raises BadInput unless a file can be written under a name. What is there stays, unless is_own(path) says that Waft wrote it
    and nobody changed it since."""
    folder = os.path.dirname(os.path.abspath(path))
    if not os.path.isdir(folder):
        raise BadInput(f"{path}: expected a folder that is there")
    if os.path.isdir(path):
        raise BadInput(f"{path}: expected the name of a file, found a folder")
    if os.path.lexists(path) and (is_own is None or os.path.islink(path) or not is_own(path)):
        raise BadInput(f"{path}: {'it is there' if is_own is None else _NOT_OURS}, and stays as it is: choose another name")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise BadInput(f"{folder}: expected a folder that may be written in")


@contextlib.contextmanager
def whole_file(path, is_own=None):
    """A name to write to; what was written takes the place of `path` when all went well, else nothing is left and what was there
    stays. Raises BadInput where something is there that may not be replaced, see check_target."""
    check_target(path, is_own)
    with temporary_file(os.path.dirname(path) or ".") as (part, descriptor):
        yield part
        os.fsync(descriptor)
        if is_own is not None and os.path.lexists(path):
            check_target(path, is_own)
            os.replace(part, path)
            return
        try:
            move_new(part, path)
        except FileExistsError as error:  # it came there meanwhile
            raise BadInput(f"{path}: it is there, and stays as it is: choose another name") from error


_NOT_OURS = "Waft did not write it, or it was changed since"


def write_bytes(path, content):
    with open(path, "wb") as stream:
        stream.write(content)


def write_text(path, text):
    """Lines end as they are."""
    write_bytes(path, text.encode())


def appending(path):
    """A descriptor of a file that is there, no link, to write on at its end and to read."""
    return os.open(path, os.O_RDWR | os.O_APPEND | os.O_NOFOLLOW | os.O_CLOEXEC)


def copy_file(source, path):
    """The bytes of a file that may be anybody's, piece by piece."""
    with open_stream(source) as content, open(path, "wb") as stream:
        shutil.copyfileobj(content, stream)


def write_csv(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[cell(value) if isinstance(value, str) else value for value in row] for row in rows])


def write_json(path, content):
    with open(path, "w", encoding="utf-8") as stream:
        json.dump(content, stream, indent=2)
        stream.write("\n")
        stream.flush()
        os.fsync(stream.fileno())


def write_xml(data, path, packs_well=False):
    """A VTK data set in its XML format, compressed, in base64; of a vtkMultiBlockDataSet each block has a file in a folder of the
    name. packs_well: by LZMA, which makes three quarters of what is rounded. Raises OSError when it could not be written: VTK's
    writers end the process where the disk is full, so that Waft writes what they give, piece by piece."""
    from waft.vtkWaftSources import vtkCheckedFiles

    path = pathlib.Path(path)
    if path.suffix != ".vtm":
        _check_written(path, vtkCheckedFiles.Write(os.fsencode(path), data, packs_well))
        return
    content = _blocks_text(data, path)
    try:
        write_text(path, content)
    except OSError as error:
        _check_written(path, error.strerror)


def _check_written(path, lack):
    if lack:
        raise OSError(f"{path}: could not be written: {lack}")


def _blocks_text(data, path):
    """Writes the files of the blocks; returns the text of the file that names them."""
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    bare = vtkPolyData()
    bare.SetFieldData(data.GetFieldData())
    writer = vtkXMLPolyDataWriter()
    writer.SetInputDataObject(bare)
    writer.SetDataModeToBinary()
    writer.SetCompressionLevel(1)  # as of all others
    writer.WriteToOutputStringOn()
    writer.Write()
    text = writer.GetOutputString()
    head = text[:text.index("<PolyData>")].replace('type="PolyData"', 'type="vtkMultiBlockDataSet"')
    head = re.sub(r' version="[^"]*" byte_order', ' version="1.0" byte_order', head)  # before it blocks were named otherwise
    fields = text[text.index("<FieldData>"):text.index("</FieldData>") + len("</FieldData>")] if "<FieldData>" in text else ""
    path.with_suffix("").mkdir(exist_ok=True)
    entries = []
    for index in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(index)
        if block is None:
            continue
        named = data.GetMetaData(index) if data.HasMetaData(index) else None
        name = named.Get(data.NAME()) if named is not None and named.Has(data.NAME()) else None
        file = f"{path.stem}/{path.stem}_{index}.{'vtt' if block.IsA('vtkTable') else 'vtp'}"
        write_xml(block, path.parent / file)
        title = f" name={in_xml(name)}" if name else ""
        entries.append(f'    <DataSet index="{index}"{title} file={in_xml(file)}/>\n')
    return f"{head}<vtkMultiBlockDataSet>\n{''.join(entries)}  </vtkMultiBlockDataSet>\n{fields}\n</VTKFile>\n"


def write_pvd(path, entries):
    """A ParaView collection of (time, file) entries, files relative to it."""
    with open(path, "w", encoding="utf-8") as stream:
        stream.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n')
        for time, file in entries:
            stream.write(f'    <DataSet timestep="{number(time)}" part="0" file={in_xml(file)}/>\n')
        stream.write("  </Collection>\n</VTKFile>\n")


def table_rows(table):
    """Header and rows of a vtkTable, doubles with 17 digits; what is no number is empty."""
    header = [table.GetColumnName(c) for c in range(table.GetNumberOfColumns())]
    rows = []
    for r in range(table.GetNumberOfRows()):
        row = []
        for c in range(table.GetNumberOfColumns()):
            value = table.GetValue(r, c)
            if value.IsDouble() or value.IsFloat():
                row.append("" if math.isnan(value.ToDouble()) else number(value.ToDouble()))
            else:
                row.append(value.ToString())
        rows.append(row)
    return header, rows
