// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirLoop.h"

#include "Base/SmoothStep.h"
#include "Constraints/LoopRows.h"
#include "Rotation/PoseRates.h"
#include "Rotation/RigidBody.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace waft
{
namespace
{

constexpr double BlendTime = 3.0;    // s, of a volume of 4 m
constexpr double LongestBlend = 0.5; // of the period
constexpr double BendTime = 1.0;     // s
constexpr double TurnTime = 0.8;     // s, in which a body turns into another one's start
constexpr std::size_t MostNamed = 10;

double MeanSquare(const HalfSeries::Field& field)
{
  double sum = 0.0;
  for (const std::array<float, 3>& u : field)
  {
    sum += static_cast<double>(u[0]) * u[0] + static_cast<double>(u[1]) * u[1] +
           static_cast<double>(u[2]) * u[2];
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, field.size()));
}

// a and b by shares of theirs.
void Mix(double ofA, HalfSeries::Field& a, double ofB, const HalfSeries::Field& b)
{
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      a[i][c] = static_cast<float>(ofA * a[i][c] + ofB * b[i][c]);
    }
  }
}

// change(k): of each of some fields.
template <class Change>
void EachField(std::size_t count, const ParallelFor& parallel, const Change& change)
{
  parallel(count,
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t k = begin; k < end; ++k)
             {
               change(k);
             }
           });
}

// By object the one as which it goes on.
std::map<int, int> LoopsTo(int loopRow, const std::vector<Constraint>& rows)
{
  std::map<int, int> to;
  for (const Constraint& row : rows)
  {
    if (row.Row == loopRow)
    {
      to[row.ObjectId] = row.Target;
    }
  }
  return to;
}

// A body's last frames, to the pose, the turning and the slip with which another one begins.
void TurnInto(const PoseTrack& start, int frames, double step, PoseTrack& poses)
{
  const auto last = static_cast<int>(poses.Orientations.size()) - 1;
  const Vec3 turn = LogMap(start.Orientations.front() * poses.Orientations.back().conjugate());
  const Vec3 faster =
    start.AngularVelocities.front() - ExpMap(turn) * poses.AngularVelocities.back();
  std::vector<unsigned char> changed(poses.Orientations.size(), 0);
  for (int k = last; k > std::max(last - frames, 0); --k)
  {
    const auto at = static_cast<std::size_t>(k);
    const double t = 1.0 - static_cast<double>(last - k) / frames;
    const double share = CubicStep(t);
    const double gained = t * t * (t - 1.0) * frames * step; // 0 at the end, with a slope of 1
    poses.Orientations[at] =
      (ExpMap(share * turn + gained * faster) * poses.Orientations[at]).normalized();
    changed[at] = k < last ? 1 : 0;
    if (!poses.Slips.empty() && !start.Slips.empty())
    {
      poses.Slips[at] += share * (start.Slips.front() - poses.Slips[at]);
    }
  }
  JoinSigns(poses.Orientations);
  SetRatesWhereTurned(changed, step, poses);
  poses.AngularVelocities.back() = start.AngularVelocities.front();
}

} // namespace

Result Unroll(const AssimilationInput& input, AssimilationInput& unrolled)
{
  unrolled = input;
  const int frames = input.Scene.Time.NumberOfFrames;
  ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(obstacles.Build(input.Obstacles));
  WAFT_RETURN_IF_FAILED(
    CloseLoop(input.Scene, input.Objects, obstacles, unrolled.Constraints, unrolled.LoopRow));
  unrolled.Scene.Time.NumberOfFrames = frames + 1;
  const int beyond = FramesBeyond(unrolled.Scene, frames);
  for (Track& track : unrolled.Tracks)
  {
    track.Positions.push_back(track.Positions.back());
  }
  for (ObstacleMesh& obstacle : unrolled.Obstacles)
  {
    for (int k = 0; obstacle.IsMoving() && k <= beyond; ++k)
    {
      obstacle.Offsets.push_back(obstacle.Offsets[static_cast<std::size_t>(k)]);
    }
  }
  FieldSeries& wind = unrolled.Wind;
  const double period = input.Scene.Time.Time(frames);
  for (std::size_t k = 0; k < input.Wind.Values.size(); ++k)
  {
    const double time = input.Wind.Times[k] + period;
    if (time > wind.Times.back() && time <= unrolled.Scene.Time.Time(frames + beyond))
    {
      wind.Times.push_back(time);
      wind.Values.push_back(input.Wind.Values[k]);
    }
  }
  if (input.PlanAround)
  {
    unrolled.PlanAround = [frames, plan = input.PlanAround](
                            const std::vector<MotionObject>& objects, std::vector<Constraint> rows)
    {
      rows.erase(std::remove_if(rows.begin(), rows.end(),
                                [frames](const Constraint& row) { return row.Frame >= frames; }),
                 rows.end());
      std::vector<std::vector<Vec3>> plans = plan(objects, rows);
      for (std::vector<Vec3>& one : plans)
      {
        one.resize(one.empty() ? 0 : one.size() + 1, one.empty() ? Vec3::Zero() : one.back());
      }
      return plans;
    };
  }
  return Result::Ok();
}

SolidsOn Unrolled(const SolidsOn& solids, int frames)
{
  if (!solids)
  {
    return solids;
  }
  return [solids, frames](const SmokeOptions& smoke) -> SolidsAtFrame
  {
    const SolidsAtFrame at = solids(smoke);
    return [at, frames](int frame, std::vector<float>& distances,
                        std::vector<std::array<float, 3>>& velocities)
    { return at(frame % frames, distances, velocities); };
  };
}

void RollUp(const AssimilationInput& unrolled, AssimilationOutput& output)
{
  const int loopRow = unrolled.LoopRow;
  const int frames = unrolled.Scene.Time.NumberOfFrames - 1;
  const auto shorten = [frames](auto& values)
  {
    if (values.size() > static_cast<std::size_t>(frames))
    {
      values.resize(static_cast<std::size_t>(frames));
    }
  };
  const auto isClosing = [loopRow](const auto& row) { return row.Row == loopRow; };
  std::map<int, int> loopsTo = LoopsTo(loopRow, output.Constraints);
  std::size_t open = 0;
  for (const ReportRow& line : output.Report)
  {
    if (isClosing(line) && line.Status != ConstraintStatus::Met)
    {
      loopsTo.erase(line.ObjectId);
      if (++open <= MostNamed)
      {
        output.Warnings.push_back("the scene loops, and object " + std::to_string(line.ObjectId) +
                                  " does not go on as object " + std::to_string(line.Target) +
                                  ": " + line.Message);
      }
    }
  }
  if (open > MostNamed)
  {
    output.Warnings.push_back("and " + std::to_string(open - MostNamed) +
                              " more objects that do not go on as others");
  }
  for (Track& track : output.Tracks)
  {
    const auto to = loopsTo.find(track.ObjectId);
    track.LoopTo = to != loopsTo.end() ? to->second : -1;
    track.Leave = track.Leave >= frames ? -1 : track.Leave;
    shorten(track.Positions);
    shorten(track.AirVelocities);
    shorten(track.Slips);
    shorten(track.Orientations);
    shorten(track.AngularVelocities);
  }
  std::for_each(output.Controls.begin(), output.Controls.end(), shorten);
  std::for_each(output.Free.begin(), output.Free.end(), shorten);
  auto& rows = output.Constraints;
  rows.erase(std::remove_if(rows.begin(), rows.end(), isClosing), rows.end());
  for (Constraint& row : rows)
  {
    row.Until = std::min(row.Until, frames - 1);
    row.LiftOff = std::min(row.LiftOff, frames - 1);
  }
  output.Report.erase(std::remove_if(output.Report.begin(), output.Report.end(), isClosing),
                      output.Report.end());
}

int FramesBeyond(const SceneInfo& unrolled, int frames)
{
  const double blend =
    BlendTime * TimeScaleOf(unrolled.Bounds.Width()) * unrolled.Time.FramesPerSecond;
  return unrolled.Loops != 0 ? static_cast<int>(std::lround(std::min(blend, LongestBlend * frames)))
                             : 0;
}

void JoinEnds(int frames, const ParallelFor& parallel, HalfSeries& air)
{
  const auto period = static_cast<std::size_t>(frames);
  const std::size_t beyond = air.Values.size() - period - 1;
  EachField(beyond, parallel,
            [&](std::size_t k)
            {
              HalfSeries::Field field = air.At(k);
              const HalfSeries::Field later = air.At(period + k);
              const double share = CubicStep(static_cast<double>(k) / static_cast<double>(beyond));
              const double wanted =
                share * std::sqrt(MeanSquare(field)) + (1.0 - share) * std::sqrt(MeanSquare(later));
              Mix(share, field, 1.0 - share, later);
              const double found = std::sqrt(MeanSquare(field));
              Mix(found > 0.0 ? wanted / found : 1.0, field, 0.0, later);
              air.Set(k, field);
            });
  air.Times.resize(period + 1);
  air.Values.resize(period + 1);
  air.Values.back() = air.Values.front();
}

void BendEnds(double framesPerSecond, const ParallelFor& parallel, HalfSeries& air)
{
  const std::size_t last = air.Values.size() - 1;
  const std::size_t frames =
    std::min(last, static_cast<std::size_t>(std::lround(BendTime * framesPerSecond)));
  HalfSeries::Field lacking = air.At(0);
  Mix(1.0, lacking, -1.0, air.At(last));
  EachField(frames, parallel,
            [&](std::size_t k)
            {
              HalfSeries::Field field = air.At(last - k);
              Mix(1.0, field,
                  SmoothStep(1.0 - static_cast<double>(k) / static_cast<double>(frames)), lacking);
              air.Set(last - k, field);
            });
  air.Values.back() = air.Values.front();
}

void TurnIntoStarts(const AirContext& run, AirBodies& bodies)
{
  if (run.Input.Scene.Loops == 0 || bodies.Poses.size() != bodies.Size())
  {
    return;
  }
  std::map<int, const PoseTrack*> starts;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    starts[bodies.Problems[o].Object().ObjectId] = &bodies.Poses[o];
  }
  const double rate = run.Input.Scene.Time.FramesPerSecond;
  const int last = run.Input.Scene.Time.NumberOfFrames - 1;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    const std::vector<Constraint>& rows = bodies.Problems[o].Rows();
    const bool lies = std::any_of(rows.begin(), rows.end(),
                                  [last](const Constraint& row)
                                  { return IsRest(row.Kind) && LastFrame(row) >= last; });
    const std::map<int, int> to = LoopsTo(run.Input.LoopRow, rows);
    const auto start = to.empty() ? starts.end() : starts.find(to.begin()->second);
    if (!bodies.IsKept(o) && !lies && start != starts.end())
    {
      TurnInto(*start->second, static_cast<int>(std::lround(TurnTime * rate)), 1.0 / rate,
               bodies.Poses[o]);
      bodies.Problems[o].SetSlips(bodies.Poses[o].Slips);
    }
  }
}

} // namespace waft
