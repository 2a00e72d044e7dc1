// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Constraint.h"

#include <algorithm>
#include <array>

namespace waft
{

namespace
{

constexpr double LeastSpeed = 1e-6; // m/s: of tracks that stand still

constexpr std::array<ConstraintTraits, NumberOfConstraintKinds> Kinds{ {
  // Kind, Name, Unit, IsPositional, Lasts, Derivative, Tolerance
  { ConstraintKind::Position, "position", "m", true, false, 0, 1e-9 },
  { ConstraintKind::Velocity, "velocity", "m/s", false, false, 1, 1e-6 },
  { ConstraintKind::Acceleration, "acceleration", "m/s^2", false, false, 2, 1e-6 },
  { ConstraintKind::Orientation, "orientation", "rad", false, false, -1, 1e-6 },
  { ConstraintKind::Rest, "rest", "m", true, true, 0, 1e-9 },
} };

constexpr bool AreInOrder()
{
  for (std::size_t k = 0; k < Kinds.size(); ++k)
  {
    if (static_cast<std::size_t>(Kinds[k].Kind) != k)
    {
      return false;
    }
  }
  return true;
}
static_assert(AreInOrder(), "a line for each kind, in the order of the enumeration");

/// Of a path that begins at frame a.
std::map<int, double> VelocityStencil(int frame, const Timeline& time, int a)
{
  const int n = time.NumberOfFrames;
  const double rate = time.FramesPerSecond;
  if (n < a + 2)
  {
    return {};
  }
  if (n == a + 2)
  {
    return { { a, -rate }, { a + 1, rate } };
  }
  if (frame == a)
  {
    return { { a, -1.5 * rate }, { a + 1, 2.0 * rate }, { a + 2, -0.5 * rate } };
  }
  if (frame == n - 1)
  {
    return { { n - 1, 1.5 * rate }, { n - 2, -2.0 * rate }, { n - 3, 0.5 * rate } };
  }
  return { { frame - 1, -0.5 * rate }, { frame + 1, 0.5 * rate } };
}

} // namespace

const ConstraintTraits& TraitsOf(ConstraintKind kind)
{
  return Kinds[static_cast<std::size_t>(kind)];
}

const ConstraintTraits* FindConstraintKind(const std::string& name)
{
  const auto* found = std::find_if(Kinds.begin(), Kinds.end(),
                                   [&](const ConstraintTraits& k) { return name == k.Name; });
  return found == Kinds.end() ? nullptr : found;
}

std::map<int, double> DerivativeStencil(int derivative, int frame, const Timeline& time, int first)
{
  std::map<int, double> stencil{ { frame, 1.0 } };
  for (int order = 0; order < derivative; ++order)
  {
    std::map<int, double> next;
    for (const auto& [k, outer] : stencil)
    {
      for (const auto& [f, inner] : VelocityStencil(k, time, first))
      {
        next[f] += outer * inner;
      }
    }
    stencil = std::move(next);
  }
  return stencil;
}

void SetHolds(int lastFrame, std::vector<Constraint>& rows)
{
  std::map<std::pair<bool, int>, int> last; // arrival
  for (const Constraint& row : rows)
  {
    if (row.Hold > 0)
    {
      int& own = last[EntryOf(row)];
      own = std::max(own, row.Frame);
    }
  }
  for (Constraint& row : rows)
  {
    if (row.Hold > 0)
    {
      const int all = last[EntryOf(row)];
      const int held = std::min(all + row.Hold, lastFrame);
      row.Until = row.Drifts != 0      ? std::min(all, lastFrame)
                  : row.Goes.From >= 0 ? std::max(row.Frame, row.Goes.From)
                                       : held;
    }
  }
}

double ToleranceOf(ConstraintKind kind, const MotionScales& scales)
{
  const ConstraintTraits& traits = TraitsOf(kind);
  const double speed = std::max(scales.TopSpeed, LeastSpeed);
  switch (traits.Derivative)
  {
    case 0:
      return traits.Tolerance * scales.Width;
    case 1:
      return traits.Tolerance * speed;
    case 2:
      return traits.Tolerance * speed * scales.FramesPerSecond;
    default:
      return traits.Tolerance;
  }
}

const char* ToString(ConstraintStatus status)
{
  switch (status)
  {
    case ConstraintStatus::Met:
      return "met";
    case ConstraintStatus::Infeasible:
      return "infeasible";
    case ConstraintStatus::Conflict:
      return "conflict";
    case ConstraintStatus::Unreachable:
      return "unreachable";
  }
  return "unknown";
}

const char* ToString(FaceUp side)
{
  switch (side)
  {
    case FaceUp::Any:
      return "any";
    case FaceUp::Up:
      return "up";
    case FaceUp::Down:
      return "down";
  }
  return "unknown";
}

const FaceUp* FindFaceUp(const std::string& name)
{
  static constexpr FaceUp Sides[] = { FaceUp::Any, FaceUp::Up, FaceUp::Down };
  const auto* found = std::find_if(std::begin(Sides), std::end(Sides),
                                   [&](FaceUp side) { return name == ToString(side); });
  return found == std::end(Sides) ? nullptr : found;
}

} // namespace waft
