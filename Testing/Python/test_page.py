# SPDX-License-Identifier: BSD-3-Clause
"""`waft page` on a small flown word: what is in the page, what is refused; and the page in chromium, where that is.

    test_page.py SCENES WORK_FOLDER"""

import base64
import json
import os
import pathlib
import re
import shutil
import sys
import time
import unittest
from unittest import mock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkTriangleFilter  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkCubeSource  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

import result_files  # noqa: E402
import sample_folder  # noqa: E402
from browser import PROGRAM, Browser  # noqa: E402

from waft.failures import BadInput, WaftError  # noqa: E402
from datafiles import write_pvd, write_xml  # noqa: E402
from waft.files import write_json  # noqa: E402
from waft.page import write_page  # noqa: E402
from waft.page import _thinning  # noqa: E402
from waft.page import writing as pages  # noqa: E402
from waft.page._pagedata import describe  # noqa: E402
from waft.reading import read_blocks, read_surface  # noqa: E402
from waft.results.exporting import export  # noqa: E402
from waft.scene import Scene  # noqa: E402
from waft.synthesis import synthesize  # noqa: E402
from waft.vtkWaftFilters import vtkMotionAnimationWriter  # noqa: E402

SCENES, WORK = (pathlib.Path(argument) for argument in sys.argv[1:3])
FLOWN = WORK / "flown"
MOST = 8e6  # bytes


def setUpModule():
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    # A word, and a box that is pushed along beside it: what is to be seen is all there.
    scene = json.loads((SCENES / "leaves-letters.waft.json").read_text(encoding="utf-8"))
    for shape in scene["shapes"].values():
        shape["texture"] = str(SCENES / shape["texture"])
    scene["title"] = "Leaves </script> & a <ball>"
    write_json(WORK / "word.waft.json", scene)
    synthesize(WORK / "word.waft.json", output=FLOWN, preview=True,
               _settings={"Assimilation": {"Resolution": 16, "LatticeResolution": 12, "Candidates": 2, "Rounds": 1}})
    boxes = [_boxes((-5, 5, -5, 5, -0.5, 0), (x, x + 0.3, 1.4, 1.7, 0, 0.3)) for x in (0.0, 1.0)]
    for step, surface in enumerate(boxes):
        write_xml(surface, FLOWN / f"box_{step}.vtp")
    write_pvd(FLOWN / "obstacles.pvd", [(0.0, "box_0.vtp"), (299 / 30, "box_1.vtp")])
    write_page(FLOWN)


def _keys(animation):
    """{number of an accessor: keys} of the times, places and turns of an animation.glb."""
    size = int.from_bytes(animation[12:16], "little")
    gltf, binary = json.loads(animation[20:20 + size]), animation[28 + size:]
    samplers = gltf["animations"][0]["samplers"]
    found = {}
    for number in {sampler[end] for sampler in samplers for end in ("input", "output")}:
        view = gltf["bufferViews"][gltf["accessors"][number]["bufferView"]]
        data = binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
        found[number] = np.frombuffer(data, "<f4").reshape(gltf["accessors"][number]["count"], -1)
    return found


def _often(data, times):
    """Poses or objects several times, each object with an id of its own."""
    all_of = vtkAppendPolyData()
    for number in range(times):
        copy = data.NewInstance()
        copy.DeepCopy(data)
        for arrays in (copy.GetPointData(), copy.GetCellData()):
            ids = arrays.GetArray("ObjectId")
            if ids is not None:
                vtk_to_numpy(ids)[...] += 48 * number
        all_of.AddInputData(copy)
    all_of.Update()
    result = all_of.GetOutput()
    result.GetFieldData().DeepCopy(data.GetFieldData())
    return result


def _write_animation(place, source, times, marks):
    """animation.glb of the word of a folder several times; with its marks it may be thinned."""
    writer = vtkMotionAnimationWriter()
    for port, name in enumerate(("poses.vtp", "objects.vtp")):
        writer.SetInputDataObject(port, _often(read_surface(source / name), times))
    shapes = read_blocks(source / "shapes.vtm")
    for block in range(shapes.GetNumberOfBlocks()):
        shapes.GetBlock(block).GetFieldData().RemoveArray("Texture")  # it is beside the file
    writer.SetInputDataObject(2, shapes)
    if marks:
        writer.SetInputDataObject(3, read_surface(source / "constraints.vtp"))
    writer.SetFileName(str(place / "animation.glb"))
    if not writer.Write():
        raise AssertionError("not written")
    return (place / "animation.glb").read_bytes()


def _motion(animation):
    """(JSON, {(node, path): (times, values)}) of an animation.glb."""
    size = int.from_bytes(animation[12:16], "little")
    gltf, binary = json.loads(animation[20:20 + size]), animation[28 + size:]

    def read(number, width):
        accessor = gltf["accessors"][number]
        first = gltf["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(binary, "<f4", accessor["count"] * width, first).reshape(-1, width)
    motion, found = gltf["animations"][0], {}
    for channel in motion["channels"]:
        sampler, path = motion["samplers"][channel["sampler"]], channel["target"]["path"]
        found[channel["target"]["node"], path] = (read(sampler["input"], 1)[:, 0], read(sampler["output"], 3 + (path == "rotation")))
    return gltf, found


FAR = np.array([447000.0, 812000.0, 120.0])  # as maps have it


def far_and_near():
    """Two folders of the same, the first of which is far from the origin."""
    near = folder("near")
    _write_animation(near, near, 1, marks=False)
    far = WORK / "far"
    shutil.rmtree(far, ignore_errors=True)
    shutil.copytree(near, far)
    for path in far.glob("*.vtp"):
        data = read_surface(path)
        if data.GetNumberOfPoints():
            data.GetPoints().SetData(numpy_to_vtk(vtk_to_numpy(data.GetPoints().GetData()).astype(float) + FAR, deep=True))
        if data.GetFieldData().HasArray("Bounds"):
            vtk_to_numpy(data.GetFieldData().GetArray("Bounds"))[...] += np.repeat(FAR, 2)
        write_xml(data, path)
    _write_animation(far, far, 1, marks=False)
    return far, near


def _mesh_points(gltf, animation, node):
    """Points of the mesh of a node."""
    accessor = gltf["accessors"][gltf["meshes"][gltf["nodes"][node]["mesh"]]["primitives"][0]["attributes"]["POSITION"]]
    first = 28 + int.from_bytes(animation[12:16], "little") + gltf["bufferViews"][accessor["bufferView"]].get("byteOffset", 0)
    return np.frombuffer(animation, "<f4", 3 * accessor["count"], first).reshape(-1, 3)


def _boxes(*bounds):
    """Obstacles, a box each, of triangles."""
    both = vtkAppendPolyData()
    for number, box in enumerate(bounds):
        cube = vtkCubeSource()
        cube.SetBounds(*box)
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(cube.GetOutputPort())
        triangles.Update()
        data = triangles.GetOutput()
        sample_folder.add(data.GetPointData(), "ObstacleId", [number] * data.GetNumberOfPoints(), np.int32)
        both.AddInputData(data)
    both.Update()
    return both.GetOutput()


def folder(name, *left_out):
    """A copy of what a page is made of."""
    place = WORK / name
    shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(FLOWN, place, ignore=shutil.ignore_patterns("air", "*.state", "page.*", *left_out))
    return place


def contents(place):
    """What there is to tell, and the animation, of a page."""
    text = (place / "page.html").read_text(encoding="utf-8")
    run, = re.findall(r'<script type="application/json" id="run">(.*?)</script>', text, re.DOTALL)
    animation, = re.findall(r'<script type="text/plain" id="animation">(.*?)</script>', text, re.DOTALL)
    return json.loads(run), base64.b64decode(animation), text


class ContentsTest(unittest.TestCase):
    def test_it_is_one_file_with_all_in_it(self):
        run, animation, text = contents(FLOWN)
        self.assertLess(len(text.encode()), MOST)
        self.assertEqual(animation, (FLOWN / "animation.glb").read_bytes())
        self.assertEqual(re.findall(r'(?:src|href)="[^"]+"', text), [])
        self.assertIn("Permission is hereby granted", text)
        self.assertIn("three.js authors", text)
        self.assertIn("<title>Leaves &lt;/script&gt; &amp; a &lt;ball&gt;</title>", text)

    def test_it_says_what_it_shows(self):
        run, _, _ = contents(FLOWN)
        report = json.loads((FLOWN / "report.json").read_text(encoding="utf-8"))
        self.assertEqual(run["title"], "Leaves </script> & a <ball>")
        for name in ("scene", "seed", "quality", "version"):
            self.assertEqual(run[name], report[name])
        self.assertEqual((run["frames"], run["rate"]), (300, 30.0))
        self.assertEqual(len(run["rounds"]), len((FLOWN / "rounds.csv").read_text(encoding="utf-8").splitlines()) - 1)
        self.assertIsNone(run["energy"])
        self.assertIsNone(run["measured"])
        former = folder("former")
        write_json(former / "report.json", {**report, "quality": "assimilated"})
        self.assertEqual(describe(former)[0]["quality"], "air")

    def test_marks_are_those_of_the_run(self):
        run, _, _ = contents(FLOWN)
        rows = {(row.row, row.target): row for row in result_files.read_rows(FLOWN)}
        self.assertEqual(len(run["marks"]), len(rows))
        for mark in run["marks"]:
            row = rows[mark["row"], mark["target"]]
            self.assertEqual((mark["object"], mark["frame"], mark["kind"], mark["status"]), (row.object, row.frame, "rest", row.status))
            (frame, *place, radius), = mark["places"]
            self.assertEqual((frame, radius), (row.frame, row.radius))
            self.assertEqual(tuple(place), tuple(row.value[:3]))

    def test_the_plan_is_that_of_the_run(self):
        run, _, _ = contents(FLOWN)
        plan = run["plan"]
        steps = memoryview(base64.b64decode(plan["steps"])).cast("H")
        for index, (_, path) in enumerate(sorted(result_files.read_tracks(FLOWN / "planned.vtp").items())):
            for frame in (0, 150, 299):
                for axis in range(3):
                    low, high = plan["low"][axis], plan["high"][axis]
                    value = low + (high - low) * steps[3 * (index * 300 + frame) + axis] / 65535
                    self.assertAlmostEqual(value, path[frame][axis], delta=1e-4)

    def test_what_is_much_is_thinned_and_says_so(self):
        whole, animation = describe(FLOWN)
        with mock.patch.object(_thinning, "MOST_POSES", 48 * 300 // 3):
            run, thin = describe(FLOWN)
        self.assertEqual((1, 3, 100, 10.0), (whole["every"], run["every"], run["frames"], run["rate"]))
        before, after = (_keys(content) for content in (animation, thin))
        self.assertEqual(2 * 48 + 1, len(before))
        for name, keys in before.items():
            self.assertTrue(np.array_equal(keys[::3], after[name]), name)
        self.assertLess(len(thin), len(animation) - 0.6 * sum(keys.nbytes for keys in before.values()))

        def places(each):  # a thinned plan is in a box of its own
            plan = each["plan"]
            low, high = np.array(plan["low"]), np.array(plan["high"])
            steps = np.frombuffer(base64.b64decode(plan["steps"]), "<u2").reshape(48, each["frames"], 3)
            return low + steps / 65535.0 * (high - low)

        self.assertLess(np.abs(places(whole)[:, ::3] - places(run)).max(), 1e-4)
        for mark, shown in zip(whole["marks"], run["marks"]):
            self.assertEqual(mark["frame"], shown["frame"])
            self.assertLessEqual(abs(3 * shown["shown"] - mark["frame"]), 2)

    def test_keys_that_are_left_out_are_there_again(self):
        place = folder("many", "planned.vtp")
        gltf, whole = _motion(_write_animation(place, FLOWN, 8, marks=False))
        self.assertNotIn("keys", gltf["asset"]["extras"])
        _, marked = _motion(_write_animation(place, FLOWN, 6, marks=True))  # 86,400 poses
        self.assertTrue(all(len(times) == 300 for times, _ in marked.values()))
        thin = _write_animation(place, FLOWN, 8, marks=True)  # 115,200
        gltf, kept = _motion(thin)
        said = gltf["asset"]["extras"]["keys"]
        self.assertEqual((said["frames"], said["of"], said["kept"]), (300, 384 * 300, sum(len(times) for times, _ in kept.values()) // 2))
        self.assertLess(said["kept"], said["of"])
        for row in result_files.read_rows(FLOWN):
            for path in ("translation", "rotation"):
                times, values = kept[row.object, path]
                at = np.flatnonzero(times == np.float32(row.frame / 30.0))
                self.assertTrue(np.array_equal(values[at], whole[row.object, path][1][row.frame:row.frame + 1]), row)
        sizes = {node: np.ptp(_mesh_points(gltf, thin, node), axis=0).max() for node in range(384)}
        for every, most in ((1, 384 * 300), (3, 384 * 100)):
            with mock.patch.object(_thinning, "MOST_POSES", most):
                run, shown = describe(place)
            self.assertEqual((run["every"], run["frames"]), (every, 300 // every))
            content, filled = _motion(shown)
            self.assertNotIn("keys", content["asset"]["extras"])
            for (node, path), (times, values) in filled.items():
                wanted = whole[node, path][1][::every]
                self.assertTrue(np.array_equal(times, whole[node, path][0][::every]))
                if path == "translation":
                    self.assertLess(np.linalg.norm(values - wanted, axis=1).max(), 0.05 * sizes[node] + 1e-6)
                else:
                    cosine = np.abs(np.sum(values.astype(float) * wanted, axis=1)) / np.linalg.norm(wanted, axis=1)
                    self.assertGreater(cosine.min(), np.cos(np.radians(2.0) / 2.0) - 1e-7)
        self.assertEqual(export(place, "glb", ("obstacles",)), str(place / "scene.glb"))
        gltf, moved = _motion((place / "scene.glb").read_bytes())
        times, values = moved[next(number for number, node in enumerate(gltf["nodes"]) if node["name"] == "obstacle-1"), "translation"]
        self.assertEqual((len(times), len(values)), (300, 300))
        self.assertEqual(gltf["asset"]["extras"]["keys"], said)

    def test_a_thinned_animation_that_is_damaged_is_named(self):
        place = folder("damaged", "planned.vtp")
        whole = _write_animation(place, FLOWN, 8, marks=True)
        size = int.from_bytes(whole[12:16], "little")
        content = json.loads(whole[20:20 + size])
        for change in (lambda gltf: gltf["accessors"][-1].update(count=1 << 30), lambda gltf: gltf["accessors"][-1].update(byteOffset=1 << 30),
                       lambda gltf: gltf["asset"]["extras"]["keys"].update(frames=0), lambda gltf: gltf["accessors"].pop(),
                       lambda gltf: gltf["animations"][0]["channels"][0].update(sampler="a"),
                       lambda gltf: gltf["animations"][0]["samplers"][3].update(output=0), lambda gltf: gltf["bufferViews"].append({"byteLength": 1}),
                       lambda gltf: gltf["animations"][0]["samplers"][5].update(input=1 << 20)):
            gltf = json.loads(json.dumps(content))
            change(gltf)
            text = json.dumps(gltf).encode()
            text += b" " * (-len(text) % 4)
            rest = whole[20 + size:]
            (place / "animation.glb").write_bytes(whole[:8] + b"".join(number.to_bytes(4, "little") for number in (
                20 + len(text) + len(rest), len(text))) + b"JSON" + text + rest)
            with self.assertRaisesRegex(BadInput, "animation.glb: "):
                describe(place)

    def test_far_from_the_origin_it_is_as_exact(self):
        far, near = far_and_near()
        (run, animation), (wanted, of_near) = (describe(place) for place in (far, near))
        corner = FAR + wanted["bounds"][::2]
        self.assertEqual((run["origin"], wanted["origin"]), (corner.tolist(), [0.0, 0.0, 0.0]))
        gltf, motion = _motion(animation)
        root = gltf["nodes"][-1]
        self.assertEqual((root["translation"], root["children"]), ([corner[0], corner[2], -corner[1]], list(range(48))))
        places = motion[7, "translation"][1] + np.array(root["translation"]) - (FAR[0], FAR[2], -FAR[1])
        self.assertLess(np.abs(places - _motion(of_near)[1][7, "translation"][1]).max(), 1e-6)
        for obstacle, other in zip(run["obstacles"], wanted["obstacles"]):
            points, theirs = (np.frombuffer(base64.b64decode(each["points"]), "<f4") for each in (obstacle, other))
            self.assertLess(np.abs(points.reshape(-1, 3) + wanted["bounds"][::2] - theirs.reshape(-1, 3)).max(), 1e-6)
        for place in (far, near):
            export(place, "glb", ("ground", "obstacles", "marks", "camera"))
        (gltf, moved), (other, of_near) = (_motion((place / "scene.glb").read_bytes()) for place in (far, near))
        self.assertEqual([gltf["nodes"][number]["name"] for number in gltf["scenes"][0]["nodes"]], ["volume"])
        nodes, theirs = ({node["name"]: node for node in content["nodes"]} for content in (gltf, other))
        self.assertEqual(nodes.keys() - theirs.keys(), {"volume"})
        self.assertEqual(len(nodes) - 1, len(nodes["volume"]["children"]))
        for name in theirs:
            place = np.array(nodes[name]["translation"]) + nodes["volume"]["translation"] - (FAR[0], FAR[2], -FAR[1])
            self.assertLess(np.abs(place - theirs[name]["translation"]).max(), 1e-5, name)
        (pushed,), (wanted,) = ([values for (node, _), (_, values) in found.items() if content["nodes"][node]["name"] == "obstacle-1"]
                                for content, found in ((gltf, moved), (other, of_near)))
        self.assertLess(np.abs(pushed - pushed[0] - wanted + wanted[0]).max(), 1e-5)

    def test_obstacles_move_and_the_ground_is_a_height(self):
        run, _, _ = contents(FLOWN)
        ground = [entry for entry in run["obstacles"] if entry["ground"] is not None]
        box, = [entry for entry in run["obstacles"] if entry["ground"] is None]
        self.assertEqual([entry["ground"] for entry in ground], [0.0])
        shifts = memoryview(base64.b64decode(box["shifts"])).cast("f")
        self.assertEqual(len(shifts), 900)
        self.assertAlmostEqual(shifts[3 * 299], 1.0, places=5)
        self.assertAlmostEqual(shifts[3 * 149], 149 / 299, places=5)

    def test_an_optimiser_is_plotted(self):
        place = folder("optimised")
        table = "Stage,E,Ex,Ev,Ec\n" + "".join(f"a,{3000 - k},1,2,3\n" for k in range(2999))
        (place / "convergence.csv").write_text(table, encoding="utf-8")
        write_page(place)
        energy = contents(place)[0]["energy"]
        self.assertEqual((energy["columns"], energy["rows"][0], energy["rows"][-1]),
                         (["E", "Ex", "Ev", "Ec"], [3000, 1, 2, 3], [2, 1, 2, 3]))
        self.assertLess(len(energy["rows"]), 1300)

    def test_measured_rows_are_taken_where_they_are(self):
        place = folder("measured")
        row = {"key": "life", "row": "life", "value": 1.5, "wanted": [None, 1.0], "drifters": None, "met": False, "why": ""}
        entry = {"folder": str(place), "tracks": "optimized", "objects": 48, "notes": ["so"], "rows": [row]}
        write_json(place / "measure.json", [{**entry, "folder": "another", "notes": []}, entry])
        write_page(place)
        measured = contents(place)[0]["measured"]
        self.assertEqual((measured["notes"], [found["value"] for found in measured["rows"]]), (["so"], [1.5]))
        write_json(place / "others.json", [{**entry, "folder": "a"}, {**entry, "folder": "b"}])
        with self.assertRaisesRegex(BadInput, "others.json: expected what `waft measure --json` writes"):
            write_page(place, place / "others.json")
        (place / "measure.json").write_text("mine", encoding="utf-8")
        write_page(place)
        self.assertIsNone(contents(place)[0]["measured"])


class RefusalTest(unittest.TestCase):
    def test_its_own_page_makes_room(self):
        place = folder("own")
        first = write_page(place)
        before = pathlib.Path(first).read_bytes()
        self.assertEqual(write_page(place), first)
        self.assertEqual(pathlib.Path(first).read_bytes(), before)
        self.assertEqual([path.name for path in place.glob(".waft-*")], [])

    def test_a_page_of_the_users_stays(self):
        place = folder("foreign")
        (place / "page.html").write_text("mine", encoding="utf-8")
        with self.assertRaisesRegex(BadInput, r"page\.html: no run of waft wrote it: it stays as it is"):
            write_page(place)
        self.assertEqual((place / "page.html").read_text(encoding="utf-8"), "mine")
        self.assertFalse((place / "page.json").exists())

    def test_a_page_that_was_changed_stays(self):
        place = folder("changed")
        path = pathlib.Path(write_page(place))
        with open(path, "a", encoding="utf-8") as stream:
            stream.write("<!-- my own -->")
        with self.assertRaisesRegex(BadInput, r"page\.html: it was changed since a run wrote it"):
            write_page(place)
        self.assertTrue(path.read_text(encoding="utf-8").endswith("<!-- my own -->"))

    def test_what_is_no_result_is_named(self):
        with self.assertRaisesRegex(BadInput, "nowhere: no such folder"):
            write_page(WORK / "nowhere")
        for name in ("report.json", "animation.glb", "poses.vtp", "constraints.vtp", "constraints.csv"):
            place = folder("lacking", name)
            with self.subTest(name), self.assertRaisesRegex(BadInput, re.escape(name)):
                write_page(place)
            self.assertFalse((place / "page.html").exists() or (place / "page.json").exists())

    def test_what_is_damaged_is_named(self):
        for name in ("report.json", "animation.glb", "planned.vtp", "constraints.csv", "rounds.csv"):
            place = folder("damaged")
            content = (place / name).read_bytes()
            (place / name).write_bytes(content[:len(content) // 3] if name.endswith((".glb", ".vtp")) else b"Row,Stage\n1,2\n")
            with self.subTest(name), self.assertRaisesRegex(BadInput, re.escape(name)):
                write_page(place)
            self.assertFalse((place / "page.html").exists())

    def test_the_package_that_is_missing_is_named(self):
        place = folder("bare")
        with mock.patch.object(pages, "THREE", "/nowhere/three.min.js"), self.assertRaisesRegex(WaftError, "libjs-three") as caught:
            write_page(place)
        self.assertNotIsInstance(caught.exception, BadInput)
        self.assertFalse((place / "page.html").exists())


@unittest.skipUnless(PROGRAM, "chromium is not installed: the page was not looked at")
class BrowserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.browser.size(960, 600)
        cls.browser.prefer(color_scheme="light", reduced_motion="reduce")
        cls.browser.open(FLOWN / "page.html", "window.waft && waft.ready")

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])
        own = (FLOWN / "page.html").absolute().as_uri()
        self.assertEqual([url for url in self.browser.requests if url != own and not url.startswith("data:")], [])

    def pixels(self, name):
        """The page as [row from the top, column, colour]."""
        path = WORK / f"{name}.png"
        self.browser.picture(path)
        reader = vtkPNGReader()
        reader.SetFileName(str(path))
        reader.Update()
        columns, rows, _ = reader.GetOutput().GetDimensions()
        return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(rows, columns, -1)[::-1, :, :3].astype(int)

    def test_it_says_what_it_shows(self):
        text = self.browser.run("document.body.innerText")
        for words in ("Leaves </script> & a <ball>", "48 of 48", "preview", "word.waft.json", "10 s"):
            self.assertIn(words, text)
        self.assertEqual(self.browser.run("document.querySelectorAll('#constraints tbody tr').length"), 48)
        self.assertGreaterEqual(self.browser.run("document.querySelectorAll('#plots figure').length"), 2)

    def test_all_that_is_worked_has_a_name(self):
        lacking = self.browser.run("""[...document.querySelectorAll('button, input, select, canvas, #plots svg')].filter((part) =>
          !(part.getAttribute('aria-label') || part.textContent.trim() || (part.labels || []).length)).map((part) => part.outerHTML)""")
        self.assertEqual(lacking, [])

    def test_it_plays_and_stops(self):
        self.browser.run("waft.view('side'), waft.seek(60), waft.settle()")
        before = self.pixels("before")
        self.browser.press(" ", code="Space", text=" ")
        self.browser.wait("waft.frame > 75")
        self.assertTrue(self.browser.run("waft.playing"))
        self.browser.press(" ", code="Space", text=" ")
        self.assertFalse(self.browser.run("waft.playing"))
        after = self.pixels("after")
        self.assertGreater((abs(after - before).max(axis=2) > 40)[:480, :580].mean(), 0.002)

    def test_it_begins_by_itself_where_motion_is_welcome(self):
        try:
            self.browser.prefer(color_scheme="light", reduced_motion="no-preference")
            self.browser.open(FLOWN / "page.html", "window.waft && waft.ready && waft.frame > 2")
        finally:
            self.browser.prefer(color_scheme="light", reduced_motion="reduce")
            self.browser.open(FLOWN / "page.html", "window.waft && waft.ready")
        self.assertFalse(self.browser.run("waft.playing"))

    def test_a_watched_page_follows(self):
        place = folder("watched")
        write_page(place, is_watched=True)
        self.browser.requests.clear()
        try:
            self.browser.open(place / "page.html", "window.waft && waft.ready")
            self.browser.run("waft.view('top'), waft.seek(50)")
            time.sleep(1.5)  # looked at meanwhile, and as it was
            self.assertEqual(self.browser.run("waft.frame"), 50)
            report = json.loads((place / "report.json").read_text(encoding="utf-8"))
            write_json(place / "report.json", {**report, "title": "Anew"})
            write_page(place, is_watched=True)
            self.browser.wait("document.title === 'Anew' && window.waft && waft.ready && waft.frame === 50")
            self.assertEqual(self.browser.run("document.querySelector('#views [aria-pressed=true]').dataset.view"), "top")
            self.assertTrue(all(url.startswith(place.absolute().as_uri()) or url.startswith("data:") for url in self.browser.requests))
            write_page(place)
            self.assertFalse((place / "page.watch.js").exists())
        finally:
            self.browser.open(FLOWN / "page.html", "window.waft && waft.ready")
            self.browser.requests.clear()  # also those that the page of before had still made

    def test_marks_show_their_status(self):
        place = folder("statuses")
        lines = (place / "constraints.csv").read_text(encoding="utf-8").splitlines(keepends=True)
        lines[2::2] = [line.replace(",met,", ",unreachable,") for line in lines[2::2]]
        (place / "constraints.csv").write_text("".join(lines), encoding="utf-8")
        write_page(place)
        try:
            self.browser.open(place / "page.html", "window.waft && waft.ready")
            self.assertIn("24 of 48", self.browser.run("document.getElementById('facts').innerText"))
            self.browser.run("waft.view('top'), waft.seek(0), waft.settle()")
            before = self.pixels("statuses-before")
            self.browser.run("waft.seek(299), waft.settle()")
            marks = self.browser.run("waft.run.marks.map(({ status, places: [[, x, y]] }) => [status, waft.project([x, y, 0])])")
            reach = round(self.browser.run("waft.project([0.1, 0, 0])[0] - waft.project([0, 0, 0])[0]")) + 2
            pixels = self.pixels("statuses")
        finally:
            self.browser.open(FLOWN / "page.html", "window.waft && waft.ready")
            self.browser.requests.clear()

        def shown(pixels):
            red, green, blue = (pixels[..., color] for color in range(3))
            hues = {"met": green > red + 40, "unreachable": (blue > green + 30) & (blue > red + 15)}  # leaves have neither
            return [hues[status][round(row) - reach:round(row) + reach, round(column) - reach:round(column) + reach].sum() > 8
                    for status, (column, row) in marks]

        self.assertEqual(sum(shown(pixels)), 48, shown(pixels))
        self.assertEqual(sum(shown(before)), 0, "nothing is met before its frame")

    def test_far_from_the_origin_it_looks_the_same(self):
        seen = []
        try:
            for place in far_and_near():
                write_page(place)
                self.browser.open(place / "page.html", "window.waft && waft.ready")
                self.browser.run("waft.stage('paper'), waft.view('side'), waft.seek(120), waft.settle()")
                marks = self.browser.run("waft.run.marks.map(({ places: [[, x, y, z]] }) => waft.project([x, y, z]))")
                seen.append((np.array(marks), self.pixels(place.name)))
        finally:
            self.browser.open(FLOWN / "page.html", "window.waft && waft.ready")
            self.browser.requests.clear()
        (marks, pixels), (wanted, others) = seen
        self.assertLess(np.abs(marks - wanted).max(), 0.02)
        self.assertLess((np.abs(pixels - others).max(axis=2) > 8).mean(), 1e-3)

    def test_keys_step(self):
        self.browser.run("waft.seek(100)")
        for key, shift, wanted in (("ArrowRight", 0, 101), ("ArrowRight", 8, 131), ("ArrowLeft", 0, 130), ("End", 0, 299), ("Home", 0, 0)):
            self.browser.press(key, code=key, modifiers=shift)
            self.assertEqual(self.browser.run("waft.frame"), wanted, key)

    def test_it_scrubs_to_the_last_frame_and_the_word_reads(self):
        self.browser.run("""(() => { const slider = document.getElementById('frame');
          slider.value = slider.max; slider.dispatchEvent(new Event('input')); document.getElementById('marks').click();
          waft.view('top'); waft.settle(); })()""")
        self.assertEqual(self.browser.run("waft.frame"), 299)
        self.assertIn("frame 299 of 299, 10.0 seconds", self.browser.run("document.getElementById('frame').getAttribute('aria-valuetext')"))
        marks = self.browser.run("waft.run.marks.map(({ places: [[, x, y]] }) => waft.project([x, y, 0]))")
        # Half-way between neighbouring letters, and above and below the word, the floor is empty.
        empty = self.browser.run("[[-1.5, 1], [0, 1], [1.5, 1], [-1.5, -1], [0, -1], [1.5, -1]].map(([x, y]) => waft.project([x, y, 0]))")
        pixels = self.pixels("word")
        self.browser.run("document.getElementById('marks').click()")
        saturation = pixels.max(axis=2) - pixels.min(axis=2)  # leaves are yellow, red and brown, the stage is pale

        def share(point, reach=4):
            column, row = (round(value) for value in point)
            return (saturation[row - reach:row + reach + 1, column - reach:column + reach + 1] > 70).mean()

        self.assertEqual(len(marks), 48)
        covered = [share(mark) for mark in marks]
        self.assertGreaterEqual(sum(part > 0.5 for part in covered), 46, covered)
        self.assertEqual([share(point) for point in empty], [0.0] * 6)
        # The word and not its mirror image.
        middle = sum(column for column, _ in marks) / len(marks)
        mirrored = [share((2 * middle - column, row)) for column, row in marks]
        self.assertLess(sum(part > 0.5 for part in mirrored), 40, mirrored)

    def test_one_object_is_followed(self):
        self.browser.run("waft.view('side'), waft.seek(120), waft.follow(5), waft.settle()")
        self.assertEqual(self.browser.run("document.getElementById('follow').selectedOptions[0].text"), "gold-5")
        near = self.pixels("near")
        self.browser.run("waft.follow(-1), waft.view('side'), waft.settle()")
        far = self.pixels("far")
        self.assertGreater((abs(near - far).max(axis=2) > 40)[:480, :580].mean(), 0.005)

    def test_the_plan_is_beside_the_result(self):
        self.browser.run("waft.view('top'), waft.seek(150), document.getElementById('beside').click(), waft.settle()")
        self.assertTrue(self.browser.run("!document.getElementById('label-plan').hidden"))
        pixels = self.pixels("beside")
        width = self.browser.run("document.getElementById('canvas').clientWidth")
        plan, result = pixels[130:430, :width // 2], pixels[130:430, width // 2:width // 2 * 2]
        for pane in (plan, result):
            self.assertGreater((pane.max(axis=2) - pane.min(axis=2) > 70).sum(), 300)
        self.assertGreater((abs(plan - result).max(axis=2) > 60).mean(), 0.005)
        self.browser.run("document.getElementById('beside').click(), waft.settle()")

    def test_it_fits_a_phone(self):
        try:
            self.browser.size(390, 844, is_phone=True)
            self.browser.run("waft.seek(299), waft.view('top'), waft.settle()")
            self.assertEqual(self.browser.run("document.documentElement.scrollWidth"), 390)
            boxes = self.browser.run("""[...document.querySelectorAll('#play, #frame, #clock, #speed, #views button, #title')]
              .map((part) => part.getBoundingClientRect()).map(({ left, right }) => [left, right])""")
            self.assertTrue(all(0 <= left < right <= 390 for left, right in boxes), boxes)
            marks = self.browser.run("waft.run.marks.map(({ places: [[, x, y]] }) => waft.project([x, y, 0]))")
            self.assertTrue(all(0 < column < 390 for column, _ in marks), marks)
        finally:
            self.browser.size(960, 600)

    def test_dark_is_dark(self):
        def light():
            time.sleep(0.3)
            return self.pixels("stage").mean()

        bright = light()
        self.browser.prefer(color_scheme="dark", reduced_motion="reduce")
        self.browser.wait("document.getElementById('scheme').value === 'night'")
        dark = light()
        self.browser.prefer(color_scheme="light", reduced_motion="reduce")
        self.browser.wait("document.getElementById('scheme').value === 'paper'")
        self.assertLess(dark, 0.5 * bright)


@unittest.skipUnless(PROGRAM, "chromium is not installed: the page was not looked at")
class LoopTest(unittest.TestCase):
    def test_a_loop_goes_on_over_its_end(self):
        made = Scene("Round and round", seed=3)
        made.set_time(60, loop=True)
        made.add_objects("bubble", count=6, region={"min": (-1, -1, 1), "max": (1, 1, 3)})
        synthesize(made, output=WORK / "round", preview=True, _settings={"Assimilation": {"Resolution": 16, "LatticeResolution": 12}})
        write_page(WORK / "round")
        with Browser() as browser:
            browser.prefer(reduced_motion="reduce")
            browser.open(WORK / "round" / "page.html", "window.waft && waft.ready")
            browser.run("waft.seek(55), waft.play()")
            browser.wait("waft.frame < 20", seconds=1.5)  # one that does not stays at its end for two
            self.assertTrue(browser.run("waft.playing"))
            self.assertEqual([], browser.errors)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
