// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ForceOptions.h"

#include "Scene/SceneFormat.h"

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

Result WindSourceOptions::Make(AnalyticWind& wind) const
{
  const double length = this->Direction.stableNorm();
  if (!(length > 0.0))
  {
    return Result::Error("Direction: expected one, found 0, 0, 0");
  }
  wind.Direction = this->Direction / length;
  wind.Strength = this->Strength;
  wind.Center = this->Center;
  wind.Radius = this->Radius;
  wind.CenterTime = this->CenterTime;
  wind.Duration = this->Duration;
  return Result::Ok();
}

std::string AuthoredWind(const AnalyticWind& wind)
{
  const SceneJson scene = { { "waft", 1 }, { "winds", SceneJson::array({ FormatWind(wind) }) } };
  return scene.dump();
}

} // namespace waft
