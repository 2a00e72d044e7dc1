// SPDX-License-Identifier: BSD-3-Clause
// Obstacles, winds and vortices as a scene file has them.
#include "Scene/AuthoredParts.h"
#include "Scene/SceneComparison.h"
#include "Scene/SceneFormat.h"

#include <algorithm>

namespace waft
{

/// Of a mesh from a file, which has its points where they are: the keys are the displacements, as
/// few of them as hold the motion within a rounding.
SceneJson SceneFormat::FormatMotion(const ObstacleMesh& obstacle) const
{
  const std::vector<Vec3>& offsets = obstacle.Offsets;
  const int last =
    std::min(this->In.Info.Time.NumberOfFrames, static_cast<int>(offsets.size())) - 1;
  const auto offset = [&](int frame) -> const Vec3&
  { return offsets[static_cast<std::size_t>(frame)]; };
  const double tolerance = 1e-12 * this->In.Info.Bounds.Width();
  const auto isStraight = [&](int a, int b)
  {
    for (int k = a + 1; k < b; ++k)
    {
      const double s = static_cast<double>(k - a) / (b - a);
      if ((offset(a) + s * (offset(b) - offset(a)) - offset(k)).norm() > tolerance)
      {
        return false;
      }
    }
    return true;
  };
  SceneJson keys = SceneJson::array();
  const auto add = [&](int frame) {
    keys.push_back({ { "frame", frame }, { "position", FormatVector(offset(frame)) } });
  };
  add(0);
  for (int from = 0, to = 1; from < last; from = to++)
  {
    while (to < last && isStraight(from, to + 1))
    {
      ++to;
    }
    add(to);
  }
  return keys;
}

/// position: in the list that is written. authored: the entry of this id, or null.
SceneJson SceneFormat::FormatObstacle(std::size_t index, int position, const SceneJson* authored)
{
  const ObstacleMesh& obstacle = this->In.Obstacles[index];
  const bool hasOwnId = obstacle.ObstacleId != position;
  if (hasOwnId && !limits::Id.Holds(obstacle.ObstacleId))
  {
    throw SceneError{ "Obstacles: `ObstacleId`: expected 0 to 1000000000, found " +
                      std::to_string(obstacle.ObstacleId) };
  }
  SceneJson json = authored == nullptr ? SceneJson::object() : *authored;
  ObstacleMesh read;
  const bool isAuthored =
    authored != nullptr &&
    IsReadable([&] { read = this->Reader.ReadObstacle(SceneNode(json, ""), position); }) &&
    IsSameObstacle(read, obstacle);
  if (isAuthored)
  {
    json = this->AsWritten(std::move(json));
  }
  else
  {
    const std::string file =
      this->SideFile("obstacle-" + std::to_string(obstacle.ObstacleId), ".vtp");
    this->Out.Meshes.push_back({ file, false, index });
    json = { { "kind", "mesh" }, { "file", file } };
    this->Reader.SetReference(obstacle.ObstacleId, Vec3::Zero());
  }
  if (hasOwnId)
  {
    json["id"] = obstacle.ObstacleId;
  }
  if (!isAuthored && obstacle.IsMoving())
  {
    json["motion"] = this->FormatMotion(obstacle);
  }
  return json;
}

/// The obstacle that the authored ground still is; how many there are where none is.
std::size_t SceneFormat::FindGround(const SceneJson& authored)
{
  std::size_t index = this->In.Obstacles.size();
  if (!authored.contains("waft") ||
      !IsReadable([&] { this->Reader.ReadGround(SceneNode(authored, "")); }))
  {
    return index;
  }
  this->Reader.AddGround();
  for (const ObstacleMesh& ground : this->Written.Obstacles) // one or none
  {
    const auto found =
      std::find_if(this->In.Obstacles.begin(), this->In.Obstacles.end(),
                   [&](const ObstacleMesh& obstacle) { return IsSameObstacle(obstacle, ground); });
    index = static_cast<std::size_t>(found - this->In.Obstacles.begin());
  }
  this->Written.Obstacles.clear();
  return index;
}

void SceneFormat::WriteObstacles()
{
  const SceneJson authored = AuthoredPart(this->In.Authored.Obstacles);
  const std::size_t count = this->In.Obstacles.size();
  const std::size_t ground = this->FindGround(authored);
  if (ground == count)
  {
    this->Root["ground"]["enabled"] = false;
  }
  else if (authored.contains("ground"))
  {
    this->Root["ground"] = authored["ground"];
  }
  std::map<int, SceneJson> entries; // by id
  int next = 0;
  for (const SceneJson& entry : AuthoredList(this->In.Authored.Obstacles, "obstacles"))
  {
    const bool hasId = entry.is_object() && entry.contains("id") && entry["id"].is_number();
    const double id = hasId ? entry["id"].get<double>() : next;
    if (limits::Id.Holds(id))
    {
      entries.emplace(static_cast<int>(id), entry);
    }
    ++next;
  }
  SceneJson list = SceneJson::array();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i != ground)
    {
      const auto entry = entries.find(this->In.Obstacles[i].ObstacleId);
      list.push_back(this->FormatObstacle(i, static_cast<int>(list.size()),
                                          entry == entries.end() ? nullptr : &entry->second));
    }
  }
  this->Written.Obstacles = this->In.Obstacles; // objects keep clear of all, in whatever order
  if (!list.empty())
  {
    this->Root["obstacles"] = std::move(list);
  }
}

SceneJson FormatWind(const AnalyticWind& wind)
{
  return { { "direction", FormatVector(wind.Direction) },
           { "strength", wind.Strength },
           { "center", FormatVector(wind.Center) },
           { "radius", wind.Radius },
           { "centerTime", wind.CenterTime },
           { "duration", wind.Duration } };
}

SceneJson FormatFront(const WindFront& front, double framesPerSecond)
{
  return { { "kind", "front" },
           { "direction", FormatVector(front.Direction) },
           { "speed", front.Speed },
           { "strength", front.Strength },
           { "width", front.Width },
           { "startFrame", std::lround(front.StartTime * framesPerSecond) },
           { "origin", FormatVector(front.Origin) } };
}

void SceneFormat::WriteWinds()
{
  SceneJson list = SceneJson::array();
  SceneJson authored = AuthoredPart(this->In.Authored.Winds);
  if (authored.contains("winds") &&
      IsReadable([&] { this->Reader.ReadWinds(SceneNode(authored["winds"], "/winds")); }) &&
      AreSameWinds(this->Written, this->In))
  {
    for (SceneJson& entry : authored["winds"])
    {
      list.push_back(this->AsWritten(entry));
    }
  }
  else
  {
    for (const AnalyticWind& wind : this->In.Winds)
    {
      list.push_back(FormatWind(wind));
    }
    for (const WindFront& front : this->In.Fronts)
    {
      list.push_back(FormatFront(front, this->In.Info.Time.FramesPerSecond));
    }
    for (const WindFile& file : this->In.WindFiles)
    {
      SceneJson json = { { "file", this->Relative(file.Path) } };
      if (!file.Array.empty())
      {
        json["array"] = file.Array;
      }
      if (file.IsYUp)
      {
        json["up"] = "y";
      }
      if (file.FirstFrame)
      {
        json["firstFrame"] = *file.FirstFrame;
      }
      if (file.Scale != 1.0)
      {
        json["scale"] = file.Scale;
      }
      list.push_back(std::move(json));
    }
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
