# SPDX-License-Identifier: BSD-3-Clause
"""A machine that is short of something, and files that are no files."""
import json
import os
import resource
import shutil

from case import LEAF, Case, scene_case, synthesize


def _short(name, limits, status=(1, 2)):
    def make(folder, results):
        (folder / "scene.waft.json").write_text(json.dumps(LEAF), encoding="utf-8")
        return synthesize("scene.waft.json", results)
    return Case("environment", name, make, status=status, says=("waft:",), limits=limits)


def _special(name, file, make_special, scene, *says):
    case = scene_case("environment", name, scene, *says)
    write = case.make

    def make(folder, results):
        make_special(folder / file)
        return write(folder, results)
    case.make = make
    return case


def cases():
    for size in (0, 1000, 4000):
        yield _short(f"files of at most {size} bytes", {resource.RLIMIT_FSIZE: size})
    yield _short("at most 16 open files", {resource.RLIMIT_NOFILE: 16}, status=(0, 1, 2))

    def pipe(path):
        os.mkfifo(path)

    def endless(path):
        path.symlink_to("/dev/zero")

    def nowhere(path):
        path.symlink_to("nowhere" + path.suffix)

    def circle(path):
        path.symlink_to(path.name)

    for name, special in (("a pipe", pipe), ("an endless file", endless), ("a link to nothing", nowhere), ("a link to itself", circle)):
        for what, file, scene in (
                ("shape", "m.obj", LEAF | {"shapes": {"leaf": {"mesh": "m.obj"}}}),
                ("obstacle", "m.ply", LEAF | {"obstacles": [{"kind": "mesh", "file": "m.ply"}]}),
                ("photograph", "p.png", LEAF | {"shapes": {"leaf": {"mesh": "p.png"}}}),
                ("wind", "w.vti", LEAF | {"winds": [{"file": "w.vti"}]}),
                ("volume", "w.vdb", LEAF | {"winds": [{"file": "w.vdb"}]}),
                ("font", "f.ttf", LEAF | {"constraints": [{"kind": "keyframe", "frame": 30, "targets": {
                    "text": "I", "font": "f.ttf", "origin": [0.0, 0.0, 1.7], "width": 0.5}}]})):
            yield _special(f"{what} is {name}", file, special, scene)

        def scene_itself(folder, results, special=special):
            special(folder / "scene.waft.json")
            return synthesize("scene.waft.json", results)
        yield Case("environment", f"the scene is {name}", scene_itself, says=("scene.waft.json",))

        for file, *commands in (("report.json", ["page"]), ("page.json", ["page"]), ("constraints.csv", ["page"], ["export"]),
                                ("animation.glb", ["page"], ["export"]), ("planned.vtp", ["measure", "--tracks", "planned"]),
                                ("measure.json", ["page", "--measure", "results/measure.json"]), ("air.pvd", ["measure"]),
                                ("obstacles.pvd", ["render"], ["page"]), ("shapes.vtm", ["render"])):
            for command in commands:
                def beside(folder, results, special=special, file=file, command=command):
                    shutil.copytree(results, folder / "results")
                    (folder / "results" / file).unlink(missing_ok=True)
                    special(folder / "results" / file)
                    return [command[0], "results", *command[1:]]
                yield Case("environment", f"{command[0]} of results whose {file} is {name}", beside, says=(file,))
        for command in (["new", "n.waft.json", "--path", "p.csv"], ["takes", "p.csv", "--seeds", "1", "--output", "t"],
                        ["page", "results", "--measure", "p.csv"], ["measure", "results", "--drifters", "p.csv"]):
            def given(folder, results, special=special, command=command):
                shutil.copytree(results, folder / "results")
                special(folder / "p.csv")
                return command
            yield Case("environment", f"{command[0]} of a file that is {name}", given, says=("p.csv",))

    data = _short("without the data of Waft", {})
    data.environment = {"WAFT_DATA": "/nowhere"}
    yield data
    for name, variables in (("without a folder for temporary files", {"TMPDIR": "/nowhere"}),
                            ("without a home", {"HOME": "/nowhere"}),
                            ("in a locale that is none", {"LANG": "xx_YY", "LC_ALL": "xx_YY"})):
        yield scene_case("environment", name, LEAF, status=(0,), environment=variables)
