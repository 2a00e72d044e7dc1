# SPDX-License-Identifier: BSD-3-Clause
"""The command as the processes of a launcher run it (processes.py)."""
import atexit
import os
import traceback
from typing import Callable, Sequence

from waft import processes
from waft.cli.command import parse
from waft.loading import load_classes, set_threads


def as_one_run(act: Callable[[Sequence[str]], int], arguments: Sequence[str]) -> int:
    """The status of act(arguments), which the first process does; that of the others is 0, once the first has no more work."""
    launched = processes.launch()
    if launched is None:
        return act(arguments)
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    controller = vtkMultiProcessController.GetGlobalController()
    known = 1 if controller is None else controller.GetNumberOfProcesses()
    if known != launched.size:
        raise RuntimeError(f"{launched.size} processes were started, of which MPI knows {known}: expected the launcher of the MPI that "
                           "ParaView was built with")
    atexit.register(controller.Finalize)  # else the launcher takes the end of a process for its failure
    if not launched.is_first:
        _serve(controller, arguments)
        return 0
    load_classes()
    from waft.vtkWaftSources import vtkSharedWork

    processes.lead(controller)
    vtkSharedWork.SetProcessesHere(launched.local)
    try:
        return act(arguments)
    finally:
        vtkSharedWork.Release(controller)


def _serve(controller, arguments):
    """Ends all processes by ending this one, where it fails: the first would wait for it."""
    try:
        load_classes()
        from waft.vtkWaftSources import vtkSharedWork

        set_threads(parse(arguments).threads)
        vtkSharedWork.Serve(controller)
    except BaseException:  # noqa: B902
        traceback.print_exc()
        os._exit(1)
