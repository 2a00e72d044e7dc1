// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files are looked at before its readers see them, which trust their counts.
#include "Base/TemporaryFolder.h"
#include "Files/DataFileCheck.h"

#include <gtest/gtest.h>
#include <zlib.h>

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

std::string Words(const std::vector<std::uint64_t>& numbers)
{
  return std::string(reinterpret_cast<const char*>(numbers.data()), 8 * numbers.size());
}

// Zeros as VTK packs them: the numbers of the blocks' bytes, and the blocks.
std::string PackedZeros(std::uint64_t bytes)
{
  constexpr std::uint64_t size = 1 << 20;
  const auto packed = [](std::uint64_t count)
  {
    const std::string zeros(count, '\0');
    std::string made(compressBound(uLong(count)), '\0');
    uLongf length = made.size();
    compress(reinterpret_cast<Bytef*>(made.data()), &length,
             reinterpret_cast<const Bytef*>(zeros.data()), uLong(count));
    made.resize(length);
    return made;
  };
  const std::string full = packed(size);
  const std::string rest = bytes % size > 0 ? packed(bytes % size) : std::string();
  std::string blocks;
  std::vector<std::uint64_t> head{ 0, size, bytes % size };
  for (std::uint64_t left = bytes; left > 0; left -= std::min(left, size))
  {
    const std::string& block = left < size ? rest : full;
    head.push_back(block.size());
    blocks += block;
    ++head[0];
  }
  return Words(head) + blocks;
}

// A surface of points that are packed; more: elements in its piece.
std::string PackedSurface(std::uint64_t points, const std::string& more = "")
{
  return "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
         "compressor=\"vtkZLibDataCompressor\"><PolyData><Piece NumberOfPoints=\"" +
         std::to_string(points) +
         "\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"appended\" "
         "offset=\"0\"/></Points>" +
         more + "</Piece></PolyData><AppendedData encoding=\"raw\">_" + PackedZeros(12 * points) +
         "</AppendedData></VTKFile>";
}

bool Unpack(const std::string& compressor, const std::string& packed, std::string& bytes)
{
  uLongf size = bytes.size();
  return compressor == "vtkZLibDataCompressor" &&
         uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                    reinterpret_cast<const Bytef*>(packed.data()), uLong(packed.size())) == Z_OK &&
         size == bytes.size();
}

std::string Changed(std::string text, const std::string& from, const std::string& to)
{
  return text.replace(text.find(from), from.size(), to);
}

} // namespace

class DataFileCheck : public testing::Test
{
protected:
  std::string Error(const std::string& text, const std::string& type) const
  {
    return CheckDataFile(this->Folder.Write("file", text), { type }, Unpack).Message();
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
        { "Piece Extent=\"0 1 0 1 0 1\"", "Piece Extent=\"0 1 0\"", "Extent" },
        { "Piece Extent=\"0 1 0 1 0 1\"", "Piece Extent=\"0 1 0 1 1 2\"", "part of WholeExtent" },
        { "<Piece", "<ImageData WholeExtent=\"0 9 0 1 0 1\"/><Piece", "none within another" } } });
}

TEST_F(DataFileCheck, RefusesPointsThatHaveNoPlace)
{
  this->ExpectErrors(
    Surface, "PolyData",
    { { { "NumberOfComponents=\"3\"", "",
          "expected 3 numbers a point, found 1 of type \"Float32\"" },
        { "NumberOfComponents=\"3\"", "NumberOfComponents=\"4\"", "found 4" },
        { "type=\"Float32\"", "type=\"String\"", "found 3 of type \"String\"" },
        { "type=\"Float32\"", "type=\"Bit\"", "found 3 of type \"Bit\"" },
        { "format=\"ascii\"", "format=\"ascii\" offset=\"0\"", "the format ascii, binary, or" },
        { "format=\"ascii\"", "format=\"words\"", "the format ascii, binary, or" } } });
}

TEST_F(DataFileCheck, CountsTexts)
{
  const auto surface = [](const std::string& attributes, const std::string& values)
  {
    return Changed(Surface, "<Points>",
                   "<PointData><Array type=\"String\" Name=\"w\" " + attributes + ">" + values +
                     "</Array></PointData><Points>");
  };
  const std::string written = "format=\"ascii\"";
  EXPECT_EQ(this->Error(surface(written, "65 66 0 0 67 0"), "PolyData"), "");
  EXPECT_NE(this->Error(surface(written, "65 0 66 0 0 67 0"), "PolyData")
              .find("array \"w\": expected 3 texts, found 4"),
            std::string::npos);
  for (const char* odd : { "65 0 `0 0", "65 0-0 0", "65 256 0", "1e1 0" })
  {
    EXPECT_NE(this->Error(surface(written, odd), "PolyData").find("the letters of texts"),
              std::string::npos)
      << odd;
  }
  // Four bytes that say how many follow, and these: A0B0C0 and A0B00C0.
  const std::string binary = "format=\"binary\"";
  EXPECT_EQ(this->Error(surface(binary, "BgAAAEEAQgBDAA=="), "PolyData"), "");
  EXPECT_NE(this->Error(surface(binary, "BwAAAEEAQgAAQwA="), "PolyData").find("expected 3 texts"),
            std::string::npos);
  // Packed: a zero is an empty text.
  const auto packed = [this](std::uint64_t texts, const std::string& compressor)
  {
    const std::string text =
      Changed("<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
              "compressor=\"vtkZLibDataCompressor\"><PolyData><FieldData><Array type=\"String\" "
              "Name=\"w\" NumberOfTuples=\"2000000\" format=\"appended\" offset=\"0\"/></FieldData>"
              "</PolyData><AppendedData encoding=\"raw\">_" +
                PackedZeros(texts) + "</AppendedData></VTKFile>",
              "vtkZLibDataCompressor", compressor);
    return this->Error(text, "PolyData");
  };
  EXPECT_EQ(packed(2'000'000, "vtkZLibDataCompressor"), "");
  EXPECT_NE(packed(2'000'001, "vtkZLibDataCompressor").find("found 2000001"), std::string::npos);
  EXPECT_NE(packed(2'000'000, "vtkNoCompressor").find("the letters of texts"), std::string::npos);
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

TEST_F(DataFileCheck, BoundsWhatIsUnpacked)
{
  const auto error = [this](const std::string& text, const char* type = "PolyData")
  { return this->Error(text, type); };
  EXPECT_EQ(error(PackedSurface(1'000'000)), "");
  EXPECT_NE(error(PackedSurface(200'000'000)).find("536870912 bytes in memory, found 2400000000"),
            std::string::npos);
  // Arrays that are the same bytes of the file.
  std::string many = "<PointData>";
  for (int i = 0; i < 3; ++i)
  {
    many += "<DataArray type=\"Float32\" Name=\"a\" NumberOfComponents=\"3\" format=\"appended\" "
            "offset=\"0\"/>";
  }
  EXPECT_NE(error(PackedSurface(10'000'000, many + "</PointData>")).find("that share them"),
            std::string::npos);
  // Pieces and extents that no values stand for.
  const std::string pieces = Changed(PackedSurface(1'000'000), "</Piece>",
                                     "</Piece><Piece NumberOfPoints=\"12000000\"/>"
                                     "<Piece NumberOfPoints=\"12000000\"/>"
                                     "<Piece NumberOfPoints=\"12000000\"/>"
                                     "<Piece NumberOfPoints=\"12000000\"/>");
  EXPECT_NE(error(pieces).find("bytes in memory, found 588000000"), std::string::npos)
    << error(pieces);
  std::string ascii =
    Changed(Image, "Extent=\"0 1 0 1 0 1\" Origin", "Extent=\"0 399 0 399 0 399\" Origin");
  ascii += std::string(64'000'000, ' ');
  EXPECT_NE(error(ascii, "ImageData").find("bytes in memory, found 768000000"), std::string::npos)
    << error(ascii, "ImageData");
}

TEST_F(DataFileCheck, TakesNumbersThatNothingCouldHold)
{
  const auto error = [this](std::uint64_t blocks, std::uint64_t size, std::uint64_t last)
  {
    std::string text = PackedSurface(3);
    const std::size_t at = text.find(">_") + 2;
    return this->Error(text.replace(at, 24, Words({ blocks, size, last })), "PolyData");
  };
  constexpr std::uint64_t huge = 0x2020202020202020;
  EXPECT_NE(error(0, huge, huge).find("expected 36 bytes of values, found 0"), std::string::npos);
  EXPECT_NE(error(huge, huge, huge).find("cut or damaged"), std::string::npos);
  EXPECT_NE(error(1, huge, 0).find("cut or damaged"), std::string::npos);
  const std::string much =
    Changed(PackedSurface(3), "NumberOfComponents=\"3\"", "NumberOfComponents=\"30000000000\"");
  EXPECT_NE(this
              ->Error(Changed(much, "NumberOfPoints=\"3\"", "NumberOfPoints=\"30000000000\"") +
                        std::string(40'000'000, ' '),
                      "PolyData")
              .find("expected 3 numbers a point, found 30000000000"),
            std::string::npos);
}

TEST_F(DataFileCheck, BlocksShareTheirBounds)
{
  const std::string block = "<DataSet index=\"0\" name=\"A\" file=\"a.vtp\"/>";
  const auto blocks = [](const std::string& inside)
  {
    return "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet>" + inside +
           "</vtkMultiBlockDataSet></VTKFile>";
  };
  this->Folder.Write("a.vtp", PackedSurface(30'000'000));
  EXPECT_EQ(this->Error(blocks(block), "vtkMultiBlockDataSet"), "");
  EXPECT_NE(this->Error(blocks(block + block), "vtkMultiBlockDataSet").find("file of its own"),
            std::string::npos);
  this->Folder.Write("b.vtp", PackedSurface(30'000'000));
  EXPECT_NE(this->Error(blocks(block + Changed(block, "a.vtp", "b.vtp")), "vtkMultiBlockDataSet")
              .find("\"b.vtp\": expected values of at most"),
            std::string::npos);
}
