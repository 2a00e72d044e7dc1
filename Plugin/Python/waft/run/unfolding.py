# SPDX-License-Identifier: BSD-3-Clause
"""The stages of a Waft Animation as sources and filters of their own."""
from typing import Any, Dict

from waft.failures import InputError
from waft.run.updating import check_proxy


def unfold(animation: Any) -> Dict[str, Any]:
    """Makes the stages that a Waft Animation runs, in one pipeline and set as it is: {name in the pipeline browser: proxy}. They
    give the same bytes, and nothing links them back. Raises InputError where animation is no such proxy."""
    from paraview import simple

    check_proxy(animation)
    if animation.SMProxy.GetProperty("Unfold") is None:
        raise InputError(f"animation: expected a Waft Animation, found {animation!r}")
    before = set(simple.GetSources())
    animation.Unfold = 1
    animation.UpdateVTKObjects()
    return {name: source for (name, number), source in simple.GetSources().items() if (name, number) not in before}
