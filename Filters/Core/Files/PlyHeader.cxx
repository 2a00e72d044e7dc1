// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PlyHeader.h"

#include <map>

namespace waft
{
namespace
{

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

} // namespace

Result ReadPlyHeader(TextLines& lines, PlyHeader& header)
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
    if (kind.empty())
    {
      continue;
    }
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

} // namespace waft
