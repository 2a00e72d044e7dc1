# SPDX-License-Identifier: BSD-3-Clause
"""Where the installed tree (or the build tree, which is laid out alike) keeps what the package needs."""
import os
import pathlib
import sys
from typing import Optional

from waft.processes import threads_here
from waft.reading import read_text

_PACKAGE = pathlib.Path(__file__).resolve().parent


def _find_upwards(pattern):
    for folder in _PACKAGE.parents:
        found = sorted(folder.glob(pattern))
        if found:
            return found[0]
        if (folder / "share" / "waft").exists():
            break
    return None


def version() -> str:
    """The version of this Waft, as text."""
    return read_text(_find_upwards("share/waft/VERSION")).strip()


def data_file(name: str) -> str:
    """Path of a file that comes with Waft: "Database/embedded.vtm", "Scenes/...".

    WAFT_DATA names another folder. Raises FileNotFoundError when there is no such file.
    """
    folder = os.environ.get("WAFT_DATA") or _find_upwards("share/waft/Data")
    path = pathlib.Path(folder or ".") / name
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such file among Waft's data")
    return str(path)


def command() -> str:
    """Path of the command `waft` that came with this package."""
    return str(_find_upwards("bin/waft"))


def addon_folder() -> Optional[pathlib.Path]:
    """The folder of the add-on for Blender; None where it was not installed."""
    return _find_upwards("share/blender/scripts/addons/waft_addon")


def is_paraview_here() -> bool:
    """Whether this process is one of ParaView's programs, or has its package imported."""
    try:
        program = os.path.basename(os.readlink("/proc/self/exe"))
    except OSError:
        program = ""
    return program.startswith(("pvpython", "pvbatch", "paraview")) or "paraview.simple" in sys.modules


def load() -> None:
    """In a program of ParaView its proxies, before a class is seen that is one's of them; else nothing: VTK will do."""
    if is_paraview_here():
        load_plugin()


def load_plugin() -> None:
    """Makes the proxies known to paraview.simple, once; a clear error when ParaView's version differs, or there is none."""
    try:
        from paraview import simple
    except ImportError as error:
        raise ImportError(f"ParaView's Python package was not found ({error}): run this by pvpython") from error

    if not hasattr(simple, "StylisticPlannerFilter"):
        _load_library(simple)
    _check_plugin()
    # Before the first object of a class is seen from Python: what has no class then keeps that of its nearest base.
    from waft import vtkWaftFilters, vtkWaftSources  # noqa: F401


def _check_plugin():
    """ImportError where the plugin that is loaded is of another version than this package."""
    from paraview import servermanager

    plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
    names = [plugins.GetPluginName(i) for i in range(plugins.GetNumberOfPlugins())]
    loaded = next((i for i, name in enumerate(names) if name == "Waft" and plugins.GetPluginLoaded(i)), None)
    if loaded is not None and plugins.GetPluginVersion(loaded) != version():
        raise ImportError(f"the plugin {plugins.GetPluginFileName(loaded)} is of Waft {plugins.GetPluginVersion(loaded)}, the package "
                          f"{_PACKAGE} of Waft {version()}: install both anew, from one, or set PV_PLUGIN_PATH and PYTHONPATH alike")


def _plugin():
    """Path of the plugin; None where Waft was built for VTK alone."""
    return _find_upwards("lib*/paraview-*/plugins/Waft/Waft.so") or _find_upwards("lib/*/paraview-*/plugins/Waft/Waft.so")


def load_classes() -> None:
    """Makes the VTK classes ready: with the plugin where there is one, else they need VTK's own package alone."""
    if _plugin() is not None:
        load_plugin()


def _load_library(simple):
    plugin = _plugin()
    if plugin is None:
        raise ImportError(f"the ParaView plugin Waft.so was not found above {_PACKAGE}")
    built_for = plugin.parts[-4].replace("paraview-", "")
    running = f"{simple.GetParaViewVersion().major}.{simple.GetParaViewVersion().minor}"
    if running != built_for:
        raise ImportError(f"Waft was built for ParaView {built_for}, this is ParaView {running}")
    simple.LoadPlugin(str(plugin), remote=False, ns=vars(simple))


_has_threads = True


def set_threads(threads: Optional[int]) -> None:
    """Number of threads of every stage (None: all cores, divided among the processes of a launcher). Results do not depend on it."""
    from vtkmodules.vtkCommonCore import vtkSMPTools

    threads = threads or threads_here()
    vtkSMPTools.SetBackend("STDThread" if threads != 1 and _has_threads else "Sequential")
    vtkSMPTools.Initialize(threads or 0)


def _work_alone():
    """A fork has none of the threads that VTK keeps for its loops since 9.3, and would wait for them for ever."""
    global _has_threads
    vtk = sys.modules.get("vtkmodules.vtkCommonCore")
    if vtk is not None and (vtk.vtkVersion.GetVTKMajorVersion(), vtk.vtkVersion.GetVTKMinorVersion()) >= (9, 3):
        _has_threads = False
        vtk.vtkSMPTools.SetBackend("Sequential")


os.register_at_fork(after_in_child=_work_alone)
