# SPDX-License-Identifier: BSD-3-Clause
"""What of a scene cannot be, and what will be hard, before anything is flown: `waft check`."""
import dataclasses
from typing import Any, Dict, List

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkTable

from waft import reading
from waft.failures import BadInput
from waft.run.database import check_database, settle_database


@dataclasses.dataclass(frozen=True)
class Judgement:
    """objects, constraints: how many; findings: as command.schema.json has them; lines: those that are told."""

    objects: int
    constraints: int
    findings: List[Dict[str, Any]]
    lines: List[str]

    @property
    def impossible(self) -> int:
        """How many constraints cannot be met."""
        return sum(not finding["possible"] for finding in self.findings)


def check(scene, database=None) -> Judgement:
    """Of a scene file; raises BadInput where it is malformed. It needs VTK's own package alone."""
    from waft.vtkWaftFilters import vtkSceneJudge

    reading.check_scene_file(scene)
    if database is not None:
        settle_database(database)
        check_database(database)
    table = vtkTable()
    wrong = vtkSceneJudge.JudgeFile(str(scene), str(database or ""), table)
    if wrong:
        raise BadInput(wrong)
    fields = table.GetFieldData()
    objects, constraints = (fields.GetArray(name).GetValue(0) for name in ("NumberOfObjects", "NumberOfConstraints"))
    lines = fields.GetAbstractArray("Lines")
    return Judgement(objects, constraints, list(_findings(table)), [lines.GetValue(i) for i in range(lines.GetNumberOfValues())])


def _findings(table):
    rows = table.GetRowData()
    kinds, texts = (rows.GetAbstractArray(name) for name in ("Kind", "Text"))
    possible, place, *numbers = (vtk_to_numpy(rows.GetArray(name)).tolist() if table.GetNumberOfRows() else []
                                 for name in ("Possible", "Place", "ObjectId", "Frame", "Row", "Target"))
    for i, own in enumerate(zip(*numbers)):
        yield {"possible": bool(possible[i]), "kind": kinds.GetValue(i), "text": texts.GetValue(i),
               **{name: number if number >= 0 else None for name, number in zip(("object", "frame", "row", "target"), own)},
               "place": place[i] if np.isfinite(place[i]).all() else None}
