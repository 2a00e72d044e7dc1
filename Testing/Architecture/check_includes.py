#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The house's rules about who may include whom, checked on the sources as text.

    check_includes.py ROOT     prints each violation as file:line: reason; exit status 1 when there is one

Rules: nothing under Filters/Core includes VTK; a Core library includes only itself and the libraries it
is allowed; wrappers (Sources, Filters/Motion) include no other wrapper's header but that of an
abstract base; Bridge includes no wrapper; third-party libraries stay in the Core library that owns them.
"""
import pathlib
import re
import sys

CORE_MAY_INCLUDE = {
    "Base": set(),
    "Files": {"Base"},
    "Constraints": {"Base", "Obstacles"},
    "Scene": {"Base", "Constraints"},
    "Shapes": {"Base"},
    "Grid": {"Base"},
    "Obstacles": {"Base"},
    "Volumes": {"Base"},
    "Trajectory": {"Base", "Obstacles"},
    "Database": {"Base", "Grid", "Obstacles", "Trajectory"},
    "Planning": {"Base", "Constraints", "Obstacles", "Trajectory"},
    "Vortex": {"Base"},
    "Particles": {"Base", "Obstacles"},
    "Spacetime": {"Base", "Constraints", "Obstacles", "Particles", "Vortex"},
    "Rotation": {"Base", "Constraints", "Obstacles"},
    "Export": {"Base"},
}
THIRD_PARTY_OWNERS = {
    "CGAL": {"Obstacles", "Shapes"},
    "openvdb": {"Obstacles", "Volumes"},
    "ceres": {"Vortex"},
    "nlohmann": {"Files", "Scene"},
    "tiny_gltf.h": {"Export"},
}
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


def check_core(root):
    for path in sources(root / "Filters" / "Core"):
        library = path.relative_to(root / "Filters" / "Core").parts[0]
        if library not in CORE_MAY_INCLUDE:
            yield path, 1, f"library {library} is not in the list of Core libraries"
            continue
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


def check(root):
    root = pathlib.Path(root)
    return list(check_core(root)) + list(check_wrappers(root))


def main():
    violations = check(sys.argv[1])
    for path, number, reason in violations:
        print(f"{path}:{number}: {reason}")
    count = len(sources(pathlib.Path(sys.argv[1]) / "Filters" / "Core"))
    print(f"{count} Core files read, {len(violations)} violations")
    return 1 if violations or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
