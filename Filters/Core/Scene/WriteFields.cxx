// SPDX-License-Identifier: BSD-3-Clause
// Obstacles, winds and vortices as a scene file has them.
#include "Base/Primitives.h"
#include "Scene/SceneFormat.h"

#include <algorithm>
#include <filesystem>

namespace waft
{

/// Boxes, spheres and cylinders are known by their meshes, to the last bit.
bool SceneFormat::FormatSurface(const TriangleMesh& mesh, SceneJson& json) const
{
  const std::vector<Vec3>& points = mesh.Points;
  if (points.size() < 8)
  {
    return false;
  }
  if (IsSameMesh(mesh, MakeBox(Box{ points.front(), points.back() })))
  {
    json = { { "kind", "box" },
             { "min", FormatVector(points.front()) },
             { "max", FormatVector(points.back()) } };
    return true;
  }
  const double reach = (points[2] - points[0]).norm();
  for (const double radius : ShortNumbers(reach))
  {
    if (radius > 0.0 && points[0] != points[1] &&
        IsSameMesh(mesh, MakeCylinder(points[0], points[1], radius)))
    {
      json = { { "kind", "cylinder" },
               { "base", FormatVector(points[0]) },
               { "top", FormatVector(points[1]) },
               { "radius", radius } };
      return true;
    }
  }
  const Vec3 middle = 0.5 * (points.front() + points.back());
  for (const double radius : ShortNumbers(0.5 * (points.front() - points.back()).norm()))
  {
    for (const double height : ShortNumbers(middle.z()))
    {
      const Vec3 center(points.front().x(), points.front().y(), height);
      if (radius > 0.0 && IsSameMesh(mesh, MakeSphere(center, radius)))
      {
        json = { { "kind", "sphere" }, { "center", FormatVector(center) }, { "radius", radius } };
        return true;
      }
    }
  }
  return false;
}

/// As few keys as hold the motion within a rounding. reference: the point that moves, where the
/// mesh stands.
SceneJson SceneFormat::FormatMotion(const ObstacleMesh& obstacle, const Vec3& reference) const
{
  const std::vector<Vec3>& offsets = obstacle.Offsets;
  const int last =
    std::min(this->In.Info.Time.NumberOfFrames, static_cast<int>(offsets.size())) - 1;
  const double tolerance = 1e-12 * this->In.Info.Bounds.Width();
  SceneJson keys = SceneJson::array();
  const auto add = [&](int frame)
  {
    const Vec3 exact = reference + offsets[frame];
    Vec3 place = exact;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double number : ShortNumbers(exact[axis]))
      {
        if (std::abs(number - exact[axis]) <= tolerance)
        {
          place[axis] = number;
          break;
        }
      }
    }
    keys.push_back({ { "frame", frame }, { "position", FormatVector(place) } });
  };
  const auto isStraight = [&](int a, int b)
  {
    for (int k = a + 1; k < b; ++k)
    {
      const double s = static_cast<double>(k - a) / (b - a);
      if ((offsets[a] + s * (offsets[b] - offsets[a]) - offsets[k]).norm() > tolerance)
      {
        return false;
      }
    }
    return true;
  };
  add(0);
  int from = 0;
  while (from < last)
  {
    int to = from + 1;
    while (to < last && isStraight(from, to + 1))
    {
      ++to;
    }
    add(to);
    from = to;
  }
  return keys;
}

/// Of an obstacle as it is written.
static Vec3 ReferencePoint(const SceneJson& json)
{
  const auto point = [&](const char* field)
  {
    return Vec3(json[field][0].get<double>(), json[field][1].get<double>(),
                json[field][2].get<double>());
  };
  const std::string kind = json["kind"].get<std::string>();
  return kind == "box"        ? Vec3(0.5 * (point("min") + point("max")))
         : kind == "sphere"   ? point("center")
         : kind == "cylinder" ? point("base")
                              : Vec3(Vec3::Zero()); // a file has its points where they are
}

SceneJson SceneFormat::FormatObstacle(std::size_t place)
{
  const ObstacleMesh& obstacle = this->In.Obstacles[place];
  SceneJson json = SceneJson::object();
  if (!this->FormatSurface(obstacle.Mesh, json))
  {
    json["kind"] = "mesh";
    json["file"] = this->MeshFile("obstacle-" + std::to_string(obstacle.ObstacleId), false, place);
  }
  if (obstacle.ObstacleId != static_cast<int>(place))
  {
    if (obstacle.ObstacleId < 0 || obstacle.ObstacleId > 1000000000)
    {
      throw SceneError{ "Obstacles: `ObstacleId`: expected 0 to 1000000000, found " +
                        std::to_string(obstacle.ObstacleId) };
    }
    json["id"] = obstacle.ObstacleId;
  }
  if (obstacle.IsMoving())
  {
    json["motion"] = this->FormatMotion(obstacle, ReferencePoint(json));
  }
  return json;
}

/// The ground is the last obstacle and has the id and the mesh that the reader gives it.
bool SceneFormat::IsGround(double& height) const
{
  if (this->In.Obstacles.empty() || this->In.Obstacles.back().Mesh.Points.empty())
  {
    return false;
  }
  const ObstacleMesh& slab = this->In.Obstacles.back();
  int id = static_cast<int>(this->In.Obstacles.size()) - 1;
  for (const ObstacleMesh& obstacle : this->In.Obstacles)
  {
    id = &obstacle == &slab ? id : std::max(id, obstacle.ObstacleId + 1);
  }
  height = slab.Mesh.Points.back().z();
  return !slab.IsMoving() && slab.ObstacleId == id && height < this->In.Info.Bounds.Max.z() &&
         IsSameMesh(slab.Mesh, MakeGround(this->In.Info.Bounds, height));
}

void SceneFormat::WriteObstacles()
{
  double height = 0.0;
  const bool hasGround = this->IsGround(height);
  if (!hasGround)
  {
    this->Root["ground"]["enabled"] = false;
  }
  else if (height != this->In.Info.Bounds.Min.z())
  {
    this->Root["ground"]["height"] = height;
  }
  const std::size_t count = this->In.Obstacles.size() - (hasGround ? 1 : 0);
  SceneJson list = SceneJson::array();
  for (std::size_t i = 0; i < count; ++i)
  {
    list.push_back(this->FormatObstacle(i));
  }
  if (!list.empty())
  {
    this->Root["obstacles"] = std::move(list);
  }
}

void SceneFormat::WriteWinds()
{
  SceneJson list = SceneJson::array();
  for (const AnalyticWind& wind : this->In.Winds)
  {
    list.push_back({ { "direction", FormatVector(wind.Direction) },
                     { "strength", wind.Strength },
                     { "center", FormatVector(wind.Center) },
                     { "radius", wind.Radius },
                     { "centerTime", wind.CenterTime },
                     { "duration", wind.Duration } });
  }
  for (const WindFile& file : this->In.WindFiles)
  {
    const std::filesystem::path path(file.Path);
    list.push_back(
      { { "file",
          path.is_absolute()
            ? path.lexically_relative(std::filesystem::absolute(this->Folder)).generic_string()
            : file.Path } });
  }
  if (!list.empty())
  {
    this->Root["winds"] = std::move(list);
  }
}

void SceneFormat::WriteVortices()
{
  SceneJson list = SceneJson::array();
  for (const Vortex& vortex : this->In.Vortices)
  {
    if (!(vortex.CoreRadius > 0.0) || !(vortex.Duration > 0.0) || vortex.P1 == vortex.P2)
    {
      throw SceneError{ "Vortices: vortex " + std::to_string(vortex.VortexId) +
                        ": expected two different poles and a CoreRadius and Duration above 0" };
    }
    list.push_back({ { "p1", FormatVector(vortex.P1) },
                     { "p2", FormatVector(vortex.P2) },
                     { "strength", vortex.Strength },
                     { "centerTime", vortex.CenterTime },
                     { "duration", vortex.Duration },
                     { "coreRadius", vortex.CoreRadius } });
  }
  if (!list.empty())
  {
    this->Root["vortices"] = std::move(list);
  }
}

} // namespace waft
