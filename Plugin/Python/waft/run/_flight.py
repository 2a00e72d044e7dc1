# SPDX-License-Identifier: BSD-3-Clause
"""What there is of a flight once it is flown: for those who write its files, and to fly it by another seed."""
import dataclasses
import pathlib
import tempfile
from typing import Any, Dict, List, Optional, Sequence

from waft import failures
from waft.run.pipeline import Pipeline
from waft.run.request import Request


def _of_pipeline(name: str) -> Any:
    """An attribute that is the pipeline's."""
    return property(lambda self: getattr(self.pipeline, name))


@dataclasses.dataclass
class Flight:
    """The pipeline, and what came of it."""

    pipeline: Pipeline
    report: List[Dict[str, Any]]  # the constraints, a dictionary each
    warnings: List[str]
    stopped: bool  # somebody stopped it, or its time was over: the best so far
    hurries: bool  # somebody stopped it, and waits
    stopped_in: str  # the stage
    series: List[str]  # of data that were asked for, a file a frame
    seed: int
    quality: str
    edit_of: Optional[pathlib.Path]  # the file with the air that was kept
    keep: Sequence[str]  # what is written in full
    key: str  # of the run, for checkpoints
    request: Request  # what was asked for
    scene_folder: "Optional[tempfile.TemporaryDirectory[str]]" = None  # with the file of a scene that was made here

    scene_file, database_file, watches = map(_of_pipeline, ("scene_file", "database_file", "watches"))
    reader, database, planner = map(_of_pipeline, ("reader", "database", "planner"))
    assimilation, spacetime, rotation, fit = map(_of_pipeline, ("assimilation", "spacetime", "rotation", "fit"))
    plan_report, plan_objects, planned = map(_of_pipeline, ("plan_report", "plan_objects", "planned"))
    motion, moved, has_air = map(_of_pipeline, ("motion", "moved", "has_air"))

    def output(self, name: str, port: int = 0) -> Any:
        """The data object of an output port of a stage, on this side."""
        return self.pipeline.output(name, port)

    @property
    def status(self) -> int:
        """Exit status of the command."""
        if self.stopped:
            return failures.STOPPED_EARLY
        return failures.ALL_MET if all(row["Status"] == "met" for row in self.report) else failures.NOT_ALL_MET
