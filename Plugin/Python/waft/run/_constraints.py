# SPDX-License-Identifier: BSD-3-Clause
"""What came of each constraint, by all stages of a pipeline together."""
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkTable

from waft.failures import BadInput
from waft.results.writing import read_rows


def constraint_report(pipeline):
    """One dictionary a row, all texts: see vtkMotionReport."""
    from waft.vtkWaftFilters import vtkMotionReport

    planned = _table_of(pipeline.plan_report)
    name, _, _, port = pipeline.motion
    moved = planned if name == "planner" else pipeline.output(name, port)
    rows = pipeline.planned(3) if pipeline.assimilation is None else pipeline.output("assimilation", 3)
    joined = vtkTable()
    wrong = vtkMotionReport.Join(moved, planned, pipeline.output("rotation", 2), rows, joined)
    if wrong:
        raise BadInput(wrong)
    return read_rows(joined)


def _table_of(rows):
    """A vtkTable of texts, of dictionaries with the same keys."""
    table = vtkTable()
    for name in rows[0] if rows else ():
        column = vtkStringArray()
        column.SetName(name)
        for row in rows:
            column.InsertNextValue(row[name])
        table.AddColumn(column)
    return table
