// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/RotationReport.h"

#include "Constraints/ConstraintCheck.h"

#include <set>

namespace waft
{

void ReportOrientations(const RotationInput& input,
                        const std::map<std::pair<int, int>, std::string>& tooFast,
                        RotationOutput& output)
{
  std::vector<Constraint> rows;
  std::set<std::pair<int, int>> reported;
  for (const Constraint& row : input.Constraints)
  {
    if (IsAttitude(row.Kind))
    {
      rows.push_back(row);
      if (row.Status != ConstraintStatus::Met)
      {
        reported.insert({ row.Row, row.Target });
      }
    }
  }
  const ObstacleSet none;
  output.Report =
    JudgeConstraints(rows, input.Objects, input.Obstacles ? *input.Obstacles : none, input.Scene);
  MeasureOrientationResiduals(rows, output.Poses, output.Report);
  for (ReportRow& line : output.Report)
  {
    const std::pair<int, int> key(line.Row, line.Target);
    const auto reason = tooFast.find(key);
    if (line.Status == ConstraintStatus::Unreachable && reason != tooFast.end())
    {
      line.Message += "; " + reason->second;
    }
    if (line.Status != ConstraintStatus::Met && reported.count(key) == 0)
    {
      output.Warnings.push_back("object " + std::to_string(line.ObjectId) + ": " + line.Message);
    }
  }
}
void TakeRestTimes(int objectId, const std::vector<RestTimes>& rests, RotationOutput& output)
{
  for (const RestTimes& rest : rests)
  {
    for (Constraint& row : output.Constraints)
    {
      if (row.ObjectId == objectId && row.Row == rest.Row && row.Target == rest.Target &&
          IsRest(row.Kind))
      {
        row.TouchDown = rest.TouchDown;
        row.Settled = rest.Settled;
      }
    }
  }
}

void ReportRests(RotationOutput& output)
{
  for (const Constraint& row : output.Constraints)
  {
    if (IsRest(row.Kind) && row.Settled >= 0)
    {
      ReportRow line;
      line.Row = row.Row;
      line.Target = row.Target;
      line.ObjectId = row.ObjectId;
      line.Frame = row.Frame;
      line.Kind = row.Kind;
      line.TouchDown = row.TouchDown;
      line.Settled = row.Settled;
      output.Report.push_back(line);
    }
  }
}

} // namespace waft
