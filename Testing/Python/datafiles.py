# SPDX-License-Identifier: BSD-3-Clause
"""Files of VTK data that tests make, by the writer that Waft has for its own."""
import os
import pathlib
import re

from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from waft.files import number, write_text
from waft.texts import in_xml
from waft.vtkWaftSources import vtkCheckedFiles


def write_xml(data, path, packs_well=False):
    """A VTK data set in its XML format, compressed, in base64; of a vtkMultiBlockDataSet each block has a file in a folder of the
    name. packs_well: by LZMA, which makes three quarters of what is rounded. Raises OSError when it could not be written: VTK's
    writers end the process where the disk is full, so that Waft writes what they give, piece by piece."""
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
