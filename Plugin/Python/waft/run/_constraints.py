# SPDX-License-Identifier: BSD-3-Clause
"""What came of each constraint, by all stages of a pipeline together."""
from waft.results.writing import read_rows


def constraint_report(pipeline):
    """The report of the stage that moves the objects, with the reasons of the planner and the orientation rows as they were turned."""
    report = pipeline.moved_report()
    turned = {(row["Row"], row["Target"]): row for row in read_rows(pipeline.output("rotation", 2))}
    reasons = {(row["Row"], row["Target"]): row["Message"] for row in pipeline.plan_report if row["Status"] != "met"}
    for row in report:
        reason = reasons.get((row["Row"], row["Target"]))
        if reason is not None:  # the plan's, with how near the result comes
            row["Message"] = "; ".join(_sentences(reason, False) + _sentences(row["Message"], True))
        measured = turned.get((row["Row"], row["Target"]))
        if measured is not None and row["Kind"] == "orientation" and row["Status"] == "met":
            row.update((name, measured[name]) for name in ("Residual", "Status", "Message"))
        elif measured is not None and row["Status"] == "met" != measured["Status"]:  # it is there, but faces otherwise
            row.update((name, measured[name]) for name in ("Status", "Message"))
    _add_rests(pipeline, report)
    return report


def _add_rests(pipeline, report):
    """When each rest touches its surface, is still, and lifts off; -1 of other rows, and where no stage says."""
    names = ("TouchDown", "LiftOff")
    frames = {}
    begun = {(row["Row"], row["Target"]): row for row in read_rows(pipeline.output("rotation", 2)) if row["Settled"] != "-1"}
    if pipeline.assimilation is not None:
        rows = pipeline.output("assimilation", 3).GetPointData()
        columns = [rows.GetArray(name) for name in ("Row", "Target", *names)]
        for i in range(columns[0].GetNumberOfTuples()):
            row, target, *found = (column.GetValue(i) for column in columns)
            frames[row, target] = found
    for line in report:
        found = frames.get((int(line["Row"]), int(line["Target"])), (-1, -1))
        line.update(zip(names, map(str, found)), Settled="-1")
        posed = begun.get((line["Row"], line["Target"]))
        if posed is not None and line["Kind"] == "rest":
            line.update((name, posed[name]) for name in ("TouchDown", "Settled"))


def _sentences(message, are_approaches):
    return [text for text in message.split("; ") if text.startswith("it comes within ") == are_approaches]
