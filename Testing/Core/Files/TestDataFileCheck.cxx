// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files are looked at before its readers see them, which trust their counts.
#include "Base/TemporaryFolder.h"
#include "Files/DataFileCheck.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

const std::string Surface =
  "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">"
  "<PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">"
  "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">"
  "0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
  "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
  "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>"
  "</Piece></PolyData></VTKFile>";

const std::string Image =
  "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 1 0 1 0 1\" "
  "Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 1 0 1 0 1\"><PointData>"
  "<DataArray type=\"Float32\" Name=\"Wind\" NumberOfComponents=\"3\" format=\"ascii\">"
  "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0</DataArray></PointData></Piece></ImageData>"
  "</VTKFile>";

std::string Changed(std::string text, const std::string& from, const std::string& to)
{
  return text.replace(text.find(from), from.size(), to);
}

class DataFileCheck : public testing::Test
{
protected:
  std::string Error(const std::string& text, const std::string& type) const
  {
    return CheckDataFile(this->Folder.Write("file", text), { type }).Message();
  }
  void ExpectErrors(const std::string& good, const std::string& type,
                    const std::vector<std::array<std::string, 3>>& cases) const
  {
    EXPECT_EQ(this->Error(good, type), "");
    for (const auto& [from, to, part] : cases)
    {
      const std::string message = this->Error(Changed(good, from, to), type);
      EXPECT_NE(message.find(part), std::string::npos) << to << "\n" << message;
    }
  }

  test::TemporaryFolder Folder;
};

} // namespace

TEST_F(DataFileCheck, HoldsCountsAgainstTheFile)
{
  this->ExpectErrors(
    Surface, "PolyData",
    { { { "NumberOfPoints=\"3\"", "NumberOfPoints=\"1000000000000\"", "NumberOfPoints: expected" },
        { "NumberOfPolys=\"1\"", "NumberOfPolys=\"1152921504606846976\"", "NumberOfPolys" },
        { "NumberOfPoints=\"3\"", "NumberOfPoints=\"-1\"", "NumberOfPoints" },
        { "NumberOfPoints=\"3\"", "NumberOfPoints=\"three\"", "\"three\"" },
        { "NumberOfComponents=\"3\"", "NumberOfComponents=\"99999999\"", "NumberOfComponents" },
        { "type=\"Float32\"", "type=\"Complex\"", "a type of numbers" },
        { "type=\"PolyData\"", "type=\"ImageData\"", "of type PolyData" },
        { "LittleEndian", "MiddleEndian", "\"MiddleEndian\"" } } });
}

TEST_F(DataFileCheck, HoldsExtentsAgainstTheFile)
{
  this->ExpectErrors(
    Image, "ImageData",
    { { { "Extent=\"0 1 0 1 0 1\" Origin", "Extent=\"0 99999 0 99999 0 99999\" Origin",
          "WholeExtent" },
        { "Piece Extent=\"0 1 0 1 0 1\"", "Piece Extent=\"1 0 1 0 1 0\"", "Extent" },
        { "Piece Extent=\"0 1 0 1 0 1\"", "Piece Extent=\"0 1 0\"", "Extent" } } });
}

TEST_F(DataFileCheck, RefusesPlacesThatAReaderWouldMakeUp)
{
  this->ExpectErrors(
    Image, "ImageData",
    { { { "Spacing=\"1 1 1\"", "Spacing=\"nan 1 1\"", "Spacing: expected 3 numbers" },
        { "Spacing=\"1 1 1\"", "Spacing=\"1 1\"", "Spacing: expected 3 numbers" },
        { "Spacing=\"1 1 1\"", "Spacing=\"\"", "Spacing: expected 3 numbers" },
        { "Origin=\"0 0 0\"", "Origin=\"inf 0 0\"", "Origin: expected 3 numbers" },
        { "Origin=\"0 0 0\"", "Direction=\"1 0 0 0 1 0 0 0 a\"", "Direction: expected 9" } } });
  EXPECT_EQ(this->Error(Changed(Image, "Spacing=\"1 1 1\"", ""), "ImageData"), "");
}

TEST_F(DataFileCheck, RefusesACutFile)
{
  for (const auto& [good, type] : { std::pair(Surface, "PolyData"), std::pair(Image, "ImageData") })
  {
    for (std::size_t size = 0; size < good.size(); ++size)
    {
      EXPECT_NE(this->Error(good.substr(0, size), type), "") << size;
    }
  }
}

TEST_F(DataFileCheck, LooksAtBlocksAndTheirFiles)
{
  this->Folder.Write("part.vtp", Surface);
  const std::string blocks =
    "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet>"
    "<DataSet index=\"0\" name=\"Segments\" file=\"part.vtp\"/></vtkMultiBlockDataSet></VTKFile>";
  this->ExpectErrors(blocks, "vtkMultiBlockDataSet",
                     { { { "index=\"0\"", "index=\"-1\"", "index: expected" },
                         { "index=\"0\"", "index=\"999999999\"", "index: expected" },
                         { "part.vtp", "none.vtp", "block Segments: no such file" } } });
  std::string deep = "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet>";
  for (int level = 0; level < 100000; ++level)
  {
    deep += "<Block index=\"0\">";
  }
  EXPECT_NE(this->Error(deep, "vtkMultiBlockDataSet").find("one in the other"), std::string::npos);
  this->Folder.Write("part.vtp",
                     Changed(Surface, "NumberOfPoints=\"3\"", "NumberOfPoints=\"1e9\""));
  EXPECT_NE(this->Error(blocks, "vtkMultiBlockDataSet").find("block Segments: \"part.vtp\": "),
            std::string::npos);
}
