# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvpython on an installed tree: the package, a proxy and a class work, and come from there.

    pvpython use_installed.py PREFIX package|path    package: by `import waft` alone;
                                                     path: by PV_PLUGIN_PATH alone"""

import os
import sys

from paraview import simple

PREFIX, WAY = os.path.realpath(sys.argv[1]), sys.argv[2]


def inside(path):
    return os.path.realpath(path).startswith(PREFIX + os.sep)


def libraries():
    """Files of this process that have Waft in their names."""
    with open("/proc/self/maps", encoding="utf-8") as maps:
        names = {line.split()[-1] for line in maps if "/" in line}
    return [name for name in names if "Waft" in os.path.basename(name)]


def main():
    if WAY == "package":
        import waft

        assert inside(waft.__file__), waft.__file__
        from waft.vtkWaftSources import vtkObjectSource

        source = vtkObjectSource()
        source.SetPosition(1.0, 2.0, 3.0)
        source.Update()
        assert source.GetOutput().GetPoint(0) == (1.0, 2.0, 3.0)
        for kind in os.listdir(os.path.join(PREFIX, "share", "waft", "Data")):
            assert inside(waft.data_file(kind)), kind
        assert waft.__version__[0].isdigit(), waft.__version__
    proxy = simple.ObjectSource(Position=[0.5, 0.25, 2.0])
    proxy.UpdatePipeline()
    bounds = proxy.GetDataInformation().GetBounds()
    assert bounds == (0.5, 0.5, 0.25, 0.25, 2.0, 2.0), bounds
    used = libraries()
    assert used and all(inside(name) for name in used), used
    print(f"installed tree in use by {WAY}")


main()
