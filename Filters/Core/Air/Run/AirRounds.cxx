// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirRounds.h"

#include "Constraints/ConstraintCheck.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double LargeControl = 0.3; // of the flow, that is warned of
constexpr std::size_t MostWarnings = 10;

/// " (its mark at frame 30)", " (its 4 marks at frames 30 to 60)": those that somebody asked for.
std::string MarksText(const std::vector<Constraint>& rows)
{
  int count = 0, first = 0, last = 0;
  for (const Constraint& row : rows)
  {
    if (row.Row != OfNoRow)
    {
      first = count == 0 ? row.Frame : std::min(first, row.Frame);
      last = count == 0 ? row.Frame : std::max(last, row.Frame);
      ++count;
    }
  }
  const std::string marks = count == 1 ? "its mark" : "its " + std::to_string(count) + " marks";
  return count == 0 ? "" : " (" + marks + " " + FramesText(first, last) + ")";
}

// Of squares of the wind correction, over the steps of free flight.
double WindAlong(const BodyProblem& body, const WindCorrection& correction, const AirSampler& air,
                 const std::vector<Vec3>& path)
{
  const DriftProblem problem = body.In(air);
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < path.size(); ++k)
  {
    if (IsFreeStep(problem, path, static_cast<int>(k)))
    {
      const Vec3 middle = 0.5 * (path[k] + path[k + 1]);
      sum += correction.At(middle, static_cast<double>(k) + 0.5).squaredNorm();
    }
  }
  return sum;
}

} // namespace

std::vector<ResidualControl> ResidualControlsOf(const AirContext& run, const AirBodies& bodies,
                                                const HalfSeries& series)
{
  const AirSampler air(series);
  std::vector<ResidualControl> residuals(bodies.Size());
  run.Parallel(residuals.size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   residuals[o] = ResidualControlOf(bodies.Problems[o], air, bodies.Paths[o]);
                 }
               });
  return residuals;
}

AssimilationRound RoundOf(const AirContext& run, const AirState& state, const std::string& stage,
                          const WindCorrection* correction)
{
  const AirBodies& bodies = state.Bodies;
  const AirSampler air(state.Sampled.Velocity);
  const std::size_t count = bodies.Size();
  const std::vector<ResidualControl> residuals =
    ResidualControlsOf(run, bodies, state.Sampled.Velocity);
  std::vector<double> winds(count, 0.0);
  run.Parallel(correction ? count : 0,
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   winds[o] = WindAlong(bodies.Problems[o], *correction, air, bodies.Paths[o]);
                 }
               });
  ResidualControl all;
  double wind = 0.0;
  std::vector<double> byObject;
  for (std::size_t o = 0; o < count; ++o)
  {
    all.Control += residuals[o].Control;
    all.Flow += residuals[o].Flow;
    all.Steps += residuals[o].Steps;
    wind += winds[o];
    byObject.push_back(residuals[o].Rms(residuals[o].Control));
  }
  std::sort(byObject.begin(), byObject.end());
  AssimilationRound row;
  row.Stage = stage;
  row.Candidate = state.Candidate;
  row.Control = all.Rms(all.Control);
  row.MedianControl = byObject[byObject.size() / 2];
  row.Flow = all.Rms(all.Flow);
  row.Wind = all.Rms(wind);
  row.Seconds = run.Seconds();
  return row;
}

void WarnOfLargeControls(const AirContext& run, const AirBodies& bodies, const HalfSeries& air,
                         double flow, std::vector<std::string>& warnings)
{
  const std::vector<ResidualControl> residuals = ResidualControlsOf(run, bodies, air);
  const std::string advice = bodies.IsOld.empty()
                               ? "give it more time between its marks, or marks that are nearer"
                               : "this air is kept as it is; flown from the start it is "
                                 "corrected for it";
  std::size_t warned = 0;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    const ResidualControl& residual = residuals[o];
    const double part = flow > 0.0 ? residual.Rms(residual.Control) / flow : 0.0;
    if (part <= LargeControl || ++warned > MostWarnings)
    {
      continue;
    }
    warnings.push_back("object " + std::to_string(bodies.Problems[o].Object().ObjectId) +
                       MarksText(bodies.Problems[o].Rows()) +
                       ": the air does not take it there: what moves it besides is " +
                       std::to_string(std::lround(100.0 * part)) +
                       " % of the flow's velocity: " + advice);
  }
  if (warned > MostWarnings)
  {
    warnings.push_back("and " + std::to_string(warned - MostWarnings) +
                       " more objects that the air does not take to their marks");
  }
}

} // namespace waft
