# SPDX-License-Identifier: BSD-3-Clause
"""How many of several processes that a launcher (mpiexec, srun) started share a machine."""
import os
import re
from typing import Optional

# By launcher: this process' number, how many there are, how many on this machine.
_LAUNCHERS = (("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE"),
              ("PMIX_RANK", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_TASKS_PER_NODE"))


def threads_here() -> Optional[int]:
    """How many threads this process has by default: its machine's cores over the processes there. None where it is alone, or the
    batch system has said it."""
    for names in _LAUNCHERS:
        found = [int(number.group()) for number in (re.match(r"\d+", os.environ.get(name, "")) for name in names) if number]
        if len(found) == len(names):
            _, size, local = found
            given = os.environ.get("SLURM_CPUS_PER_TASK", "")
            return None if size == 1 else int(given) if given.isdigit() else max(1, len(os.sched_getaffinity(0)) // max(local, 1))
    return None
