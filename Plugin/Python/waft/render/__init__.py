# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and movies of a result."""
from typing import TYPE_CHECKING

from waft.importing import later

if TYPE_CHECKING:
    from waft.render.stage import Stage, parse_frames, render

__all__ = ["Stage", "parse_frames", "render"]
__getattr__ = later("waft.render.stage", __all__)
