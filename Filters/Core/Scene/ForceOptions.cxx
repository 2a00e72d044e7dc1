// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ForceOptions.h"

#include "Scene/Scene.h"
#include "Scene/SceneFormat.h"

#include <algorithm>
#include <string>

namespace waft
{

Result VortexSourceOptions::Make(Vortex& vortex) const
{
  if (this->P1 == this->P2)
  {
    return Result::Error("P2: expected another place than P1");
  }
  vortex = Vortex();
  vortex.VortexId = this->VortexId;
  vortex.P1 = this->P1;
  vortex.P2 = this->P2;
  vortex.Strength = this->Strength;
  vortex.CoreRadius = this->CoreRadius;
  vortex.CenterTime = this->CenterTime;
  vortex.Duration = this->Duration;
  return Result::Ok();
}

Result WindSourceOptions::Make(Scene& scene) const
{
  const bool isFront = this->Kind == WindKind::Front;
  const Vec3& along = isFront ? this->Heading : this->Direction;
  const double length = along.stableNorm();
  if (!(length > 0.0))
  {
    return Result::Error(std::string(isFront ? "Heading" : "Direction") +
                         ": expected one, found 0, 0, 0");
  }
  if (isFront)
  {
    WindFront front;
    front.Direction = along / length;
    front.Speed = this->Speed;
    front.Strength = this->Strength;
    front.Width = this->Width;
    front.StartTime = this->StartFrame / this->FramesPerSecond;
    front.Origin = this->Origin;
    scene.Fronts = { front };
    return Result::Ok();
  }
  AnalyticWind wind;
  wind.Direction = along / length;
  wind.Strength = this->Strength;
  wind.Center = this->Center;
  wind.Radius = this->Radius;
  wind.CenterTime = this->CenterTime;
  wind.Duration = this->Duration;
  scene.Winds = { wind };
  return Result::Ok();
}

std::string AuthoredWinds(const Scene& scene)
{
  SceneJson list = SceneJson::array();
  for (const AnalyticWind& wind : scene.Winds)
  {
    list.push_back(FormatWind(wind));
  }
  for (const WindFront& front : scene.Fronts)
  {
    list.push_back(FormatFront(front, scene.Info.Time.FramesPerSecond));
  }
  return SceneJson{
    { "waft", 1 },
    { "time",
      { { "frames", std::max(scene.Info.Time.NumberOfFrames, 2) },
        { "framesPerSecond", scene.Info.Time.FramesPerSecond } } },
    { "winds", list }
  }.dump();
}

} // namespace waft
