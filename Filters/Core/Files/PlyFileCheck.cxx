// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshFileCheck.h"

#include "Base/Limits.h"
#include "Files/TextLines.h"

#include <cmath>
#include <map>

namespace waft
{
namespace
{

// Readers keep the number of a face's corners in a byte.
constexpr double MostCorners = 255.0;

// A type of a number: its bytes, and whether it is a float or below zero at times.
struct PlyType
{
  int Size = 0; // 0: none
  bool IsReal = false;
  bool IsSigned = false;
};

PlyType TypeOf(std::string_view name)
{
  static const std::map<std::string_view, PlyType> types = {
    { "char", { 1, false, true } },    { "int8", { 1, false, true } },
    { "uchar", { 1, false, false } },  { "uint8", { 1, false, false } },
    { "short", { 2, false, true } },   { "int16", { 2, false, true } },
    { "ushort", { 2, false, false } }, { "uint16", { 2, false, false } },
    { "int", { 4, false, true } },     { "int32", { 4, false, true } },
    { "uint", { 4, false, false } },   { "uint32", { 4, false, false } },
    { "float", { 4, true, true } },    { "float32", { 4, true, true } },
    { "double", { 8, true, true } },   { "float64", { 8, true, true } },
  };
  const auto found = types.find(name);
  return found == types.end() ? PlyType() : found->second;
}

struct PlyProperty
{
  std::string Name;
  PlyType Type;
  PlyType Count; // of a list
};

struct PlyElement
{
  std::string Name;
  long long Count = 0;
  std::vector<PlyProperty> Properties;

  const PlyProperty* Find(const std::string& name) const
  {
    for (const PlyProperty& property : this->Properties)
    {
      if (property.Name == name)
      {
        return &property;
      }
    }
    return nullptr;
  }
};

struct PlyHeader
{
  bool IsText = false;
  ByteOrder Order = ByteOrder::Little;
  std::vector<PlyElement> Elements;
};

bool ReadProperty(const std::vector<std::string_view>& words, PlyProperty& property)
{
  const bool isList = words.size() == 5 && words[1] == "list";
  if (!isList && words.size() != 3)
  {
    return false;
  }
  property.Name = words.back();
  property.Type = TypeOf(words[words.size() - 2]);
  property.Count = isList ? TypeOf(words[2]) : PlyType();
  return property.Type.Size > 0 && (!isList || (property.Count.Size > 0 && !property.Count.IsReal));
}

Result ReadHeader(TextLines& lines, PlyHeader& header)
{
  std::string_view line;
  if (!lines.Next(line) || WordsOf(line) != std::vector<std::string_view>{ "ply" })
  {
    return Result::Error("expected the signature of a PLY mesh, found another file");
  }
  bool hasFormat = false;
  while (lines.Next(line))
  {
    const std::vector<std::string_view> words = WordsOf(line);
    const std::string_view kind = words.empty() ? std::string_view() : words[0];
    PlyElement element;
    PlyProperty property;
    bool isGood = true;
    if (kind == "end_header")
    {
      return hasFormat ? Result::Ok() : Result::Error("expected a line `format`, found none");
    }
    if (kind == "format")
    {
      isGood = words.size() == 3 && words[2] == "1.0" &&
               (words[1] == "ascii" || words[1] == "binary_little_endian" ||
                words[1] == "binary_big_endian");
      header.IsText = isGood && words[1] == "ascii";
      header.Order = isGood && words[1] == "binary_big_endian" ? ByteOrder::Big : ByteOrder::Little;
      hasFormat = true;
    }
    else if (kind == "element")
    {
      isGood = words.size() == 3 && ParseInteger(words[2], element.Count) && element.Count >= 0;
      if (isGood)
      {
        element.Name = words[1];
        header.Elements.push_back(element);
      }
    }
    else if (kind == "property")
    {
      isGood = !header.Elements.empty() && ReadProperty(words, property);
      if (isGood)
      {
        header.Elements.back().Properties.push_back(property);
      }
    }
    else
    {
      isGood = kind == "comment" || kind == "obj_info";
    }
    if (!isGood)
    {
      return Result::Error(lines.Location() + "expected a line of a PLY header, found " +
                           Quoted(line));
    }
  }
  return Result::Error("expected `end_header`, found the end of the file");
}

// Gives the numbers of the elements one after the other, from text or bytes.
class PlyNumbers
{
public:
  PlyNumbers(const PlyHeader& header, const TextLines& lines) :
    Header(header), Lines(lines), Bytes(lines.Remainder())
  {
  }

  bool BeginElement()
  {
    std::string_view line;
    this->Word = 0;
    if (this->Header.IsText && !this->Lines.Next(line))
    {
      return false;
    }
    this->Words = WordsOf(line);
    return true;
  }
  bool Next(const PlyType& type, double& number)
  {
    if (this->Header.IsText)
    {
      return this->Word < this->Words.size() && ParseNumber(this->Words[this->Word++], number);
    }
    if (!Holds(this->Bytes, 0, static_cast<std::uint64_t>(type.Size)))
    {
      return false;
    }
    const std::uint64_t bits = ReadUnsigned(this->Bytes, 0, type.Size, this->Header.Order);
    const double range = std::ldexp(1.0, 8 * type.Size);
    const auto whole = static_cast<double>(bits);
    number = type.IsReal ? ReadReal(this->Bytes, 0, type.Size, this->Header.Order)
             : type.IsSigned && whole >= 0.5 * range ? whole - range
                                                     : whole;
    this->Bytes.remove_prefix(static_cast<std::size_t>(type.Size));
    return true;
  }

private:
  const PlyHeader& Header;
  TextLines Lines;
  std::string_view Bytes;
  std::vector<std::string_view> Words;
  std::size_t Word = 0;
};

bool IsCoordinate(const std::string& name)
{
  return name == "x" || name == "y" || name == "z";
}

bool IsIndexList(const PlyProperty& property)
{
  return property.Count.Size > 0 &&
         (property.Name == "vertex_indices" || property.Name == "vertex_index");
}

Result CheckElement(const PlyElement& element, const std::string& location, long long points,
                    PlyNumbers& numbers)
{
  if (!numbers.BeginElement())
  {
    return Result::Error(location + "expected it, found the end of the file");
  }
  for (const PlyProperty& property : element.Properties)
  {
    double count = 1.0;
    if (property.Count.Size > 0 && (!numbers.Next(property.Count, count) || count < 0.0))
    {
      return Result::Error(location + "expected the length of `" + property.Name + "`");
    }
    const bool isIndex = element.Name == "face" && IsIndexList(property);
    const bool isPosition = element.Name == "vertex" && IsCoordinate(property.Name);
    if (isIndex && count > MostCorners)
    {
      return Result::Error(location + "expected at most 255 corners, found more");
    }
    for (double i = 0.0; i < count; ++i)
    {
      double number = 0.0;
      if (!numbers.Next(property.Type, number))
      {
        return Result::Error(location + "expected all of `" + property.Name +
                             "`, found fewer numbers");
      }
      if (isPosition && !limits::Coordinate.Holds(number))
      {
        return Result::Error(location + "expected coordinates of at most 1e6, found others");
      }
      if (isIndex && !(number >= 0.0 && number < static_cast<double>(points)))
      {
        return Result::Error(location + "expected indices of " + std::to_string(points) +
                             " points, found another");
      }
    }
  }
  return Result::Ok();
}

} // namespace

Result CheckPly(std::string_view file)
{
  TextLines lines(file);
  PlyHeader header;
  WAFT_RETURN_IF_FAILED(ReadHeader(lines, header));
  long long points = -1;
  bool hasFaces = false;
  for (const PlyElement& element : header.Elements)
  {
    const bool hasPositions = element.Find("x") && element.Find("y") && element.Find("z");
    for (const PlyProperty& property : element.Properties)
    {
      hasFaces = hasFaces || (element.Name == "face" && IsIndexList(property));
    }
    points = element.Name == "vertex" && hasPositions ? element.Count : points;
  }
  if (points < 0 || !hasFaces)
  {
    return Result::Error(
      "expected elements `vertex` with x, y, z and `face` with a list `vertex_indices`");
  }
  PlyNumbers numbers(header, lines);
  for (const PlyElement& element : header.Elements)
  {
    if (Quoted(element.Name).size() != element.Name.size() + 2 || element.Properties.empty())
    {
      return Result::Error("element " + Quoted(element.Name) + ": expected one with properties");
    }
    for (long long i = 0; i < element.Count; ++i)
    {
      const std::string location = "element " + element.Name + " " + std::to_string(i) + ": ";
      WAFT_RETURN_IF_FAILED(CheckElement(element, location, points, numbers));
    }
  }
  return Result::Ok();
}

} // namespace waft
