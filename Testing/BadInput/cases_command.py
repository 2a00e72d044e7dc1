# SPDX-License-Identifier: BSD-3-Clause
"""Options that are none, folders that are another's, results and checkpoints that are damaged."""
import functools
import json
import pathlib
import shutil
import subprocess
import tempfile
import time

from case import LEAF, OUT, Case, synthesize
from waft import loading

CONSTRAINED = LEAF | {"constraints": [{"kind": "position", "object": 0, "frame": 30, "value": [0.0, 0.0, 1.6], "radius": 0.1}]}
_made = tempfile.TemporaryDirectory()


def _write_scene(folder, scene=None):
    (folder / "scene.waft.json").write_text(json.dumps(scene or LEAF), encoding="utf-8")


def _options(name, *options, says=(), scene="scene.waft.json"):
    def make(folder, results):
        _write_scene(folder)
        return synthesize(scene, results, *options)
    return Case("command", f"synthesize {name}", make, says=says)


def _call(name, *arguments, says=(), status=(2,)):
    def make(folder, results):
        _write_scene(folder)
        return [str(argument) for argument in arguments]
    return Case("command", name, make, says=says, status=status)


def _bad_options():
    numbers = {"--seed": ("x", "-1", "1.5", "2147483648", "", "1e3"), "--threads": ("0", "-2", "x", "1.5", 10 ** 18),
               "--time-limit": ("0", "-1", "nan", "inf", "x", ""), "--memory-limit": ("0", "-1", "nan", "inf", "x")}
    for option, values in numbers.items():
        for value in values:
            yield _options(f"{option} '{value}'", f"{option}={value}", says=(option,))
        yield _options(f"{option} of nothing", option, says=(option,))
    for name, options in (("an unknown option", ("--fast",)), ("two scenes", ("other.waft.json",)),
                          ("--preview with a value", ("--preview=1",)), ("--memory-limit 0.001", ("--quality", "paper", "--memory-limit", "0.001")),
                          ("a database that is none", ("--database", "scene.waft.json")), ("--database ''", ("--database", ""))):
        yield _options(name, *options)
    yield _call("nothing")
    yield _call("an unknown command", "fly", says=("fly",))
    yield _call("synthesize alone", "synthesize")
    yield _call("synthesize without --output", "synthesize", "scene.waft.json", says=("--output",))
    yield _call("synthesize --output ''", "synthesize", "scene.waft.json", "--output", "")
    yield _call("synthesize --output of 5000 letters", "synthesize", "scene.waft.json", "--output", "o" * 5000)
    yield _call("synthesize --output below a file", "synthesize", "scene.waft.json", "--output", "scene.waft.json/o",
                says=("scene.waft.json",))
    yield _call("synthesize --output /dev/null", "synthesize", "scene.waft.json", "--output", "/dev/null", says=("/dev/null",))
    yield _call("synthesize --output /proc/none", "synthesize", "scene.waft.json", "--output", "/proc/none", status=(1, 2))
    yield _call("synthesize --output ~ of no one", "synthesize", "none.waft.json", "--output", "~nobody/x", says=("none",))

    numbers = {"--simulations": ("0", "-1", "x", 10 ** 12, 10 ** 18), "--frames": ("0", "1", "-1", "x", 10 ** 9, 10 ** 12),
               "--resolution": ("0", "1", "3", "-8", "x", 10 ** 9, 10 ** 12), "--seed": ("-1", "x", 2 ** 31),
               "--threads": ("0", "x", 10 ** 18), "--until-covered": ("0", "2", "nan", "x"),
               "--coverage-tolerance": ("0", "-1", "nan", "x"), "--time-limit": ("0", "nan")}
    for option, values in numbers.items():
        for value in values:
            yield _call(f"database {option} {value}", "database", "--output", "d.vtm", f"{option}={value}", says=(option,))
    for output in ("d", "d.vtp", "", ".", "scene.waft.json/d.vtm", "d" * 5000 + ".vtm"):
        yield _call(f"database --output '{output[:30]}'", "database", "--output", output, "--simulations", 1, "--frames", 30,
                    "--resolution", 8)

    numbers = {"--frames": ("x", "5:1", "0:9:0", "99:100", "-1", "1:2:3:4", "1.5"),
               "--size": ("x", "0x0", "15x15", "99999x99999", "640", "640x-1"), "--views": ("", "front", "side,side"),
               "--obstacle-opacity": ("-1", "2", "nan", "x"), "--shutter": ("-1", "1.5", "nan", "x"),
               "--aperture": ("-1", "2000", "nan", "x"), "--subframes": ("1", "1000", "2.5", "x"),
               "--jobs": ("0", "65", "x")}
    for option, values in numbers.items():
        for value in values:
            def make(folder, results, option=option, value=value):
                return ["render", str(results), f"{option}={value}"]
            yield Case("command", f"render {option} '{value}'", make, says=(value,) if option == "--frames" else (option,))
    for folder in ("none", ".", "scene.waft.json", "f" * 5000, ""):
        yield _call(f"render '{folder[:30]}'", "render", folder)
        yield _call(f"measure '{folder[:30]}'", "measure", folder)
        yield _call(f"page '{folder[:30]}'", "page", folder)
        yield _call(f"check '{folder[:30]}'", "check", folder, status=(0,) if folder == "scene.waft.json" else (2,))
    yield _call("page --measure of a file that is none", "page", "none", "--measure", "m.json")
    yield _call("check with a database that is none", "check", "scene.waft.json", "--database", "scene.waft.json")
    for option, value in (("--tracks", "x"), ("--airs", "1"), ("--seed", "-1"), ("--settling-speeds", "0.5,x"),
                          ("--settling-speeds", "-1"), ("--settling-speeds", "")):
        yield _call(f"measure {option} '{value}'", "measure", "none", f"{option}={value}", says=(option,))

    for name, *options in (("--text ''", "--text="), ("--text of a blank", "--text", " "), ("--count 0", "--count=0"),
                           ("--count -1", "--count=-1"), ("--count x", "--count=x"), ("--count 10^12", "--count=1000000000000"),
                           ("--shape none", "--shape=none"), ("--image none", "--image=none.png"),
                           ("--image of a scene", "--image=scene.waft.json"), ("--path none", "--path=none.csv"),
                           ("--path of a scene", "--path=scene.waft.json"), ("--obstacle none", "--obstacle=none.obj"),
                           ("--obstacle of a scene", "--obstacle=scene.waft.json")):
        yield _call(f"new {name}", "new", "n.waft.json", *options)
    yield _call("new alone", "new")
    for option, values in {"--seeds": ("", "x", "4:3", "-1:2", "1:2:3", "1.5", "0:100000", 2 ** 31), "--jobs": ("0", "-1", "x", 10 ** 9),
                           "--threads": ("0", "x"), "--quality": ("x",)}.items():
        for value in values:
            yield _call(f"takes {option} '{value}'", "takes", "scene.waft.json", "--output", "t", "--seeds=1", f"{option}={value}",
                        says=(option,))
    for name, scene, *options in (("of no scene", "none.waft.json"), ("with a database that is none", "scene.waft.json", "--database", "none.vtm"),
                                  ("below a file", "scene.waft.json", "--output", "scene.waft.json/t"),
                                  ("of a folder", "."), ("without --output", "scene.waft.json", "--output", "")):
        yield _call(f"takes {name}", "takes", scene, "--seeds", "1", "--output", "t", *options)
    for path in ("scene.waft.json", "n.json", "", ".", "none/n.waft.json", "n" * 5000 + ".waft.json"):
        yield _call(f"new '{path[:30]}'", "new", path, says=(path,) if path == "scene.waft.json" else ())
    yield _call("synthesize --progress x", "synthesize", "scene.waft.json", "--output", OUT, "--progress=x", says=("--progress",))


def _in_the_way():
    """Files of another's where a run would write. They have to be there afterwards, as they were."""
    def foreign(path):
        def make(folder, _results):
            _write_scene(folder)
            (folder / OUT / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / OUT / path).write_text("mine", encoding="utf-8")
            return synthesize("scene.waft.json", OUT)
        return make

    for path in ("shapes/mine", "air/mine", "checkpoint/mine", "poses.csv/mine", "shapes/deep/mine", "report.json",
                 "poses.csv", "planned.vtp", "animation.glb", "shapes.vtm", "air.pvd", "air", "shapes", "checkpoint"):
        yield Case("command", f"DIR has another's {path}", foreign(path), says=(path.split("/")[0],))

    def project(folder, _results):
        from good_files import obj

        (folder / "shapes").mkdir()
        (folder / "shapes" / "my.obj").write_bytes(obj())
        _write_scene(folder, LEAF | {"shapes": {"leaf": {"mesh": "shapes/my.obj", "size": 0.1}}})
        return synthesize("scene.waft.json", ".")
    yield Case("command", "DIR is the scene's own project", project, says=("shapes",))

    def linked(folder, _results):
        _write_scene(folder)
        (folder / "precious").mkdir()
        (folder / "precious" / "mine").write_text("mine", encoding="utf-8")
        (folder / OUT).mkdir()
        (folder / OUT / "shapes").symlink_to("../precious")
        return synthesize("scene.waft.json", OUT)
    yield Case("command", "DIR/shapes is a link to another's folder", linked, says=("shapes",))

    def database(path):
        def make(folder, _results):
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text("mine", encoding="utf-8")
            return ["database", "--output", "d.vtm", "--simulations", "1", "--frames", "30", "--resolution", "8", "--threads", "1"]
        return make
    for path in ("d/mine", "d.vtm", "d.vtm/mine", "d.coverage.csv", "d.vtm.kept/mine", "d"):
        yield Case("command", f"database beside another's {path}", database(path), says=(path.split("/")[0],))


def _damaged_results():
    """What `render` and `measure` are given: results of which a file is damaged."""
    names = ("poses.vtp", "objects.vtp", "shapes.vtm", "shapes/shapes_0.vtp", "obstacles.vtp", "constraints.vtp")
    damages = (("cut in half", lambda content: content[:len(content) // 2]), ("empty", lambda content: b""),
               ("junk", lambda content: b"this is junk\n"), ("gone", None))
    for name in names:
        for damage, change in damages:
            def make(folder, results, name=name, change=change):
                shutil.copytree(results, folder / "r")
                path = folder / "r" / name
                if change is None:
                    path.unlink()
                else:
                    path.write_bytes(change(path.read_bytes()))
                return ["render", "r", "--frames", "0"]
            # Without obstacles and constraints there is something to draw, too.
            if damage != "gone" or name not in ("obstacles.vtp", "constraints.vtp"):
                yield Case("command", f"render with {name} {damage}", make, says=(pathlib.Path(name).name,))

    for damage, change in damages:
        def judge(folder, results, change=change):
            shutil.copytree(results, folder / "r")
            path = folder / "r" / "optimized.vtp"
            if change is None:
                path.unlink()
            else:
                path.write_bytes(change(path.read_bytes()))
            return ["measure", "r"]
        yield Case("command", f"measure with optimized.vtp {damage}", judge, says=("optimized.vtp",))

    def beyond(folder, results):
        from good_files import vtp

        shutil.copytree(results, folder / "r")
        (folder / "r" / "obstacles.vtp").write_bytes(vtp(connectivity="0 2 1 0 1 3 0 3 2 1 2 99999"))
        return ["render", "r", "--frames", "0"]
    yield Case("command", "render with indices beyond the points of obstacles.vtp", beyond, says=("obstacles.vtp",))


@functools.lru_cache(maxsize=None)
def _stopped_run():
    """A folder of results whose run ended without a word behind its plan."""
    out = pathlib.Path(_made.name) / "stopped"
    _write_scene(pathlib.Path(_made.name), CONSTRAINED)
    run = subprocess.Popen([loading.command(), *map(str, synthesize(pathlib.Path(_made.name) / "scene.waft.json", out))],
                           stderr=subprocess.DEVNULL)
    while not (out / "checkpoint" / "key").exists():
        assert run.poll() is None
        time.sleep(0.001)
    run.kill()
    run.wait()
    return out


def _damaged_checkpoints():
    for name in ("key", "constraints.vtp", "vortices.vtp", "planned.vtp"):
        for damage, change in (("cut in half", lambda content: content[:len(content) // 2]), ("gone", None),
                               ("no UTF-8", lambda content: b"\xff\xfe\xff" * 20),
                               ("of one bit another", lambda content: content[:-40] + bytes([content[-40] ^ 1]) + content[-39:])):
            def make(folder, _results, name=name, change=change):
                _write_scene(folder, CONSTRAINED)
                shutil.copytree(_stopped_run(), folder / OUT)
                path = folder / OUT / "checkpoint" / name
                if change is None:
                    path.unlink()
                else:
                    path.write_bytes(change(path.read_bytes()))
                return synthesize("scene.waft.json", OUT, "--resume")
            yield Case("command", f"--resume with {name} {damage}", make, status=(0,), says=("--resume", "1 of 1"))

    def whole(folder, _results):
        _write_scene(folder, CONSTRAINED)
        shutil.copytree(_stopped_run(), folder / OUT)
        return synthesize("scene.waft.json", OUT, "--resume")
    yield Case("command", "--resume with a checkpoint that is right", whole, status=(0,), says=("1 of 1",))


def cases():
    yield from _bad_options()
    yield from _in_the_way()
    yield from _damaged_results()
    yield from _damaged_checkpoints()
