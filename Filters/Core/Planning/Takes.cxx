// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Takes.h"

#include "Constraints/RowsOfObjects.h"
#include "Planning/InputCheck.h"
#include "Trajectory/Style.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace waft
{

namespace
{

/// The part of a take in the progress of all.
class TakeMonitor : public Monitor
{
public:
  TakeMonitor(Monitor& all, int take, int count) : All(all), Take(take), Count(count) {}
  bool Tick(double fraction, const std::string& text) override
  {
    return this->All.Tick((this->Take + fraction) / this->Count,
                          this->Count == 1 ? text
                                           : "Take " + std::to_string(this->Take) + ": " + text);
  }
  bool Publishes() const override { return this->Take == 0 && this->All.Publishes(); }

private:
  Monitor& All;
  int Take;
  int Count;
};

StyleSamples FlightStyle(const PlanOutput& plan, const Timeline& time)
{
  const auto second = static_cast<int>(std::lround(time.FramesPerSecond));
  const RowsOfObjects places(plan.Constraints);
  StyleSamples style;
  for (const Track& track : plan.Tracks)
  {
    const auto count = static_cast<int>(track.Positions.size());
    std::vector<unsigned char> isFree(track.Positions.size(), 1);
    for (const std::size_t place : places.Of(track.ObjectId))
    {
      const Constraint& row = plan.Constraints[place];
      if (IsRest(row.Kind))
      {
        const int last = std::min(count, row.Until + second + 1);
        for (int k = std::max(0, row.Frame - second); k < last; ++k)
        {
          isFree[k] = 0;
        }
      }
    }
    for (int first = 0; first < count; ++first)
    {
      int last = first;
      while (last < count && isFree[last] != 0)
      {
        ++last;
      }
      if (last > first)
      {
        AppendStyle(track.Positions, time.Step(), static_cast<std::size_t>(first),
                    static_cast<std::size_t>(last), style);
        first = last;
      }
    }
  }
  return style;
}

TakeScore ScoreOf(const PlanOutput& plan, const StyleSamples& reference, const Timeline& time)
{
  TakeScore score;
  score.NumberOfRows = static_cast<int>(plan.Report.size());
  score.NumberOfMet = static_cast<int>(
    std::count_if(plan.Report.begin(), plan.Report.end(),
                  [](const ReportRow& line) { return line.Status == ConstraintStatus::Met; }));
  StyleSamples style = FlightStyle(plan, time);
  if (!style.Acceleration.empty())
  {
    score.Curvature = KolmogorovSmirnov(reference.LogCurvature, std::move(style.LogCurvature));
    score.Acceleration = KolmogorovSmirnov(reference.Acceleration, std::move(style.Acceleration));
  }
  score.Score = score.NumberOfRows - score.NumberOfMet + score.Curvature + score.Acceleration;
  return score;
}

} // namespace

Result TakeOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(ValidateFields<TakeOptions>(*this));
  if (this->Take >= this->NumberOfTakes)
  {
    return Result::Error("planner: Take is " + std::to_string(this->Take) +
                         ", expected -1 (the best) to " + std::to_string(this->NumberOfTakes - 1));
  }
  return Result::Ok();
}

Result PlanTakes(const PlanInput& input, const PlanOptions& options, const TakeOptions& takes,
                 const ParallelFor& parallelFor, Monitor& monitor, PlanOutput& output,
                 std::vector<TakeScore>& scores, PlanCache* memory)
{
  output = PlanOutput();
  scores.clear();
  if (Result valid = takes.Validate(); !valid)
  {
    return valid;
  }
  StyleSamples reference;
  double least = 1e300;
  for (int take = 0; take < takes.NumberOfTakes; ++take)
  {
    PlanOptions own = options;
    own.Seed = options.Seed + static_cast<std::uint64_t>(take);
    TakeMonitor part(monitor, take, takes.NumberOfTakes);
    PlanOutput other;
    PlanOutput& plan = take == 0 ? output : other;
    const Result result = PlanMotion(input, own, parallelFor, part, plan, memory);
    if (!result || result.IsStopped())
    {
      return result;
    }
    if (take == 0)
    {
      const double scale = DatabaseScale(input.Database, input.Scene);
      reference = scale == 1.0 ? StyleOf(input.Database) : StyleOf(input.Database.Scaled(scale));
    }
    TakeScore score = ScoreOf(plan, reference, input.Scene.Time);
    score.Take = take;
    score.Seed = own.Seed;
    scores.push_back(score);
    // Until the one that is asked for is there the best so far stands for it.
    const bool isAskedFor = take == takes.Take;
    if (isAskedFor || ((takes.Take < 0 || take < takes.Take) && score.Score < least))
    {
      least = score.Score;
      if (take > 0)
      {
        output = std::move(other);
      }
    }
  }
  return Result::Ok();
}

} // namespace waft
