# SPDX-License-Identifier: BSD-3-Clause
"""Data of an output by its name. ParaView's own Fetch reads the first one, whichever it is given, unless it is told `idx`."""
from typing import Any, Optional, Union

from paraview import servermanager

from waft.failures import InputError


def fetch(stage: Any, port: Optional[Union[int, str]] = None, time: Optional[float] = None) -> Any:
    """The data of one output of a source or filter, as a VTK data object in this process, from a pvserver too.

    port: the name of the output ("Poses") or its number; none: the one that the stage was named with, stage["Poses"], else the
    first. time: in seconds; none: what the output shows now, up to date.
    """
    if not isinstance(stage, servermanager.SourceProxy):
        raise InputError(f"fetch: expected a stage, found {stage!r}")
    number = _number_of(stage, stage.Port if port is None else port)
    stage.UpdatePipeline(time)
    return servermanager.Fetch(stage, idx=number)


def _number_of(stage, port):
    names = [stage.SMProxy.GetOutputPortName(number) for number in range(stage.SMProxy.GetNumberOfOutputPorts())]
    if port in names:
        return names.index(port)
    if isinstance(port, bool) or not isinstance(port, int) or not 0 <= port < len(names):
        raise InputError(f"fetch: port: expected one of {', '.join(names)}, or a number from 0 to {len(names) - 1}, found {port!r}")
    return port
