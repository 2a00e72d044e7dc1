# SPDX-License-Identifier: BSD-3-Clause
"""Updates of stages that do not fail in silence."""
from typing import Any

from waft.failures import InputError

_MARK = "Failure"  # field data of the outputs of a stage that failed, and of those after it: the sentence


def update(source: Any) -> None:
    """Updates a source or filter, Waft Animation or a stage by itself; raises InputError with the sentence of what failed, its own
    or one that it takes from. Works on a pvserver as well. Raises InputError where source is no proxy."""
    check_proxy(source)
    source.UpdatePipeline()
    sentence = failure_of(source)
    if sentence:
        raise InputError(sentence)


def check_proxy(source: Any) -> None:
    if not hasattr(source, "SMProxy") or not hasattr(source, "UpdatePipeline"):
        raise InputError(f"source: expected a proxy of a source or filter, found {source!r}")


def failure_of(source: Any) -> str:
    """The sentence that the last update of a source failed with; empty where it did not."""
    proxy = source.SMProxy
    for port in range(proxy.GetNumberOfOutputPorts()):
        fields = proxy.GetOutputPort(port).GetDataInformation().GetFieldDataInformation()
        mark = fields.GetArrayInformation(_MARK)
        if mark is not None and mark.GetNumberOfStringValues() > 0:
            return mark.GetStringValue(0)
    return ""
