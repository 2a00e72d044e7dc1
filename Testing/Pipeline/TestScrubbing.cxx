// SPDX-License-Identifier: BSD-3-Clause
// Looking at frames in any order: each stage computes once.
#include "PipelineTesting.h"

#include "SceneChain.h"

#include <vtkGridSmokeSource.h>
#include <vtkImageData.h>
#include <vtkTrajectoryClusterFilter.h>
#include <vtkTrajectoryTraceFilter.h>
#include <vtkVortexFitFilter.h>

#include <gtest/gtest.h>

#include <list>

namespace
{

const char* const WindyScene = R"({"waft": 1, "time": {"frames": 40}, "ground": {"enabled": false},
  "shapes": {"leaf": {"builtin": "leaf"}},
  "objects": [{"shape": "leaf", "positions": [[-0.5, 0.0, 2.1], [-0.5, 0.4, 2.2]]}],
  "constraints": [{"kind": "position", "object": 0, "frame": 39, "value": [0.3, 0.1, 2.0]}],
  "obstacles": [{"kind": "sphere", "center": [1, -1, 2], "radius": 0.2, "motion":
    [{"frame": 0, "position": [1, -1, 2]}, {"frame": 39, "position": [1, 1, 2]}]}],
  "winds": [{"direction": [1, 0, 0], "strength": 0.5, "center": [0, 0, 2], "radius": 1,
    "centerTime": 0.6, "duration": 0.5}]})";

/// Where the points of an output lie, and the time it says it shows.
struct Look
{
  double Time = -1.0;
  double Bounds[6];
};

Look LookAt(vtkAlgorithm* stage, int port, double time)
{
  vtkInformation* output = stage->GetOutputInformation(port);
  output->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  stage->Update(port);
  vtkDataObject* data = stage->GetOutputDataObject(port);
  Look look;
  look.Time = data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
  vtkDataSet::SafeDownCast(data)->GetBounds(look.Bounds);
  return look;
}

/// Looks at frames in an order that goes to and fro: nothing computes, frames say their time, and
/// what moves has moved.
void ExpectServed(const std::vector<vtkAlgorithm*>& working, vtkAlgorithm* seen, int port,
                  bool isMoving)
{
  SCOPED_TRACE(seen->GetClassName() + std::string(" port ") + std::to_string(port));
  std::list<WorkCount> counts;
  for (vtkAlgorithm* stage : working)
  {
    counts.emplace_back(stage);
  }
  Look first;
  for (const int frame : { 3, 31, 30, 12, 39, 0, 3 })
  {
    const Look look = LookAt(seen, port, frame / 30.0);
    EXPECT_NEAR(look.Time, frame / 30.0, 1e-9);
    if (first.Time < 0.0)
    {
      first = look;
    }
    for (int i = 0; i < 6 && frame == 3; ++i)
    {
      EXPECT_EQ(look.Bounds[i], first.Bounds[i]);
    }
    if (isMoving && frame == 31)
    {
      EXPECT_FALSE(std::equal(look.Bounds, look.Bounds + 6, first.Bounds));
    }
  }
  auto stage = working.begin();
  for (const WorkCount& count : counts)
  {
    EXPECT_EQ(count.Value, 0) << (*stage++)->GetClassName();
  }
}

} // namespace

TEST(Scrubbing, TheChainComputesOnce)
{
  SceneChain chain(WindyScene);
  chain.BlowWind();
  vtkNew<vtkVortexFitFilter> fit;
  fit->SetInputConnection(0, chain.Spacetime->GetOutputPort(0));
  fit->SetInputConnection(1, chain.Planner->GetOutputPort(4));
  const std::vector<vtkAlgorithm*> computing{ chain.Planner, chain.Spacetime, chain.Rotation, fit };
  {
    std::list<WorkCount> counts;
    for (vtkAlgorithm* stage : computing)
    {
      counts.emplace_back(stage);
    }
    chain.Rotation->Update();
    fit->Update();
    for (const WorkCount& count : counts)
    {
      EXPECT_GT(count.Value, 0) << "the counter sees a stage that computes";
    }
  }
  std::filesystem::remove(chain.Folder.File("scene.waft.json")); // who reads it again fails
  ErrorLog errors(chain.Reader);
  ExpectServed(computing, chain.Reader, vtkMotionSceneReader::OBSTACLES, true);
  ExpectServed(computing, chain.Reader, vtkMotionSceneReader::WIND, false);
  ExpectServed(computing, chain.Planner, 0, false);
  ExpectServed(computing, chain.Spacetime, 0, false);
  ExpectServed(computing, chain.Spacetime, 1, true);
  ExpectServed(computing, chain.Spacetime, 3, false);
  ExpectServed(computing, chain.Rotation, 0, true);
  ExpectServed(computing, chain.Rotation, 1, false);
  ExpectServed(computing, fit, 0, false);
  ExpectServed(computing, fit, 1, false);
  EXPECT_EQ(errors.Text, "");
}

TEST(Scrubbing, TheAssimilationComputesOnce)
{
  AssimilatedChain chain(WindyScene);
  chain.BlowWind();
  const std::vector<vtkAlgorithm*> computing{ chain.Planner, chain.Assimilation };
  {
    const WorkCount count(chain.Assimilation);
    chain.Assimilation->Update();
    EXPECT_GT(count.Value, 0) << "the counter sees a stage that computes";
  }
  ErrorLog errors(chain.Assimilation);
  for (const int port : { 0, 1, 2, 3 }) // Tracks, Air, Vortices, Constraints
  {
    ExpectServed(computing, chain.Assimilation, port, false);
  }
  EXPECT_EQ(errors.Text, "");
}

TEST(Scrubbing, TheDatabasesStagesComputeOnce)
{
  vtkNew<vtkGridSmokeSource> smoke;
  smoke->SetResolution(16, 16, 16);
  smoke->SetNumberOfFrames(40);
  smoke->SetWarmUpSeconds(0.2);
  vtkNew<vtkTrajectoryTraceFilter> trace;
  trace->SetInputConnection(0, smoke->GetOutputPort(0));
  trace->SetInputConnection(1, smoke->GetOutputPort(1));
  trace->SetInputConnection(2, smoke->GetOutputPort(2));
  trace->SetSeedStride(4);
  vtkNew<vtkTrajectoryClusterFilter> cluster;
  cluster->AddInputConnection(0, trace->GetOutputPort());
  cluster->AddInputConnection(1, smoke->GetOutputPort(1));
  const std::vector<vtkAlgorithm*> computing{ smoke, trace, cluster };
  {
    std::list<WorkCount> counts;
    for (vtkAlgorithm* stage : computing)
    {
      counts.emplace_back(stage);
    }
    cluster->Update();
    for (const WorkCount& count : counts)
    {
      EXPECT_GT(count.Value, 0) << "the counter sees a stage that computes";
    }
  }
  ExpectServed(computing, smoke, 0, false);
  ExpectServed(computing, trace, 0, false);
  // A database has no time of its own.
  using Sddp = vtkStreamingDemandDrivenPipeline;
  EXPECT_FALSE(cluster->GetOutputInformation(0)->Has(Sddp::TIME_STEPS()));
  EXPECT_FALSE(cluster->GetOutputInformation(0)->Has(Sddp::TIME_RANGE()));
}
