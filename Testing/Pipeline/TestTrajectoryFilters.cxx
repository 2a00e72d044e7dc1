// SPDX-License-Identifier: BSD-3-Clause
// Trace and cluster as stages of the pipeline.
#include "PipelineTesting.h"

#include "Base/Primitives.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"
#include "Trajectory/TrajectoryClusters.h"
#include "Trajectory/TrajectoryTracer.h"

#include <vtkFloatArray.h>
#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrajectoryClusterFilter.h>
#include <vtkTrajectoryTraceFilter.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

// A swirling flow in closed form as a source that varies in time.
class SwirlSource : public vtkImageAlgorithm
{
public:
  static SwirlSource* New();
  vtkTypeMacro(SwirlSource, vtkImageAlgorithm);

  int Frames = 61;
  bool HasVelocity = true;
  double Phase = 0.0;
  bool HasSolid = false;
  int Executions = 0;

protected:
  SwirlSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(vtkInformation*, vtkInformationVector**,
                         vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const int extent[6] = { 0, 15, 0, 15, 0, 15 };
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    std::vector<double> times;
    for (int frame = 0; frame < this->Frames; ++frame)
    {
      times.push_back(frame / 30.0);
    }
    const double range[2] = { times.front(), times.back() };
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), this->Frames);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    ++this->Executions;
    vtkInformation* info = outputs->GetInformationObject(0);
    const double time = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                          ? info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                          : 0.0;
    vtkImageData* image = vtkImageData::GetData(outputs);
    image->Initialize();
    image->SetDimensions(16, 16, 16);
    image->SetOrigin(-1.875, -1.875, 0.125);
    image->SetSpacing(0.25, 0.25, 0.25);
    vtkNew<vtkFloatArray> velocity;
    velocity->SetName(this->HasVelocity ? "Velocity" : "Something");
    velocity->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      double x[3];
      image->GetPoint(i, x);
      const double p = this->Phase + 0.9 * time;
      velocity->InsertNextTuple3(0.5 * (std::sin(1.7 * x[2] + p) + std::cos(1.7 * x[1])),
                                 0.5 * (std::sin(1.7 * x[0]) + std::cos(1.7 * x[2] + p)),
                                 0.5 * (std::sin(1.7 * x[1]) + std::cos(1.7 * x[0])));
    }
    image->GetPointData()->AddArray(velocity);
    if (this->HasSolid)
    {
      vtkNew<vtkUnsignedCharArray> solid; // where x > 0.5: between two points
      solid->SetName("Obstacle");
      for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
      {
        solid->InsertNextValue(image->GetPoint(i)[0] > 0.5 ? 1 : 0);
      }
      image->GetPointData()->AddArray(solid);
    }
    SceneInfo scene;
    scene.Time.NumberOfFrames = this->Frames;
    SceneInfoToFieldData(scene, image);
    image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(SwirlSource);

std::vector<Track> TracksOf(vtkAlgorithm* filter)
{
  std::vector<Track> tracks;
  const Result result =
    TracksFromPolyData(vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0)), tracks);
  EXPECT_TRUE(result) << result.Message();
  return tracks;
}

} // namespace

TEST(TrajectoryTraceFilter, TracesInOnePassAndServesItsResult)
{
  vtkNew<SwirlSource> source;
  vtkNew<vtkTrajectoryTraceFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetSeedStride(4);
  filter->Update();
  const std::vector<Track> tracks = TracksOf(filter);
  ASSERT_EQ(tracks.size(), 64u);
  std::size_t longest = 0;
  for (const Track& track : tracks)
  {
    longest = std::max(longest, track.Positions.size());
  }
  EXPECT_EQ(longest, 61u);
  EXPECT_EQ(source->Executions, 61);
  EXPECT_EQ(TimeSteps(filter).size(), 61u);

  filter->UpdateTimeStep(1.0);
  EXPECT_LE(source->Executions, 62);
  const std::vector<Track> again = TracksOf(filter);
  ASSERT_EQ(again.size(), tracks.size());
  EXPECT_EQ(again[7].Positions, tracks[7].Positions);

  // The same as Core by itself.
  TraceOptions options;
  options.SeedStride = 4;
  EXPECT_EQ(tracks[0].ObjectId, 0);
  EXPECT_LT((tracks[0].Positions[0] - Vec3(-1.625, -1.625, 0.375)).norm(), 0.26);
  SceneInfo info;
  ASSERT_TRUE(SceneInfoFromFieldData(filter->GetOutput(), info));
  EXPECT_EQ(info.Time.NumberOfFrames, 61);
}

TEST(TrajectoryTraceFilter, ObstaclesEndTracers)
{
  vtkNew<SwirlSource> source;
  ObstacleMesh box;
  box.Mesh = MakeBox(Box{ Vec3(-0.7, -0.7, 0.5), Vec3(0.7, 0.7, 3.5) });
  vtkNew<vtkPolyData> surface;
  ObstaclesToPolyData({ box }, 0, SceneInfo(), surface);
  vtkNew<vtkTrajectoryTraceFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetInputDataObject(2, surface);
  filter->SetSeedStride(4);
  filter->Update();
  const std::vector<Track> tracks = TracksOf(filter);
  EXPECT_LT(tracks.size(), 64u);
  EXPECT_GT(tracks.size(), 30u);
  for (const Track& track : tracks)
  {
    for (const Vec3& x : track.Positions)
    {
      EXPECT_FALSE(std::abs(x.x()) < 0.699 && std::abs(x.y()) < 0.699 && x.z() > 0.501 &&
                   x.z() < 3.499);
    }
  }
}

TEST(TrajectoryTraceFilter, SolidVoxelsOfTheFlowEndTracers)
{
  vtkNew<SwirlSource> source;
  source->HasSolid = true;
  vtkNew<vtkTrajectoryTraceFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetSeedStride(4);
  filter->Update();
  const std::vector<Track> tracks = TracksOf(filter);
  EXPECT_EQ(tracks.size(), 48u); // one of four layers of seeds is solid: x = 1.375
  double farthest = -2.0;
  for (const Track& track : tracks)
  {
    for (const Vec3& x : track.Positions)
    {
      farthest = std::max(farthest, x.x());
    }
  }
  EXPECT_LE(farthest, 0.5 + 1e-9); // the wall stands half way between the points at 0.375 and 0.625
  EXPECT_GT(farthest, 0.4);
}

TEST(TrajectoryTraceFilter, NamesTheArrayThatIsMissing)
{
  vtkNew<SwirlSource> source;
  source->HasVelocity = false;
  vtkNew<vtkTrajectoryTraceFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  ErrorLog errors(filter);
  filter->Update();
  EXPECT_TRUE(errors.Contains("`Velocity`")) << errors.Text;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  // And it recovers.
  source->HasVelocity = true;
  source->Modified();
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(TrajectoryTraceFilter, StoppedHalfWayItKeepsWhatItHas)
{
  vtkNew<SwirlSource> source;
  vtkNew<vtkTrajectoryTraceFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  const AbortBeyond stop(filter, 0.5);
  filter->Update();
  std::size_t longest = 0;
  for (const Track& track : TracksOf(filter))
  {
    longest = std::max(longest, track.Positions.size());
  }
  EXPECT_GT(longest, 20u);
  EXPECT_LT(longest, 45u);
}

TEST(TrajectoryClusterFilter, MakesADatabaseFromTracksOfSeveralRuns)
{
  vtkNew<SwirlSource> sources[2];
  vtkNew<vtkTrajectoryTraceFilter> traces[2];
  vtkNew<vtkTrajectoryClusterFilter> filter;
  for (int i = 0; i < 2; ++i)
  {
    sources[i]->Phase = 1.3 * i;
    traces[i]->SetInputConnection(sources[i]->GetOutputPort());
    traces[i]->SetSeedStride(2);
    traces[i]->SetSettlingSpeed(0.1);
    filter->AddInputConnection(0, traces[i]->GetOutputPort());
  }
  filter->SetMaximumSegments(0);
  filter->Update();
  MotionDatabase database;
  const Result result = DatabaseFromMultiBlock(filter->GetOutput(), database);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_EQ(database.SettlingSpeed, 0.1);
  EXPECT_GT(database.Segments.size(), 500u);

  // The same as Core by itself.
  ClusterInput input;
  input.SettlingSpeed = 0.1;
  for (int i = 0; i < 2; ++i)
  {
    input.Simulations.push_back({ TracksOf(traces[i]), {} });
  }
  ClusterOptions options;
  options.MaximumSegments = 0;
  MotionDatabase direct;
  SilentMonitor monitor;
  ASSERT_TRUE(ClusterTrajectories(input, options, SerialFor(), monitor, direct));
  ASSERT_EQ(database.Segments.size(), direct.Segments.size());
  for (std::size_t s = 0; s < direct.Segments.size(); ++s)
  {
    ASSERT_EQ(database.Segments[s].Coefficients, direct.Segments[s].Coefficients);
  }
  EXPECT_EQ(database.Provenance, direct.Provenance);
  ASSERT_EQ(database.Connections.size(), direct.Connections.size());
}

TEST(TrajectoryClusterFilter, RefusesTracksThatAreTooShort)
{
  vtkNew<SwirlSource> source;
  source->Frames = 5;
  vtkNew<vtkTrajectoryTraceFilter> trace;
  trace->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkTrajectoryClusterFilter> filter;
  filter->AddInputConnection(0, trace->GetOutputPort());
  ErrorLog errors(filter);
  filter->Update();
  EXPECT_TRUE(errors.Contains("shortest segment (ShortestSegment)")) << errors.Text;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(TrajectoryFilters, DefaultsAreThoseOfCore)
{
  vtkNew<vtkTrajectoryTraceFilter> trace;
  const TraceOptions options;
  EXPECT_EQ(trace->GetSeedStride(), options.SeedStride);
  EXPECT_EQ(trace->GetSettlingSpeed(), options.SettlingSpeed);
  EXPECT_EQ(trace->GetVortexShare(), options.Annotation.VortexShare);
  EXPECT_EQ(trace->GetForceFloor(), options.Annotation.ForceFloor);
  EXPECT_EQ(trace->GetShortestRun(), options.Annotation.ShortestRun);
  vtkNew<vtkTrajectoryClusterFilter> cluster;
  const ClusterOptions c;
  EXPECT_EQ(cluster->GetShortestSegment(), c.Segmentation.ShortestSegment);
  EXPECT_EQ(cluster->GetLongestSegment(), c.Segmentation.LongestSegment);
  EXPECT_EQ(cluster->GetLengthRatio(), c.Segmentation.LengthRatio);
  EXPECT_EQ(cluster->GetFeatureCurvature(), c.Segmentation.FeatureCurvature);
  EXPECT_EQ(cluster->GetFeatureContrast(), c.Segmentation.FeatureContrast);
  EXPECT_EQ(cluster->GetLeastSpeed(), c.Segmentation.LeastSpeed);
  EXPECT_EQ(cluster->GetWindow(), c.Window);
  EXPECT_EQ(cluster->GetRelativeError(), c.RelativeError);
  EXPECT_EQ(cluster->GetMaximumSegments(), c.MaximumSegments);
  EXPECT_EQ(cluster->GetNumberOfTopNodes(), c.Trees.NumberOfTopNodes);
  EXPECT_EQ(cluster->GetBranching(), c.Trees.Branching);
  EXPECT_EQ(cluster->GetRotationFreedom(), static_cast<int>(c.Connections.RotationFreedom));
  EXPECT_EQ(cluster->GetMaxTilt(), c.Connections.MaxTilt);
  EXPECT_EQ(cluster->GetNotConnectible(), c.Connections.NotConnectible);
  EXPECT_EQ(static_cast<std::uint64_t>(cluster->GetSeed()), c.Trees.Seed);
}
