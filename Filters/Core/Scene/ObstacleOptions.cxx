// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ObstacleOptions.h"

#include "Base/Primitives.h"
#include "Scene/Scene.h"
#include "Scene/SceneFormat.h"

#include <utility>

namespace waft
{

Result ObstacleSourceOptions::Make(std::vector<ObstacleMesh>& obstacles) const
{
  obstacles.clear();
  const auto add = [&](TriangleMesh mesh)
  {
    ObstacleMesh obstacle;
    obstacle.ObstacleId = static_cast<int>(obstacles.size());
    obstacle.Mesh = std::move(mesh);
    obstacles.push_back(std::move(obstacle));
  };
  switch (this->Kind)
  {
    case ObstacleKind::None:
      break;
    case ObstacleKind::Box:
      if (!(this->Size.minCoeff() > 0.0))
      {
        return Result::Error("Size: expected extents above 0");
      }
      add(MakeBox({ this->Corner, this->Corner + this->Size }));
      break;
    case ObstacleKind::Sphere:
      add(MakeSphere(this->Center, this->Radius));
      break;
    case ObstacleKind::Cylinder:
      if (this->Base == this->Top)
      {
        return Result::Error("Top: expected another place than Base");
      }
      add(MakeCylinder(this->Base, this->Top, this->Radius));
      break;
  }
  if (this->Ground)
  {
    add(MakeGround(this->Bounds, this->GroundHeight));
  }
  return obstacles.empty() ? Result::Error("Kind: expected an obstacle, or Ground on")
                           : Result::Ok();
}

std::string ObstacleSourceOptions::Authored() const
{
  SceneJson scene = { { "waft", 1 } };
  scene["ground"] = { { "enabled", this->Ground } };
  if (this->Ground)
  {
    scene["ground"]["height"] = this->GroundHeight;
  }
  switch (this->Kind)
  {
    case ObstacleKind::None:
      break;
    case ObstacleKind::Box:
      scene["obstacles"] =
        SceneJson::array({ { { "kind", "box" },
                             { "min", FormatVector(this->Corner) },
                             { "max", FormatVector(this->Corner + this->Size) } } });
      break;
    case ObstacleKind::Sphere:
      scene["obstacles"] = SceneJson::array({ { { "kind", "sphere" },
                                                { "center", FormatVector(this->Center) },
                                                { "radius", this->Radius } } });
      break;
    case ObstacleKind::Cylinder:
      scene["obstacles"] = SceneJson::array({ { { "kind", "cylinder" },
                                                { "base", FormatVector(this->Base) },
                                                { "top", FormatVector(this->Top) },
                                                { "radius", this->Radius } } });
      break;
  }
  return scene.dump();
}

} // namespace waft
