// SPDX-License-Identifier: BSD-3-Clause
// Winds that a scene file names: images, series of them, volumes.
#include "PipelineTesting.h"

#include "Base/TemporaryFolder.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMotionSceneReader.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataWriter.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

double ValueAt(vtkImageData* wind, const char* array, int component)
{
  vtkDataArray* values = wind->GetPointData()->GetArray(array);
  EXPECT_TRUE(values) << array;
  return values != nullptr ? values->GetComponent(values->GetNumberOfTuples() / 2, component) : NAN;
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

// Of a series without end what the scene lasts is read, and no more is looked for.
TEST(SceneWinds, SeriesAreReadToTheEndOfTheScene)
{
  waft::test::TemporaryFolder folder;
  WriteWind(folder.File("a.vti"), "Wind", 1.0);
  WriteWind(folder.File("b.vti"), "Wind", 3.0);
  const auto seriesOf = [&folder](double step)
  {
    std::string list = R"(<VTKFile type="Collection"><Collection>)";
    for (int i = 0; i < 12000; ++i)
    {
      list += "<DataSet timestep=\"" + std::to_string(i * step) + "\" file=\"" +
              (i == 0   ? "a.vti"
               : i == 1 ? "b.vti"
                        : "none.vti") +
              "\"/>";
    }
    folder.Write("series.pvd", list + "</Collection></VTKFile>");
    return folder.Write("a.waft.json", R"({"waft": 1, "time": {"frames": 31}, "winds": [{"file":
      "series.pvd"}]})");
  };
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(seriesOf(1.0));
  EXPECT_NEAR(ValueAt(WindAt(reader, 0.5), "Wind", 0), 2.0, 1e-6);
  ErrorLog errors(reader);
  reader->SetFileName(seriesOf(1e-5));
  reader->Update();
  EXPECT_TRUE(errors.Contains("at most 10000 files up to the end of the scene")) << errors.Text;
}

TEST(SceneWinds, TimesOfASeriesAreSorted)
{
  waft::test::TemporaryFolder folder;
  WriteWind(folder.File("a.vti"), "Wind", 1.0);
  WriteWind(folder.File("b.vti"), "Wind", 3.0);
  const auto series = [&](const std::string& first, const std::string& second)
  {
    folder.Write("series.pvd", "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"" +
                                 first + "\" file=\"b.vti\"/><DataSet timestep=\"" + second +
                                 "\" file=\"a.vti\"/></Collection></VTKFile>");
    return folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "series.pvd"}]})");
  };
  vtkNew<vtkMotionSceneReader> sorted;
  sorted->SetFileName(series("2", "0"));
  EXPECT_NEAR(ValueAt(WindAt(sorted, 0.5), "Wind", 0), 1.5, 1e-6);
  for (const auto& [first, second, part] :
       { std::array{ "1", "1", "expected one file a timestep, found two at 1 s" },
         std::array{ "0", "", "expected a timestep that is a number" },
         std::array{ "0", "nan", "expected a timestep that is a number" } })
  {
    vtkNew<vtkMotionSceneReader> reader;
    ErrorLog errors(reader);
    reader->SetFileName(series(first, second));
    reader->Update();
    EXPECT_TRUE(errors.Contains(part)) << errors.Text;
  }
}

TEST(SceneWinds, NamesOfOtherProgramsAreVelocities)
{
  waft::test::TemporaryFolder folder;
  for (const char* name : { "U", "vel", "velocity", "v" })
  {
    WriteWind(folder.File("w.vti"), name, 1.0);
    vtkNew<vtkMotionSceneReader> reader;
    reader->SetFileName(
      folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "w.vti"}]})"));
    EXPECT_NEAR(ValueAt(WindAt(reader, 0.0), "Velocity", 2), 2.0, 1e-6) << name;
  }
  WriteWind(folder.File("w.vti"), "Draft", 1.0);
  vtkNew<vtkMotionSceneReader> reader;
  ErrorLog errors(reader);
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "w.vti"}]})"));
  reader->Update();
  EXPECT_TRUE(errors.Contains("`Draft` (3) of points, none of cells: name one by `array`"))
    << errors.Text;
  reader->SetFileName(folder.Write(
    "b.waft.json", R"({"waft": 1, "winds": [{"file": "w.vti", "array": "Draft", "scale": 0.5}]})"));
  EXPECT_NEAR(ValueAt(WindAt(reader, 0.0), "Velocity", 2), 1.0, 1e-6);
}

TEST(SceneWinds, OfCellsAndOfThreeArrays)
{
  waft::test::TemporaryFolder folder;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 5); // 2 x 1 x 4 cells
  image->SetOrigin(-1.0, 0.0, 0.0);
  const char* names[] = { "vel.x", "vel.y", "vel.z" };
  for (int part = 0; part < 3; ++part)
  {
    vtkNew<vtkFloatArray> values;
    values->SetName(names[part]);
    for (int i = 0; i < 8; ++i)
    {
      values->InsertNextValue(static_cast<float>(10 * part + i % 2));
    }
    image->GetCellData()->AddArray(values);
  }
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(folder.File("w.vti").c_str());
  writer->Write();
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "w.vti"}]})"));
  vtkImageData* wind = WindAt(reader, 0.0);
  EXPECT_EQ(wind->GetDimensions()[0], 2);
  EXPECT_EQ(wind->GetDimensions()[1], 1);
  EXPECT_EQ(wind->GetDimensions()[2], 4);
  EXPECT_NEAR(wind->GetOrigin()[0], -0.5, 1e-9);
  const vtkIdType right = PointAt(wind, 0.5, 0.5, 1.5);
  ASSERT_GE(right, 0);
  EXPECT_NEAR(wind->GetPointData()->GetArray("Velocity")->GetComponent(right, 0), 1.0, 1e-6);
  EXPECT_NEAR(wind->GetPointData()->GetArray("Velocity")->GetComponent(right, 2), 21.0, 1e-6);
}

TEST(SceneWinds, OfAFileWhoseYAxisIsUp)
{
  waft::test::TemporaryFolder folder;
  WriteWind(folder.File("w.vti"), "Wind", 1.0); // (1, 0, 2) from (-2, -2, 0) to (2, 2, 4)
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(
    folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "w.vti", "up": "y"}]})"));
  vtkImageData* wind = WindAt(reader, 0.0);
  EXPECT_NEAR(ValueAt(wind, "Wind", 0), 1.0, 1e-6);
  EXPECT_NEAR(ValueAt(wind, "Wind", 1), -2.0, 1e-6);
  EXPECT_NEAR(ValueAt(wind, "Wind", 2), 0.0, 1e-6);
  const double* bounds = wind->GetBounds();
  EXPECT_NEAR(bounds[2], -4.0, 1e-9);
  EXPECT_NEAR(bounds[3], 0.0, 1e-9);
  EXPECT_NEAR(bounds[4], -2.0, 1e-9);
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
  const vtkIdType point = PointAt(wind, 1.0, 0.0, 3.0);
  EXPECT_NEAR(values->GetComponent(point, 0), 2.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(point, 1), 1.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(point, 2), 1.0, 1e-6);
}

TEST(SceneWinds, ASeriesBeginsWithTheFileThatIsNamed)
{
  waft::test::TemporaryFolder folder;
  const std::string fixtures = std::string(WAFT_SOURCE_DIR) + "/Testing/Pipeline/Fixtures";
  std::filesystem::copy_file(fixtures + "/wind_0000.vdb", folder.File("storm-2019.vdb"));
  std::filesystem::copy_file(fixtures + "/wind_0030.vdb", folder.File("storm-2020.vdb"));
  const auto speed = [&](const std::string& fields, double time, const char* warning)
  {
    vtkNew<vtkMotionSceneReader> reader;
    ErrorLog warnings(reader, vtkCommand::WarningEvent);
    reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "winds": [{)" + fields + "}]}"));
    const double value = ValueAt(WindAt(reader, time), "Wind", 0);
    EXPECT_EQ(warnings.Text.empty(), *warning == 0) << warnings.Text;
    EXPECT_TRUE(warnings.Contains(warning)) << warnings.Text;
    return value;
  };
  const char* late = "/winds/0/file: the series begins at frame 2019, the scene ends at frame 299";
  EXPECT_NEAR(speed(R"("file": "storm-2020.vdb")", 5.0, ""), 3.0, 1e-6);
  EXPECT_NEAR(speed(R"("file": "storm-2019.vdb")", 5.0, late), 1.0, 1e-6);
  const std::string placed = R"("file": "storm-2019.vdb", "firstFrame": 30)";
  EXPECT_NEAR(speed(placed, 1.0, ""), 1.0, 1e-6);
  EXPECT_NEAR(speed(placed, 1.0 + 0.5 / 30.0, ""), 2.0, 1e-6);
  EXPECT_NEAR(speed(placed, 2.0, ""), 3.0, 1e-6);
}

TEST(SceneWinds, OutsideOfTheVolumeAreWarnedOf)
{
  waft::test::TemporaryFolder folder;
  WriteWind(folder.File("w.vti"), "Wind", 1.0); // from (-2, -2, 0) to (2, 2, 4)
  const auto warningsOf = [&](const std::string& min, const std::string& max)
  {
    vtkNew<vtkMotionSceneReader> reader;
    ErrorLog warnings(reader, vtkCommand::WarningEvent);
    reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "domain": {"min": )" + min +
                                                      R"(, "max": )" + max +
                                                      R"(}, "winds": [{"file": "w.vti"}]})"));
    reader->Update();
    return warnings.Text;
  };
  EXPECT_NE(
    warningsOf("[10, 10, 0]", "[14, 14, 4]").find("/winds/0/file: the wind's field is outside"),
    std::string::npos);
  EXPECT_EQ(warningsOf("[1, 1, 0]", "[5, 5, 4]"), "");
}
