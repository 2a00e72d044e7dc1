// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files are read the same however they keep their values.
#include "Base/TemporaryFolder.h"
#include "Bridge/Files/DataFiles.h"
#include "Files/FileBytes.h"
#include "Files/InlineData.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace waft;

namespace
{

struct Way
{
  bool IsRaw;
  int Compressor, Order, Header; // as the writers have them
};

std::vector<Way> Ways()
{
  std::vector<Way> ways;
  for (const bool isRaw : { false, true })
  {
    for (const int compressor : { vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4 })
    {
      for (const int order : { vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian })
      {
        for (const int header : { vtkXMLWriter::UInt32, vtkXMLWriter::UInt64 })
        {
          ways.push_back({ isRaw, compressor, order, header });
        }
      }
    }
  }
  return ways;
}

template <class Writer, class Data>
void Write(const Way& way, Data* data, const std::string& path)
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(data);
  writer->SetFileName(path.c_str());
  writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(!way.IsRaw);
  writer->SetCompressorType(way.Compressor);
  writer->SetByteOrder(way.Order);
  writer->SetHeaderType(way.Header);
  EXPECT_EQ(writer->Write(), 1);
  FileBytes file;
  EXPECT_TRUE(file.Open(path));
  EXPECT_NE(file.View().find("<AppendedData"), std::string_view::npos);
  const std::string made = WithInlineData(file.View());
  EXPECT_FALSE(made.empty());
  EXPECT_EQ(made.find("ppended"), std::string::npos);
}

void ExpectSame(vtkDataArray* found, vtkDataArray* wanted)
{
  ASSERT_NE(found, nullptr);
  ASSERT_EQ(found->GetNumberOfTuples(), wanted->GetNumberOfTuples());
  ASSERT_EQ(found->GetDataType(), wanted->GetDataType());
  for (vtkIdType i = 0; i < wanted->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < wanted->GetNumberOfComponents(); ++c)
    {
      ASSERT_EQ(found->GetComponent(i, c), wanted->GetComponent(i, c)) << i;
    }
  }
}

} // namespace

TEST(DataFiles, SurfacesAreReadHoweverTheyKeepTheirValues)
{
  vtkNew<vtkPolyData> surface; // of more than a block of 32 kB
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkFloatArray> heights;
  heights->SetName("Height");
  for (vtkIdType i = 0; i < 20000; ++i)
  {
    const double x = 0.01 * static_cast<double>(i);
    points->InsertNextPoint(x, std::cos(x), i % 2);
    heights->InsertNextValue(static_cast<float>(std::sin(x)));
    const vtkIdType corners[] = { i - 2, i - 1, i };
    if (i >= 2)
    {
      triangles->InsertNextCell(3, corners);
    }
  }
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  surface->GetPointData()->AddArray(heights);
  vtkNew<vtkDoubleArray> nothing;
  nothing->SetName("Nothing");
  surface->GetFieldData()->AddArray(nothing);
  vtkNew<vtkStringArray> words;
  words->SetName("Words");
  words->InsertNextValue("leaf");
  words->InsertNextValue("air & <wind>");
  surface->GetFieldData()->AddArray(words);
  const test::TemporaryFolder folder;
  const std::string path = (folder.Path() / "surface.vtp").string();
  for (const Way& way : Ways())
  {
    Write<vtkXMLPolyDataWriter>(way, surface.Get(), path);
    vtkNew<vtkPolyData> read;
    const Result result = ReadPolyDataFile(path, read);
    ASSERT_TRUE(result) << result.Message();
    ExpectSame(read->GetPoints()->GetData(), surface->GetPoints()->GetData());
    ExpectSame(read->GetPointData()->GetArray("Height"), heights);
    ASSERT_EQ(read->GetNumberOfPolys(), surface->GetNumberOfPolys());
    auto* said = vtkStringArray::SafeDownCast(read->GetFieldData()->GetAbstractArray("Words"));
    ASSERT_NE(said, nullptr);
    EXPECT_EQ(said->GetValue(1), "air & <wind>");
    EXPECT_NE(read->GetFieldData()->GetArray("Nothing"), nullptr);
  }
}

TEST(DataFiles, SoAreImages)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(12, 13, 14);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Velocity");
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < 3 * values->GetNumberOfTuples(); ++i)
  {
    values->SetValue(i, std::sin(0.1 * static_cast<double>(i)));
  }
  image->GetPointData()->AddArray(values);
  const test::TemporaryFolder folder;
  const std::string path = (folder.Path() / "image.vti").string();
  for (const Way& way : Ways())
  {
    Write<vtkXMLImageDataWriter>(way, image.Get(), path);
    vtkNew<vtkImageData> read;
    const Result result = ReadImageFile(path, read);
    ASSERT_TRUE(result) << result.Message();
    ExpectSame(read->GetPointData()->GetArray("Velocity"), values);
  }
}

TEST(DataFiles, SoAreBlocks)
{
  vtkNew<vtkDoubleArray> values;
  values->SetName("Values");
  for (int i = 0; i < 9000; ++i)
  {
    values->InsertNextValue(std::sqrt(static_cast<double>(i)));
  }
  vtkNew<vtkTable> table;
  table->AddColumn(values);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, table);
  blocks->SetBlock(1, table);
  const test::TemporaryFolder folder;
  const std::string path = (folder.Path() / "all of it & more.vtm").string();
  for (const bool isAppended : { true, false })
  {
    vtkNew<vtkXMLMultiBlockDataWriter> writer;
    writer->SetInputDataObject(blocks);
    writer->SetFileName(path.c_str());
    writer->SetDataMode(isAppended ? vtkXMLWriter::Appended : vtkXMLWriter::Binary);
    ASSERT_EQ(writer->Write(), 1);
    vtkNew<vtkMultiBlockDataSet> read;
    const Result result = ReadBlocksFile(path, read);
    ASSERT_TRUE(result) << result.Message();
    ASSERT_EQ(read->GetNumberOfBlocks(), 2U);
    auto* found = vtkTable::SafeDownCast(read->GetBlock(1));
    ASSERT_NE(found, nullptr);
    ExpectSame(vtkDataArray::SafeDownCast(found->GetColumnByName("Values")), values);
  }
}

TEST(DataFiles, TextWithoutAppendedValuesIsLeft)
{
  EXPECT_EQ(WithInlineData("<VTKFile><PolyData/></VTKFile>"), "");
  EXPECT_EQ(WithInlineData("no XML"), "");
  EXPECT_EQ(WithInlineData("<VTKFile><AppendedData encoding=\"raw\">"), "");
}
