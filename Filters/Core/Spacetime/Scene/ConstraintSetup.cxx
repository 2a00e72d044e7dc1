// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Scene/ConstraintSetup.h"

#include "Base/SmoothStep.h"
#include "Constraints/ConstraintCheck.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace waft
{
namespace
{

// The way from the plan after a start or a rest grows as half of this times t^2 [m/s^2].
constexpr double StartReach = 1.6;

// Before a rest an object keeps to the way down that the surface leaves it, the nearer the closer:
// the last of what brakes a leaf there is finer than the gas.
double LandingReach(double before) // s; in m
{
  return 0.1 * std::pow(before, 2) + 0.3 * std::pow(before, 4);
}

// Of the volume's width: what comes down as near to each other does so alike.
constexpr double AlikeRadius = 0.1;

// Braking is not the air's way; a cost of it would have it done in no time. So the cost of slipping
// through the air fades before a rest, and comes back after it [s].
constexpr double FadeBegins = 0.8;
constexpr double FadeEnds = 0.1;

float Faded(double aside)
{
  return static_cast<float>(SmoothStep((aside - FadeEnds) / (FadeBegins - FadeEnds)));
}

void SetUpStarts(const SpacetimeInput& input, SpacetimeSetup& setup)
{
  SpacetimeModel& model = setup.Model;
  const std::size_t no = model.NumberOfObjects;
  // What starts at a given place does not leap away from it: the way from the plan grows as half
  // StartReach t^2.
  const double rate = input.Scene.Time.FramesPerSecond;
  for (int frame = 1; frame < std::min(model.NumberOfFrames, static_cast<int>(rate)); ++frame)
  {
    const double after = frame / rate;
    std::fill_n(model.Reach.begin() + static_cast<std::ptrdiff_t>(frame * no), no,
                static_cast<float>(0.5 * StartReach * after * after / setup.Spacing));
  }
}

void Fix(SpacetimeSetup& setup, int frame, std::size_t object, const Vec3& position, int flags)
{
  const std::size_t index = static_cast<std::size_t>(frame) * setup.Model.NumberOfObjects + object;
  setup.Model.Flags[index] |= static_cast<std::uint8_t>(flags | FixedPosition);
  setup.ExactPositions[index] = position;
  setup.Table.FixedPositions[index] = setup.FromWorld(position);
}

void SetUpLandings(const SpacetimeInput& input, const std::vector<int>& grounds,
                   const std::vector<Constraint>& binding, SpacetimeSetup& setup)
{
  SpacetimeModel& model = setup.Model;
  const int frames = model.NumberOfFrames;
  const double rate = input.Scene.Time.FramesPerSecond;
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    const auto flags = [&](int frame) -> std::uint8_t&
    { return model.Flags[static_cast<std::size_t>(frame) * model.NumberOfObjects + o]; };
    const auto coherence = [&](int frame) -> float& {
      return model.CoherenceFractions[static_cast<std::size_t>(frame) * model.NumberOfObjects + o];
    };
    const auto comeNear = [&](const LandingWindow& window)
    {
      const bool floor =
        std::find(grounds.begin(), grounds.end(), window.ObstacleId) != grounds.end();
      // The way to and from a frame near the surface lies within the window, too.
      for (int frame = std::max(0, static_cast<int>(std::ceil(window.First)) + 1);
           frame <= std::min(frames - 1, static_cast<int>(std::floor(window.Last)) - 1); ++frame)
      {
        flags(frame) |= floor ? LandsOnFloor : LandsOnObstacle;
        flags(frame) |= frame > window.Until ? LiftsOff : 0;
      }
    };
    setup.Landings.push_back(LandingWindows(setup.Objects[o], binding, setup.Obstacles, rate));
    setup.Exempts.push_back(setup.Landings.back());
    LandingWindow hanging;
    if (HangingWindow(setup.Objects[o], setup.Obstacles, rate, hanging))
    {
      comeNear(hanging);
      setup.Exempts.back().push_back(hanging);
    }
    for (const LandingWindow& window : setup.Landings.back())
    {
      comeNear(window);
      for (int frame = std::max(1, window.Frame - static_cast<int>(rate)); frame < window.Frame;
           ++frame)
      {
        const double before = (window.Frame - frame) / rate;
        coherence(frame) = std::min(coherence(frame), Faded(before));
        model.Reach[static_cast<std::size_t>(frame) * model.NumberOfObjects + o] =
          static_cast<float>(LandingReach(before) / setup.Spacing);
      }
      for (int frame = window.Frame; frame <= std::min(frames - 1, window.Until); ++frame)
      {
        // It arrives without speed, so it is braked over the frames before; from then on the
        // surface carries its weight. A sampled air brakes it in the step to the rest itself.
        const bool arrives = frame == window.Frame && !input.Air.IsEmpty();
        Fix(setup, frame, o, window.Centre.At(frame),
            arrives || window.Centre.IsMoving() ? 0 : FixedVelocity);
        coherence(frame) = 0.0f;
        if (frame > window.Frame)
        {
          flags(frame) |= NoDynamics;
        }
      }
      const int second = static_cast<int>(rate);
      for (int frame = window.Until + 1; frame < std::min(frames, window.Until + second); ++frame)
      {
        const double after = (frame - window.Until) / rate;
        coherence(frame) = std::min(coherence(frame), Faded(after));
        model.Reach[static_cast<std::size_t>(frame) * model.NumberOfObjects + o] =
          static_cast<float>(0.5 * StartReach * after * after / setup.Spacing);
      }
    }
  }
}

// Things that come down beside each other come down through the same air, and plans do not know of
// each other: the way that each has left in the last second is the mean of its neighbours' ways.
void SetUpApproaches(double rate, SpacetimeSetup& setup)
{
  struct Landing
  {
    std::size_t Object;
    int Frame;
    Vec3 Rest; // [dx]
  };
  SpacetimeModel& model = setup.Model;
  std::vector<Landing> landings;
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    for (const LandingWindow& window : setup.Landings[o])
    {
      landings.push_back({ o, window.Frame, setup.FromWorld(window.Centre.At(window.Frame)) });
    }
  }
  const int second = static_cast<int>(rate);
  const double radius = AlikeRadius * model.Size.head<2>().maxCoeff();
  const auto index = [&](int frame, std::size_t o)
  { return static_cast<std::size_t>(frame) * model.NumberOfObjects + o; };
  std::vector<Vec3> ways(second + 1); // by frames before the rest
  std::vector<double> weights(second + 1);
  for (const Landing& landing : landings)
  {
    std::fill(ways.begin(), ways.end(), Vec3::Zero());
    std::fill(weights.begin(), weights.end(), 0.0);
    for (const Landing& other : landings)
    {
      const double distance = (other.Rest - landing.Rest).norm();
      if (std::abs(other.Frame - landing.Frame) > second || distance > 3.0 * radius)
      {
        continue;
      }
      const double weight = std::exp(-0.5 * distance * distance / (radius * radius));
      for (int k = 1; k <= second && other.Frame - k > 0; ++k)
      {
        ways[k] +=
          weight * (setup.Table.Planned[index(other.Frame - k, other.Object)] - other.Rest);
        weights[k] += weight;
      }
    }
    for (int k = 1; k <= second && landing.Frame - k > 0; ++k)
    {
      model.Approach[index(landing.Frame - k, landing.Object)] =
        landing.Rest + ways[k] / weights[k];
    }
  }
}

// Once all that holds them is known.
void SetUpKeptDistances(double rate, SpacetimeSetup& setup)
{
  SpacetimeModel& model = setup.Model;
  std::vector<std::vector<HeldMark>> marks(model.NumberOfObjects);
  for (const PositionBall& ball : setup.Table.Balls)
  {
    marks[ball.Object].push_back({ ball.Frame, ball.Center, ball.Radius });
  }
  model.Kept = KeptDistances(rate);
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    for (int frame = 0; frame < model.NumberOfFrames; ++frame)
    {
      if (model.Flag(frame, o) & FixedPosition)
      {
        const std::size_t index = static_cast<std::size_t>(frame) * model.NumberOfObjects + o;
        marks[o].push_back({ frame, model.Approach[index], 0.0 });
      }
    }
    model.Kept.AddBody(0.5 * model.Weights.ContactDistance,
                       setup.Objects[o].SettlingSpeed / setup.Spacing, model.NumberOfFrames,
                       std::move(marks[o]));
  }
}

// What no path was found for is approached as near as the plan comes to it: its ball reaches to
// there. A rest that is not reached is a position in passing.
std::vector<Constraint> FindApproaches(const SpacetimeInput& input, const SpacetimeSetup& setup,
                                       const std::map<int, std::size_t>& index)
{
  std::set<std::pair<int, int>> missed;
  for (const ReportRow& line : setup.Report)
  {
    if (line.Status == ConstraintStatus::Unreachable)
    {
      missed.emplace(line.Row, line.Target);
    }
  }
  std::vector<Constraint> approaches;
  for (Constraint row : input.Constraints)
  {
    if (!IsPositional(row.Kind) || row.ObjectId < 0 || missed.count({ row.Row, row.Target }) == 0 ||
        row.Frame < 0 || row.Frame >= setup.Model.NumberOfFrames)
    {
      continue;
    }
    const std::size_t o = index.at(row.ObjectId);
    if (IsRest(row.Kind))
    {
      SurfaceHit hit;
      const Vec3 value = row.Value;
      (void)RestingPosition(setup.Obstacles, value, row.Frame, setup.Objects[o].RestHeight,
                            row.Value, hit);
      row.Kind = ConstraintKind::Position;
    }
    const double distance = (input.Tracks[o].Positions[row.Frame] - row.Value).norm();
    const double least = 1e-9 * input.Scene.Bounds.Width();
    row.Radius = std::max(row.Radius, distance > least ? distance : 0.0);
    approaches.push_back(row);
  }
  return approaches;
}

void AddDifference(const Constraint& row, std::size_t object, const Timeline& time,
                   SpacetimeSetup& setup)
{
  const int derivative = TraitsOf(row.Kind).Derivative;
  double scale = setup.FrameStep;
  for (int order = 1; order < derivative; ++order)
  {
    scale *= setup.FrameStep;
  }
  DifferenceRow linear;
  linear.Object = object;
  for (const auto& [frame, coefficient] : DerivativeStencil(derivative, row.Frame, time))
  {
    linear.Terms.push_back({ frame, coefficient * scale });
  }
  linear.Value = row.Value * (scale / setup.Spacing);
  linear.Radius = row.Radius * (scale / setup.Spacing);
  if (!linear.Terms.empty())
  {
    setup.Table.Rows.push_back(linear);
  }
}

} // namespace

void SetUpConstraints(const SpacetimeInput& input, const std::vector<int>& grounds,
                      SpacetimeSetup& setup)
{
  SetUpStarts(input, setup);
  setup.Report = JudgeConstraints(input.Constraints, setup.Objects, setup.Obstacles, input.Scene);
  std::map<int, std::size_t> index;
  const int last = input.Scene.Time.NumberOfFrames - 1;
  for (std::size_t o = 0; o < setup.Objects.size(); ++o)
  {
    index[setup.Objects[o].ObjectId] = o;
    const CarriedPlace start = StartPlace(setup.Objects[o], setup.Obstacles);
    for (int f = 0; f <= std::min(setup.Objects[o].Released(), last); ++f)
    {
      Fix(setup, f, o, start.At(f), 0);
    }
  }
  std::vector<Constraint> binding;
  for (const Constraint& row : input.Constraints)
  {
    if (row.ObjectId >= 0 && IsBinding(row, setup.Report))
    {
      binding.push_back(row);
    }
  }
  SetUpLandings(input, grounds, binding, setup);
  SetUpApproaches(input.Scene.Time.FramesPerSecond, setup);
  for (const Constraint& row : FindApproaches(input, setup, index))
  {
    binding.push_back(row);
  }
  for (const Constraint& row : binding)
  {
    const std::size_t o = index[row.ObjectId];
    switch (row.Kind)
    {
      case ConstraintKind::Position:
        if (row.Radius <= 0.0)
        {
          CarriedPlace place;
          (void)WantedPlace(row, 0.0, setup.Obstacles, place);
          for (int f = row.Frame; f <= std::min(LastFrame(row), last); ++f)
          {
            Fix(setup, f, o, place.At(f), 0);
          }
        }
        else
        {
          setup.Table.Balls.push_back(
            { row.Frame, o, setup.FromWorld(row.Value), row.Radius / setup.Spacing });
        }
        break;
      case ConstraintKind::Velocity:
      case ConstraintKind::Acceleration:
        AddDifference(row, o, input.Scene.Time, setup);
        break;
      case ConstraintKind::Rest:        // fixed with its landing
      case ConstraintKind::Orientation: // nothing that bodies without extent know of
        break;
    }
  }
  SetUpKeptDistances(input.Scene.Time.FramesPerSecond, setup);
}

} // namespace waft
