# SPDX-License-Identifier: BSD-3-Clause
"""Stages that work in slices: each update a bounded part, with the motion so far to look at."""
from typing import Any

from waft.run.updating import check_proxy, update


def go_on(source: Any) -> bool:
    """Goes on with the work that a source holds, by one slice of its stages; True when nothing is left.

    source: a proxy, Waft Animation or a stage by itself, whose property Slice [s] is above 0. The first slice is done by
    UpdatePipeline() or Show(). Works on a pvserver as well. Raises InputError where source is no proxy, and with the sentence of a
    stage that fails: one that has failed has nothing left to do.
    """
    check_proxy(source)
    if _has_more(source.SMProxy):
        source.SMProxy.InvokeCommand("GoOn")
        source.SMProxy.MarkModified(source.SMProxy)
    update(source)
    return not _has_more(source.SMProxy)


def _has_more(stage):
    complete = stage.GetProperty("Complete")
    if complete is None:
        return False
    stage.UpdatePropertyInformation(complete)
    return complete.GetElement(0) == 0
