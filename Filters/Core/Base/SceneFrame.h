// SPDX-License-Identifier: BSD-3-Clause
// The volume and the frames of what is made without a scene file.
#pragma once

#include "Base/OptionFields.h"
#include "Base/Types.h"

namespace waft
{

/// What the options that say where and when call it alike.
inline OptionField BoundsField()
{
  return { "Bounds", limits::Coordinate, "m",
           "The volume (xmin, xmax, ymin, ymax, zmin, zmax) in metres; z is up." };
}
inline OptionField NumberOfFramesField(int least)
{
  return { "NumberOfFrames",
           { static_cast<double>(least), limits::Frames.High },
           "",
           "Frames of the animation; frame k is at time k / FramesPerSecond." };
}
inline OptionField FramesPerSecondField()
{
  return { "FramesPerSecond", limits::FramesPerSecond, "1/s", "Frames per second." };
}
inline OptionField SeedField()
{
  return { "Seed", limits::Seed, "",
           "Seed of everything random in this stage. The same seed gives the same result, bit by "
           "bit, on any number of threads." };
}

struct SceneFrame
{
  Box Bounds;
  int NumberOfFrames = Timeline().NumberOfFrames;
  double FramesPerSecond = Timeline().FramesPerSecond;

  SceneInfo Info() const
  {
    SceneInfo info;
    info.Bounds = this->Bounds;
    info.Time = { this->NumberOfFrames, this->FramesPerSecond };
    return info;
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(BoundsField(), of.Bounds...);
    visit(NumberOfFramesField(1), of.NumberOfFrames...);
    visit(FramesPerSecondField(), of.FramesPerSecond...);
  }
};

} // namespace waft
