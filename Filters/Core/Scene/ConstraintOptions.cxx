// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ConstraintOptions.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace waft
{

namespace
{

int OrLast(int frame, int last)
{
  return frame < 0 ? last : frame;
}

} // namespace

Result ConstraintOptions::CheckFrames(int count) const
{
  const int last = this->NumberOfFrames - 1;
  const int lastFrame = OrLast(this->LastFrame, last);
  if (this->UseWaypoints && count == 0)
  {
    return Result::Error("Waypoints: expected at least one, since UseWaypoints is on");
  }
  if (this->Frame > last || (count > 1 && lastFrame > last))
  {
    return Result::Error("Frame or LastFrame: expected at most " + std::to_string(last) +
                         ", the last of NumberOfFrames");
  }
  if (count > 1 && lastFrame - this->Frame < count - 1)
  {
    return Result::Error("LastFrame: expected at least " + std::to_string(this->Frame + count - 1) +
                         ", a frame for each of " + std::to_string(count) + " waypoints");
  }
  return Result::Ok();
}

Result ConstraintOptions::TakeTimes(const ConstraintTraits& kind, Constraint& row) const
{
  if (this->FrameFrom >= 0 && (!kind.IsPositional || this->FrameFrom >= this->Frame))
  {
    return Result::Error("FrameFrom: expected a frame before Frame, of a position or rest");
  }
  if (this->Hold > 0 && (kind.Kind != ConstraintKind::Position || this->Radius > 0.0))
  {
    return Result::Error("Hold: expected 0 but for a position without Radius");
  }
  row.FrameFrom = this->FrameFrom;
  row.IsOpenWindow = this->FrameFrom >= 0;
  row.Hold = this->Hold;
  row.Drifts = this->Drift && this->Hold > 0 ? 1 : 0;
  row.On = kind.IsPositional ? this->On : -1;
  return Result::Ok();
}

Result ConstraintOptions::MakeRows(std::vector<Constraint>& rows) const
{
  const int count = this->UseWaypoints ? static_cast<int>(this->Waypoints.size()) : 0;
  WAFT_RETURN_IF_FAILED(this->CheckFrames(count));
  const ConstraintTraits& kind = TraitsOf(this->Kind);
  if (count > 0 && !kind.IsPositional)
  {
    return Result::Error("Kind: expected position or rest, since there are waypoints");
  }
  const int last = this->NumberOfFrames - 1;
  Constraint row;
  row.Kind = kind.Kind;
  row.ObjectId = this->ObjectId;
  row.Frame = this->Frame;
  row.Until = kind.Lasts ? OrLast(this->Until, last) : this->Frame;
  row.Value = this->Value;
  const std::array<double, 4>& q = this->Orientation;
  row.Orientation = Quat(q[0], q[1], q[2], q[3]);
  row.Radius = this->Radius;
  row.Row = -1;
  WAFT_RETURN_IF_FAILED(this->TakeTimes(kind, row));
  this->AskOf(row);
  if (IsAttitude(kind.Kind) && !(row.Orientation.norm() > 0.0))
  {
    return Result::Error("Orientation: expected a quaternion that is not zero");
  }
  rows.assign(static_cast<std::size_t>(std::max(1, count)), row);
  for (int k = 0; k < count; ++k)
  {
    Constraint& own = rows[static_cast<std::size_t>(k)];
    own.Value = Vec3(this->Waypoints[static_cast<std::size_t>(k)].data());
    const double fraction = count > 1 ? static_cast<double>(k) / (count - 1) : 0.0;
    own.Frame =
      this->Frame +
      static_cast<int>(std::lround(fraction * (OrLast(this->LastFrame, last) - this->Frame)));
    own.Until = waft::LastFrame(own);
  }
  SetHolds(last, rows);
  return Result::Ok();
}

} // namespace waft
