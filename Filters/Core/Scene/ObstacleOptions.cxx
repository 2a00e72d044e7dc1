// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ObstacleOptions.h"

#include "Scene/Scene.h"
#include "Scene/SceneFormat.h"
#include "Scene/Solids.h"

#include <utility>

namespace waft
{

namespace
{

const SolidKind& KindOf(const ObstacleSourceOptions& options)
{
  return SolidKinds()[static_cast<std::size_t>(options.Kind) - 1];
}

} // namespace

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
  if (this->Kind != ObstacleKind::None)
  {
    const SolidKind& kind = KindOf(*this);
    const PlainSolid solid = kind.Made(*this);
    if (!kind.HasVolume(solid))
    {
      return Result::Error(kind.ExpectedOfOption);
    }
    add(kind.Mesh(solid));
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
  if (this->Kind != ObstacleKind::None)
  {
    const SolidKind& kind = KindOf(*this);
    const PlainSolid solid = kind.Made(*this);
    SceneJson entry = { { "kind", kind.Word } };
    for (std::size_t i = 0; i < kind.Fields.size(); ++i)
    {
      entry[kind.Fields[i].Name] =
        i < solid.Points.size() ? FormatVector(solid.Points[i]) : SceneJson(solid.Radius);
    }
    scene["obstacles"] = SceneJson::array({ entry });
  }
  return scene.dump();
}

} // namespace waft
