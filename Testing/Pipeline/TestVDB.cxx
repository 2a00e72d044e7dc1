// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/TemporaryFolder.h"
#include "Bridge/Data/SceneData.h"
#include "Volumes/VolumeFile.h"

#include <vtkFloatArray.h>
#include <vtkGridSmokeSource.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrajectoryTraceFilter.h>
#include <vtkVDBReader.h>
#include <vtkVDBWriter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace
{

constexpr int Frames = 6;

void MakeSmall(vtkGridSmokeSource* source)
{
  source->SetResolution(12, 10, 14);
  source->SetNumberOfFrames(Frames);
  source->SetWarmUpSeconds(1.0);
}

/// Smoke that is to be written into a folder.
struct SmokeFiles
{
  explicit SmokeFiles(const std::string& name)
  {
    MakeSmall(this->Smoke);
    this->Writer->SetInputConnection(this->Smoke->GetOutputPort());
    this->Writer->SetFileName(this->Folder.File(name));
  }

  waft::test::TemporaryFolder Folder;
  vtkNew<vtkGridSmokeSource> Smoke;
  vtkNew<vtkVDBWriter> Writer;
};

std::vector<float> Values(vtkDataObject* data, const char* name)
{
  auto* array =
    vtkFloatArray::SafeDownCast(vtkImageData::SafeDownCast(data)->GetPointData()->GetArray(name));
  return array ? std::vector<float>(array->GetPointer(0),
                                    array->GetPointer(0) + array->GetNumberOfValues())
               : std::vector<float>();
}

double TimeOf(vtkDataObject* data)
{
  return data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
}

} // namespace

TEST(VDB, SmokeComesBackAsItWas)
{
  const SmokeFiles files("smoke.vdb");
  const waft::test::TemporaryFolder& folder = files.Folder;
  vtkGridSmokeSource* smoke = files.Smoke;
  vtkVDBWriter* writer = files.Writer;
  writer->UpdateTimeStep(2.0 / 30.0);
  EXPECT_EQ(folder.Names().size(), static_cast<std::size_t>(Frames));
  EXPECT_EQ(folder.Names().front(), "smoke_0000.vdb");
  EXPECT_EQ(folder.Names().back(), "smoke_0005.vdb");
  // It passes on what was asked for, then and later.
  EXPECT_NEAR(TimeOf(writer->GetOutputDataObject(0)), 2.0 / 30.0, 1e-12);
  std::vector<std::vector<float>> velocities;
  for (int frame = 0; frame < Frames; ++frame)
  {
    smoke->UpdateTimeStep(frame / 30.0);
    velocities.push_back(Values(smoke->GetOutputDataObject(0), "Velocity"));
  }
  EXPECT_EQ(Values(writer->GetOutputDataObject(0), "Velocity"), velocities[2]);
  const auto written = std::filesystem::last_write_time(folder.File("smoke_0003.vdb"));
  writer->UpdateTimeStep(4.0 / 30.0);
  EXPECT_EQ(Values(writer->GetOutputDataObject(0), "Velocity"), velocities[4]);
  EXPECT_EQ(std::filesystem::last_write_time(folder.File("smoke_0003.vdb")), written);

  vtkNew<vtkVDBReader> reader;
  reader->SetFileName(folder.File("smoke_0004.vdb")); // any of them
  EXPECT_EQ(TimeSteps(reader), TimeSteps(smoke));
  for (const int frame : { 5, 0, 3 })
  {
    smoke->UpdateTimeStep(frame / 30.0);
    reader->UpdateTimeStep(frame / 30.0);
    auto* before = vtkImageData::SafeDownCast(smoke->GetOutputDataObject(0));
    vtkImageData* after = reader->GetOutput();
    EXPECT_NEAR(TimeOf(after), frame / 30.0, 1e-12);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(after->GetDimensions()[axis], before->GetDimensions()[axis]);
      EXPECT_NEAR(after->GetOrigin()[axis], before->GetOrigin()[axis], 1e-12);
      EXPECT_NEAR(after->GetSpacing()[axis], before->GetSpacing()[axis], 1e-12);
    }
    for (const char* name :
         { "Velocity", "Density", "Pressure", "Vorticity", "VortexForce", "WindForce" })
    {
      EXPECT_FALSE(Values(after, name).empty()) << name;
      EXPECT_EQ(Values(after, name), Values(before, name)) << name << " of frame " << frame;
    }
    waft::SceneInfo scene;
    ASSERT_TRUE(waft::SceneInfoFromFieldData(after, scene));
    EXPECT_EQ(scene.Time.NumberOfFrames, Frames);
    EXPECT_EQ(scene.Bounds.Max.z(), 4.0);
  }
  reader->SetFramesPerSecond(10.0);
  EXPECT_NEAR(TimeSteps(reader)[3], 0.3, 1e-12);
}

TEST(VDB, TracersFollowWhatIsReadAsTheyFollowedTheSmoke)
{
  const SmokeFiles files("air.vdb");
  const waft::test::TemporaryFolder& folder = files.Folder;
  vtkGridSmokeSource* smoke = files.Smoke;
  vtkVDBWriter* writer = files.Writer;
  EXPECT_TRUE(writer->Write());
  vtkNew<vtkVDBReader> reader;
  reader->SetFileName(folder.File("air_0000.vdb"));
  std::vector<std::vector<double>> paths;
  for (vtkAlgorithm* source :
       { static_cast<vtkAlgorithm*>(smoke), static_cast<vtkAlgorithm*>(reader) })
  {
    vtkNew<vtkTrajectoryTraceFilter> trace;
    trace->SetSeedStride(2);
    trace->SetInputConnection(0, source->GetOutputPort());
    trace->Update();
    auto* tracks = vtkPolyData::SafeDownCast(trace->GetOutputDataObject(0));
    ASSERT_GT(tracks->GetNumberOfPoints(), 500);
    paths.emplace_back();
    for (vtkIdType i = 0; i < tracks->GetNumberOfPoints(); ++i)
    {
      paths.back().insert(paths.back().end(), tracks->GetPoint(i), tracks->GetPoint(i) + 3);
    }
  }
  ASSERT_EQ(paths[0].size(), paths[1].size());
  for (std::size_t i = 0; i < paths[0].size(); ++i)
  {
    ASSERT_NEAR(paths[0][i], paths[1][i], 1e-12);
  }
}

TEST(VDB, VelocitiesOfOtherProgramsServeAsWind)
{
  const waft::test::TemporaryFolder folder;
  for (const int frame : { 3, 4 })
  {
    waft::Volume volume;
    volume.Dimensions = { 3, 3, 3 };
    volume.Origin = waft::Vec3(-2.0, -2.0, 0.0);
    volume.Spacing = waft::Vec3(2.0, 2.0, 2.0);
    waft::VolumeField field;
    field.Name = "vel";
    field.Components = 3;
    field.Values.assign(81, 0.0f);
    for (std::size_t i = 0; i < 81; i += 3)
    {
      field.Values[i] = static_cast<float>(frame);
    }
    volume.Fields = { field };
    const std::string name = folder.File("gust_" + std::to_string(frame) + ".vdb");
    ASSERT_TRUE(waft::WriteVolume(name, volume, waft::SceneInfo()));
  }
  vtkNew<vtkVDBReader> reader;
  reader->SetFileName(folder.File("gust_3.vdb"));
  reader->SetFramesPerSecond(15.0);
  EXPECT_EQ(TimeSteps(reader), (std::vector<double>{ 3.0 / 15.0, 4.0 / 15.0 }));
  vtkNew<vtkGridSmokeSource> smoke;
  MakeSmall(smoke);
  smoke->SetNumberOfVortices(0);
  smoke->SetNumberOfWinds(0);
  smoke->SetNumberOfObstacles(0);
  smoke->SetNumberOfFrames(10);
  smoke->SetWarmUpSeconds(0.0);
  smoke->SetWindDrag(2.0);
  smoke->SetBoundaryX(vtkGridSmokeSource::PERIODIC);
  smoke->SetInputConnection(2, reader->GetOutputPort());
  // At 7 / 30 s half way between the two files: drag 2 (3.5 - u).
  smoke->UpdateTimeStep(7.0 / 30.0);
  const std::vector<float> force = Values(smoke->GetOutputDataObject(0), "WindForce");
  const std::vector<float> velocity = Values(smoke->GetOutputDataObject(0), "Velocity");
  const std::size_t middle = 3 * (6 + 12 * (5 + 10 * 7));
  EXPECT_GT(velocity[middle], 0.5f);
  EXPECT_NEAR(force[middle], 2.0 * (3.5 - velocity[middle]), 0.2);
}

TEST(VDB, AnImageWithoutTimeIsOneFile)
{
  const waft::test::TemporaryFolder folder;
  vtkNew<vtkImageData> wind;
  MakeEvenWind(wind, "Wind", { 2.0, 0.0, 0.0 });
  vtkNew<vtkVDBWriter> writer;
  writer->SetInputData(wind);
  writer->SetFileName(folder.File("wind.vdb"));
  EXPECT_TRUE(writer->Write());
  EXPECT_EQ(folder.Names(), std::vector<std::string>{ "wind.vdb" });
  vtkNew<vtkVDBReader> reader;
  reader->SetFileName(folder.File("wind.vdb"));
  reader->Update();
  EXPECT_EQ(Values(reader->GetOutput(), "Wind"), Values(wind, "Wind"));
  waft::SceneInfo scene;
  ASSERT_TRUE(waft::SceneInfoFromFieldData(reader->GetOutput(), scene));
  EXPECT_EQ(scene.Bounds.Max.x(), 2.0);
}

TEST(VDB, StoppedItKeepsTheFilesThatAreWhole)
{
  const SmokeFiles files("smoke.vdb");
  const waft::test::TemporaryFolder& folder = files.Folder;
  vtkVDBWriter* writer = files.Writer;
  {
    const AbortBeyond stop(writer, 0.3);
    EXPECT_FALSE(writer->Write());
  }
  EXPECT_EQ(folder.Names().size(), 3u);
  EXPECT_TRUE(writer->Write());
  EXPECT_EQ(folder.Names().size(), static_cast<std::size_t>(Frames));
}

TEST(VDB, NamesWhatIsWrong)
{
  const waft::test::TemporaryFolder folder;
  vtkNew<vtkImageData> wind;
  MakeEvenWind(wind, "Wind", { 2.0, 0.0, 0.0 });
  {
    vtkNew<vtkVDBWriter> writer;
    writer->SetInputData(wind);
    ErrorLog errors(writer);
    EXPECT_FALSE(writer->Write());
    EXPECT_TRUE(errors.Contains("FileName")) << errors.Text;
  }
  for (const std::string& name : { folder.File("wind.txt"), folder.File("none/wind.vdb") })
  {
    vtkNew<vtkVDBWriter> writer;
    writer->SetInputData(wind);
    writer->SetFileName(name);
    ErrorLog errors(writer);
    EXPECT_FALSE(writer->Write());
    EXPECT_TRUE(errors.Contains(name)) << errors.Text;
  }
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 2);
  vtkNew<vtkVDBWriter> writer;
  writer->SetInputData(bare);
  writer->SetFileName(folder.File("bare.vdb"));
  ErrorLog noArrays(writer);
  EXPECT_FALSE(writer->Write());
  EXPECT_TRUE(noArrays.Contains("point data array")) << noArrays.Text;
  EXPECT_TRUE(folder.Names().empty());
  const std::string own = folder.Write("own.vdb", "of another program");
  for (const std::string& name : { own, folder.File("new.vdb"), folder.File("new.vdb") })
  {
    vtkNew<vtkVDBWriter> again;
    again->SetInputData(wind);
    again->SetFileName(name);
    ErrorLog errors(again);
    EXPECT_EQ(again->Write(), name != own);
    EXPECT_EQ(errors.Contains(own + ": nothing was written"), name == own) << errors.Text;
  }
  EXPECT_EQ(std::filesystem::file_size(own), 18u);

  vtkNew<vtkVDBReader> reader;
  ErrorLog errors(reader);
  reader->Update();
  EXPECT_TRUE(errors.Contains("FileName")) << errors.Text;
  reader->SetFileName(folder.File("missing.vdb"));
  reader->Update();
  EXPECT_TRUE(errors.Contains("missing.vdb")) << errors.Text;
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
}
