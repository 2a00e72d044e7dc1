// SPDX-License-Identifier: BSD-3-Clause
// What rows ask of an object's path, and how it comes to that exactly.
#include "Air/Drift/BodyProblem.h"

#include "Constraints/IntoBalls.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{
constexpr double LeavingSpeed = 1.0; // m/s, of who goes out
constexpr double LeavingDelay = 0.5; // s, in which the air takes it up
constexpr double WideBall = 20.0;    // sizes of the volume
} // namespace

void BodyProblem::AddRows()
{
  for (const Constraint& row : this->Wanted)
  {
    this->AddLeaving(row);
    switch (row.Kind)
    {
      case ConstraintKind::Position:
        if (row.Radius <= 0.0)
        {
          CarriedPlace place;
          (void)WantedPlace(row, 0.0, this->World.Obstacles, place);
          const int last = std::min(LastFrame(row), this->NumberOfFrames() - 1);
          for (int frame = row.Frame; frame <= last; ++frame)
          {
            this->Passed.emplace_back(frame, place.At(frame));
          }
          if (row.Hold > 0 && (row.Drifts == 0 || last > row.Frame))
          {
            this->Stays.push_back({ row.Frame, last, place });
          }
          this->AddFormation(row);
        }
        else
        {
          this->Balls.push_back({ row.Frame, 0, row.Value, row.Radius });
          this->DriftRows.push_back({ { { row.Frame, 1.0 } }, row.Value, row.Radius });
        }
        break;
      case ConstraintKind::Velocity:
      case ConstraintKind::Acceleration:
        this->AddDifference(row);
        break;
      case ConstraintKind::Rest:        // fixed with its landing
      case ConstraintKind::Orientation: // the path does not know of it
        break;
    }
  }
}

void BodyProblem::AddDifference(const Constraint& row)
{
  const Timeline& time = this->World.Scene.Time;
  const int derivative = TraitsOf(row.Kind).Derivative;
  // As lengths for what is exact; as they are for the search.
  const double scale = std::pow(time.Step(), derivative);
  DifferenceRow exact;
  DriftRow sought;
  for (const auto& [frame, coefficient] :
       DerivativeStencil(derivative, row.Frame, time, this->Body.FirstPresent()))
  {
    exact.Terms.push_back({ frame, coefficient * scale });
    sought.Terms.emplace_back(frame, coefficient * std::pow(time.Step(), derivative - 1));
  }
  exact.Value = scale * row.Value;
  exact.Radius = scale * row.Radius;
  sought.Value = std::pow(time.Step(), derivative - 1) * row.Value;
  sought.Radius = std::pow(time.Step(), derivative - 1) * row.Radius;
  if (!exact.Terms.empty())
  {
    this->Differences.push_back(exact);
    this->DriftRows.push_back(sought);
  }
}

// Near its place in the form until that ends, or half a second before another row.
void BodyProblem::AddFormation(const Constraint& row)
{
  const bool drifts = row.Drifts != 0 && this->World.Formations != nullptr;
  const Formation* form = drifts ? FindFormation(*this->World.Formations, row) : nullptr;
  if (form == nullptr)
  {
    return;
  }
  int end = std::min(form->End, FormEnd(row, this->NumberOfFrames() - 1));
  const auto before = static_cast<int>(0.5 * this->World.Scene.Time.FramesPerSecond);
  for (const Constraint& other : this->Wanted)
  {
    end = other.Frame > row.Frame && IsPositional(other.Kind) ? std::min(end, other.Frame - before)
                                                              : end;
  }
  const double radius = row.HoldRadius > 0.0 ? row.HoldRadius : 2.0 * this->Body.ClearanceRadius;
  for (int frame = form->Begin + 1; frame <= end; ++frame)
  {
    const Vec3 place = form->At(row.Value, frame);
    this->Balls.push_back({ frame, 0, place, radius });
    this->DriftRows.push_back({ { { frame, 1.0 } }, place, radius });
  }
}

// At a place in time, or beyond the side, in a ball so wide that it is as good as all that is
// there.
void BodyProblem::AddLeaving(const Constraint& row)
{
  if (row.Goes.From < 0 || !row.Goes.IsUnderway())
  {
    return;
  }
  const SceneInfo& scene = this->World.Scene;
  const bool hasPlace = row.Goes.HasPlace != 0;
  const double way =
    hasPlace ? (row.Goes.Place - row.Value).norm()
             : scene.Bounds.WayOut(row.Value, row.Goes.Away) + 2.0 * this->Body.ClearanceRadius;
  const double seconds = way / LeavingSpeed + LeavingDelay;
  const auto frame =
    row.Goes.From + static_cast<int>(std::lround(seconds * scene.Time.FramesPerSecond));
  this->AtPlace = hasPlace ? frame : -1;
  if (frame < this->NumberOfFrames() && hasPlace)
  {
    this->DriftRows.push_back({ { { frame, 1.0 } }, row.Goes.Place, this->Body.ClearanceRadius });
  }
  else if (frame < this->NumberOfFrames())
  {
    const double wide = WideBall * scene.Bounds.Size().maxCoeff();
    this->DriftRows.push_back(
      { { { frame, 1.0 } }, row.Value + (way + wide) * row.Goes.Away, wide });
  }
}

std::vector<HeldMark> BodyProblem::HeldMarks() const
{
  std::vector<HeldMark> marks;
  for (const PositionBall& ball : this->Balls)
  {
    marks.push_back({ ball.Frame, ball.Center, ball.Radius });
  }
  for (int frame = 0; frame < this->NumberOfFrames(); ++frame)
  {
    if (const Vec3* place = this->HeldAt(frame))
    {
      marks.push_back({ frame, *place, 0.0 });
    }
  }
  return marks;
}

bool BodyProblem::HoldToBalls(const std::vector<Vec3>& path, DriftProblem& problem) const
{
  bool misses = false;
  for (const PositionBall& ball : this->Balls)
  {
    const auto f = static_cast<std::size_t>(ball.Frame);
    const Vec3 held = NearestOf(ball, problem.IsFixed[f] ? problem.Fixed[f] : path[f]);
    if (!this->IsFixed[f] && held != path[f])
    {
      problem.IsFixed[f] = 1;
      problem.Fixed[f] = held;
      misses = true;
    }
  }
  return misses;
}

void BodyProblem::MeetRows(std::vector<Vec3>& path) const
{
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    path[f] = this->IsFixed[f] ? this->Fixed[f] : path[f];
  }
  this->CloseBarrierGaps(path);
  MoveIntoBalls(
    this->Balls, [this](std::size_t frame) { return this->IsFixed[frame] != 0; },
    this->World.Scene.Time.Step(), [this](std::vector<Vec3>& x) { this->CloseBarrierGaps(x); },
    path);
  const FixedAt fixedAt = [this](int frame, std::size_t) { return this->HeldAt(frame); };
  for (const LinearCluster& cluster :
       MakeClusters(this->Differences, this->Balls, fixedAt, std::vector<bool>(path.size(), true)))
  {
    Eigen::MatrixX3d positions(static_cast<Eigen::Index>(cluster.Frames().size()), 3);
    Eigen::Index row = 0;
    for (const int f : cluster.Frames())
    {
      positions.row(row++) = path[static_cast<std::size_t>(f)].transpose();
    }
    cluster.Project(positions);
    row = 0;
    for (const int f : cluster.Frames())
    {
      path[static_cast<std::size_t>(f)] = positions.row(row++).transpose();
    }
  }
}

} // namespace waft
