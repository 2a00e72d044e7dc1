# SPDX-License-Identifier: BSD-3-Clause
"""Several MPI processes that are one run of the command: the first does it, and the others work for it where work can be divided.

A launcher (mpiexec, srun) starts the command in each process. Those of a command that has nothing to divide end at once, but the
first, which is then alone; else each becomes ParaView's pvbatch, whose processes know each other.
"""
import dataclasses
import os
import pathlib
import re
import sys
from typing import Optional, Sequence

DIVIDED = ("synthesize", "database")  # commands

# By launcher: this process' number, how many there are, how many on this machine.
_LAUNCHERS = (("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE"),
              ("PMIX_RANK", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_TASKS_PER_NODE"))
_OF_LAUNCHERS = re.compile(r"(OMPI|PMIX|PMI|ORTE|PRTE)_.*")


@dataclasses.dataclass(frozen=True)
class Launch:
    """One of several processes that were started together."""

    rank: int
    size: int
    local: int  # of them on this machine
    is_bound: bool  # to some of its cores, by the launcher's habit and nobody's wish

    @property
    def is_first(self) -> bool:
        return self.rank == 0


def launch() -> Optional[Launch]:
    """Of this process; None where it is alone."""
    for names in _LAUNCHERS:
        found = [int(number.group()) for number in (re.match(r"\d+", os.environ.get(name, "")) for name in names) if number]
        if len(found) == len(names):
            rank, size, local = found
            return Launch(rank, size, max(local, 1), names is _LAUNCHERS[0]) if size > 1 else None
    return None


def threads_here() -> Optional[int]:
    """How many threads this process has by default: its machine's cores over the processes there. None where it is alone, or the
    batch system has said it."""
    launched = launch()
    if launched is None:
        return None
    given = os.environ.get("SLURM_CPUS_PER_TASK", "")
    return int(given) if given.isdigit() else max(1, len(os.sched_getaffinity(0)) // launched.local)


def leave_launcher() -> None:
    """This process is alone from here on, and so are its children."""
    for name in filter(_OF_LAUNCHERS.fullmatch, list(os.environ)):
        del os.environ[name]


def become_pvbatch(launched: Launch, arguments: Sequence[str], environment: dict) -> None:
    """Runs `waft` with these arguments in the place of this process, whose number MPI knows."""
    if launched.is_bound:
        os.sched_setaffinity(0, range(os.cpu_count() or 1))
    given = os.memfd_create("waft")
    os.write(given, b"\0".join(map(os.fsencode, arguments)))
    os.set_inheritable(given, True)
    waits = {"OMPI_MCA_mpi_yield_when_idle": os.environ.get("OMPI_MCA_mpi_yield_when_idle", "1")}  # for the threads of others
    main = pathlib.Path(__file__).resolve().parent / "__main__.py"
    sys.stdout.flush()
    sys.stderr.flush()
    os.execvpe("pvbatch", ["pvbatch", "--symmetric", str(main)], {**environment, **waits, "WAFT_ARGUMENTS": str(given)})


class _Team:
    controller = None  # of the processes that work for this one


def lead(controller) -> None:
    """The other processes of a controller serve this one from here on (cli/serving.py)."""
    _Team.controller = controller


def share(algorithm) -> None:
    """Has the processes of this run divide the work of a stage."""
    if _Team.controller is not None:
        algorithm.SetController(_Team.controller)
