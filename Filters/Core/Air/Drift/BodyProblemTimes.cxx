// SPDX-License-Identifier: BSD-3-Clause
// When an object touches down and lifts off, and its paths brought to such frames.
#include "Air/Drift/BodyProblem.h"

#include <algorithm>
#include <cmath>

namespace waft
{
Vec3 PlaceAt(const std::vector<Vec3>& path, double frame)
{
  const auto low = static_cast<std::size_t>(frame);
  const std::size_t high = std::min(low + 1, path.size() - 1);
  return path[low] + (frame - static_cast<double>(low)) * (path[high] - path[low]);
}

void BodyProblem::FixFrames()
{
  const std::size_t frames = this->Planned.size();
  this->IsFixed.assign(frames, 0);
  this->Fixed.assign(frames, Vec3::Zero());
  const auto fix = [&](int frame, const Vec3& x)
  {
    this->IsFixed[static_cast<std::size_t>(frame)] = 1;
    this->Fixed[static_cast<std::size_t>(frame)] = x;
  };
  const CarriedPlace start = StartPlace(this->Body, this->World.Obstacles);
  for (int f = 0; f <= std::min(this->Body.Released(), static_cast<int>(frames) - 1); ++f)
  {
    fix(f, start.At(f));
  }
  const int last = static_cast<int>(frames) - 1;
  for (const LandingWindow& landing : this->Landings)
  {
    for (int f = std::max(0, landing.Frame); f <= std::min(last, landing.Until); ++f)
    {
      fix(f, landing.Centre.At(f));
    }
  }
  for (const auto& [frame, place] : this->Passed)
  {
    fix(frame, place);
  }
  this->Space = FlightRoom(this->World.Scene, this->FreeFrom());
  this->Exempts = this->Hanging;
  this->Exempts.insert(this->Exempts.end(), this->Landings.begin(), this->Landings.end());
}

int BodyProblem::EarliestTouchDown(std::size_t landing, int most) const
{
  // Not before another mark, and with some way to go from there.
  int earliest = this->Latest[landing] - (this->IsTimed(landing) ? 0 : most);
  for (int f = this->Latest[landing] - 1; f >= std::max(0, earliest); --f)
  {
    if (this->IsFixed[static_cast<std::size_t>(f)] && f < this->Landings[landing].Frame)
    {
      earliest = f + static_cast<int>(this->World.Scene.Time.FramesPerSecond);
      break;
    }
  }
  return std::clamp(earliest, 0, this->Latest[landing]);
}

double BodyProblem::NearFrom(std::size_t landing) const
{
  const double second = this->World.Scene.Time.FramesPerSecond;
  return this->Landings[landing].Frame -
         (this->IsTimed(landing) ? SinkingFrames(this->Body, second) : second);
}

void BodyProblem::SetTouchDown(std::size_t landing, int frame)
{
  LandingWindow& window = this->Landings[landing];
  this->RestOf(window).TouchDown = frame;
  window.Frame = frame;
  window.First = this->NearFrom(landing);
  this->FixFrames();
}

int BodyProblem::LatestLiftOff(std::size_t landing, int most) const
{
  // Most of the way to the next mark, or to the end, is flown.
  const int frames = this->NumberOfFrames();
  int next = this->LiftOff(landing) + 1;
  while (next < frames && !this->IsFixed[static_cast<std::size_t>(next)])
  {
    ++next;
  }
  const int leaving = this->Leaving[landing];
  const int later = this->IsTimed(landing) ? 0 : std::min(most, (next - leaving) / 3);
  return std::max(leaving, leaving + later);
}

void BodyProblem::SetLiftOff(std::size_t landing, int frame)
{
  LandingWindow& window = this->Landings[landing];
  this->RestOf(window).LiftOff = frame;
  window.Until = frame;
  window.Last = frame + this->World.Scene.Time.FramesPerSecond;
  this->FixFrames();
}

int BodyProblem::FreeFrom() const
{
  const int second = static_cast<int>(std::lround(this->World.Scene.Time.FramesPerSecond));
  int first = 1 + this->Body.Released();
  for (const Constraint& row : this->Wanted)
  {
    if (row.Row != OfNoRow || !IsRest(row.Kind)) // it lies by itself
    {
      const int last = row.Drifts != 0 ? FormEnd(row, this->NumberOfFrames() - 1) : LastFrame(row);
      first = std::max(first, last + (IsRest(row.Kind) ? second : 1));
    }
  }
  return first;
}

const Constraint* BodyProblem::LeavingRow() const
{
  const auto found = std::find_if(this->Wanted.begin(), this->Wanted.end(),
                                  [](const Constraint& row) { return row.Goes.From >= 0; });
  return found != this->Wanted.end() ? &*found : nullptr;
}

int BodyProblem::GoneFrom(const std::vector<Vec3>& path) const
{
  const Constraint* leaving = this->LeavingRow();
  if (leaving != nullptr && (leaving->Goes.HasPlace != 0 || leaving->Goes.Away.isZero()))
  {
    const int there = leaving->Goes.HasPlace != 0 ? this->AtPlace : leaving->Goes.From;
    const int gone = std::max(this->FreeFrom(), there + leaving->Goes.Fade);
    return gone < this->NumberOfFrames() ? gone : -1;
  }
  const int last = this->World.Scene.IsOpen() ? this->NumberOfFrames() - 1 : -1;
  for (int f = this->Space.OpenFrom; f <= last; ++f)
  {
    const Vec3& x = path[static_cast<std::size_t>(f)];
    if (this->World.Scene.Bounds.InnerDistance(x) < -this->Body.ClearanceRadius)
    {
      return f;
    }
  }
  return -1;
}

void BodyProblem::LandFreely(int frame, const Vec3& place)
{
  Constraint rest;
  rest.ObjectId = this->Body.ObjectId;
  rest.Kind = ConstraintKind::Rest;
  rest.Frame = rest.TouchDown = frame;
  rest.Until = this->NumberOfFrames() - 1;
  rest.Value = place + Vec3(0.0, 0.0, this->Body.ClearanceRadius);
  rest.Row = rest.Target = OfNoRow;
  this->LandFreely(rest);
}

void BodyProblem::LandFreely(const Constraint& landing)
{
  Constraint rest = landing;
  rest.TouchDown = rest.Frame;
  const std::vector<LandingWindow> windows = LandingWindows(
    this->Body, { rest }, this->World.Obstacles, this->World.Scene.Time.FramesPerSecond);
  if (windows.empty())
  {
    return;
  }
  this->Wanted.push_back(rest);
  this->Landings.push_back(windows.front());
  this->Latest.push_back(rest.Frame);
  this->Leaving.push_back(rest.Until);
  this->Timed.push_back(0);
  this->FixFrames();
}

const Constraint* BodyProblem::FreeLanding() const
{
  const bool has =
    !this->Wanted.empty() && IsRest(this->Wanted.back().Kind) && this->Wanted.back().Row == OfNoRow;
  return has ? &this->Wanted.back() : nullptr;
}

int BodyProblem::NumberOfFlownSteps() const
{
  const int last = this->NumberOfFrames() - 1;
  int flown = last;
  for (const LandingWindow& landing : this->Landings)
  {
    flown -= std::max(0, std::min(landing.Until, last) - std::max(landing.Frame, 0));
  }
  return std::max(flown, 1);
}

Constraint& BodyProblem::RestOf(const LandingWindow& landing)
{
  return *std::find_if(this->Wanted.begin(), this->Wanted.end(),
                       [&](const Constraint& row) {
                         return row.Row == landing.Row && row.Target == landing.Target &&
                                IsRest(row.Kind);
                       });
}

std::vector<Vec3> BodyProblem::Retimed(const std::vector<Vec3>& path, std::size_t landing,
                                       int touchDown) const
{
  // From the mark before on it goes faster, to be there earlier.
  const int early = this->Landings[landing].Frame;
  int from = 0;
  for (const int mark : this->Marks())
  {
    from = mark < early ? mark : from;
  }
  std::vector<Vec3> retimed = path;
  for (int f = from; f <= touchDown && early > from; ++f)
  {
    const double s = std::min<double>(
      touchDown, from + (f - from) * static_cast<double>(touchDown - from) / (early - from));
    retimed[static_cast<std::size_t>(f)] = PlaceAt(path, s);
  }
  return retimed;
}

std::vector<Vec3> BodyProblem::Delayed(const std::vector<Vec3>& path, std::size_t landing,
                                       int liftOff) const
{
  // To the mark after it goes faster; without one all is later.
  const int late = this->Landings[landing].Until;
  const int last = this->NumberOfFrames() - 1;
  int to = last + late - liftOff;
  for (const int mark : this->Marks())
  {
    if (mark > late)
    {
      to = mark;
      break;
    }
  }
  std::vector<Vec3> delayed = path;
  for (int f = liftOff; f <= std::min(to, last) && late < to; ++f)
  {
    const double s =
      liftOff + std::max(0, f - late) * static_cast<double>(to - liftOff) / (to - late);
    delayed[static_cast<std::size_t>(f)] = PlaceAt(path, s);
  }
  return delayed;
}

std::vector<Vec3> BodyProblem::RetimedPlan() const
{
  std::vector<Vec3> planned = this->Planned;
  for (std::size_t l = 0; l < this->Landings.size(); ++l)
  {
    planned = this->Delayed(this->Retimed(planned, l, this->Latest[l]), l, this->Leaving[l]);
  }
  return planned;
}

} // namespace waft
