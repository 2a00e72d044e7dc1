# SPDX-License-Identifier: BSD-3-Clause
"""Waft: motion of light things in air that hits the artist's marks.

    import waft
    scene = waft.Scene("A word")                      # or a scene file: waft.Scene.load("word.waft.json")
    scene.add_objects("maple", count=60, region={"min": (-1, -1, 2.5), "max": (1, 1, 3.8)})
    scene.add_keyframe(299, text="HELLO", origin=(0, 0, 1.5), v=(0, 0, 1), width=3)
    scene.save("word.waft.json")

    run = waft.synthesize(scene, quality="preview", output="out")
    run.positions[object, frame], run.orientations, run.times, run.marks     # numpy arrays
    run.seed = 7                    # another flight through the same marks
    run.rotation.Seed = 3           # change one property of a stage ...
    run.rotation.UpdatePipeline()   # ... and update: only what depends on it is computed again
    run = waft.load("out")          # what was written, nothing flown again

Scenes need nothing but Python. All else needs ParaView: in pvpython, pvbatch and ParaView's own shell the plugin is loaded by the
import, elsewhere by its first use or by load_plugin(). The VTK classes are there by name, `from waft import vtkSPHSpacetimeFilter`,
once the plugin is loaded.
"""
import importlib as _importlib
import typing as _typing

from waft.importing import find_moved as _find_moved
from waft.failures import BadInput, InputError, WaftError
from waft.loading import data_file, load as _load, load_classes as _load_classes, load_plugin, version
from waft.scene import Scene

if _typing.TYPE_CHECKING:  # what __getattr__ finds
    from waft.measuring import measure
    from waft.run.fetching import fetch
    from waft.run.finished import load
    from waft.run.showing import show
    from waft.run.slices import go_on
    from waft.run.synthesis import synthesize
    from waft.run.unfolding import unfold
    from waft.run.updating import update

__version__ = version()
__all__ = ["BadInput", "InputError", "Scene", "WaftError", "data_file", "fetch", "go_on", "load", "load_plugin", "measure", "show", "synthesize",
           "unfold", "update", "version"]

# What takes its time to import, by its module.
_LATER = {"fetch": "waft.run.fetching", "go_on": "waft.run.slices", "load": "waft.run.finished", "measure": "waft.measuring.rows",
          "show": "waft.run.showing", "synthesize": "waft.run.synthesis", "unfold": "waft.run.unfolding",
          "update": "waft.run.updating"}
_WRAPPED = ("vtkWaftSources", "vtkWaftFilters")


def __getattr__(name):
    try:
        if name in _LATER:
            found = getattr(_importlib.import_module(_LATER[name]), name)
        elif name.startswith("vtk") and name not in _WRAPPED:
            _load_classes()
            found = next(vars(module)[name] for module in map(_wrapped, _WRAPPED) if name in vars(module))
        else:
            raise AttributeError(f"module 'waft' has no attribute '{name}'")
    except ImportError as error:
        raise AttributeError(f"waft.{name} is not there: {error}") from error
    except StopIteration:
        raise AttributeError(f"module 'waft' has no class '{name}'") from None
    globals()[name] = found
    return found


def _wrapped(name):
    return _importlib.import_module(f"waft.{name}")


def __dir__():
    return [*__all__, *(name for name in globals() if name.startswith("__") or (name.startswith("vtk") and name not in _WRAPPED))]


_find_moved()
_load()
