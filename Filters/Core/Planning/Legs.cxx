// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Legs.h"

#include "Constraints/Rest.h"
#include "Planning/Blending.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace waft
{

Stop StopOf(const Constraint& row, double restHeight, const ObstacleSet& obstacles)
{
  Stop stop;
  stop.First = row.Frame;
  stop.Last = LastFrame(row);
  stop.Value = row.Value;
  CarriedPlace place;
  stop.Position = WantedPlace(row, restHeight, obstacles, place) ? place.Place : row.Value;
  stop.Leaves = place.On != nullptr ? place.At(stop.Last) : stop.Position;
  stop.Radius = RadiusOf(row);
  stop.IsRest = IsRest(row.Kind);
  return stop;
}

Stop StartOf(const MotionObject& object, const ObstacleSet& obstacles)
{
  Stop start;
  start.Value = start.Position = object.Position;
  start.Last = object.Released();
  start.Leaves = StartPlace(object, obstacles).At(start.Last);
  return start;
}

SpeedLimit::SpeedLimit(double topStep, double framesPerSecond, int shortestSpan, double tolerance) :
  TopStep(topStep), Second(static_cast<int>(std::lround(framesPerSecond))),
  ShortestSpan(shortestSpan), Tolerance(tolerance)
{
}

double SpeedLimit::Reach(int frames, bool launches, bool brakes) const
{
  const bool isDrawn = frames < this->ShortestSpan;
  const SpanClock clock =
    SpanClock::Of(frames, launches && !isDrawn, brakes && !isDrawn, this->Second);
  return this->TopStep * clock.FlightFrames();
}

double SpeedLimit::Haste(const Stop& from, const Stop& to) const
{
  const double way = (to.Position - from.Leaves).norm() - from.Radius - to.Radius;
  const int frames = to.First - from.Last;
  if (way <= this->Tolerance)
  {
    return 0.0;
  }
  return frames > 0 ? way / this->Reach(frames, from.IsRest, to.IsRest)
                    : std::numeric_limits<double>::infinity();
}

} // namespace waft
