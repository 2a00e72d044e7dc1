// SPDX-License-Identifier: BSD-3-Clause
// Scenes to plan in, and what is measured on the tracks: shared by tests and benchmark.
#pragma once

#include "Base/Primitives.h"
#include "Constraints/Constraint.h"
#include "Planning/Planner.h"
#include "SwirlDatabase.h"

#include <map>
#include <stdexcept>

namespace waft
{
namespace test
{

constexpr int GroundId = 100;

struct PlanScene
{
  std::vector<MotionObject> Objects;
  std::vector<Constraint> Constraints;
  std::vector<ObstacleMesh> Meshes;
  ObstacleSet Obstacles;
  SceneInfo Scene;
  std::vector<Guide> Guides;

  PlanScene()
  {
    ObstacleMesh ground;
    ground.ObstacleId = GroundId;
    ground.Mesh = MakeBox(Box{ Vec3(-3, -3, -1), Vec3(3, 3, 0) });
    this->Meshes.push_back(ground);
  }
  void AddObject(const Vec3& position)
  {
    MotionObject object;
    object.ObjectId = static_cast<int>(this->Objects.size());
    object.Position = position;
    object.RestHeight = 0.002;
    this->Objects.push_back(object);
  }
  void AddBox(const Vec3& low, const Vec3& high)
  {
    ObstacleMesh mesh;
    mesh.ObstacleId = static_cast<int>(this->Meshes.size());
    mesh.Mesh = MakeBox(Box{ low, high });
    this->Meshes.push_back(mesh);
  }
  Constraint& AddRow(ConstraintKind kind, int object, int frame, const Vec3& value)
  {
    Constraint row;
    row.Kind = kind;
    row.ObjectId = object;
    row.Frame = row.Until = frame;
    row.Value = value;
    row.Row = static_cast<int>(this->Constraints.size());
    this->Constraints.push_back(row);
    return this->Constraints.back();
  }
  /// Plans with the shared database; what goes wrong is thrown.
  PlanOutput Run(std::uint64_t seed, const ParallelFor& parallelFor = SerialFor())
  {
    PlanOptions options;
    options.Seed = seed;
    return this->Run(options, parallelFor);
  }
  PlanOutput Run(const PlanOptions& options, const ParallelFor& parallelFor = SerialFor())
  {
    Check(this->Obstacles.Build(this->Meshes));
    const PlanInput input{ SwirlDatabase(), this->Objects, this->Constraints,
                           this->Obstacles, this->Scene,   this->Guides };
    PlanOutput output;
    SilentMonitor monitor;
    Check(PlanMotion(input, options, parallelFor, monitor, output));
    return output;
  }
  static void Check(const Result& result)
  {
    if (!result)
    {
      throw std::runtime_error(result.Message());
    }
  }
};

/// Least clearance minus radius of the swept centre, 8 samples a frame, in frames [first, last).
inline double LeastSlack(const PlanScene& scene, const Track& track, int first, int last)
{
  double slack = 1e30;
  for (int k = first; k < last; ++k)
  {
    for (int i = 0; i < 8; ++i)
    {
      const double u = i / 8.0;
      const Vec3 x = (1.0 - u) * track.Positions[k] + u * track.Positions[k + 1];
      const double distance =
        std::min(scene.Scene.Bounds.InnerDistance(x), scene.Obstacles.SignedDistance(x, k + u));
      slack = std::min(slack, distance - scene.Objects[track.ObjectId].ClearanceRadius);
    }
  }
  return slack;
}

inline double FastestStep(const Track& track)
{
  double fastest = 0.0;
  for (std::size_t k = 1; k < track.Positions.size(); ++k)
  {
    fastest = std::max(fastest, (track.Positions[k] - track.Positions[k - 1]).norm());
  }
  return fastest * 30.0;
}

/// Four walls across the volume, each of four boxes about a window: 16 boxes, 192 triangles. Object
/// 0 flies from one side to the other through all four. splits: every triangle is cut into
/// 4^splits.
struct MazeSize
{
  double Window = 0.6;    // m, side of a window
  double Thickness = 0.1; // m, of a wall
  int Splits = 0;         // every triangle of every second box is cut into 4^Splits
};

/// Each triangle in four, by the middles of its sides.
inline TriangleMesh Split(const TriangleMesh& mesh)
{
  TriangleMesh fine;
  fine.Points = mesh.Points;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b)
  {
    const auto [entry, isNew] =
      middles.emplace(std::minmax(a, b), static_cast<int>(fine.Points.size()));
    if (isNew)
    {
      fine.Points.push_back(0.5 * (mesh.Points[a] + mesh.Points[b]));
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.Triangles)
  {
    const int ab = middle(a, b);
    const int bc = middle(b, c);
    const int ca = middle(c, a);
    fine.Triangles.push_back({ a, ab, ca });
    fine.Triangles.push_back({ ab, b, bc });
    fine.Triangles.push_back({ ca, bc, c });
    fine.Triangles.push_back({ ab, bc, ca });
  }
  return fine;
}

inline void AddMaze(PlanScene& scene, const MazeSize& size = MazeSize())
{
  const Vec3 windows[4] = { Vec3(-1.2, -0.5, 1.6), Vec3(-0.4, 0.5, 2.4), Vec3(0.4, -0.4, 2.2),
                            Vec3(1.2, 0.5, 1.5) };
  const double half = 0.5 * size.Window;
  for (const Vec3& w : windows)
  {
    const double low = w.x() - 0.5 * size.Thickness;
    const double high = w.x() + 0.5 * size.Thickness;
    scene.AddBox(Vec3(low, -2.0, 0.0), Vec3(high, w.y() - half, 4.0));
    scene.AddBox(Vec3(low, w.y() + half, 0.0), Vec3(high, 2.0, 4.0));
    scene.AddBox(Vec3(low, w.y() - half, 0.0), Vec3(high, w.y() + half, w.z() - half));
    scene.AddBox(Vec3(low, w.y() - half, w.z() + half), Vec3(high, w.y() + half, 4.0));
  }
  for (int k = 0; k < size.Splits; ++k)
  {
    for (std::size_t i = 1; i < scene.Meshes.size(); i += 2)
    {
      scene.Meshes[i].Mesh = Split(scene.Meshes[i].Mesh);
    }
  }
}

/// A flight through the maze that has this many frames.
inline void AddMazeFlight(PlanScene& scene, int frames)
{
  scene.AddObject(Vec3(-1.7, 0.0, 2.0));
  scene.Scene.Time.NumberOfFrames = frames;
  scene.AddRow(ConstraintKind::Position, 0, frames - 1, Vec3(1.7, 0.0, 2.0));
}

/// Objects aloft all over the volume that lie on the ground from frame 250 on and spell WAFT.
/// So many frames, of which the last 50 are rest.
inline void AddLetters(PlanScene& scene, int count, int frames = 300)
{
  scene.Scene.Time.NumberOfFrames = frames;
  const char* rows[7] = { "#...#..###..#####.#####", "#...#.#...#.#.......#..",
                          "#...#.#...#.#.......#..", "#.#.#.#####.####....#..",
                          "#.#.#.#...#.#.......#..", "##.##.#...#.#.......#..",
                          "#...#.#...#.#.......#.." };
  std::vector<Vec3> dots;
  for (int y = 0; y < 7; ++y)
  {
    for (int x = 0; x < 23; ++x)
    {
      if (rows[y][x] == '#')
      {
        dots.emplace_back(0.15 * (x - 11), 0.15 * (3 - y), 0.1);
      }
    }
  }
  Random random(11);
  for (int i = 0; i < count; ++i)
  {
    scene.AddObject(random.InBox(Box{ Vec3(-1.7, -1.5, 2.0), Vec3(1.7, 1.5, 3.7) }));
    scene.Objects.back().SettlingSpeed = 0.5;
    Vec3 place = dots[static_cast<std::size_t>(i) % dots.size()];
    place += random.InBox(Box{ Vec3(-0.06, -0.06, 0.0), Vec3(0.06, 0.06, 1e-9) });
    Constraint& row = scene.AddRow(ConstraintKind::Rest, -1, frames - 50, place);
    row.Until = scene.Scene.Time.NumberOfFrames - 1;
    row.Row = 0;
    row.Target = i;
    row.Group = 0;
  }
}

} // namespace test
} // namespace waft
