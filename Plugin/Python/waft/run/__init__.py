# SPDX-License-Identifier: BSD-3-Clause
"""From a scene to an animation: what is asked for, the stages, what came of them."""
from typing import TYPE_CHECKING

from waft.importing import later

if TYPE_CHECKING:
    from waft.run.result import Result, Run

__all__ = ["Result", "Run"]
__getattr__ = later("waft.run.result", __all__)
