// SPDX-License-Identifier: BSD-3-Clause
// An obstacle that moves through the volume, from the scene file to the posed objects.
#include "PipelineTesting.h"

#include "SceneChain.h"

#include "Base/Types.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"

#include <vtkConstraintSource.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkObjectSource.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <map>

namespace
{

using namespace waft;

constexpr int Frames = 60;
constexpr int SamplesPerFrame = 8;

// Three leaves go from the left to the right while a box comes towards them, from where their marks
// are to where they start.
const char* const AgainstTheLeaves = R"({"waft": 1, "seed": 3, "time": {"frames": 60},
  "shapes": {"leaf": {"builtin": "leaf"}},
  "objects": [{"shape": "leaf", "positions":
    [[-0.7, 0.0, 2.1], [-0.7, 0.3, 2.2], [-0.6, -0.25, 1.9]]}],
  "constraints": [
    {"kind": "position", "object": 0, "frame": 59, "value": [0.7, 0.0, 2.0]},
    {"kind": "position", "object": 1, "frame": 59, "value": [0.7, 0.2, 2.1]},
    {"kind": "position", "object": 2, "frame": 59, "value": [0.6, -0.2, 1.95]}],
  "obstacles": [{"kind": "box", "min": [0.55, -0.35, 1.7], "max": [0.85, 0.35, 2.3], "motion":
    [{"frame": 0, "position": [0.7, 0, 2]}, {"frame": 59, "position": [-0.7, 0, 2]}]}]})";

using Paths = std::map<int, std::vector<Vec3>>; // by object

Paths StraightLines(const std::vector<MotionObject>& objects, const Paths& flown)
{
  Paths straight;
  for (const MotionObject& object : objects)
  {
    const Vec3 goal = flown.at(object.ObjectId).back();
    for (int k = 0; k < Frames; ++k)
    {
      straight[object.ObjectId].push_back(object.Position +
                                          k / (Frames - 1.0) * (goal - object.Position));
    }
  }
  return straight;
}

/// How far the objects' centres stay outside their clearance radius at least [m], negative inside,
/// by the surface that the reader shows at each moment, or at frame 0 when it is frozen.
double LeastSpare(vtkMotionSceneReader* reader, const std::vector<MotionObject>& objects,
                  const Paths& paths, bool isFrozen)
{
  double least = std::numeric_limits<double>::max();
  for (int sample = 0; sample <= (Frames - 1) * SamplesPerFrame; ++sample)
  {
    const double frame = static_cast<double>(sample) / SamplesPerFrame;
    reader->GetOutputInformation(vtkMotionSceneReader::OBSTACLES)
      ->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), isFrozen ? 0.0 : frame / 30.0);
    reader->Update(vtkMotionSceneReader::OBSTACLES);
    vtkNew<vtkImplicitPolyDataDistance> distance;
    distance->SetInput(SceneChain::Poly(reader, vtkMotionSceneReader::OBSTACLES));
    const auto k = static_cast<std::size_t>(std::min(Frames - 2, static_cast<int>(frame)));
    for (const MotionObject& object : objects)
    {
      const std::vector<Vec3>& path = paths.at(object.ObjectId);
      const Vec3 x = path[k] + (frame - static_cast<double>(k)) * (path[k + 1] - path[k]);
      const double d = distance->EvaluateFunction(x.x(), x.y(), x.z());
      least = std::min(least, d - object.ClearanceRadius);
    }
  }
  return least;
}

Paths PathsOf(vtkPolyData* data)
{
  std::vector<Track> tracks;
  EXPECT_TRUE(TracksFromPolyData(data, tracks));
  Paths paths;
  for (const Track& track : tracks)
  {
    EXPECT_EQ(track.Positions.size(), static_cast<std::size_t>(Frames));
    paths[track.ObjectId] = track.Positions;
  }
  return paths;
}

/// Updates all of it; a stage that sees the obstacle elsewhere finds marks or poses inside it.
void ExpectNoComplaint(const SceneChain& chain)
{
  chain.Rotation->SetMaximumTurn(180.0); // small leaves that are chased turn faster than 60
  std::list<ErrorLog> logs;
  for (vtkAlgorithm* stage : chain.Stages())
  {
    logs.emplace_back(stage);
    logs.emplace_back(stage, vtkCommand::WarningEvent);
  }
  chain.Rotation->Update();
  for (const ErrorLog& log : logs)
  {
    EXPECT_EQ(log.Text, "");
  }
}

} // namespace

TEST(MovingObstacles, ObjectsKeepClearOfThemFromTheSceneToThePoses)
{
  SceneChain chain(AgainstTheLeaves);
  ExpectNoComplaint(chain);
  auto* report = vtkTable::SafeDownCast(chain.Spacetime->GetOutputDataObject(5));
  ASSERT_EQ(report->GetNumberOfRows(), 3);
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(report->GetValueByName(row, "Status").ToString(), "met");
  }
  std::vector<MotionObject> objects;
  ASSERT_TRUE(
    ObjectsFromPolyData(SceneChain::Poly(chain.Reader, vtkMotionSceneReader::OBJECTS), objects));
  ASSERT_EQ(objects.size(), 3u);
  for (const MotionObject& object : objects)
  {
    EXPECT_NEAR(object.ClearanceRadius, 0.05, 0.01);
  }
  const Paths planned = PathsOf(SceneChain::Poly(chain.Planner, 0));
  const Paths optimized = PathsOf(SceneChain::Poly(chain.Spacetime, 0));
  const Paths posed = PathsOf(SceneChain::Poly(chain.Rotation, 1));
  ASSERT_EQ(posed.size(), 3u);
  EXPECT_EQ(posed.at(0).back(), Vec3(0.7, 0.0, 2.0));
  EXPECT_EQ(posed.at(1).back(), Vec3(0.7, 0.2, 2.1));
  EXPECT_EQ(posed.at(2).back(), Vec3(0.6, -0.2, 1.95));

  const double tolerance = 1e-3 * 4.0; // of the width of the volume [m]
  EXPECT_GT(LeastSpare(chain.Reader, objects, planned, false), -tolerance);
  EXPECT_GT(LeastSpare(chain.Reader, objects, optimized, false), -tolerance);
  EXPECT_GT(LeastSpare(chain.Reader, objects, posed, false), -tolerance);
  // The measure tells: the marks lie inside the box as it stands at frame 0, and straight lines run
  // into it on its way.
  EXPECT_LT(LeastSpare(chain.Reader, objects, posed, true), -0.1);
  EXPECT_LT(LeastSpare(chain.Reader, objects, StraightLines(objects, posed), false), -0.1);
}

TEST(MovingObstacles, AreNotPulledAgainForAnEditOfARow)
{
  struct Edited : SceneChain
  {
    vtkNew<vtkObjectSource> Leaf;
    vtkNew<vtkConstraintSource> Row;

    Edited() : SceneChain(AgainstTheLeaves)
    {
      this->Leaf->SetPosition(-0.7, 0.0, 2.1);
      this->Leaf->SetNumberOfFrames(Frames);
      this->Row->SetNumberOfFrames(Frames);
      this->Row->SetFrame(59);
      this->Row->SetValue(0.7, 0.0, 2.0);
      this->Planner->SetInputConnection(1, this->Leaf->GetOutputPort());
      this->Planner->SetInputConnection(2, this->Row->GetOutputPort());
    }
    std::vector<Vec3> Path()
    {
      this->Planner->Update();
      std::vector<Track> tracks;
      EXPECT_TRUE(TracksFromPolyData(Poly(this->Planner, 0), tracks));
      return tracks.at(0).Positions;
    }
  };
  Edited chain;
  (void)chain.Path();
  ExecutionCount pulls(chain.Reader);
  chain.Row->SetValue(0.7, 0.1, 2.0);
  Edited fresh;
  fresh.Row->SetValue(0.7, 0.1, 2.0);
  EXPECT_EQ(chain.Path(), fresh.Path());
  EXPECT_LE(pulls.Value, 1);
  // At another frame rate the same surfaces stand at other frames: all are seen again.
  chain.Leaf->SetFramesPerSecond(24.0);
  Edited slower;
  slower.Row->SetValue(0.7, 0.1, 2.0);
  slower.Leaf->SetFramesPerSecond(24.0);
  EXPECT_EQ(chain.Path(), slower.Path());
  EXPECT_GT(pulls.Value, Frames / 2);
  // And when the obstacles change.
  pulls.Value = 0;
  chain.Reader->SetFileName(chain.Folder.File("scene.waft.json"));
  EXPECT_EQ(chain.Path(), slower.Path());
  EXPECT_GT(pulls.Value, Frames / 2);
}
