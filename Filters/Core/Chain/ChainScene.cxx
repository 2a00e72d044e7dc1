// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/ChainScene.h"

#include "Scene/SceneEdits.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace waft
{
namespace
{

constexpr double LeastMove = 1e-9; // m

ObstacleMesh SeenFromFrames(const ObstacleMesh& obstacle, const Timeline& line)
{
  ObstacleMesh seen = obstacle;
  seen.Offsets.clear();
  if (!obstacle.IsMoving() || obstacle.Mesh.Points.empty())
  {
    return seen;
  }
  const auto offsetAt = [&](int frame)
  { return obstacle.Offset(line.Time(frame) * line.FramesPerSecond); };
  const Vec3 start = offsetAt(0);
  for (Vec3& point : seen.Mesh.Points)
  {
    point += start;
  }
  // Of the points, as whoever sees them alone has it: the same bits for all.
  const Vec3& mark = obstacle.Mesh.Points.front();
  bool moves = false;
  for (int frame = 0; frame < line.NumberOfFrames; ++frame)
  {
    seen.Offsets.emplace_back((mark + offsetAt(frame)) - seen.Mesh.Points.front());
    moves = moves || seen.Offsets.back().norm() > LeastMove;
  }
  if (!moves)
  {
    seen.Offsets.clear();
  }
  return seen;
}

} // namespace

std::vector<ObstacleMesh> ObstaclesOfFrames(const std::vector<ObstacleMesh>& obstacles,
                                            const Timeline& line)
{
  std::vector<ObstacleMesh> seen;
  for (const ObstacleMesh& obstacle : obstacles)
  {
    seen.push_back(SeenFromFrames(obstacle, line));
  }
  std::sort(seen.begin(), seen.end(),
            [](const ObstacleMesh& a, const ObstacleMesh& b)
            { return a.ObstacleId < b.ObstacleId; });
  return seen;
}

Box VolumeAboveGround(const Scene& scene)
{
  Box volume = scene.Info.Bounds;
  for (const ObstacleMesh& obstacle : scene.Obstacles)
  {
    if (obstacle.ObstacleId == scene.GroundId)
    {
      for (const Vec3& point : obstacle.Mesh.Points)
      {
        volume.Min.z() = std::max(volume.Min.z(), point.z());
      }
    }
  }
  return volume;
}

Quality FlownQuality(const Scene& scene, Quality wanted)
{
  const bool comeAndGo =
    std::any_of(scene.Objects.begin(), scene.Objects.end(),
                [](const MotionObject& object)
                { return object.FirstPresent() > 0 || object.Goes.From >= 0; }) ||
    std::any_of(scene.Constraints.begin(), scene.Constraints.end(),
                [](const Constraint& row) { return row.Goes.From >= 0 || row.Drifts != 0; });
  const bool isOfTheAir = comeAndGo || scene.Info.IsOpen() || scene.Info.Loops != 0;
  return isOfTheAir && RunsAt(ChainStage::Spacetime, wanted) ? Quality::Air : wanted;
}

Result ReadSceneAndWind(const std::string& file, const SceneAssets& assets, Scene& scene,
                        SceneWind& wind)
{
  std::string text;
  WAFT_RETURN_IF_FAILED(ReadSceneText(file, text));
  return ParseSceneAndWind(text, file, assets, scene, wind);
}

Result ParseSceneAndWind(const std::string& text, const std::string& file,
                         const SceneAssets& assets, Scene& scene, SceneWind& wind)
{
  Scene read;
  SceneWind built;
  const std::string folder = std::filesystem::path(file).parent_path().string();
  WAFT_RETURN_IF_FAILED(ParseScene(text, file, folder, assets, read));
  WAFT_RETURN_IF_FAILED(built.Build(read, assets));
  const std::vector<std::string>& odd = built.Warnings();
  read.Warnings.insert(read.Warnings.end(), odd.begin(), odd.end());
  scene = std::move(read);
  wind = std::move(built);
  return Result::Ok();
}

} // namespace waft
