// SPDX-License-Identifier: BSD-3-Clause
// What the files of a flight keep of its data, and what they leave out to be small.
#include "Bridge/Files/DataWriting.h"
#include "Bridge/Files/FlightFiles.h"
#include "Bridge/Files/SeriesFiles.h"

#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLPolyDataReader.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

using namespace waft;

namespace
{

std::string TestFolder()
{
  const std::string folder = ::testing::TempDir() + "waft_" +
                             ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::create_directories(folder);
  return folder;
}

vtkSmartPointer<vtkDoubleArray> Numbers(const char* name, int components, vtkIdType count)
{
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    array->SetValue(i, normal(random));
  }
  return array;
}

} // namespace

TEST(FlightFiles, MotionKeepsAllDigitsAndWhatDrivesItSeven)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(Numbers("", 3, 50));
  data->SetPoints(points);
  for (const char* name : { "Orientation", "Torque" })
  {
    data->GetPointData()->AddArray(Numbers(name, 3, 50));
  }
  DataFileForm form;
  form.IsRounded = true;
  form.Exact = { "Orientation" };
  const std::string path = TestFolder() + "/poses.vtp";
  ASSERT_TRUE(WriteDataFile(path, data, form));
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  for (vtkIdType i = 0; i < 50; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(reader->GetOutput()->GetPoint(i)[k], data->GetPoint(i)[k]);
      const auto at = [i, k](vtkPolyData* of, const char* name)
      { return of->GetPointData()->GetArray(name)->GetComponent(i, k); };
      EXPECT_EQ(at(reader->GetOutput(), "Orientation"), at(data, "Orientation"));
      const double torque = at(data, "Torque");
      EXPECT_NE(at(reader->GetOutput(), "Torque"), torque);
      EXPECT_NEAR(at(reader->GetOutput(), "Torque"), torque, 6e-8 * std::abs(torque));
    }
  }
}

TEST(FlightFiles, AnAirIsRoundedToWhatIsTypical)
{
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  vtkNew<vtkImageData> image;
  image->SetDimensions(12, 11, 10);
  vtkNew<vtkFloatArray> air;
  air->SetName("Velocity");
  air->SetNumberOfComponents(3);
  air->SetNumberOfTuples(image->GetNumberOfPoints());
  std::vector<float> before;
  double squares = 0.0;
  for (vtkIdType i = 0; i < air->GetNumberOfValues(); ++i)
  {
    before.push_back(i < 300 ? 0.0f : normal(random));
    squares += before.back() * before.back();
    air->SetValue(i, before.back());
  }
  image->GetPointData()->AddArray(air);
  RoundPoints(image, 8);
  const double typical = std::sqrt(squares / static_cast<double>(before.size()));
  double off = 0.0;
  for (vtkIdType i = 0; i < air->GetNumberOfValues(); ++i)
  {
    const float value = air->GetValue(i), given = before[static_cast<std::size_t>(i)];
    EXPECT_TRUE(given != 0.0f || value == 0.0f);
    EXPECT_LE(std::abs(value - given), typical / 256);
    off += (value - given) * (value - given);
  }
  EXPECT_LT(std::sqrt(off / static_cast<double>(before.size())), typical / 512);
  air->FillValue(0.0f);
  RoundPoints(image, 8);
  EXPECT_EQ(air->GetValue(0), 0.0f);
}

TEST(FlightFiles, TimesKeepTheirDistanceAndTheLastIsThere)
{
  using Steps = std::vector<std::size_t>;
  const auto chosen = [](int count, double rate) {
    return Spaced(TimesOf(Timeline{ count, rate }), 0.1);
  };
  EXPECT_EQ(chosen(11, 30.0), (Steps{ 0, 3, 6, 9, 10 }));
  EXPECT_EQ(chosen(10, 30.0), (Steps{ 0, 3, 6, 9 }));
  EXPECT_EQ(chosen(10, 24.0), (Steps{ 0, 2, 4, 6, 8, 9 }));
  EXPECT_EQ(chosen(5, 8.0), (Steps{ 0, 1, 2, 3, 4 })); // frames that are farther apart
  EXPECT_EQ(chosen(1, 30.0), Steps{ 0 });
  EXPECT_EQ(Spaced({ 0.0, 0.1, 0.2 }, 0.0), (Steps{ 0, 1, 2 }));
}

TEST(FlightFiles, TablesHoldNumbersWholeAndTextsAsTexts)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("Residual");
  vtkNew<vtkStringArray> texts;
  texts->SetName("Message");
  for (const auto& [number, text] :
       { std::pair(0.1, "a, \"b\""), { std::nan(""), "=SUM(A1)" }, { -1.0 / 3.0, "-0.5" } })
  {
    numbers->InsertNextValue(number);
    texts->InsertNextValue(text);
  }
  table->AddColumn(numbers);
  table->AddColumn(texts);
  const std::string path = TestFolder() + "/table.csv";
  ASSERT_TRUE(WriteCsv(path, table, { "Message", "Residual" }));
  std::stringstream written;
  written << std::ifstream(path).rdbuf();
  EXPECT_EQ(written.str(), "Message,Residual\n\"a, \"\"b\"\"\",0.10000000000000001\n"
                           "'=SUM(A1),\n-0.5,-0.33333333333333331\n");
  const Result failed = WriteCsv(path + "/none.csv", table, {});
  EXPECT_NE(failed.Message().find("none.csv"), std::string::npos);
}
