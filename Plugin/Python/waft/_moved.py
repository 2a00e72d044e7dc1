# SPDX-License-Identifier: BSD-3-Clause
"""Modules by the names that they had before there were packages of them: `import waft.synthesis` gives waft.run.synthesis."""
import importlib
import sys
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any, Optional

_PACKAGES = {"scene": ("checking", "starting"),
             "run": ("database", "fetching", "pipeline", "repeating", "resuming", "showing", "slices", "synthesis", "takes", "unfolding",
                     "updating"),
             "results": ("cleaning", "exporting", "store", "writing"),
             "cli": ("blenderaddon", "demo")}
_NOW = {f"waft.{name}": f"waft.{package}.{name}" for package, names in _PACKAGES.items() for name in names}


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
