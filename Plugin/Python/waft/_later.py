# SPDX-License-Identifier: BSD-3-Clause
"""Names of a package that are looked up at their first use: what they are in takes its time to import, or needs ParaView."""
import importlib
from typing import Any, Callable, Collection


def later(module: str, names: Collection[str]) -> Callable[[str], Any]:
    """A package's __getattr__, for names of one of its modules."""
    def find(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module '{module.rpartition('.')[0]}' has no attribute '{name}'")
        return getattr(importlib.import_module(module), name)
    return find
