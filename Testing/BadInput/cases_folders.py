# SPDX-License-Identifier: BSD-3-Clause
"""Folders of results of somebody else, whose files and links lead out of them. Nothing beside them may come, go or change."""
import hashlib
import json
import os
import re
import shutil
import socket

from case import LEAF, Case, synthesize

TEXT = b"the user's own\n"
ROW = {"size": len(TEXT), "digest": f"sha256:{hashlib.sha256(TEXT).hexdigest()}"}
PAGE, EXPORT, RENDER, MEASURE = ["page", "r"], ["export", "r"], ["render", "r", "--frames", "0"], ["measure", "r"]
WRITE = synthesize("scene.waft.json", "r")
EDIT = [*synthesize("scene.waft.json", "new"), "--edit-of", "r"]
# What a name may be that leads out, by way of r/link, r/shapes/link or r/shapes/deep/link, which lead to the user's folder.
LEADING = ("link/thesis.txt", "link/new.txt", "link/deep/new.txt", "shapes/link/thesis.txt", "shapes/deep/link/thesis.txt",
           "thesis-link", "../mine/thesis.txt", "shapes/../../mine/thesis.txt", "./../mine/thesis.txt", "{mine}/thesis.txt",
           "//{mine}/thesis.txt",
           "link/../mine/thesis.txt", "", "/", ".", "..", "a\0b", "a/" * 200 + "b", "x" * 300, 7, None, ["a"], {"a": 1})


def _make(change, arguments, has_links):
    """Results `r`, the user's folder `mine`, and maybe links from the one into the other; change(r, mine) does the rest."""
    def make(folder, results):
        (folder / "scene.waft.json").write_text(json.dumps(LEAF), encoding="utf-8")
        r, mine = folder / "r", folder / "mine"
        shutil.copytree(results, r)
        mine.mkdir()
        (mine / "thesis.txt").write_bytes(TEXT)
        (r / "thesis.txt").write_bytes(TEXT)
        if has_links:
            (r / "shapes" / "deep").mkdir()
            for link in (r / "link", r / "shapes" / "link", r / "shapes" / "deep" / "link"):
                link.symlink_to(mine)
            (r / "thesis-link").symlink_to(mine / "thesis.txt")
        change(r, mine)
        return arguments
    return make


def _case(name, change, arguments, *says, has_links=False):
    return Case("folders", f"{arguments[0]}: {name}"[:100].replace("\0", "0"), _make(change, arguments, has_links), says=says)


def _named(name, mine):
    return name.format(mine=mine) if isinstance(name, str) else name


def _write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")


def _change(r, manifest, files=()):
    """A change of results that was staged whole and cut short, with files that go in."""
    from waft.temporary import temporary_name

    staging = r / temporary_name()
    _write(staging / "manifest.json", manifest)
    for name in files:
        _write(staging / "new" / name, TEXT.decode())
    return staging


def _changed(new=(), old=()):
    """A manifest of the change of these rows, with that of the seal."""
    return {"seal": "report.json", "new": [{"name": "report.json", **ROW}, *new], "old": list(old)}


def _names_in_changes():
    for number, name in enumerate(LEADING):
        for which in ("new", "old") if name != "thesis-link" else ():
            def change(r, mine, name=name, which=which):
                inner = name if isinstance(name, str) and re.fullmatch(r"\w+(/[\w.]+)+", name) and len(name) < 99 else "one"
                (r / "report.json").unlink()
                _change(r, _changed(**{which: [{"name": _named(name, mine), **ROW}]}), [inner, "report.json"])
            # What is not there under a name of the results before is not removed.
            if which == "new" or not isinstance(name, str) or not re.match(r"\w+/\w", name):
                yield _case(f"a staged manifest whose {which} file is {name!r}", change, (PAGE, MEASURE, EXPORT)[number % 3], ".waft-",
                            has_links=True)


def _contents_of_changes():
    rows = [{"name": "one", **ROW}]
    right = _changed(rows)
    wrongs = ([], 7, "text", None, {}, {"seal": "none"}, {**right, "new": {}}, {**right, "old": None}, {**right, "seal": 3},
              {**right, "seal": "two"}, {**right, "more": 1}, {**right, "new": [7]}, {**right, "new": ["one"]}, {**right, "new": [{"name": "one"}]},
              *({**right, "new": [{**rows[0], **change}]} for change in (
                  {"size": -1}, {"size": "1"}, {"size": 1.5}, {"size": None}, {"size": 1e300}, {"digest": ""},
                  {"digest": "sha256:"},
                  {"digest": None}, {"digest": ROW["digest"].upper()}, {"digest": ROW["digest"] + "\n"},
                  {"digest": "md5:" + "0" * 32},
                  {"more": 1})))
    for number, wrong in enumerate((*wrongs, "{", "", "[" * 100000, "\ufeff")):
        arguments = (PAGE, EXPORT, RENDER, WRITE, MEASURE, EDIT)[number % 6]
        yield _case(f"a staged manifest of {json.dumps(wrong)[:40]}",
                    lambda r, mine, wrong=wrong: _change(r, wrong, ["one", "report.json"]), arguments, ".waft-", "manifest.json")


def _in_the_way_of_changes():
    """Something of the user's, or something else, where files that change hands are or go."""
    for kind, make in KINDS.items():
        for place in ("one", "report.json", "new/one", "manifest.json"):
            def change(r, mine, make=make, place=place):
                (r / "report.json").unlink()
                staging = _change(r, _changed([{"name": "one", **ROW}]), ["one", "report.json"])
                path = (r if place in ("one", "report.json") else staging) / place
                path.unlink(missing_ok=True)
                make(path, mine)
            yield _case(f"a change in which {place} is {kind}", change, MEASURE, place)


def _what_former_versions_left():
    for name in (".waft-move", ".waft-put"):
        for kind, make in KINDS.items():
            yield _case(f"{name}, which is {kind}", lambda r, mine, name=name, make=make: make(r / name, mine), RENDER, name)


def _manifests():
    seals = (("report.json", WRITE), ("page.json", PAGE), ("export-glb.json", EXPORT), ("pictures.json", RENDER),
             ("takes.json", ["takes", "scene.waft.json", "--seeds", "1", "--output", "r"]))
    for seal, arguments in seals:
        for name in LEADING if seal == "page.json" else LEADING[:10] if seal == "report.json" else LEADING[5:7]:
            def change(r, mine, seal=seal, name=name):
                content = json.loads((r / seal).read_text(encoding="utf-8")) if seal == "report.json" else {"manifest": []}
                content["manifest"].append({"name": _named(name, mine), **ROW})
                _write(r / seal, content)
            if seal != "pictures.json" or ".." in name:  # only what is drawn anew is replaced: of others nothing is done
                yield _case(f"a manifest of {seal} names {name!r}", change, arguments, has_links=True)
        own = {"page.json": "page.html", "export-glb.json": "scene.glb", "pictures.json": "frames/hero_0000.png"}
        own = own.get(seal, "thesis.txt")
        rows = ({"size": -1, "digest": ""}, {"size": len(TEXT), "digest": ""}, {"size": -1, "digest": ROW["digest"]}, {},
                {"digest": ROW["digest"]}, {"size": True, "digest": ROW["digest"]}, {**ROW, "more": 1})
        for number, row in enumerate(rows):
            for name in {own, "thesis.txt"} if number == 0 else {own}:
                def bare(r, mine, seal=seal, row=row, name=name):
                    content = json.loads((r / seal).read_text(encoding="utf-8")) if seal == "report.json" else {"manifest": []}
                    content["manifest"].append({"name": name, **row})
                    _write(r / seal, content)
                    _write(r / name, TEXT.decode())
                yield _case(f"a manifest of {seal} with {name}, {row}", bare, arguments, seal)


def _names_in_files():
    """A collection, a file of blocks and a picture's name, which others open."""
    out = [name for name in LEADING if isinstance(name, str) and "\0" not in name and name != ""]
    for name in (*out, "none.vtp", "thesis.txt"):
        def steps(r, mine, name=name, series="obstacles"):
            path = _named(name, mine)
            _write(r / f"{series}.pvd", f'<VTKFile><Collection><DataSet timestep="0" file="{path}"/></Collection></VTKFile>')
        yield _case(f"obstacles.pvd names {name!r}", steps, (PAGE, RENDER, EXPORT)[len(name) % 3],
                    "obstacles.pvd" if name in out else "", has_links=True)
        yield _case(f"air.pvd names {name!r}", lambda r, mine, steps=steps: steps(r, mine, series="air"), MEASURE,
                    "air.pvd" if name in out else "", has_links=True)

        def blocks(r, mine, name=name):
            text = (r / "shapes.vtm").read_text(encoding="utf-8")
            assert 'file="shapes/shapes_0.vtp"' in text
            shutil.copy(r / "shapes" / "shapes_0.vtp", mine / "thesis.txt")
            _write(r / "shapes.vtm", text.replace("shapes/shapes_0.vtp", _named(name, mine)))
        yield _case(f"shapes.vtm names {name!r}", blocks, RENDER, "shapes.vtm", has_links=True)

        def picture(r, mine, name=name):
            from datafiles import write_xml
            from waft.reading import read_blocks

            shapes = read_blocks(str(r / "shapes.vtm"))
            shapes.GetBlock(0).GetFieldData().GetAbstractArray("Texture").SetValue(0, _named(name, mine))
            write_xml(shapes, r / "shapes.vtm")
        if name in out:
            yield _case(f"a texture is {name!r}", picture, RENDER, "shapes.vtm", "Texture", has_links=True)

    for name in LEADING[:10]:
        def database(folder, results, name=name):
            from waft.loading import data_file

            _make(lambda r, mine: shutil.copytree(os.path.dirname(data_file("Database/embedded.vtm")), r / "base"), [], True)(
                folder, results)
            path = folder / "r" / "base" / "embedded.vtm"
            path.rename(folder / "r" / "base.vtm")
            text = (folder / "r" / "base.vtm").read_text(encoding="utf-8")
            _write(folder / "r" / "base.vtm", text.replace("embedded/embedded_0.vtt", name.format(mine=folder / "mine"))
                   .replace("embedded/embedded_0.vtp", name.format(mine=folder / "mine")))
            return ["check", "scene.waft.json", "--database", "r/base.vtm"]
        yield Case("folders", f"check: a database that names {name!r}", database, says=("base.vtm",))

    def entity(r, mine):
        text = (r / "shapes.vtm").read_text(encoding="utf-8").replace("shapes/shapes_0.vtp", "&up;/mine/thesis.txt")
        _write(r / "shapes.vtm", text.replace("?>\n", '?>\n<!DOCTYPE VTKFile [<!ENTITY up "..">]>\n', 1))
    yield _case("shapes.vtm leads out by an entity", entity, RENDER)


def _pipe(path, _mine):
    os.mkfifo(path)


def _socket(path, _mine):
    here = os.getcwd()
    os.chdir(path.parent)  # names of sockets are short
    with socket.socket(socket.AF_UNIX) as end:
        end.bind(path.name)
    os.chdir(here)


KINDS = {"a pipe": _pipe, "a socket": _socket, "a link to a device": lambda path, mine: path.symlink_to("/dev/zero"),
         "a link to a file": lambda path, mine: path.symlink_to(mine / "thesis.txt"),
         "a link to a folder": lambda path, mine: path.symlink_to(mine),
         "a link to nothing": lambda path, mine: path.symlink_to(mine / "new.txt"),
         "a link to itself": lambda path, mine: path.symlink_to(path.name),
         "a folder": lambda path, mine: path.mkdir()}


def _kinds():
    """Something else where a file of results, or one of Waft's own, would be."""
    read = {"poses.vtp": (PAGE, RENDER, EXPORT), "optimized.vtp": (MEASURE,), "objects.vtp": (MEASURE, RENDER),
            "constraints.vtp": (PAGE, MEASURE),
            "constraints.csv": (PAGE,), "report.json": (PAGE, WRITE), "animation.glb": (PAGE, EXPORT), "planned.vtp": (PAGE,),
            "shapes.vtm": (RENDER,),
            "shapes/shapes_0.vtp": (RENDER,), "obstacles.pvd": (PAGE, RENDER), "air.pvd": (MEASURE,),
            "assimilated.state": (EDIT,),
            "page.json": (PAGE,), "page.html": (PAGE,), "export-glb.json": (EXPORT,), "scene.glb": (EXPORT,),
            "pictures.json": (RENDER,),
            "frames/hero_0000.png": (RENDER,), "checkpoint": (WRITE,), "checkpoint/key": (WRITE,),
            "checkpoint/assimilation.state": (WRITE,), ".waft-lock": (PAGE, WRITE, EXPORT)}
    for number, (name, commands) in enumerate(read.items()):
        for place, (kind, make) in enumerate(KINDS.items()):
            if (number + place) % 2 and name != "report.json" or (kind == "a folder" and name == "checkpoint"):
                continue  # each kind meets half of the names

            def change(r, mine, name=name, make=make):
                path = r / name
                path.parent.mkdir(exist_ok=True)
                if name == "frames/hero_0000.png":
                    os.environ["DISPLAY"] = ":nowhere"  # asked for before it is used
                if path.is_dir():
                    shutil.rmtree(path)
                path.unlink(missing_ok=True)
                make(path, mine)
            yield _case(f"{name} is {kind}", change, commands[(number + place) // 2 % len(commands)], name.split("/")[0])

    for name in ("frames", "shapes", "air"):
        def linked(r, mine, name=name):
            if (r / name).is_dir():
                shutil.copytree(r / name, mine / name, symlinks=True)
                shutil.rmtree(r / name)
            else:
                (mine / name).mkdir()
            (r / name).symlink_to(mine / name)
            os.environ["DISPLAY"] = ":nowhere"
        yield _case(f"the folder {name} is a link", linked, {"frames": RENDER, "shapes": RENDER, "air": MEASURE}[name], name)

    def take(r, mine):
        (r / "take-0001").symlink_to(mine)
    yield _case("a take's folder is a link", take, ["takes", "scene.waft.json", "--seeds", "1", "--output", "r"], "take-0001")

    def temporary(r, mine):
        from waft.temporary import temporary_name

        (r / temporary_name()).symlink_to(mine)
        (r / temporary_name()).mkdir()
        (next(r.glob(".waft-*"))).is_symlink()
        for folder in r.glob(".waft-*"):
            if not folder.is_symlink():
                (folder / "link").symlink_to(mine)
        (r / "report.json").write_text("{", encoding="utf-8")
    yield _case("temporary folders that are and hold links", temporary, MEASURE, "report.json")


def cases():
    yield from _names_in_changes()
    yield from _contents_of_changes()
    yield from _in_the_way_of_changes()
    yield from _what_former_versions_left()
    yield from _manifests()
    yield from _names_in_files()
    yield from _kinds()
