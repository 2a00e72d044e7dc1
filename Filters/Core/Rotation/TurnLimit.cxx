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
constexpr int MostFlights = 12;
constexpr int MostInVain = 3;
constexpr int MostNamed = 5;           // objects of which the same is said
constexpr int Ramp = 8;                // frames over which the flight slows down, and gathers speed
constexpr double LeastFraction = 0.05; // of the limit, that a flight is left
constexpr double Quickness = 0.5;      // of the limit, by which torques change turning in a frame
constexpr double Aim = 0.97;           // of the limit, for what is above it: few flights do
constexpr double Slack = 1.0 + 1e-9;   // rounding
constexpr double Unlimited = std::numeric_limits<double>::infinity();
const double Half = std::acos(-1.0); // rad, of a turn
const double Degrees = 180.0 / Half;

/// rad, from each frame to the next: as poses show it, but half a turn and more within a frame may
/// look like less. None from a frame on, after which poses are given.
std::vector<double> Turns(const AttitudeOutcome& outcome,
                          int until = std::numeric_limits<int>::max())
{
  const std::vector<Quat>& poses = outcome.Poses.Orientations;
  std::vector<double> turns;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
  {
    const double shown = LogMap(poses[k + 1] * poses[k].conjugate()).norm();
    const double turned = outcome.Swept[k] < Half ? shown : std::max(shown, outcome.Swept[k]);
    turns.push_back(static_cast<int>(k) < until ? turned : 0.0);
  }
  return turns;
}

/// rad, in all frames together.
double Excess(const std::vector<double>& turns, double most)
{
  double excess = 0.0;
  for (const double turn : turns)
  {
    excess += turn > most * Slack ? turn - most : 0.0;
  }
  return excess;
}

/// The first frame that turns by more, or -1.
long FirstBeyond(const std::vector<double>& turns, double most)
{
  const auto first =
    std::find_if(turns.begin(), turns.end(), [most](double turn) { return turn > most * Slack; });
  return first == turns.end() ? -1 : first - turns.begin();
}

/// Poses that came with the path are not kept from a little before the first frame that turns by
/// more: they were flown elsewhere, and a surface turns them. Where some are not kept in any case
/// the others are who moves the body's.
void FlyFrom(const AttitudePlan& given, const std::vector<double>& turns, double most,
             AttitudePlan& plan)
{
  if (given.TurnsFrom != std::numeric_limits<int>::max())
  {
    return;
  }
  const long first = FirstBeyond(turns, most);
  if (first >= 0)
  {
    const long from = std::max<long>(first - Ramp, 0);
    plan.TurnsFrom = std::min(plan.TurnsFrom, static_cast<int>(from));
  }
}

/// Sets the limit from a little before the first frame that turns by more, where the body turns
/// slower than that by itself; what was before stays.
void LimitFrom(const AttitudeOutcome& outcome, const std::vector<double>& turns, double most,
               FlightPath& path)
{
  const long first = FirstBeyond(turns, most);
  if (first < 0)
  {
    return;
  }
  const double fastest = most / path.Step;
  const std::vector<Vec3>& rates = outcome.Poses.AngularVelocities;
  auto frame = static_cast<std::size_t>(std::max<long>(first - Ramp, 0));
  while (frame > 0 && rates[frame].norm() > fastest)
  {
    --frame;
  }
  std::replace(path.FastestTurning.begin() + static_cast<long>(frame), path.FastestTurning.end(),
               Unlimited, fastest);
}

/// Takes from the flight what is too much, and smoothly less of it in the frames around.
void SlowAbout(const std::vector<double>& turns, double most, double step,
               std::vector<double>& fastest)
{
  const int count = static_cast<int>(fastest.size());
  std::vector<double> less(fastest.size(), 0.0);
  for (int k = 0; k < static_cast<int>(turns.size()); ++k)
  {
    const double excess = turns[k] > most * Slack ? turns[k] - Aim * most : 0.0;
    for (int i = std::max(k - Ramp, 0); excess > 0.0 && i <= std::min(k + Ramp, count - 1); ++i)
    {
      const double fraction = SmoothStep(1.0 - std::abs(i - k) / (Ramp + 1.0));
      less[i] = std::max(less[i], excess * fraction);
    }
  }
  for (int i = 0; i < count; ++i)
  {
    fastest[i] = std::max(fastest[i] - less[i] / step, LeastFraction * most / step);
  }
}

std::string Times(int count, const std::string& noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}
} // namespace

void SetLimit(double most, FlightPath& path)
{
  path.FastestTurning.assign(path.RelativeVelocities.size(), most / path.Step);
  path.QuickestChange = Unlimited;
}

AttitudeOutcome TurnObjectWithin(double most, const AttitudePlan& plan, const FlightBody& body,
                                 FlightPath path)
{
  AttitudeOutcome best = TurnObject(plan, body, path);
  AttitudePlan own = plan;
  std::vector<double> turns = Turns(best, plan.TurnsUntil);
  double least = Excess(turns, most);
  path.FastestTurning.assign(path.RelativeVelocities.size(), Unlimited);
  path.QuickestChange = Quickness * most / (path.Step * path.Step);
  LimitFrom(best, turns, most, path);
  FlyFrom(plan, turns, most, own);
  int vain = 0; // flights, one after another
  for (int flight = 0; flight < MostFlights && least > 0.0 && vain < MostInVain; ++flight)
  {
    AttitudeOutcome next = TurnObject(own, body, path);
    turns = Turns(next, plan.TurnsUntil);
    LimitFrom(next, turns, most, path);
    FlyFrom(plan, turns, most, own);
    SlowAbout(turns, most, path.Step, path.FastestTurning);
    const double excess = Excess(turns, most);
    ++vain;
    if (excess < least * (1.0 - 1e-6))
    {
      least = excess;
      best = std::move(next);
      vain = 0;
    }
  }
  return best;
}

void TurnCount::Tally::Add(int objectId, int frames, int first, int last)
{
  if (frames == 0)
  {
    return;
  }
  this->Frames += frames;
  if (++this->Objects <= MostNamed)
  {
    this->Named += (this->Objects > 1 ? ", object " : "object ") + std::to_string(objectId) + " " +
                   FramesText(first, last);
  }
}

std::string TurnCount::Tally::Text() const
{
  const int more = this->Objects - MostNamed;
  return Times(this->Objects, "object") + ", " + Times(this->Frames, "frame") + " (" + this->Named +
         (more > 0 ? " and " + std::to_string(more) + " more" : "") + ")";
}

void TurnCount::Add(const AttitudeOutcome& outcome)
{
  const int id = outcome.Poses.ObjectId;
  int slowed = 0, first = 0, last = 0;
  for (std::size_t k = 0; k < outcome.Slowed.size(); ++k)
  {
    if (outcome.Slowed[k] != 0)
    {
      last = static_cast<int>(k);
      first = slowed++ == 0 ? last : first;
    }
  }
  const double few = this->Tolerated * static_cast<double>(outcome.Slowed.size());
  this->Slowed.Add(id, slowed <= few ? 0 : slowed, first, last);
  const std::vector<double> turns = Turns(outcome);
  int fast = 0;
  for (std::size_t k = 0; k < turns.size(); ++k)
  {
    this->Greatest = std::max(this->Greatest, turns[k]);
    if (turns[k] > this->Most * Slack)
    {
      last = static_cast<int>(k) + 1; // turned since the frame before
      first = fast++ == 0 ? last : first;
    }
  }
  this->Fast.Add(id, fast, first, last);
}

std::vector<std::string> TurnCount::Warnings() const
{
  std::vector<std::string> warnings;
  const std::string most = NumberText(this->Most * Degrees, 4) + " degrees a frame";
  if (this->Slowed.Objects > 0)
  {
    warnings.push_back(this->Slowed.Text() + ": turning that frames cannot show is slowed to " +
                       most +
                       "; where that looks too calm, more frames per second, a wider body or more "
                       "time between its marks help (what turns faster is slowed to MaximumTurn)");
  }
  if (this->Fast.Objects > 0)
  {
    warnings.push_back(this->Fast.Text() +
                       ": orientations asked for, rests or surfaces turn by up to " +
                       NumberText(this->Greatest * Degrees, 4) + " degrees, more than " + most +
                       ": ask for orientations more frames apart, and for more time before a rest "
                       "(MaximumTurn)");
  }
  return warnings;
}

} // namespace waft
