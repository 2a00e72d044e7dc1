# SPDX-License-Identifier: BSD-3-Clause
"""How good a motion is."""
from typing import TYPE_CHECKING

from waft.importing import later

if TYPE_CHECKING:
    from waft.measuring.rows import Measured, Row, make_drifters_for, measure, table

__all__ = ["Measured", "Row", "make_drifters_for", "measure", "table"]
__getattr__ = later("waft.measuring.rows", __all__)
