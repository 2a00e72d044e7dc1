# SPDX-License-Identifier: BSD-3-Clause
"""Results that are whole and wrong: each array, each value of JSON and each column of a table of a small run is put out of shape, and
what reads it says so, exit status 2, or goes on; nobody ends by a traceback or a signal.

    pvbatch run.py test_mutations.py [EVERY]     on a display; of two thousand mutants every so many-th by one reader, with 1 each by every
                                          reader, which takes half an hour
"""
import copy
import csv
import io
import itertools
import json
import os
import pathlib
import re
import shutil
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkStringArray  # noqa: E402

import warm  # noqa: E402

from waft import cli, failures, page, reading, render, synthesis, takes  # noqa: E402, F401
from datafiles import write_xml  # noqa: E402
from waft.files import write_json  # noqa: E402

EVERY = int(sys.argv.pop(1)) if len(sys.argv) > 1 else 257
SCENE = {"waft": 1, "title": "Small", "time": {"frames": 31}, "shapes": {"leaf": {"builtin": "leaf"}, "maple": {"builtin": "maple"}},
         "objects": [{"shape": "leaf", "positions": [[-0.6, -0.5, 1.6], [0.6, 0.4, 1.4]]}, {"shape": "maple", "position": [0, 0.9, 0.8]}],
         "obstacles": [{"kind": "box", "min": [0.9, -2, 0], "max": [1.2, -1, 1],
                        "motion": [{"frame": 0, "position": [0, 0, 0]}, {"frame": 30, "position": [0.3, 0, 0]}]}],
         "constraints": [{"kind": "position", "object": 0, "frame": 30, "value": [-0.3, -0.2, 1.3], "radius": 0.1},
                         {"kind": "rest", "object": 2, "frame": 25, "value": [0.1, 0.9, 0.3]}]}
COARSE = {"Resolution": 16, "LatticeResolution": 12, "Rounds": 1}  # a preview has no wind of its own
TAKEN = {"takes": [{"seed": 3, "folder": "take-0003", "key": "k", "status": 0, "outcome": "all met", "message": "", "seconds": 1.5,
                    "met": 1, "wishes": 1, "processorSeconds": 1.0, "peakMemoryMB": 10.0,
                    "measures": [{"key": "start", "row": "start", "value": None, "wanted": [0.0, None], "drifters": 1.0, "met": None,
                                  "why": "x"}]}], "manifest": []}
PAGE, EXPORT, MEASURE = ("page", "R"), ("export", "R"), ("measure", "R")
RENDER = ("render", "R", "--frames", "30", "--size", "32x24", "--views", "hero,follow")
EDIT = ("synthesize", "scene.waft.json", "--output", "E", "--preview", "--edit-of", "R")
TAKES = ("takes", "scene.waft.json", "--seeds", "3", "--output", "T")
# Which commands read a file.
READERS = {"poses.vtp": (PAGE, EXPORT, RENDER, ("measure", "R", "--tracks", "poses")), "objects.vtp": (EXPORT, RENDER, MEASURE),
           "planned.vtp": (PAGE, ("measure", "R", "--tracks", "planned")), "optimized.vtp": (MEASURE,),
           "constraints.vtp": (PAGE, EXPORT, RENDER, MEASURE), "obstacles/obstacles_0001.vtp": (PAGE, EXPORT, RENDER),
           "obstacles/obstacles_0000.vtp": (PAGE, EXPORT, RENDER), "air/air_0003.vti": (MEASURE,),
           "air_wind/air_wind_0000.vti": (MEASURE,)}
READ = {"ObjectId", "ShapeId", "Bounds", "FramesPerSecond", "Orientation", "SettlingSpeed", "Kind", "Frame", "Radius", "Row", "Target",
        "Value", "Until", "TouchDown", "AirVelocity", "Velocity", "ObstacleId", "Color", "Opacity", "Texture", "TextureCoordinates"}
MEASURED_NOW = [{"folder": "R", "tracks": "optimized", "objects": 3, "notes": ["n"], "rows": TAKEN["takes"][0]["measures"]}]


class Mutations(unittest.TestCase):
    judged = 0

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(place.name)
        write_json("scene.waft.json", SCENE)
        synthesis.synthesize("scene.waft.json", output="whole", preview=True, _settings={"Assimilation": COARSE})
        shutil.copytree("whole", "R")
        os.mkdir("T")
        # A run that is begun has read what there was to be read; nor is there anything to be learnt from windows of so short flights.
        from waft.measuring import _two_sample

        def begun(*_, **__):
            raise failures.Interrupted("begun")
        synthesis._run, _two_sample.is_there, takes._Flight.fly = begun, lambda: False, lambda *_: (None, False)

    def judge(self, name, kind, *commands):
        """Calls commands one after the other in a fork of this process: one in turn, and of some mutants none, where not all are asked
        for."""
        type(self).judged += 1
        if EVERY > 1 and kind != "whole":
            if self.judged % EVERY:
                return ""
            commands = [commands[self.judged // EVERY % len(commands)]]
        with tempfile.TemporaryFile("w+") as said:
            child = os.fork()
            if child == 0:
                os.environ["PYTHONUNBUFFERED"] = "1"

                def act():
                    for command in commands:
                        print("::", *command, file=sys.stderr, flush=True)
                        status = cli.main(list(command))
                        if status not in (0, 2, failures.STOPPED_EARLY):
                            print("Status", status, file=sys.stderr)
                            return 1
                    return 0
                warm.become(act, os.getcwd(), said.fileno(), said.fileno())
            status = os.waitpid(child, 0)[1]
            said.seek(0)
            words = said.read()
        with self.subTest(f"{name}: {kind}"):
            self.assertTrue(status == 0 and "Traceback" not in words and "ERR|" not in words and "Error: In" not in words,
                            f"{status}\n{words[-1500:]}")
        return words

    def test_the_whole_run_is_read_by_all(self):
        words = self.judge("R", "whole", PAGE, EXPORT, MEASURE, RENDER, EDIT, TAKES)
        self.assertNotIn("waft: R", words.replace("waft: R/poses", ""))
        for path in [pathlib.Path("R/page.html"), pathlib.Path("R/scene.glb")]:
            self.assertTrue(path.is_file())

    def test_arrays(self):
        for name, commands in READERS.items():
            read = reading.read_image if name.endswith(".vti") else reading.read_surface
            data = read(f"R/{name}")
            for mutant, kind in mutants_of(data):
                write_xml(mutant, "mutant" + pathlib.Path(name).suffix)
                with Mutated(f"R/{name}", pathlib.Path("mutant" + pathlib.Path(name).suffix).read_bytes()):
                    self.judge(name, kind, *commands)

    def test_shapes(self):
        for index in range(2):
            name = f"R/shapes/shapes_{index}.vtp"
            data = reading.read_surface(name)
            for mutant, kind in itertools.islice(mutants_of(data), index, None, 2):
                write_xml(mutant, "mutant.vtp")
                with Mutated(name, pathlib.Path("mutant.vtp").read_bytes()):
                    self.judge(name, kind, RENDER, EXPORT)

    def test_json(self):
        report = json.loads(pathlib.Path("R/report.json").read_text(encoding="utf-8"))
        report.pop("manifest")
        for name, content, commands in (("R/report.json", report, (PAGE, MEASURE, EDIT)), ("T/takes.json", TAKEN, (TAKES,)),
                                        ("R/measure.json", MEASURED_NOW, (PAGE, (*PAGE, "--measure", "R/measure.json")))):
            for mutant, kind in json_mutants(content):
                manifest = {"manifest": []} if isinstance(mutant, dict) else {}
                with Mutated(name, as_text({**manifest, **mutant} if manifest else mutant)):
                    self.judge(name, kind, *commands)

    def test_animation(self):
        whole = pathlib.Path("R/animation.glb").read_bytes()
        size = struct.unpack("<I", whole[12:16])[0]
        content = json.loads(whole[20:20 + size])
        for mutant, kind in json_mutants(content, deep=1):
            text = as_text(mutant)
            text += b" " * (-len(text) % 4)
            rest = whole[20 + size:]
            head = struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON")
            with Mutated("R/animation.glb", head + text + rest):
                self.judge("animation.glb", kind, PAGE, EXPORT)
        for cut in (0, 3, 12, 19, 20, 20 + size, 27 + size, len(whole) - 1):
            with Mutated("R/animation.glb", whole[:cut]):
                self.judge("animation.glb", f"first {cut} bytes", PAGE, EXPORT)

    def test_series(self):
        for name, commands in (("obstacles.pvd", (PAGE, EXPORT, RENDER)), ("air.pvd", (MEASURE,)), ("air_wind.pvd", (MEASURE,)),
                               ("shapes.vtm", (RENDER, EXPORT))):
            whole = pathlib.Path(f"R/{name}").read_text(encoding="utf-8")
            first = re.search(r"<DataSet[^>]*/>", whole)[0]
            for before, after in ((first, ""), (first, first * 2), (re.findall(r"<DataSet.*/>", whole, re.DOTALL)[0], ""), ('file="', 'fill="'),
                                  ('timestep="0"', 'timestep="nan"'), ('timestep="0"', 'timestep="x"'), ('timestep="0"', 'timestep="1e300"'),
                                  ('index="0"', 'index="-1"'), ('index="0"', 'index="x"'), ('index="0"', 'index="9999"'), ("</", "<"),
                                  (re.search('file="[^"]*"', first)[0], 'file="poses.vtp"'), (re.search('file="[^"]*"', first)[0], 'file=""')):
                with Mutated(f"R/{name}", whole.replace(before, after, 1).encode()):
                    self.judge(name, f"{before[:30]}: {after[:30]}", *commands)

    def test_tables(self):
        for name, commands in (("constraints.csv", (PAGE, EXPORT)), ("rounds.csv", (PAGE,)), ("convergence.csv", (PAGE,))):
            rows = list(csv.reader(io.StringIO(pathlib.Path(f"R/{name}").read_text(encoding="utf-8"), newline="")))
            if len(rows) < 2:
                rows.append(["1"] * len(rows[0]))
            for column, value in itertools.product(range(len(rows[0])), ("", "x", "nan", "1e400", "-1e18", None)):
                mutant = copy.deepcopy(rows)
                for row in mutant if value is None else mutant[1:2]:
                    row[column:column + 1] = [] if value is None else [value]
                text = io.StringIO()
                csv.writer(text).writerows(mutant)
                with Mutated(f"R/{name}", text.getvalue().encode()):
                    self.judge(name, f"{rows[0][column]}: {value}", *commands)
            for text in (b"", b"\n\n", b"\0", b'"', b"a,b\n1,2,3\n", b",".join([b"Row"] * 300), "Row\né".encode("latin-1")):
                with Mutated(f"R/{name}", text):
                    self.judge(name, repr(text[:20]), *commands)


class Mutated:
    """Meanwhile a file has another content."""

    def __init__(self, name, content):
        self._path, self._content = pathlib.Path(name), content

    def __enter__(self):
        self._before = self._path.read_bytes() if self._path.exists() else None
        self._path.write_bytes(self._content)

    def __exit__(self, *_):
        if self._before is None:
            self._path.unlink()
        else:
            self._path.write_bytes(self._before)


def mutants_of(data):
    """(data set that is put out of shape in one thing, which)."""
    for attributes in ("PointData", "CellData", "FieldData"):
        whole = getattr(data, f"Get{attributes}")()
        for number in range(whole.GetNumberOfArrays()):
            array = whole.GetAbstractArray(number)
            if array.GetName() not in READ:
                continue
            for changed, kind in arrays_like(array, attributes == "FieldData"):
                mutant = data.NewInstance()
                mutant.DeepCopy(data)
                own = getattr(mutant, f"Get{attributes}")()
                own.RemoveArray(array.GetName())
                if changed is not None:
                    own.AddArray(changed)
                yield mutant, f"{array.GetName()} {kind}"
    if data.IsA("vtkPolyData"):
        for value in (np.nan, np.inf, 1e30):
            mutant = data.NewInstance()
            mutant.DeepCopy(data)
            vtk_to_numpy(mutant.GetPoints().GetData())[-1] = value
            yield mutant, f"points {value}"
        bare = data.NewInstance()
        bare.SetFieldData(data.GetFieldData())
        yield bare, "nothing"


def arrays_like(array, is_field):
    """(array of the same name and another content, or None; which)."""
    if not array.IsA("vtkDataArray"):
        numbers = numpy_to_vtk(np.ones(max(array.GetNumberOfTuples(), 1)), deep=True)
        numbers.SetName(array.GetName())
        yield numbers, "of numbers"
        return
    yield None, "missing"
    values = vtk_to_numpy(array)
    flat = values.reshape(len(values), -1).astype(float)
    changes = {"wide": np.concatenate([flat, flat[:, :1]], axis=1), "inf": np.full_like(flat, np.inf), "-1": np.full_like(flat, -1.0),
               "NaN": np.where(np.arange(flat.size).reshape(flat.shape) == 0, np.nan, flat), "zero": np.zeros_like(flat),
               "1e300": np.full_like(flat, 1e300), "0.5": flat + 0.5}
    if is_field:
        changes.update(none=flat[:0], more=np.concatenate([flat, flat]))
    for kind, change in changes.items():
        made = numpy_to_vtk(np.ascontiguousarray(change), deep=True)
        made.SetName(array.GetName())
        yield made, kind
    words = vtkStringArray()
    words.SetName(array.GetName())
    words.SetNumberOfComponents(array.GetNumberOfComponents())
    for _ in range(array.GetNumberOfValues()):
        words.InsertNextValue("x")
    yield words, "of texts"


VALUES = (None, True, -1, 0.5, 10 ** 19, "@huge", 10 ** 400, "", "x\ud800", [], {}, [[None]], "@deep", "gone")


def as_text(mutant):
    return json.dumps(mutant).replace('"@huge"', "1e400").replace('"@deep"', "[" * 900 + "]" * 900).encode()


def json_mutants(content, deep=2):
    """(copy in which one value is another, which); of lists the first `deep` entries."""
    places = list(_places(content, (), deep))
    for number, place in enumerate(places):
        # Each place with some of the values, and each value somewhere.
        for value in VALUES[number % 2::2] if len(places) > 12 else VALUES:
            mutant = copy.deepcopy(content)
            if not place:
                yield value if value != "gone" else {}, f"/: {str(value)[:20]!r}"
                continue
            *way, last = place
            holder = mutant
            for step in way:
                holder = holder[step]
            if value == "gone":
                del holder[last]
            else:
                holder[last] = value
            yield mutant, f"{'/'.join(map(str, place))}: {str(value)[:20]!r}"


def _places(content, way, deep):
    yield way
    if isinstance(content, dict):
        for key, value in content.items():
            yield from _places(value, (*way, key), deep)
    elif isinstance(content, list):
        for number, value in enumerate(content[:deep]):
            yield from _places(value, (*way, number), deep)
