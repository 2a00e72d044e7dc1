#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The house's rules about who may include whom, checked on the sources as text.

    check_includes.py ROOT     prints each violation as file:line: reason; exit status 1 when there is one

Rules: nothing under Filters/Core includes VTK; a Core library includes only itself and the libraries it
is allowed; a library in folders has them on floors, and includes none above; wrappers (Sources,
Filters/Motion) include no other wrapper's header but that of an abstract base; Bridge includes no
wrapper, and its folder Data nothing of the others, Files and Pipeline not each other, Run any; no two
headers define a class of one name, for which the linker would take either; third-party libraries
stay in the Core library that owns them; modules of the
Python package import each other in no circle, within functions neither; but for
the owners of files none of them opens, reads or writes one by itself; those that
read results take arrays, JSON and tables by the accessors that look at them.
"""
import ast
import pathlib
import re
import sys

CORE_MAY_INCLUDE = {
    "Base": set(),
    "Files": {"Base"},
    "Store": {"Base"},
    "Constraints": {"Base", "Obstacles"},
    "Scene": {"Base", "Constraints", "Obstacles"},
    "Shapes": {"Base"},
    "Grid": {"Base", "Obstacles"},
    "Obstacles": {"Base"},
    "Volumes": {"Base"},
    "Trajectory": {"Base", "Obstacles", "Store"},
    "Database": {"Base", "Grid", "Obstacles", "Store", "Trajectory"},
    "Planning": {"Base", "Constraints", "Obstacles", "Trajectory"},
    "Air": {"Base", "Constraints", "Grid", "Obstacles", "Rotation", "Store"},
    "Vortex": {"Base"},
    "Particles": {"Base", "Obstacles"},
    "Spacetime": {"Base", "Constraints", "Obstacles", "Particles", "Store", "Vortex"},
    "Rotation": {"Base", "Constraints", "Obstacles"},
    "Chain": {"Air", "Base", "Constraints", "Grid", "Obstacles", "Planning", "Rotation", "Scene", "Shapes", "Spacetime", "Trajectory", "Vortex"},
    "Export": {"Base"},
}
# Folders of a library: each with those below that it includes.
FOLDER_MAY_INCLUDE = {
    "Air": {
        "Field": set(),
        "Drift": {"Field"},
        "Run": {"Field", "Drift"},
    },
    "Spacetime": {
        "Model": set(),
        "Energy": {"Model"},
        "Solver": {"Model", "Energy"},
        "Fields": {"Model", "Energy"},
        "Scene": {"Model", "Energy", "Fields"},
        "Paper": {"Model", "Energy", "Fields", "Scene"},
        "Run": {"Model", "Energy", "Solver", "Fields", "Scene", "Paper"},
    },
}
BRIDGE_MAY_INCLUDE = {"Data": {"Data"}, "Files": {"Data", "Files"}, "Pipeline": {"Data", "Pipeline"},
                      "Run": {"Data", "Files", "Pipeline", "Run"}}
THIRD_PARTY_OWNERS = {
    "CGAL": {"Obstacles", "Shapes"},
    "openvdb": {"Obstacles", "Volumes"},
    "ceres": {"Vortex"},
    "nlohmann": {"Chain", "Files", "Scene"},
    "tiny_gltf.h": {"Export"},
}
# Modules of the package waft that open, move and remove files; the others ask these, which look at what a file is.
FILE_OWNERS = {"beneath", "files", "reading", "renaming", "temporary"}
FILE_CALLS = {"fdopen", "read_bytes", "read_text", "write_bytes", "write_text", "loadtxt", "genfromtxt", "fromfile", "memmap", "iterparse", "unlink",
              "rmtree", "symlink_to", "hardlink_to", "touch"}
FILE_MODULES = {"io": {"open"}, "os": {"open", "remove", "removedirs", "rename", "renames", "replace", "link", "symlink", "truncate"},
                "json": {"load", "dump"}, "np": {"load"}, "pickle": {"load"}, "ElementTree": {"parse"},
                "Image": {"open"}, "shutil": {"copy", "copy2", "copyfile", "copytree", "move"}}
# Modules of the package waft that read results, and what the accessors (_arrays, _records, _tables) do for them.
RESULT_READERS = {"results._folder", "page._pagedata", "measuring._runs", "measuring._airfield", "measuring._meshcuts", "render._flyers", "results.exporting",
                  "page.writing", "measuring.rows", "run.takes"}
BARE_CALLS = {"GetArray", "GetAbstractArray", "GetTuple3", "vtk_to_numpy", "loads", "DictReader"}
CLASS = re.compile(r"(?:class|struct)\s+(?:alignas\(\w+\)\s+|\w+_EXPORT\s+)?(\w+)(?!\w|\s*;|::)")
INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^">]+)[">]')


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in (".h", ".cxx", ".txx"))


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


def is_vtk(header):
    return re.match(r"(vtk|pq)[A-Za-z0-9_]*\.h$", header.split("/")[-1]) is not None


def check_folders(path, library, folder):
    floors = FOLDER_MAY_INCLUDE.get(library)
    if floors is None:
        return
    if folder not in floors:
        yield path, 1, f"{folder} is not in the list of folders of {library}"
        return
    for number, header in includes(path):
        parts = header.split("/")
        if parts[0] == library and parts[1] not in floors[folder] | {folder}:
            yield path, number, f"{library}/{folder} may not include {library}/{parts[1]}: {header}"


def check_core(root):
    for path in sources(root / "Filters" / "Core"):
        library = path.relative_to(root / "Filters" / "Core").parts[0]
        if library not in CORE_MAY_INCLUDE:
            yield path, 1, f"library {library} is not in the list of Core libraries"
            continue
        yield from check_folders(path, library, path.relative_to(root / "Filters" / "Core").parts[1])
        for number, header in includes(path):
            first = header.split("/")[0]
            if is_vtk(header):
                yield path, number, f"Core includes VTK: {header}"
            elif first in CORE_MAY_INCLUDE and first != library and first not in CORE_MAY_INCLUDE[library]:
                yield path, number, f"{library} may not include {first}: {header}"
            elif first in THIRD_PARTY_OWNERS and library not in THIRD_PARTY_OWNERS[first]:
                yield path, number, f"{first} belongs to {sorted(THIRD_PARTY_OWNERS[first])}: {header}"
            elif header.startswith(("Bridge/", "Motion/", "Sources/")):
                yield path, number, f"Core includes a layer above it: {header}"


def check_bridge(root):
    bridge = root / "Filters" / "Bridge"
    for path in sources(bridge):
        folder = path.relative_to(bridge).parts[0]
        if folder not in BRIDGE_MAY_INCLUDE:
            yield path, 1, f"{folder} is not in the list of Bridge's folders"
            continue
        for number, header in includes(path):
            parts = header.split("/")
            if parts[0] == "Bridge" and parts[1] not in BRIDGE_MAY_INCLUDE[folder]:
                yield path, number, f"Bridge/{folder} may not include Bridge/{parts[1]}: {header}"


def check_wrappers(root):
    folders = [root / "Sources", root / "Filters" / "Motion"]
    wrappers = {p.name for folder in folders if folder.exists() for p in folder.glob("vtk*.h")
                if "vtkAbstractTypeMacro" not in p.read_text(encoding="utf-8")}
    checked = [p for folder in folders if folder.exists() for p in sources(folder)]
    for path in checked + sources(root / "Filters" / "Bridge"):
        for number, header in includes(path):
            name = header.split("/")[-1]
            if name in wrappers and name != path.stem + ".h":
                yield path, number, f"includes the wrapper {name}"
            first = header.split("/")[0]
            if first in THIRD_PARTY_OWNERS:
                yield path, number, f"{first} belongs to {sorted(THIRD_PARTY_OWNERS[first])}: {header}"


def check_names(root):
    """Classes at the level of a namespace, which stand at the beginning of a line; one that is only declared ends with ;."""
    first = {}
    for folder in ("Filters", "Sources", "Plugin"):
        for path in sources(root / folder):
            if path.suffix != ".h":
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = CLASS.match(line)
                if match and first.setdefault(match.group(1), path) != path:
                    yield path, number, f"{match.group(1)} is defined in {first[match.group(1)].name} too"


def python_modules(root):
    """{name: path} of the modules of the package waft, those of its packages with a dot; a package by itself is its __init__."""
    folder = root / "Plugin" / "Python" / "waft"
    files = [*folder.glob("*.py"), *folder.glob("*/*.py")]
    return {".".join(path.relative_to(folder).with_suffix("").parts).removesuffix(".__init__"): path for path in sorted(files)}


def python_imports(name, modules):
    """{other: line} of the modules of waft that one of them imports."""
    names = {}
    for node in ast.walk(ast.parse(modules[name].read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = ["waft", *name.split(".")][:-node.level] if node.level else []
            origin = ".".join([*above, *filter(None, [node.module])])
            found = [of if of.partition(".")[2] in modules else origin for of in (f"{origin}.{alias.name}" for alias in node.names)]
        else:
            continue
        for other in (full.partition(".")[2] for full in found if full.startswith("waft.")):
            if other in modules:
                names.setdefault(other, node.lineno)
    return names


def check_python(root):
    modules = python_modules(root)
    imports = {name: python_imports(name, modules) for name in modules}
    done = set()

    def visit(name, way):
        for other, line in imports[name].items():
            if other in way:
                yield modules[name], line, "imports in a circle: " + " -> ".join([*way[way.index(other):], other])
            elif other not in done:
                yield from visit(other, [*way, other])
        done.add(name)

    for name in imports:
        if name not in done:
            yield from visit(name, [name])


def opened_by(call):
    """The name of what a call opens a file by; empty when it is no such call. What is in memory may be read by any means."""
    function = call.func
    if any(isinstance(given, ast.Call) and isinstance(given.func, ast.Attribute) and given.func.attr in ("BytesIO", "StringIO")
           or isinstance(given, ast.Attribute) and given.attr in ("stdout", "stderr", "devnull") for given in call.args):
        return ""
    if isinstance(function, ast.Name):
        return function.id if function.id == "open" or re.fullmatch(r"vtk\w+Reader", function.id) else ""
    if not isinstance(function, ast.Attribute):
        return ""
    owner = function.value.id if isinstance(function.value, ast.Name) else ""
    is_own = owner in FILE_OWNERS
    return function.attr if (function.attr in FILE_CALLS and not is_own) or function.attr in FILE_MODULES.get(owner, ()) else ""


def check_files(root):
    for name, path in python_modules(root).items():
        if name in FILE_OWNERS:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            name = opened_by(node) if isinstance(node, ast.Call) else ""
            if name:
                yield path, node.lineno, f"opens or changes a file by {name}: expected a function of {', '.join(sorted(FILE_OWNERS))}"


def check_accessors(root):
    for name, path in python_modules(root).items():
        if name not in RESULT_READERS:
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            function = node.func if isinstance(node, ast.Call) else None
            name = getattr(function, "attr", getattr(function, "id", ""))
            if name in BARE_CALLS:
                yield path, node.lineno, f"reads results by {name}: expected an accessor of _arrays, _records or _tables"


def check(root):
    root = pathlib.Path(root)
    return [*check_core(root), *check_bridge(root), *check_wrappers(root), *check_names(root), *check_python(root),
            *check_files(root), *check_accessors(root)]


def main():
    violations = check(sys.argv[1])
    for path, number, reason in violations:
        print(f"{path}:{number}: {reason}")
    count = len(sources(pathlib.Path(sys.argv[1]) / "Filters" / "Core"))
    print(f"{count} Core files read, {len(violations)} violations")
    return 1 if violations or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
