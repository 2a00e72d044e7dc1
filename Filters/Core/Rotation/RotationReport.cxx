// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/RotationReport.h"

#include "Base/NumberText.h"
#include "Constraints/ConstraintCheck.h"

#include <algorithm>
#include <cmath>
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
namespace
{
/// What of the other rows keeps a body from facing where a row wants it; empty: none does.
std::string InTheWay(const Constraint& row, const std::vector<Constraint>& rows)
{
  for (const Constraint& other : rows)
  {
    if (other.ObjectId != row.ObjectId || other.Status != ConstraintStatus::Met)
    {
      continue;
    }
    if (IsAttitude(other.Kind) && other.Frame == row.Frame)
    {
      return "the orientation of row " + std::to_string(other.Row) + " at this frame";
    }
    if (IsRest(other.Kind) && row.Frame >= FirstFrame(other) && row.Frame <= LastFrame(other))
    {
      return "the rest of row " + std::to_string(other.Row);
    }
  }
  return {};
}
} // namespace

void ReportFacings(const RotationInput& input,
                   const std::map<std::pair<int, int>, std::string>& tooFast,
                   RotationOutput& output)
{
  constexpr double Rounding = 1e-6; // rad
  std::map<int, const PoseTrack*> found;
  for (const PoseTrack& own : output.Poses)
  {
    found[own.ObjectId] = &own;
  }
  for (const Constraint& row : input.Constraints)
  {
    const auto own = found.find(row.ObjectId);
    if (row.Facing.isZero() || !IsPassing(row.Kind) || own == found.end() || row.Frame < 0 ||
        row.Frame >= static_cast<int>(own->second->Orientations.size()))
    {
      continue;
    }
    const Vec3 axis =
      own->second->Orientations[static_cast<std::size_t>(row.Frame)] * Vec3::UnitZ();
    const double angle = std::atan2(axis.cross(row.Facing).norm(), axis.dot(row.Facing));
    ReportRow line;
    line.Row = row.Row;
    line.Target = row.Target;
    line.ObjectId = row.ObjectId;
    line.Frame = row.Frame;
    line.Kind = row.Kind;
    line.Residual = std::max(0.0, angle - row.FacingTolerance);
    if (line.Residual > Rounding)
    {
      const std::string other = InTheWay(row, input.Constraints);
      const auto fast = tooFast.find({ row.Row, row.Target });
      line.Status = other.empty() ? ConstraintStatus::Unreachable : ConstraintStatus::Conflict;
      line.Message = "row " + std::to_string(row.Row) + ": it faces " + NumberText(angle, 3) +
                     " rad off its `facing`, expected at most " +
                     NumberText(row.FacingTolerance, 3);
      line.Message += !other.empty()          ? ", as " + other + " turns it"
                      : fast != tooFast.end() ? "; " + fast->second
                                              : ", as a surface turns it";
      output.Warnings.push_back("object " + std::to_string(row.ObjectId) + ": " + line.Message);
    }
    output.Report.push_back(line);
  }
}

void TakeRestTimes(const std::vector<RestTimes>& rests, Constraint& row)
{
  for (const RestTimes& rest : rests)
  {
    if (row.Row == rest.Row && row.Target == rest.Target && IsRest(row.Kind))
    {
      row.TouchDown = rest.TouchDown;
      row.Settled = rest.Settled;
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
