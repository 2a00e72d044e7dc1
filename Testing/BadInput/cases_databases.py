# SPDX-License-Identifier: BSD-3-Clause
"""Motion databases that are damaged, as files and in their values."""
import functools
import json
import pathlib
import subprocess
import tempfile

from case import LEAF, OUT, Case, synthesize

PARTS = {"Segments": "db/db_0.vtp", "Basis": "db/db_1.vtt", "Nodes": "db/db_2.vtt", "Connections": "db/db_3.vtt",
         "Vortices": "db/db_4.vtp", "Provenance": "db/db_5.vtt"}
_made = tempfile.TemporaryDirectory()


@functools.lru_cache(maxsize=None)
def _whole():
    """A small database as the command makes it, as one data set."""
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader
    from waft.loading import command

    path = pathlib.Path(_made.name) / "db.vtm"
    subprocess.run([command(), "database", "--output", path, *"--simulations 1 --frames 60 --resolution 16 --threads 1 -q".split()], check=True)
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutputDataObject(0)


def _files():
    """{name: bytes} of the small database."""
    return dict(_files_of(None))


@functools.lru_cache(maxsize=None)
def _files_of(change):
    from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter

    data = vtkMultiBlockDataSet()
    data.DeepCopy(_whole())
    if change:
        change({data.GetMetaData(i).Get(data.NAME()): data.GetBlock(i) for i in range(data.GetNumberOfBlocks())}, data)
    with tempfile.TemporaryDirectory() as folder:
        writer = vtkXMLMultiBlockDataWriter()
        writer.SetInputData(data)
        writer.SetFileName(f"{folder}/db.vtm")
        writer.Write()
        base = pathlib.Path(folder)
        return tuple((str(path.relative_to(base)), path.read_bytes()) for path in sorted(base.rglob("*")) if path.is_file())


def _case(name, files, *says, status=(2,)):
    def make(folder, results):
        (folder / "scene.waft.json").write_text(json.dumps(LEAF), encoding="utf-8")
        for file, content in (files() if callable(files) else files).items():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_bytes(content)
        return synthesize("scene.waft.json", results if status == (2,) else OUT, "--database", "db.vtm")
    return Case("databases", name, make, says=says, status=status)


def _replaced(file, change):
    def files():
        made = _files()
        made[file] = change(made[file])
        return made
    return files


def _named(text, put):
    def change(content):
        assert text in content, text
        return content.replace(text, put, 1)
    return change


def _cut(share):
    return lambda content: content[:int(share * len(content))]


def _damaged_files():
    whole = "db.vtm"
    for share in (0.0, 0.1, 0.5, 0.9):
        yield f"cut at {share}", whole, _cut(share)
    yield "junk", whole, lambda content: b"this is no database\n"
    yield "zeros", whole, lambda content: bytes(500)
    yield "another kind", whole, _named(b"vtkMultiBlockDataSet", b"PolyData")
    yield "no root", whole, lambda content: b'<?xml version="1.0"?>'
    yield "version 99.0", whole, _versioned
    yield "an index of -1", whole, _named(b'index="0"', b'index="-1"')
    yield "an index of 999999999", whole, _named(b'index="0"', b'index="999999999"')
    yield "an index that is a word", whole, _named(b'index="0"', b'index="a"')
    yield "an index twice", whole, _named(b'index="1"', b'index="0"')
    yield "a block without a file", whole, _named(b'file="db/db_0.vtp"', b"")
    yield "a block that is itself", whole, _named(b"db/db_0.vtp", b"db.vtm")
    yield "a file that is not there", whole, _named(b"db/db_0.vtp", b"db/none.vtp")
    yield "a file outside", whole, _named(b"db/db_0.vtp", b"/etc/passwd")
    yield "another file's kind", whole, _named(b"db/db_0.vtp", b"db/db_1.vtt")
    yield "nested 100000 deep", whole, lambda content: (
        b'<VTKFile type="vtkMultiBlockDataSet" version="1.0"><vtkMultiBlockDataSet>' + b'<Block index="0">' * 100000 +
        b"</Block>" * 100000 + b"</vtkMultiBlockDataSet></VTKFile>")
    yield "10^5 blocks", whole, lambda content: (
        b'<VTKFile type="vtkMultiBlockDataSet" version="1.0"><vtkMultiBlockDataSet>' +
        b'<Block index="0" name="Segments"/>' * 100000 + b"</vtkMultiBlockDataSet></VTKFile>")
    yield "laughs", whole, lambda content: (
        b'<?xml version="1.0"?><!DOCTYPE l [<!ENTITY a "ha">' + b"".join(
            f'<!ENTITY {chr(98 + i)} "{f"&{chr(97 + i)};" * 10}">'.encode() for i in range(9)) + b"]><VTKFile>&j;</VTKFile>")
    for block, file in PARTS.items():
        yield f"{block}: version 99.0", file, _versioned
        yield f"{block}: empty", file, lambda content: b""
        yield f"{block}: junk", file, lambda content: b"junk\n"
        for share in (0.3, 0.7):
            yield f"{block}: cut at {share}", file, _cut(share)
    for block, file in PARTS.items():
        if file.endswith(".vtt"):
            yield f"{block}: 2^32-1 rows", file, _numbered(b'NumberOfRows="', 2 ** 32 - 1)
            yield f"{block}: -1 rows", file, _numbered(b'NumberOfRows="', -1)
        else:
            yield f"{block}: 1e12 points", file, _numbered(b'NumberOfPoints="', 10 ** 12)
            yield f"{block}: 2^60 lines", file, _numbered(b'NumberOfLines="', 2 ** 60)


def _versioned(content):
    begin = content.index(b'version="', content.index(b"<VTKFile")) + len(b'version="')
    return content[:begin] + b"99.0" + content[content.index(b'"', begin):]


def _numbered(name, number):
    def change(content):
        begin = content.index(name) + len(name)
        return content[:begin] + str(number).encode() + content[content.index(b'"', begin):]
    return change


def _array(block, where, name):
    holder = {"cell": "GetCellData", "point": "GetPointData", "row": "GetRowData", "field": "GetFieldData"}[where]
    return getattr(block, holder)(), getattr(block, holder)().GetAbstractArray(name)


NUMBERS = (("Segments", "cell", "Group"), ("Segments", "cell", "Simulation"), ("Segments", "cell", "MeanWind"),
           ("Segments", "cell", "Coefficients"), ("Segments", "field", "Window"), ("Segments", "field", "SettlingSpeed"),
           ("Segments", "field", "TopSpeed"), ("Segments", "field", "FramesPerSecond"), ("Basis", "row", "Group"),
           ("Basis", "row", "Rank"), ("Basis", "row", "Mean"), ("Basis", "row", "Basis"), ("Nodes", "row", "Group"),
           ("Nodes", "row", "Parent"), ("Nodes", "row", "Medoid"), ("Nodes", "row", "FirstChild"),
           ("Nodes", "row", "NumberOfChildren"), ("Nodes", "row", "NumberOfSegments"), ("Nodes", "row", "Radius"),
           ("Connections", "row", "Before"), ("Connections", "row", "After"), ("Connections", "row", "Cost"),
           ("Connections", "row", "Rotation"), ("Connections", "row", "Translation"))


def _damaged_values():
    for block, where, name in NUMBERS:
        def drop(blocks, _data, block=block, where=where, name=name):
            _array(blocks[block], where, name)[0].RemoveArray(name)
        yield f"{block}: without {name}", drop

        def widen(blocks, _data, block=block, where=where, name=name):
            from vtkmodules.vtkCommonCore import vtkDoubleArray

            holder, array = _array(blocks[block], where, name)
            wide = vtkDoubleArray()
            wide.SetName(name)
            wide.SetNumberOfComponents(array.GetNumberOfComponents() + 1)
            wide.SetNumberOfTuples(array.GetNumberOfTuples())
            wide.Fill(0.0)
            holder.AddArray(wide)
        yield f"{block}: {name} of one component more", widen

        def spoil(blocks, _data, block=block, where=where, name=name):
            _, array = _array(blocks[block], where, name)
            real = array.GetDataTypeAsString() in ("double", "float")
            array.SetComponent(array.GetNumberOfTuples() // 2, 0, float("nan") if real else 2 ** 30)
        yield f"{block}: {name} beyond", spoil

    for block in PARTS:
        def empty(blocks, data, block=block):
            for i in range(data.GetNumberOfBlocks()):
                if data.GetMetaData(i).Get(data.NAME()) == block:
                    data.SetBlock(i, data.GetBlock(i).NewInstance())
        if block not in ("Vortices", "Provenance"):
            yield f"{block}: nothing in it", empty


def cases():
    for name, file, change in _damaged_files():
        yield _case(name, _replaced(file, change), "db.vtm" if file == "db.vtm" else pathlib.Path(file).stem[:2])
    for name, change in _damaged_values():
        # Not all that is in a database is needed to plan with it.
        yield _case(name, lambda change=change: dict(_files_of(change)), "db.vtm", status=(0, 2, 3))
    yield _case("that is not there", {}, "db.vtm")
    yield _case("that is a folder", {"db.vtm/x": b""}, "db.vtm")
    yield _case("without its folder", lambda: {"db.vtm": _files()["db.vtm"]}, "db.vtm", "db_0.vtp")
    yield _case("that is right", _files, status=(0, 3))
