// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirWhen.h"

#include "Air/Run/AirSetup.h"
#include "Air/Run/RunProgress.h"
#include "Air/Run/WhoPairs.h"
#include "Constraints/Arrivals.h"
#include "Constraints/ConstraintCheck.h"
#include "Constraints/RowsOfObjects.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

namespace waft
{
namespace
{

constexpr int FewestTried = 5;  // frames of a window, at first
constexpr int FinerSteps = 2;   // each a third of the one before
constexpr int Passes = 2;       // over the windows of an object that has several
constexpr int BesideOthers = 3; // frames from another row's, which may ask for velocities

/// A body's rows, and the best of what was tried.
struct Choice
{
  std::vector<Constraint> Rows;
  Way Best;
};

// What comes to lie touches in its window.
FrameWindow TriedOf(const AirContext& run, const MotionObject& object, const Constraint& row)
{
  const double sinking = SinkingFrames(object, run.Input.Scene.Time.FramesPerSecond);
  const int latest = IsRest(row.Kind) ? static_cast<int>(std::ceil(sinking)) : 0;
  return { row.FrameFrom + std::min(latest, (row.Frame - row.FrameFrom) / 2), row.Frame };
}

bool IsBeside(const std::vector<Constraint>& others, int frame)
{
  return std::any_of(others.begin(), others.end(),
                     [&](const Constraint& row)
                     {
                       return !IsAttitude(row.Kind) && frame >= EarliestFrame(row) - BesideOthers &&
                              frame <= LastFrame(row) + BesideOthers;
                     });
}

double FrameBefore(double frame, const std::vector<std::pair<double, double>>& from)
{
  for (std::size_t i = 0; i + 1 < from.size(); ++i)
  {
    const auto& [a, u] = from[i];
    const auto& [b, v] = from[i + 1];
    if (frame <= b)
    {
      return b > a ? u + (frame - a) / (b - a) * (v - u) : v;
    }
  }
  return from.back().second;
}

// A way that is there at one frame, at another: faster or slower from the row before to the next.
std::vector<Vec3> Retimed(const std::vector<Vec3>& path, const std::vector<Constraint>& others,
                          int was, int now)
{
  const int last = static_cast<int>(path.size()) - 1;
  int before = 0, next = last;
  for (const Constraint& row : others)
  {
    if (IsPositional(row.Kind))
    {
      before = LastFrame(row) < std::min(was, now) ? std::max(before, LastFrame(row)) : before;
      next = EarliestFrame(row) > std::max(was, now) ? std::min(next, EarliestFrame(row)) : next;
    }
  }
  const std::vector<std::pair<double, double>> times{
    { 0, 0 }, { before, before }, { now, was }, { next, next }, { last, last }
  };
  std::vector<Vec3> retimed;
  for (int f = 0; f <= last; ++f)
  {
    retimed.push_back(PlaceAt(path, FrameBefore(f, times)));
  }
  return retimed;
}

class WhenOfBody
{
public:
  WhenOfBody(const AirContext& run, const AirSampler& air, const MotionObject& object,
             const std::vector<Vec3>& plan, std::vector<Constraint> rows) :
    Run(run),
    Air(air), Object(object)
  {
    this->Found.Rows = std::move(rows);
    this->Found.Best.Path = plan;
  }

  Choice Choose()
  {
    std::vector<Constraint> open;
    std::copy_if(this->Found.Rows.begin(), this->Found.Rows.end(), std::back_inserter(open),
                 [](const Constraint& row) { return row.IsOpenWindow && IsPositional(row.Kind); });
    std::stable_sort(open.begin(), open.end(),
                     [](const Constraint& a, const Constraint& b)
                     { return a.FrameFrom < b.FrameFrom; });
    const int passes = open.size() > 1 ? Passes : 1;
    for (int pass = 0; pass < passes; ++pass)
    {
      for (const Constraint& row : open)
      {
        this->Choose(row);
      }
    }
    return std::move(this->Found);
  }

private:
  void Choose(const Constraint& row)
  {
    const std::vector<Constraint> others = OthersOf(row, this->Found.Rows);
    const std::vector<Vec3> before = std::move(this->Found.Best.Path);
    this->Found.Best = Way();
    int now = row.Frame; // as it is on the way so far
    for (const Constraint& own : this->Found.Rows)
    {
      now = IsOfTarget(row, own) ? own.Frame : now;
    }
    int best = now;
    const FrameWindow tried = TriedOf(this->Run, this->Object, row);
    std::set<int> done;
    const auto attempt = [&](int frame)
    {
      if (frame < tried.From || frame > tried.To || !done.insert(frame).second ||
          (done.size() > 1 && IsBeside(others, frame)))
      {
        return;
      }
      std::vector<Constraint> rows = this->Found.Rows;
      SetArrivals(row, frame, this->Run.Obstacles, rows);
      BodyProblem body = ProblemOf(this->Run, this->Object, before, rows);
      std::vector<std::vector<Vec3>> starts = OtherStarts(this->Air, body);
      starts.push_back(Retimed(before, others, now, frame));
      Way way = LeastDrift(this->Run, this->Air, body, FurtherIterations, std::move(starts));
      way.Cost /= body.NumberOfFlownSteps(); // lying costs nothing, and would end each flight early
      const bool isBetter = way.Passes == this->Found.Best.Passes ? way.Cost < this->Found.Best.Cost
                                                                  : this->Found.Best.Passes;
      if (done.size() == 1 || isBetter)
      {
        best = frame;
        this->Found.Best = std::move(way);
      }
    };
    const int length = tried.To - tried.From;
    const int most = std::max(FewestTried, 1 + length / this->Run.Search.Step);
    double step = static_cast<double>(length) / (most - 1);
    attempt(now);
    for (const int frame : FramesOf(this->Run, this->Object, row, others, most))
    {
      attempt(frame);
    }
    for (int k = 0; k < FinerSteps; ++k)
    {
      step /= 3.0;
      const int from = best;
      const int shift = std::max(1, static_cast<int>(std::lround(step)));
      attempt(from - shift);
      attempt(from + shift);
    }
    SetArrivals(row, best, this->Run.Obstacles, this->Found.Rows);
  }

  const AirContext& Run;
  const AirSampler& Air;
  const MotionObject& Object;
  Choice Found;
};

} // namespace

std::vector<Constraint> OthersOf(const Constraint& row, const std::vector<Constraint>& rows)
{
  std::vector<Constraint> others;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(others),
               [&](const Constraint& other) { return !IsOfTarget(row, other); });
  return others;
}

void SetArrivals(const Constraint& row, int frame, const ObstacleSet& obstacles,
                 std::vector<Constraint>& rows)
{
  for (Constraint& own : rows)
  {
    if (IsOfTarget(row, own))
    {
      SetArrival(frame, ValueAt(own, frame, obstacles), own);
    }
  }
}

std::vector<int> FramesOf(const AirContext& run, const MotionObject& object, const Constraint& row,
                          const std::vector<Constraint>& others, int most)
{
  if (!row.IsOpenWindow)
  {
    return { row.Frame };
  }
  std::vector<int> frames;
  for (int k = 0; k < most; ++k)
  {
    const int frame = FrameAt(TriedOf(run, object, row), TimeSpread::Even,
                              static_cast<double>(k) / std::max(1, most - 1));
    if (!IsBeside(others, frame) && (frames.empty() || frames.back() != frame))
    {
      frames.push_back(frame);
    }
  }
  return frames;
}

Result ChooseWhen(AirContext& run, const HalfSeries& series, AirBodies& bodies,
                  AssimilationOutput& output, int& chosen)
{
  const RowsOfObjects places(run.Rows);
  std::vector<char> isOpen(run.Input.Tracks.size(), 0);
  for (std::size_t o = 0; o < isOpen.size(); ++o)
  {
    for (const std::size_t i : places.Of(run.Input.Tracks[o].ObjectId))
    {
      if (run.Rows[i].IsOpenWindow && IsBinding(run.Rows[i], output.Report))
      {
        isOpen[o] = 1;
      }
    }
  }
  chosen = static_cast<int>(std::count(isOpen.begin(), isOpen.end(), 1));
  if (chosen == 0)
  {
    return Result::Ok();
  }
  const AirSampler air(series);
  PartMonitor monitor(run.Caller, DrawEnd, DrawEnd, "Choosing when each arrives by the air");
  run.Parallel(
    isOpen.size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t o = begin; o < end && monitor.Tick(-1.0, ""); ++o)
      {
        const BodyProblem& body = bodies.Problems[o];
        if (!isOpen[o])
        {
          continue;
        }
        std::vector<Constraint> rows;
        std::copy_if(body.Rows().begin(), body.Rows().end(), std::back_inserter(rows),
                     [](const Constraint& row) { return row.Row != OfNoRow; });
        Choice choice = WhenOfBody(run, air, body.Object(), run.Plans[o], std::move(rows)).Choose();
        for (const Constraint& row : choice.Rows)
        {
          for (const std::size_t i : places.Of(row.ObjectId))
          {
            if (IsOfTarget(row, run.Rows[i]) && run.Rows[i].IsOpenWindow && !row.IsOpenWindow)
            {
              SetArrival(row.Frame, ValueAt(run.Rows[i], row.Frame, run.Obstacles), run.Rows[i]);
            }
          }
        }
        run.Plans[o] = std::move(choice.Best.Path);
      }
    });
  if (!monitor.Tick(-1.0, ""))
  {
    return Result::Stopped();
  }
  SetHolds(run.Input.Scene.Time.NumberOfFrames - 1, run.Rows);
  return SetUpBodies(run, bodies, output);
}

Result MoveFormations(AirContext& run, const HalfSeries& series, AirBodies& bodies,
                      AssimilationOutput& output)
{
  std::map<int, const MotionObject*> objects;
  for (const MotionObject& object : run.Input.Objects)
  {
    objects[object.ObjectId] = &object;
  }
  const int last = run.Input.Scene.Time.NumberOfFrames - 1;
  struct Form
  {
    Formation Motion;
    std::vector<FormationPlace> Places;
    const Formation* Known = nullptr;
  };
  std::map<std::pair<bool, int>, Form> forms;
  for (const Constraint& row : run.Rows)
  {
    const auto object = objects.find(row.ObjectId);
    if (row.Drifts == 0 || !IsBinding(row, output.Report) || object == objects.end())
    {
      continue;
    }
    Form& form = forms[EntryOf(row)];
    std::tie(form.Motion.IsGroup, form.Motion.Number) = EntryOf(row);
    form.Motion.Begin = std::max(row.Frame, row.Until);
    form.Motion.End = std::max(form.Motion.End, FormEnd(row, last));
    form.Places.push_back(
      { row.Value, LawOf(*object->second).SettlingSpeed(), 2.0 * object->second->ClearanceRadius });
    form.Known = FindFormation(run.Formations, row);
  }
  const AirSampler air(series);
  bool isNew = false;
  std::vector<Formation> all;
  for (auto& [entry, form] : forms)
  {
    Formation& motion = form.Motion;
    const bool isKnown =
      form.Known != nullptr && form.Known->Begin == motion.Begin && form.Known->End == motion.End;
    if (!isKnown)
    {
      MoveFormation(form.Places, air, run.Obstacles, run.Input.Scene, motion);
    }
    all.push_back(isKnown ? *form.Known : std::move(motion));
    isNew = isNew || !isKnown;
  }
  run.Formations = std::move(all);
  run.IsTold = run.IsTold && !isNew;
  return isNew ? SetUpBodies(run, bodies, output) : Result::Ok();
}

} // namespace waft
