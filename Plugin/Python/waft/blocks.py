# SPDX-License-Identifier: BSD-3-Clause
"""Multi-block files, looked at before VTK reads them."""
import pathlib
import xml.etree.ElementTree as ElementTree

from waft.failures import BadInput


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
