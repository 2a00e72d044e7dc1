// SPDX-License-Identifier: BSD-3-Clause
// Winds that a scene file names: images, series of them, volumes.
#include "PipelineTesting.h"

#include "Base/TemporaryFolder.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMotionSceneReader.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataWriter.h>

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

namespace
{

void WriteWind(const std::string& file, const char* array, double value)
{
  vtkNew<vtkImageData> image;
  MakeEvenWind(image, array, { value, 0.0, 2.0 * value });
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->Write();
}

vtkImageData* WindAt(vtkMotionSceneReader* reader, double time)
{
  reader->UpdateInformation();
  reader->GetOutputInformation(vtkMotionSceneReader::WIND)
    ->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  reader->Update(vtkMotionSceneReader::WIND);
  return vtkImageData::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::WIND));
}

} // namespace

TEST(SceneWinds, WindFilesAndSeries)
{
  waft::test::TemporaryFolder folder;
  WriteWind(folder.File("a.vti"), "Wind", 1.0);
  WriteWind(folder.File("b.vti"), "Wind", 3.0);
  WriteWind(folder.File("v.vti"), "Velocity", 1.0);
  folder.Write("series.pvd", R"(<VTKFile type="Collection"><Collection>
    <DataSet timestep="0" file="a.vti"/><DataSet timestep="2" file="b.vti"/>
    </Collection></VTKFile>)");
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(
    folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "series.pvd"}]})"));
  vtkImageData* wind = WindAt(reader, 1.0);
  vtkDataArray* values = wind->GetPointData()->GetArray("Wind");
  ASSERT_TRUE(values);
  EXPECT_EQ(values->GetNumberOfTuples(), 27);
  EXPECT_NEAR(values->GetComponent(13, 0), 2.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(13, 2), 4.0, 1e-6);

  reader->SetFileName(folder.Write("v.waft.json", R"({"waft": 1, "winds": [{"file": "v.vti"}]})"));
  wind = WindAt(reader, 1.0);
  EXPECT_TRUE(wind->GetPointData()->HasArray("Velocity"));
  EXPECT_FALSE(wind->GetPointData()->HasArray("Wind"));

  ErrorLog errors(reader);
  reader->SetFileName(folder.Write(
    "mixed.waft.json", R"({"waft": 1, "winds": [{"file": "v.vti"}, {"file": "a.vti"}]})"));
  reader->Update();
  EXPECT_TRUE(errors.Contains("/winds/0/file: expected the only wind")) << errors.Text;
}

TEST(SceneWinds, TimesOfASeriesIncrease)
{
  waft::test::TemporaryFolder folder;
  WriteWind(folder.File("a.vti"), "Wind", 1.0);
  for (const auto& [first, second, part] :
       { std::array{ "1", "0", "timesteps that increase, found 0 s after 1 s" },
         std::array{ "1", "1", "timesteps that increase" },
         std::array{ "0", "", "expected a timestep that is a number" },
         std::array{ "0", "nan", "expected a timestep that is a number" } })
  {
    vtkNew<vtkMotionSceneReader> reader;
    ErrorLog errors(reader);
    folder.Write("series.pvd", std::string("<VTKFile type=\"Collection\"><Collection>") +
                                 "<DataSet timestep=\"" + first + "\" file=\"a.vti\"/>" +
                                 "<DataSet timestep=\"" + second + "\" file=\"a.vti\"/>" +
                                 "</Collection></VTKFile>");
    reader->SetFileName(
      folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "series.pvd"}]})"));
    reader->Update();
    EXPECT_TRUE(errors.Contains(part)) << errors.Text;
  }
}

// Fixtures/wind_0000.vdb and wind_0030.vdb: 5^3 voxels of 1 m from (-2, -2, 0) on with
// Wind = (s, s / 2, x), s = 1 and 3.
TEST(SceneWinds, VolumesAreASeriesByTheirNumbers)
{
  waft::test::TemporaryFolder folder;
  const std::string fixtures = std::string(WAFT_SOURCE_DIR) + "/Testing/Pipeline/Fixtures";
  for (const char* name : { "wind_0000.vdb", "wind_0030.vdb" })
  {
    std::filesystem::copy_file(fixtures + "/" + name, folder.File(name));
  }
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(
    folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "wind_0000.vdb"}]})"));
  vtkImageData* wind = WindAt(reader, 0.5);
  vtkDataArray* values = wind->GetPointData()->GetArray("Wind");
  ASSERT_TRUE(values);
  ASSERT_EQ(values->GetNumberOfTuples(), 125);
  const vtkIdType point = wind->FindPoint(1.0, 0.0, 3.0);
  EXPECT_NEAR(values->GetComponent(point, 0), 2.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(point, 1), 1.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(point, 2), 1.0, 1e-6);
}
