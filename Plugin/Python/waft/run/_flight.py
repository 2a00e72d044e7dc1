# SPDX-License-Identifier: BSD-3-Clause
"""What there is of a flight once it is flown: for those who write its files, and to fly it by another seed."""
import dataclasses
import pathlib
import tempfile
from typing import Any, List, Optional, Sequence

from waft import failures
from waft.run.engine import Engine
from waft.run.request import Request


def _of_engine(name: str) -> Any:
    """An attribute that is the engine's."""
    return property(lambda self: getattr(self.pipeline, name))


def _stage(name: str) -> Any:
    return property(lambda self: self.pipeline.stage(name))


@dataclasses.dataclass
class Flight:
    """The engine, and what came of it."""

    pipeline: Engine
    stopped: bool  # somebody stopped it, or its time was over: the best so far
    hurries: bool  # somebody stopped it, and waits
    series: List[str]  # of data that were asked for, a file a frame
    seed: int
    quality: str
    edit_of: Optional[pathlib.Path]  # the file with the air that was kept
    keep: Sequence[str]  # what is written in full
    key: str  # of the run, for checkpoints
    request: Request  # what was asked for
    scene_folder: "Optional[tempfile.TemporaryDirectory[str]]" = None  # with the file of a scene that was made here

    scene_file, database_file, watches, report = map(_of_engine, ("scene_file", "database_file", "watches", "report"))
    plan_objects, motion, has_air, warnings, stopped_in = map(
        _of_engine, ("plan_objects", "motion", "has_air", "warnings", "stopped_in"))
    reader, database, planner, assimilation, spacetime, rotation, fit = map(
        _stage, ("reader", "database", "planner", "assimilation", "spacetime", "rotation", "fit"))

    def output(self, name: str, port: int = 0) -> Any:
        """The data object of an output port of a stage, on this side."""
        return self.pipeline.output(name, port)

    @property
    def status(self) -> int:
        """Exit status of the command."""
        if self.stopped:
            return failures.STOPPED_EARLY
        return failures.ALL_MET if all(row["Status"] == "met" for row in self.report) else failures.NOT_ALL_MET
