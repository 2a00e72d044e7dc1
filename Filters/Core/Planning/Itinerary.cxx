// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Itinerary.h"

#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <map>

namespace waft
{

namespace
{

class ItineraryMaker
{
public:
  ItineraryMaker(const MotionObject& object, const ObstacleSet& obstacles, const SceneInfo& scene) :
    Object(object), Obstacles(obstacles), Scene(scene)
  {
    this->Marks[0].Position = object.Position;
    this->Marks[0].Place = StartPlace(object, obstacles);
    this->Marks[0].Until = object.Released();
    this->Marks[0].Halts = object.Hangs();
  }

  /// landing: where it lies then.
  void AddRest(const Constraint& row, int index, const LandingWindow& landing)
  {
    Mark mark;
    mark.Frame = row.Frame;
    mark.Until = std::clamp(row.Until, row.Frame, this->Scene.Time.NumberOfFrames - 1);
    mark.IsRest = true;
    mark.Constraint = index;
    mark.Place = landing.Centre;
    mark.Position = row.Frame == 0 ? this->Object.Position : landing.Centre.Place;
    this->Result.Landings.push_back(landing);
    this->Marks[mark.Frame] = mark;
  }

  void AddHanging(const LandingWindow& window) { this->Result.Landings.push_back(window); }

  /// After all rests.
  void AddPosition(const Constraint& row, int index)
  {
    const auto known = this->Marks.find(row.Frame);
    const bool isKnown =
      known != this->Marks.end() && (known->second.IsRest || known->second.Radius <= row.Radius);
    if (row.Frame == 0 || isKnown)
    {
      return;
    }
    const Mark& before = std::prev(this->Marks.upper_bound(row.Frame))->second;
    if ((before.IsRest || before.Halts) && before.Until >= row.Frame)
    {
      return;
    }
    Mark mark;
    mark.Frame = row.Frame;
    mark.Until = std::min(LastFrame(row), this->Scene.Time.NumberOfFrames - 1);
    mark.Halts = mark.Until > mark.Frame;
    (void)WantedPlace(row, 0.0, this->Obstacles, mark.Place);
    mark.Position = row.Value;
    mark.Radius = row.Radius;
    mark.Constraint = index;
    this->Marks[row.Frame] = mark;
  }

  /// A velocity or an acceleration; after all positions.
  void AddDerivative(const Constraint& row)
  {
    if (this->Scene.Time.NumberOfFrames < 2)
    {
      return; // one frame has no motion
    }
    const double step = this->Scene.Time.Step();
    const int derivative = TraitsOf(row.Kind).Derivative;
    Vec3 value = row.Value;
    double radius = row.Radius;
    for (int order = 0; order < derivative; ++order)
    {
      value *= step;
      radius *= step;
    }
    this->AddRow(derivative, row.Frame, value, radius);
    const auto mark = this->Marks.find(row.Frame);
    if (derivative == 1 && mark != this->Marks.end() && !mark->second.IsRest)
    {
      mark->second.HasVelocity = true;
      mark->second.Velocity = value;
      mark->second.Halts = row.Value.norm() < PlannerNumbers::HaltingSpeed;
    }
    this->StartsAsAsked = this->StartsAsAsked || (derivative == 1 && row.Frame == 0);
  }

  Itinerary Finish()
  {
    Mark& first = this->Marks.begin()->second;
    if (!this->StartsAsAsked && !first.IsRest && this->Object.Velocity.norm() > 0.0 &&
        this->Scene.Time.NumberOfFrames > 1)
    {
      first.HasVelocity = true;
      first.Halts = false;
      first.Velocity = this->Object.Velocity * this->Scene.Time.Step();
      // At a release of the next step: central differences have the still one before in them.
      this->AddRow(1, first.Until, (first.Until > 0 ? 0.5 : 1.0) * first.Velocity, 0.0);
    }
    for (auto& [frame, mark] : this->Marks)
    {
      mark.Frame = frame;
      mark.Until = std::max(mark.Until, frame);
      this->Result.Marks.push_back(mark);
    }
    return std::move(this->Result);
  }

private:
  /// A derivative as a row on positions; value and radius in m a frame (a frame squared).
  void AddRow(int derivative, int frame, const Vec3& value, double radius)
  {
    const Timeline frames{ this->Scene.Time.NumberOfFrames, 1.0 };
    MotionRow row;
    for (const auto& [k, weight] : DerivativeStencil(derivative, frame, frames))
    {
      row.Row.Frames.push_back(k);
      row.Row.Weights.push_back(weight);
    }
    row.Row.Value = value;
    row.Radius = radius;
    this->Result.Rows.push_back(row);
  }

  const MotionObject& Object;
  const ObstacleSet& Obstacles;
  const SceneInfo& Scene;
  std::map<int, Mark> Marks;  // by frame
  bool StartsAsAsked = false; // a row says how fast
  Itinerary Result;
};

} // namespace

void Itinerary::Follow(const std::vector<Vec3>& points, double radius, const SceneInfo& scene)
{
  this->Way = GuideWay(points);
  const int last = scene.Time.NumberOfFrames - 1;
  if (this->Marks.back().Until < last && scene.Bounds.InnerDistance(this->Way.End()) > 0.0)
  {
    Mark end;
    end.Frame = end.Until = last;
    end.Position = this->Way.End();
    end.Radius = radius;
    this->Marks.push_back(end);
  }
}

Itinerary MakeItinerary(const MotionObject& object, const std::vector<Constraint>& rows,
                        const std::vector<std::size_t>& places,
                        const std::vector<unsigned char>& isUsed, const ObstacleSet& obstacles,
                        const SceneInfo& scene)
{
  std::vector<Constraint> own;
  std::vector<std::size_t> rests, positions, derivatives; // of rows
  for (const std::size_t i : places)
  {
    if (isUsed[i] == 0)
    {
      continue;
    }
    own.push_back(rows[i]);
    switch (rows[i].Kind)
    {
      case ConstraintKind::Rest:
        rests.push_back(i);
        break;
      case ConstraintKind::Position:
        positions.push_back(i);
        break;
      case ConstraintKind::Velocity:
      case ConstraintKind::Acceleration:
        derivatives.push_back(i);
        break;
      case ConstraintKind::Orientation:
        break; // the path does not know of it
    }
  }
  const std::vector<LandingWindow> windows =
    LandingWindows(object, own, obstacles, scene.Time.FramesPerSecond);
  ItineraryMaker maker(object, obstacles, scene);
  LandingWindow hanging;
  if (HangingWindow(object, obstacles, scene.Time.FramesPerSecond, hanging))
  {
    maker.AddHanging(hanging);
  }
  for (const std::size_t i : rests)
  {
    for (const LandingWindow& window : windows)
    {
      if (window.Row == rows[i].Row && window.Target == rows[i].Target &&
          window.Frame == rows[i].Frame)
      {
        maker.AddRest(rows[i], static_cast<int>(i), window);
        break;
      }
    }
  }
  for (const std::size_t i : positions)
  {
    maker.AddPosition(rows[i], static_cast<int>(i));
  }
  for (const std::size_t i : derivatives)
  {
    maker.AddDerivative(rows[i]);
  }
  return maker.Finish();
}

} // namespace waft
