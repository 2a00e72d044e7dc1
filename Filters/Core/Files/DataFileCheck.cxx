// SPDX-License-Identifier: BSD-3-Clause
#include "Files/DataFileCheck.h"

#include "Base/NumberText.h"
#include "Files/DataFileArrays.h"
#include "Files/DataFilePiece.h"
#include "Files/DataFileRoom.h"
#include "Files/FileBytes.h"
#include "Files/TextLines.h"
#include "Files/XmlTags.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace waft
{
namespace
{

constexpr std::size_t DeepestElement = 64;
constexpr long long NewestVersion = 2;   // that VTK's readers know
constexpr double MostBlocks = 100'000.0; // places of one level of a .vtm

Result CheckOne(const std::string& path, const std::vector<std::string>& types,
                const BlockUnpacker& unpack, DataSetBytes& all);

class DataFile
{
public:
  DataFile(std::string_view text, const std::string& path, const BlockUnpacker& unpack,
           DataSetBytes& all) :
    Tags(text),
    Path(path), Unpack(unpack), All(all), Arrays(text)
  {
    this->All.InFiles += static_cast<double>(text.size());
  }

  Result Check(const std::vector<std::string>& types)
  {
    XmlTag tag;
    while (!this->HasEnd && this->Tags.Next(tag))
    {
      const std::string location =
        "byte " + std::to_string(tag.Begin) + ": element " + Quoted(tag.Name) + ": ";
      if (tag.IsOpening)
      {
        WAFT_RETURN_IF_FAILED(this->Open(tag, location, types));
      }
      if (tag.IsClosing)
      {
        if (this->Stack.empty() || this->Stack.back() != tag.Name)
        {
          return Result::Error(location + "expected the end of another element");
        }
        this->Stack.pop_back();
        this->HasEnd = this->Stack.empty();
      }
    }
    if (!this->HasEnd)
    {
      return Result::Error(this->Type.empty()
                             ? "expected a VTK XML file, found no XML"
                             : "expected `</VTKFile>`, found the end of the file or no XML");
    }
    ArrayBytes bytes;
    for (const ArrayClaim& claim : this->Claims)
    {
      WAFT_RETURN_IF_FAILED(this->Arrays.Check(claim, bytes));
    }
    WAFT_RETURN_IF_FAILED(this->CheckBytes(bytes));
    for (const ArrayClaim& claim : this->Claims)
    {
      WAFT_RETURN_IF_FAILED(this->Arrays.CheckTexts(claim, this->Unpack));
    }
    return Result::Ok();
  }

private:
  Result CheckBytes(const ArrayBytes& bytes) const
  {
    if (bytes.InFile > static_cast<double>(this->Arrays.Text.size()))
    {
      return Result::Error("expected arrays with values of their own, found some that share them");
    }
    this->All.InMemory += std::max(bytes.InMemory, this->Room.Bytes());
    return this->All.Check();
  }

  Result Open(const XmlTag& tag, const std::string& location, const std::vector<std::string>& types)
  {
    if (this->Stack.empty())
    {
      WAFT_RETURN_IF_FAILED(this->OpenRoot(tag, location, types));
    }
    const std::string_view parent = this->Stack.empty() ? std::string_view() : this->Stack.back();
    if ((tag.Name == "Piece" || tag.Name == "ImageData") &&
        std::find(this->Stack.begin(), this->Stack.end(), tag.Name) != this->Stack.end())
    {
      return Result::Error(location + "expected none within another");
    }
    this->Stack.push_back(tag.Name);
    if (this->Stack.size() > DeepestElement)
    {
      return Result::Error(location + "expected at most " + std::to_string(DeepestElement) +
                           " elements one in the other, found more");
    }
    if (tag.Name == "ImageData")
    {
      PieceCounts counts;
      WAFT_RETURN_IF_FAILED(this->ReadExtent(tag, "WholeExtent", location, counts));
      this->Whole = counts.Places;
      this->Room.AddTuples(counts.Points, counts.Cells, counts.Rows);
      WAFT_RETURN_IF_FAILED(CheckNumbers(tag, "Origin", location, 3));
      WAFT_RETURN_IF_FAILED(CheckNumbers(tag, "Spacing", location, 3));
      return CheckNumbers(tag, "Direction", location, 9);
    }
    if (tag.Name == "Piece")
    {
      return this->OpenPiece(tag, location);
    }
    if (tag.Name == "DataArray" || tag.Name == "Array")
    {
      return this->OpenArray(tag, parent, location);
    }
    if (this->Type == "vtkMultiBlockDataSet" && (tag.Name == "DataSet" || tag.Name == "Block"))
    {
      return this->OpenBlock(tag, location);
    }
    return tag.Name == "AppendedData" ? this->OpenAppended(tag, location) : Result::Ok();
  }

  Result OpenRoot(const XmlTag& tag, const std::string& location,
                  const std::vector<std::string>& types)
  {
    const std::string_view type = tag.Attribute("type");
    if (tag.Name != "VTKFile" || std::find(types.begin(), types.end(), type) == types.end())
    {
      return Result::Error(
        "expected a VTK XML file of type " + types.front() + ", found " +
        (tag.Name == "VTKFile" ? Printable(type) : "element " + Quoted(tag.Name)));
    }
    const std::string_view version = tag.Attribute("version");
    long long major = 0;
    if (!version.empty() && (!ParseInteger(version.substr(0, version.find('.')), major) ||
                             major < 0 || major > NewestVersion))
    {
      return Result::Error(location + "expected the format's version 0 to " +
                           std::to_string(NewestVersion) + ", found " + Quoted(version));
    }
    this->Type = type;
    this->Arrays.Packer = tag.Attribute("compressor");
    this->Arrays.WordSize = tag.Attribute("header_type") == "UInt64" ? 8 : 4;
    const std::string_view order = tag.Attribute("byte_order");
    this->Arrays.Order = order == "BigEndian" ? ByteOrder::Big : ByteOrder::Little;
    const bool isKnown = order.empty() || order == "LittleEndian" || order == "BigEndian";
    return isKnown ? Result::Ok()
                   : Result::Error(location + "expected LittleEndian or BigEndian, found " +
                                   Quoted(order));
  }

  // An attribute that counts; 0 when it is left out.
  Result ReadCount(const XmlTag& tag, const char* name, const std::string& location, double& count,
                   double absent = 0.0) const
  {
    const std::string_view text = tag.Attribute(name);
    long long number = 0;
    count = absent;
    if (text.empty())
    {
      return Result::Ok();
    }
    if (!ParseInteger(text, number) || number < 0 ||
        static_cast<double>(number) > this->Arrays.Most())
    {
      return Result::Error(location + name + ": expected a number that a file of " +
                           std::to_string(this->Arrays.Text.size()) + " bytes can hold, found " +
                           Quoted(text));
    }
    count = static_cast<double>(number);
    return Result::Ok();
  }

  // In place of other texts the reader takes its own numbers.
  static Result CheckNumbers(const XmlTag& tag, const char* name, const std::string& location,
                             std::size_t count)
  {
    const std::vector<std::string_view> words = WordsOf(tag.Attribute(name));
    bool isGood = words.size() == count;
    for (std::size_t i = 0; isGood && i < count; ++i)
    {
      double number = 0.0;
      isGood = ParseNumber(words[i], number);
    }
    return isGood || !tag.Has(name)
             ? Result::Ok()
             : Result::Error(location + name + ": expected " + std::to_string(count) +
                             " numbers, found " + Quoted(tag.Attribute(name)));
  }

  // Six numbers, each pair in order or empty (last = first - 1).
  Result ReadExtent(const XmlTag& tag, const char* name, const std::string& location,
                    PieceCounts& counts) const
  {
    const std::vector<std::string_view> words = WordsOf(tag.Attribute(name));
    counts.Points = 1.0;
    counts.Cells = 1.0;
    bool isGood = words.size() == 6;
    for (std::size_t axis = 0; isGood && axis < 3; ++axis)
    {
      long long& first = counts.Places[2 * axis];
      long long& last = counts.Places[2 * axis + 1];
      isGood = ParseInteger(words[2 * axis], first) && ParseInteger(words[2 * axis + 1], last) &&
               std::max(std::abs(double(first)), std::abs(double(last))) < 1e9 && last >= first;
      counts.Points *= static_cast<double>(last - first + 1);
      counts.Cells *= static_cast<double>(std::max(1LL, last - first));
    }
    return isGood && counts.Points <= this->Arrays.Most()
             ? Result::Ok()
             : Result::Error(location + name +
                             ": expected 6 numbers, first and last of each axis, of "
                             "a lattice that a file of " +
                             std::to_string(this->Arrays.Text.size()) + " bytes can hold, found " +
                             Quoted(tag.Attribute(name)));
  }

  Result OpenPiece(const XmlTag& tag, const std::string& location)
  {
    PieceCounts counts;
    if (this->Type == "ImageData")
    {
      WAFT_RETURN_IF_FAILED(this->ReadExtent(tag, "Extent", location, counts));
      if (!counts.IsWithin(this->Whole))
      {
        return Result::Error(location + "Extent: expected a part of WholeExtent, found " +
                             Quoted(tag.Attribute("Extent")));
      }
    }
    else
    {
      WAFT_RETURN_IF_FAILED(this->ReadCount(tag, "NumberOfPoints", location, counts.Points));
    }
    WAFT_RETURN_IF_FAILED(this->ReadCount(tag, "NumberOfRows", location, counts.Rows));
    for (const char* kind : { "Verts", "Lines", "Strips", "Polys" })
    {
      const std::string name = std::string("NumberOf") + kind;
      double& count = counts.OfKind[kind];
      WAFT_RETURN_IF_FAILED(this->ReadCount(tag, name.c_str(), location, count));
      counts.Cells += count;
    }
    this->Piece = counts;
    this->Room.AddPiece();
    if (this->Type != "ImageData")
    {
      this->Room.AddTuples(counts.Points, counts.Cells, counts.Rows);
    }
    return Result::Ok();
  }

  Result OpenArray(const XmlTag& tag, std::string_view parent, const std::string& location)
  {
    ArrayClaim claim;
    claim.Location = location + "array " + Quoted(tag.Attribute("Name")) + ": ";
    claim.Format = tag.Attribute("format");
    claim.Format = claim.Format.empty() ? "ascii" : claim.Format;
    const std::string_view type = tag.Attribute("type");
    const int size = BytesOfType(type);
    double components = 1.0;
    double tuples = 0.0;
    WAFT_RETURN_IF_FAILED(
      this->ReadCount(tag, "NumberOfComponents", claim.Location, components, 1.0));
    WAFT_RETURN_IF_FAILED(this->ReadCount(tag, "NumberOfTuples", claim.Location, tuples));
    if (size == 0)
    {
      return Result::Error(claim.Location + "expected a type of numbers or String, found " +
                           Quoted(type));
    }
    const bool isAppended = claim.Format == "appended";
    if ((claim.Format != "ascii" && claim.Format != "binary" && !isAppended) ||
        tag.Has("offset") != isAppended)
    {
      return Result::Error(claim.Location + "expected the format ascii, binary, or appended with " +
                           "an offset, found " + Quoted(claim.Format));
    }
    const bool hasNumbers = type != "String" && type != "Bit";
    if (parent == "Points" && (!hasNumbers || components != 3.0))
    {
      return Result::Error(claim.Location + "expected 3 numbers a point, found " +
                           NumberText(components, 15) + " of type " + Quoted(type));
    }
    const auto ofKind = this->Piece.OfKind.find(parent);
    const bool isOffsets = tag.Attribute("Name") == "offsets";
    const bool isCounted = hasNumbers && (ofKind == this->Piece.OfKind.end() || isOffsets);
    tuples = parent == "PointData" || parent == "Points" ? this->Piece.Points
             : parent == "CellData"                      ? this->Piece.Cells
             : parent == "RowData"                       ? this->Piece.Rows
             : ofKind != this->Piece.OfKind.end()        ? ofKind->second
                                                         : tuples;
    const double values = tuples * components;
    if (values > this->Arrays.Most())
    {
      return Result::Error(claim.Location + "expected values that the file can hold, found " +
                           NumberText(values, 15));
    }
    this->Room.AddArray(parent, components * size);
    claim.Bytes = isCounted ? values * size : -1.0;
    claim.Texts = type == "String" ? tuples * std::max(components, 1.0) : -1.0;
    claim.At = tag.End;
    if (isAppended)
    {
      double offset = 0.0;
      WAFT_RETURN_IF_FAILED(this->ReadCount(tag, "offset", claim.Location, offset));
      claim.At = static_cast<std::size_t>(offset);
    }
    this->Claims.push_back(std::move(claim));
    return Result::Ok();
  }

  Result OpenBlock(const XmlTag& tag, const std::string& location)
  {
    const std::string_view index = tag.Attribute("index");
    long long number = 0;
    if (!index.empty() &&
        (!ParseInteger(index, number) || number < 0 || static_cast<double>(number) >= MostBlocks))
    {
      return Result::Error(location + "index: expected a number from 0 to 99999, found " +
                           Quoted(index));
    }
    const std::string file = Unescaped(tag.Attribute("file"));
    if (tag.Name == "Block" || file.empty())
    {
      return Result::Ok();
    }
    const std::filesystem::path leaf = std::filesystem::path(this->Path).parent_path() / file;
    const std::string name = "block " + Printable(tag.Attribute("name")) + ": ";
    std::error_code error;
    if (!std::filesystem::is_regular_file(leaf, error))
    {
      return Result::Error(name + "no such file as " + Quoted(file));
    }
    if (!this->All.Blocks.insert(std::filesystem::weakly_canonical(leaf, error)).second)
    {
      return Result::Error(name + "expected a file of its own, found " + Quoted(file) + " again");
    }
    const Result checked =
      CheckOne(leaf.string(), { "PolyData", "Table" }, this->Unpack, this->All);
    return checked ? checked : Result::Error(name + Quoted(file) + ": " + checked.Message());
  }

  // The values follow an underscore up to the last `</AppendedData>`; they may look like tags.
  Result OpenAppended(const XmlTag& tag, const std::string& location)
  {
    const std::size_t end = this->Arrays.Text.rfind("</AppendedData>");
    const std::size_t mark = this->Arrays.Text.find('_', tag.End);
    if (end == std::string_view::npos || mark == std::string_view::npos || mark > end)
    {
      return Result::Error(location +
                           "expected `_`, values and `</AppendedData>`, found the end of "
                           "the file");
    }
    this->Arrays.Appended = this->Arrays.Text.substr(mark + 1, end - mark - 1);
    this->Arrays.IsRaw = tag.Attribute("encoding") == "raw";
    this->Tags.Seek(end);
    return Result::Ok();
  }

  XmlTags Tags;
  std::string Path;
  const BlockUnpacker& Unpack;
  DataSetBytes& All;
  std::vector<std::string_view> Stack;
  bool HasEnd = false;
  std::string Type;
  DataFileArrays Arrays;
  Extent Whole{}; // of an image
  PieceCounts Piece;
  DataFileRoom Room;
  std::vector<ArrayClaim> Claims;
};

Result CheckOne(const std::string& path, const std::vector<std::string>& types,
                const BlockUnpacker& unpack, DataSetBytes& all)
{
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(path));
  return DataFile(file.View(), path, unpack, all).Check(types);
}

} // namespace

Result CheckDataFile(const std::string& path, const std::vector<std::string>& types,
                     const BlockUnpacker& unpack)
{
  DataSetBytes all;
  return CheckOne(path, types, unpack, all);
}

} // namespace waft
