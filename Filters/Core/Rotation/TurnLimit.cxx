// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/TurnLimit.h"

#include "Base/NumberText.h"
#include "Base/SmoothStep.h"
#include "Rotation/RigidBody.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace waft
{
namespace
{
constexpr int MostFlights = 8;
constexpr int Ramp = 8;              // frames over which the flight slows down, and gathers speed
constexpr double LeastShare = 0.05;  // of the limit, that a flight is left
constexpr double TakenBack = 1.2;    // of what is too much, so that few flights do
constexpr double Slack = 1.0 + 1e-9; // rounding
const double Half = std::acos(-1.0); // rad, of a turn
const double Degrees = 180.0 / Half;

/// rad, from each frame to the next.
std::vector<double> Turns(const std::vector<Quat>& poses)
{
  std::vector<double> turns;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
  {
    turns.push_back(LogMap(poses[k + 1] * poses[k].conjugate()).norm());
  }
  return turns;
}

double Greatest(const std::vector<double>& turns)
{
  return turns.empty() ? 0.0 : *std::max_element(turns.begin(), turns.end());
}

/// Takes from the flight what is too much, and smoothly less of it in the frames around.
void SlowAbout(const std::vector<double>& turns, double most, double step,
               std::vector<double>& fastest)
{
  const int count = static_cast<int>(fastest.size());
  std::vector<double> less(fastest.size(), 0.0);
  for (int k = 0; k < static_cast<int>(turns.size()); ++k)
  {
    const double excess = turns[k] - most;
    for (int i = std::max(k - Ramp, 0); excess > 0.0 && i <= std::min(k + Ramp, count - 1); ++i)
    {
      const double share = SmoothStep(1.0 - std::abs(i - k) / (Ramp + 1.0));
      less[i] = std::max(less[i], TakenBack * excess * share);
    }
  }
  for (int i = 0; i < count; ++i)
  {
    fastest[i] = std::max(fastest[i] - less[i] / step, LeastShare * most / step);
  }
}

std::string Times(int count, const std::string& noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}
} // namespace

AttitudeOutcome TurnObjectWithin(double most, const AttitudePlan& plan, const FlightBody& body,
                                 FlightPath path)
{
  AttitudeOutcome best = TurnObject(plan, body, path);
  std::vector<double> turns = Turns(best.Poses.Orientations);
  // Half a turn and more within a frame may look like less.
  if (Greatest(turns) <= most && Greatest(best.Swept) < Half)
  {
    return best;
  }
  path.FastestTurning.assign(path.RelativeVelocities.size(), most / path.Step);
  double least = std::numeric_limits<double>::infinity();
  for (int flight = 0; flight < MostFlights && least > most * Slack; ++flight)
  {
    AttitudeOutcome next = TurnObject(plan, body, path);
    turns = Turns(next.Poses.Orientations);
    SlowAbout(turns, most, path.Step, path.FastestTurning);
    if (Greatest(turns) < least)
    {
      least = Greatest(turns);
      best = std::move(next);
    }
  }
  return best;
}

void TurnCount::Add(const AttitudeOutcome& outcome)
{
  const auto slowed = static_cast<int>(std::count(outcome.Slowed.begin(), outcome.Slowed.end(), 1));
  this->SlowedFrames += slowed;
  this->SlowedObjects += slowed > 0;
  const std::vector<double> turns = Turns(outcome.Poses.Orientations);
  const auto fast = static_cast<int>(std::count_if(
    turns.begin(), turns.end(), [this](double turn) { return turn > this->Most * Slack; }));
  this->FastFrames += fast;
  this->FastObjects += fast > 0;
  this->Greatest = std::max(this->Greatest, waft::Greatest(turns));
}

std::vector<std::string> TurnCount::Warnings() const
{
  std::vector<std::string> warnings;
  const std::string limit =
    "MaximumTurn (" + NumberText(this->Most * Degrees, 4) + " degrees a frame)";
  if (this->SlowedFrames > 0)
  {
    warnings.push_back(Times(this->SlowedObjects, "object") + ", " +
                       Times(this->SlowedFrames, "frame") +
                       ": turning that frames cannot show is slowed to " + limit);
  }
  if (this->FastFrames > 0)
  {
    warnings.push_back(Times(this->FastObjects, "object") + ", " +
                       Times(this->FastFrames, "frame") +
                       ": rows, rests or surfaces turn by up to " +
                       NumberText(this->Greatest * Degrees, 4) + " degrees, more than " + limit);
  }
  return warnings;
}

} // namespace waft
