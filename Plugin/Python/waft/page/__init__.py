# SPDX-License-Identifier: BSD-3-Clause
"""A result as one page for a browser."""
from typing import TYPE_CHECKING

from waft.importing import later

if TYPE_CHECKING:
    from waft.page.writing import NAME, STAMP, THREE, write_page

__all__ = ["NAME", "STAMP", "THREE", "write_page"]
__getattr__ = later("waft.page.writing", __all__)
