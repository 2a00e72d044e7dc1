// SPDX-License-Identifier: BSD-3-Clause
// Smoke, traced and clustered by three stages that know each other by their data only.
#include "PipelineTesting.h"

#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkGridSmokeSource.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkTrajectoryClusterFilter.h>
#include <vtkTrajectoryTraceFilter.h>

#include <gtest/gtest.h>

#include <map>
#include <vector>

using namespace waft;

namespace
{

std::size_t PointsOf(const std::vector<Track>& tracks)
{
  std::size_t count = 0;
  for (const Track& track : tracks)
  {
    count += track.Positions.size();
  }
  return count;
}

} // namespace

TEST(SmokeToDatabase, AnnotationNamesTheVorticesOfTheSmoke)
{
  vtkNew<vtkGridSmokeSource> smoke;
  smoke->SetResolution(20, 20, 20);
  smoke->SetNumberOfFrames(60);
  smoke->SetWarmUpSeconds(1.0);
  vtkNew<vtkTrajectoryTraceFilter> trace;
  trace->SetInputConnection(0, smoke->GetOutputPort(0));
  trace->SetInputConnection(1, smoke->GetOutputPort(1));
  trace->SetSeedStride(2);
  vtkNew<vtkTrajectoryClusterFilter> cluster;
  cluster->AddInputConnection(0, trace->GetOutputPort());
  cluster->AddInputConnection(1, smoke->GetOutputPort(1));
  cluster->Update();

  MotionDatabase database;
  const Result result = DatabaseFromMultiBlock(cluster->GetOutput(), database);
  ASSERT_TRUE(result) << result.Message();
  std::vector<Track> tracks;
  ASSERT_TRUE(TracksFromPolyData(trace->GetOutput(), tracks));

  // As a window wants it: in slices, to the same tracks and segments.
  smoke->WorkInSlices();
  smoke->Modified();
  trace->SetSlice(1e-9);
  cluster->WorkInSlices();
  int updates = 0;
  for (cluster->Update(); cluster->GetComplete() == 0 && updates < 10000; ++updates)
  {
    EXPECT_EQ(trace->GetOutput()->GetNumberOfPoints(),
              trace->GetComplete() == 0 ? 0 : static_cast<vtkIdType>(PointsOf(tracks)));
    smoke->GoOn();
    trace->GoOn();
    cluster->GoOn();
    cluster->Update();
  }
  EXPECT_GT(updates, 60) << "one step of the smoke each";
  std::vector<Track> slowly;
  ASSERT_TRUE(TracksFromPolyData(trace->GetOutput(), slowly));
  ASSERT_EQ(slowly.size(), tracks.size());
  EXPECT_EQ(slowly.back().Positions, tracks.back().Positions);
  MotionDatabase again;
  ASSERT_TRUE(DatabaseFromMultiBlock(cluster->GetOutput(), again));
  EXPECT_EQ(again.Segments.size(), database.Segments.size());

  // Held, it stays where it is; a change begins anew.
  trace->SetSeedStride(3);
  smoke->Update();
  trace->Update();
  EXPECT_EQ(trace->GetWorkState(), vtkTrajectoryTraceFilter::ARRIVED);
  trace->Hold();
  EXPECT_EQ(trace->GetWorkState(), vtkTrajectoryTraceFilter::HELD);
  const double done = trace->GetWorkDone();
  trace->GoOn();
  trace->Update();
  EXPECT_GT(trace->GetWorkDone(), done);
  trace->SetSeedStride(4);
  trace->Update();
  EXPECT_EQ(trace->GetWorkDone(), done);
  trace->SetSlice(0.0);
  trace->GoOn();
  trace->Update();
  EXPECT_EQ(trace->GetComplete(), 1);
  std::vector<Vortex> vortices;
  ASSERT_TRUE(
    VorticesFromPolyData(vtkPolyData::SafeDownCast(smoke->GetOutputDataObject(1)), vortices));
  ASSERT_FALSE(vortices.empty());

  // The smoke's forces at a tracer are those of its vortices.
  std::map<ForceType, int> types;
  int compared = 0;
  int alike = 0;
  for (const Track& track : tracks)
  {
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      ++types[track.ForceTypes[k]];
      Vec3 force = Vec3::Zero();
      for (const Vortex& vortex : vortices)
      {
        force += vortex.Acceleration(track.Positions[k], k / 30.0);
      }
      ++compared;
      alike += (force - track.VortexAccelerations[k]).norm() < 0.1 * (0.2 + force.norm());
    }
  }
  EXPECT_GE(alike, 0.9 * compared);
  EXPECT_GT(types[ForceType::Vortex], compared / 20);
  EXPECT_GT(types[ForceType::Wind], compared / 20);

  // Vortices that drove a segment came with it, with their own strength.
  ASSERT_FALSE(database.Vortices.empty());
  for (const Vortex& local : database.Vortices)
  {
    bool isKnown = false;
    for (const Vortex& vortex : vortices)
    {
      isKnown =
        isKnown || (vortex.Strength == local.Strength &&
                    std::abs((vortex.P2 - vortex.P1).norm() - (local.P2 - local.P1).norm()) < 1e-9);
    }
    EXPECT_TRUE(isKnown);
  }
}
