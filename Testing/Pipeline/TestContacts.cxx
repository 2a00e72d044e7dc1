// SPDX-License-Identifier: BSD-3-Clause
// What is planned, optimised and turned lies on surfaces and does not cut them: every vertex at
// every frame, against the triangles of the scene.
#include "PipelineTesting.h"

#include "SceneChain.h"

#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/TrackData.h"
#include "Obstacles/ObstacleSet.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace
{
using namespace waft;

constexpr int Frames = 110;
constexpr double Tolerance = 1e-3 * 4.0; // of the width of the volume [m]

// A stair of three steps and a hill; each takes leaves that rest from frame 60 on, one of each
// lifts off again after frame 75, and one leaf passes over the edge of a step.
const char* const StairAndHill = R"({"waft": 1, "seed": 5, "time": {"frames": 110},
  "shapes": {"leaf": {"builtin": "leaf"}, "maple": {"builtin": "maple"}},
  "objects": [
    {"shape": "leaf", "positions": [[-1.0, -0.4, 2.1], [-0.5, 0.5, 2.0], [0.2, -0.5, 1.9]]},
    {"shape": "maple", "positions": [[1.2, 0.3, 2.0], [0.9, -0.4, 2.1]]}],
  "constraints": [
    {"kind": "rest", "object": 0, "frame": 60, "value": [-0.8, 0.1, 1.5]},
    {"kind": "rest", "object": 1, "frame": 60, "until": 75, "value": [-0.3, 0.3, 1.5]},
    {"kind": "position", "object": 2, "frame": 70, "value": [0.0, -0.2, 0.75], "radius": 0.05},
    {"kind": "rest", "object": 3, "frame": 60, "value": [1.1, 0.1, 1.5]},
    {"kind": "rest", "object": 4, "frame": 60, "until": 75, "value": [0.9, -0.2, 1.5]}],
  "obstacles": [
    {"kind": "box", "min": [-1.2, -1, 0], "max": [-0.6, 1, 0.9]},
    {"kind": "box", "min": [-0.6, -1, 0], "max": [-0.1, 1, 0.6]},
    {"kind": "box", "min": [-0.1, -1, 0], "max": [0.4, 1, 0.3]},
    {"kind": "mesh", "file": "hill.obj"}]})";

/// A closed heap of 24 x 24 cells over [0.6, 1.6] x [-0.5, 0.5] with its foot below the ground.
std::string Hill()
{
  constexpr int Cells = 24;
  std::string text;
  const auto height = [](double x, double y) { return 0.45 * (1.0 - x * x) * (1.0 - y * y); };
  for (const bool top : { true, false })
  {
    for (int j = 0; j <= Cells; ++j)
    {
      for (int i = 0; i <= Cells; ++i)
      {
        const double x = 2.0 * i / Cells - 1.0;
        const double y = 2.0 * j / Cells - 1.0;
        text += "v " + std::to_string(1.1 + 0.5 * x) + " " + std::to_string(0.5 * y) + " " +
                std::to_string(top ? 0.02 + height(x, y) : -0.1) + "\n";
      }
    }
  }
  constexpr int Row = Cells + 1;
  const auto face = [&](int a, int b, int c)
  {
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
            std::to_string(c + 1) + "\n";
  };
  const int low = Row * Row;
  const auto wall = [&](int a, int b)
  {
    face(a, low + a, low + b);
    face(a, low + b, b);
  };
  for (int j = 0; j < Cells; ++j)
  {
    for (int i = 0; i < Cells; ++i)
    {
      const int p = j * Row + i;
      face(p, p + 1, p + Row + 1);
      face(p, p + Row + 1, p + Row);
      face(low + p, low + p + Row + 1, low + p + 1);
      face(low + p, low + p + Row, low + p + Row + 1);
    }
    wall(j, j + 1);
    wall(Cells * Row + j + 1, Cells * Row + j);
    wall((j + 1) * Row, j * Row);
    wall(j * Row + Cells, (j + 1) * Row + Cells);
  }
  return text;
}

vtkPolyData* MeshesAt(vtkRotationRefineFilter* rotation, int frame)
{
  rotation->GetOutputInformation(0)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(),
                                         frame / 30.0);
  rotation->Update(0);
  return SceneChain::Poly(rotation, 0);
}
} // namespace

TEST(Contacts, NoMeshCutsAStairOrAHillFromTheSceneToThePoses)
{
  SceneChain chain(StairAndHill);
  chain.Folder.Write("hill.obj", Hill());
  ErrorLog warnings(chain.Rotation, vtkCommand::WarningEvent);
  chain.Rotation->Update();

  ObstacleCollector collector;
  chain.Reader->Update(vtkMotionSceneReader::OBSTACLES);
  ASSERT_TRUE(collector.Add(SceneChain::Poly(chain.Reader, vtkMotionSceneReader::OBSTACLES), 0.0,
                            Timeline{ Frames, 30.0 }));
  ObstacleSet obstacles;
  ASSERT_TRUE(obstacles.Build(collector.Take()));
  ASSERT_EQ(obstacles.Obstacles().size(), 5u); // and the ground

  double deepest = 0.0;
  std::map<int, double> lowestAtRest; // height above what is below, by object
  std::map<int, Vec3> first;          // a vertex of each, at frame 60
  std::map<int, double> wandered;     // how far it goes from there up to frame 75 and after
  std::map<int, double> lifted;
  for (int frame = 0; frame < Frames; ++frame)
  {
    vtkPolyData* meshes = MeshesAt(chain.Rotation, frame);
    ASSERT_GT(meshes->GetNumberOfPoints(), 0);
    vtkDataArray* ids = meshes->GetPointData()->GetArray("ObjectId");
    for (vtkIdType i = 0; i < meshes->GetNumberOfPoints(); ++i)
    {
      const Vec3 x(meshes->GetPoint(i));
      const int id = static_cast<int>(ids->GetComponent(i, 0));
      const double d = obstacles.SignedDistance(x, frame, 0.05);
      deepest = std::max(deepest, -d);
      if (frame == 60)
      {
        lowestAtRest.emplace(id, 1.0);
        lowestAtRest[id] = std::min(lowestAtRest[id], d);
      }
      const bool isFirst = i == 0 || ids->GetComponent(i - 1, 0) != id;
      if (isFirst && frame >= 60)
      {
        first.emplace(id, x);
        double& away = frame <= 75 ? wandered[id] : lifted[id];
        away = std::max(away, (x - first[id]).norm());
      }
    }
  }
  EXPECT_LE(deepest, Tolerance);
  for (const int id : { 0, 1, 3, 4 })
  {
    EXPECT_LE(lowestAtRest[id], Tolerance) << id;
    EXPECT_GE(lowestAtRest[id], -Tolerance) << id;
    EXPECT_LE(wandered[id], 1e-9) << id;
  }
  EXPECT_LE(lifted[0], 1e-9);
  EXPECT_LE(lifted[3], 1e-9);
  EXPECT_GT(lifted[1], 0.05);
  EXPECT_GT(lifted[4], 0.05);
  EXPECT_EQ(warnings.Text.find("below a surface"), std::string::npos) << warnings.Text;
}
