// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/Primitives.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkFloatArray.h>
#include <vtkGridSmokeSource.h>
#include <vtkImageData.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

// A small run: 12^3 voxels, ten frames.
void MakeSmall(vtkGridSmokeSource* source)
{
  source->SetResolution(12, 12, 12);
  source->SetNumberOfFrames(10);
  source->SetWarmUpSeconds(0.2);
}

vtkImageData* Smoke(vtkGridSmokeSource* source)
{
  return vtkImageData::SafeDownCast(source->GetOutputDataObject(0));
}

std::vector<float> Values(vtkGridSmokeSource* source, const char* name)
{
  auto* array = vtkFloatArray::SafeDownCast(Smoke(source)->GetPointData()->GetArray(name));
  return array ? std::vector<float>(array->GetPointer(0),
                                    array->GetPointer(0) + array->GetNumberOfValues())
               : std::vector<float>();
}

// A box that moves along x at 0.6 m/s; counts how often it is asked.
class MovingBoxSource : public vtkPolyDataAlgorithm
{
public:
  static MovingBoxSource* New();
  vtkTypeMacro(MovingBoxSource, vtkPolyDataAlgorithm);
  int Requests = 0;

protected:
  MovingBoxSource() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(vtkInformation*, vtkInformationVector**,
                         vtkInformationVector* outputs) override
  {
    double times[10];
    for (int frame = 0; frame < 10; ++frame)
    {
      times[frame] = frame / 30.0;
    }
    const double range[2] = { times[0], times[9] };
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 10);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    ++this->Requests;
    vtkInformation* info = outputs->GetInformationObject(0);
    const double time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    const waft::Vec3 shift(0.6 * time, 0.0, 0.0);
    waft::ObstacleMesh box;
    box.ObstacleId = 4;
    box.Mesh = waft::MakeBox(
      waft::Box{ waft::Vec3(-0.8, -0.8, 1.2) + shift, waft::Vec3(0.8, 0.8, 2.8) + shift });
    vtkPolyData* output = vtkPolyData::GetData(outputs);
    waft::ObstaclesToPolyData({ box }, 0.0, waft::SceneInfo(), output);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(MovingBoxSource);

} // namespace

TEST(GridSmokeSource, GivesSmokeVorticesAndObstacles)
{
  vtkNew<vtkGridSmokeSource> source;
  MakeSmall(source);
  source->UpdateTimeStep(0.1);
  EXPECT_EQ(TimeSteps(source).size(), 10u);
  EXPECT_EQ(TimeSteps(source, 1).size(), 10u);
  vtkImageData* smoke = Smoke(source);
  ASSERT_EQ(smoke->GetNumberOfPoints(), 12 * 12 * 12);
  EXPECT_NEAR(smoke->GetOrigin()[0], -2.0 + 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(smoke->GetSpacing()[2], 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(smoke->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 0.1, 1e-12);
  for (const char* name : { "Velocity", "Vorticity", "VortexForce", "WindForce" })
  {
    EXPECT_EQ(Values(source, name).size(), 3u * 1728u) << name;
  }
  EXPECT_EQ(Values(source, "Density").size(), 1728u);
  EXPECT_EQ(Values(source, "Pressure").size(), 1728u);
  EXPECT_TRUE(smoke->GetPointData()->GetArray("Obstacle"));
  float fastest = 0.0f;
  for (const float v : Values(source, "Velocity"))
  {
    ASSERT_TRUE(std::isfinite(v));
    fastest = std::max(fastest, std::abs(v));
  }
  EXPECT_GT(fastest, 0.01f);

  std::vector<waft::Vortex> vortices;
  auto* lines = vtkPolyData::SafeDownCast(source->GetOutputDataObject(1));
  ASSERT_TRUE(waft::VorticesFromPolyData(lines, vortices));
  ASSERT_EQ(vortices.size(), 10u);
  // The array is the sum of the closed forms.
  double point[3];
  smoke->GetPoint(1000, point);
  waft::Vec3 expected = waft::Vec3::Zero();
  for (const waft::Vortex& vortex : vortices)
  {
    expected += vortex.Acceleration(waft::Vec3(point), 0.1);
  }
  EXPECT_NEAR(Values(source, "VortexForce")[3001], expected.y(), 1e-5);
  waft::SceneInfo info;
  ASSERT_TRUE(waft::SceneInfoFromFieldData(smoke, info));
  EXPECT_EQ(info.Time.NumberOfFrames, 10);
  EXPECT_EQ(info.Seed, 1u);
  auto* obstacles = vtkPolyData::SafeDownCast(source->GetOutputDataObject(2));
  EXPECT_GT(obstacles->GetNumberOfPolys(), 0);
  EXPECT_GT(source->GetCacheSize(), 0.0);
}

TEST(GridSmokeSource, StepsOutOfOrderEqualStepsInOrder)
{
  vtkNew<vtkGridSmokeSource> inOrder;
  MakeSmall(inOrder);
  std::vector<std::vector<float>> frames;
  for (int frame = 0; frame < 10; ++frame)
  {
    inOrder->UpdateTimeStep(frame / 30.0);
    frames.push_back(Values(inOrder, "Velocity"));
  }
  EXPECT_NE(frames[0], frames[9]);
  vtkNew<vtkGridSmokeSource> outOfOrder;
  MakeSmall(outOfOrder);
  outOfOrder->SetCacheLimit(1); // a few frames only
  for (const int frame : { 9, 2, 7, 0, 5 })
  {
    outOfOrder->UpdateTimeStep(frame / 30.0);
    EXPECT_EQ(Values(outOfOrder, "Velocity"), frames[frame]) << "frame " << frame;
    EXPECT_LE(outOfOrder->GetCacheSize(), 1.0);
  }
}

TEST(GridSmokeSource, SeedAndParametersDescribeTheRun)
{
  vtkNew<vtkGridSmokeSource> source;
  MakeSmall(source);
  source->Update();
  const std::vector<float> first = Values(source, "Velocity");
  const vtkMTimeType time = Smoke(source)->GetMTime();
  source->Update();
  EXPECT_EQ(Smoke(source)->GetMTime(), time); // nothing changed, nothing ran
  source->SetSeed(2);
  source->Update();
  EXPECT_NE(Values(source, "Velocity"), first);
  source->SetSeed(1);
  source->Update();
  EXPECT_EQ(Values(source, "Velocity"), first);
}

TEST(GridSmokeSource, TakesObstaclesThatMoveAndVortices)
{
  vtkNew<MovingBoxSource> box;
  waft::Vortex vortex;
  vortex.VortexId = 6;
  vortex.Strength = 3.0;
  vtkNew<vtkPolyData> lines;
  waft::VorticesToPolyData({ vortex }, waft::SceneInfo(), lines);
  vtkNew<vtkGridSmokeSource> source;
  MakeSmall(source);
  source->SetWarmUpSeconds(0.0);
  source->SetNumberOfVortices(1);
  source->SetNumberOfWinds(0);
  source->SetNumberOfObstacles(0);
  source->SetInputConnection(1, box->GetOutputPort());
  source->SetInputDataObject(3, lines);
  source->UpdateTimeStep(0.3);
  EXPECT_EQ(box->Requests, 10);
  std::vector<waft::Vortex> vortices;
  ASSERT_TRUE(waft::VorticesFromPolyData(vtkPolyData::SafeDownCast(source->GetOutputDataObject(1)),
                                         vortices));
  ASSERT_EQ(vortices.size(), 2u);
  EXPECT_EQ(vortices[0].VortexId, 6);
  EXPECT_EQ(vortices[1].VortexId, 7);
  // 1.6 m of box over 0.333 m voxels, solid inside; its front pushes the air.
  vtkImageData* smoke = Smoke(source);
  const auto indexAt = [smoke](double x, double y, double z) { return PointAt(smoke, x, y, z); };
  vtkDataArray* solid = smoke->GetPointData()->GetArray("Obstacle");
  EXPECT_EQ(solid->GetTuple1(indexAt(0.2, 0.0, 2.0)), 1.0);
  EXPECT_EQ(solid->GetTuple1(indexAt(1.5, 0.0, 2.0)), 0.0);
  EXPECT_GT(Values(source, "Velocity")[3 * indexAt(1.2, 0.2, 2.2)], 0.1f);
  source->UpdateTimeStep(0.1);
  EXPECT_EQ(box->Requests, 10); // its steps are kept
}

TEST(GridSmokeSource, TakesAWindAsImage)
{
  vtkNew<vtkImageData> wind;
  wind->SetDimensions(2, 2, 2);
  wind->SetOrigin(-2.0, -2.0, 0.0);
  wind->SetSpacing(4.0, 4.0, 4.0);
  vtkNew<vtkFloatArray> values;
  values->SetName("Wind");
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(8);
  for (int i = 0; i < 8; ++i)
  {
    values->SetTuple3(i, 0.5, 0.0, 0.0);
  }
  wind->GetPointData()->AddArray(values);
  vtkNew<vtkGridSmokeSource> source;
  MakeSmall(source);
  source->SetNumberOfVortices(0);
  source->SetNumberOfWinds(0);
  source->SetNumberOfObstacles(0);
  source->SetBoundaryX(vtkGridSmokeSource::PERIODIC);
  source->SetInputDataObject(2, wind);
  source->UpdateTimeStep(0.3);
  EXPECT_NEAR(Values(source, "WindForce")[300], 0.5, 1e-6);
  const vtkIdType middle = PointAt(Smoke(source), 0.0, 0.0, 2.0);
  EXPECT_NEAR(Values(source, "Velocity")[3 * middle], 0.25, 0.02); // 0.5 s at 0.5 m/s^2
}

TEST(GridSmokeSource, StopsWithTheLastFrameItReached)
{
  vtkNew<vtkGridSmokeSource> source;
  MakeSmall(source);
  {
    const AbortBeyond stop(source, 0.45);
    source->UpdateTimeStep(0.3);
  }
  ASSERT_EQ(Smoke(source)->GetNumberOfPoints(), 1728);
  EXPECT_NEAR(Smoke(source)->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 4.0 / 30.0,
              1e-12);
  const std::vector<float> reached = Values(source, "Velocity");
  source->UpdateTimeStep(4.0 / 30.0);
  EXPECT_EQ(Values(source, "Velocity"), reached);
  source->UpdateTimeStep(0.3);
  EXPECT_NE(Values(source, "Velocity"), reached);
}

TEST(GridSmokeSource, NamesWhatIsWrong)
{
  vtkNew<vtkGridSmokeSource> wrong;
  MakeSmall(wrong);
  wrong->SetWindRadius(0.5, 0.1);
  ErrorLog errors(wrong);
  wrong->Update();
  EXPECT_TRUE(errors.Contains("WindRadius")) << errors.Text;
  EXPECT_EQ(Smoke(wrong)->GetNumberOfPoints(), 0);

  vtkNew<vtkGridSmokeSource> empty;
  MakeSmall(empty);
  vtkNew<vtkImageData> noArrays;
  noArrays->SetDimensions(2, 2, 2);
  empty->SetInputDataObject(2, noArrays);
  ErrorLog more(empty);
  empty->Update();
  EXPECT_TRUE(more.Contains("Wind")) << more.Text;
}
