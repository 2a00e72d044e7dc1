# SPDX-License-Identifier: BSD-3-Clause
"""What there is of a flight once it is flown: for those who write its files, and to fly it by another seed."""
import dataclasses
import tempfile
from typing import Any, List, Optional

from waft import failures
from waft.run.engine import Engine
from waft.run.request import Request


def _of_engine(name: str) -> Any:
    """An attribute that is the engine's."""
    return property(lambda self: getattr(self.pipeline, name))


def _told(name: str) -> Any:
    return property(lambda self: self.pipeline.told[name])


def _stage(name: str) -> Any:
    return property(lambda self: self.pipeline.stage(name))


@dataclasses.dataclass
class Flight:
    """The engine, what was asked of it, and what came of that."""

    pipeline: Engine
    request: Request
    scene_folder: "Optional[tempfile.TemporaryDirectory[str]]" = None  # with the file of a scene that was made here

    scene_file, database_file, watches, report, warnings, motion, seed = map(
        _of_engine, ("scene_file", "database_file", "watches", "report", "warnings", "motion", "seed"))
    stopped, stopped_in, left_out, has_air, key = map(_told, ("isStopped", "stoppedIn", "leftOut", "hasAir", "key"))
    reader, database, planner, assimilation, spacetime, rotation, fit = map(
        _stage, ("reader", "database", "planner", "assimilation", "spacetime", "rotation", "fit"))

    @property
    def quality(self) -> str:
        return self.pipeline.told.get("quality", self.request.way)

    @property
    def series(self) -> List[str]:
        """Of data that were asked for, a file a frame."""
        return self.request.series

    def output(self, name: str, port: int = 0) -> Any:
        """The data object of an output port of a stage, on this side."""
        return self.pipeline.output(name, port)

    @property
    def status(self) -> int:
        """Exit status of the command."""
        if self.stopped:
            return failures.STOPPED_EARLY
        return failures.ALL_MET if all(row["Status"] == "met" for row in self.report) else failures.NOT_ALL_MET
