# SPDX-License-Identifier: BSD-3-Clause
"""Names that are found when they are first used: of modules that take their time to import, or need ParaView, and of modules by what they
were called before there were packages of them (`import waft.synthesis` gives waft.run.synthesis)."""
import importlib
import sys
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any, Callable, Collection, Optional

_PACKAGES = {"scene": ("checking", "starting"),
             "run": ("database", "fetching", "repeating", "resuming", "showing", "slices", "synthesis", "takes", "unfolding",
                     "updating"),
             "results": ("cleaning", "exporting", "store", "writing"),
             "cli": ("blenderaddon", "demo")}
_NOW = {f"waft.{name}": f"waft.{package}.{name}" for package, names in _PACKAGES.items() for name in names}


def later(module: str, names: Collection[str]) -> Callable[[str], Any]:
    """A package's __getattr__, for names of one of its modules."""
    def find(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module '{module.rpartition('.')[0]}' has no attribute '{name}'")
        return getattr(importlib.import_module(module), name)
    return find


class _Moved:
    """A finder and loader of Python's import."""

    @staticmethod
    def find_spec(name: str, _path: Any = None, _target: Any = None) -> Optional[ModuleSpec]:
        return ModuleSpec(name, _Moved) if name in _NOW else None  # type: ignore[arg-type]

    @staticmethod
    def create_module(_spec: ModuleSpec) -> None:
        """None: an empty module, in whose place comes the one that there is."""

    @staticmethod
    def exec_module(module: ModuleType) -> None:
        sys.modules[module.__name__] = importlib.import_module(_NOW[module.__name__])


def find_moved() -> None:
    if _Moved not in sys.meta_path:
        sys.meta_path.insert(0, _Moved)  # type: ignore[arg-type]
