// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshFileCheck.h"

#include "Base/Limits.h"
#include "Files/TextLines.h"

#include <array>

namespace waft
{
namespace
{

// How many of each an OBJ file has: points, texture coordinates, normals.
using ObjCounts = std::array<long long, 3>;

// One corner, `point/texture/normal`. Numbers below zero count back from the last line above.
Result CheckCorner(std::string_view corner, const ObjCounts& above, const ObjCounts& all,
                   const std::string& location)
{
  std::string_view rest = corner;
  for (std::size_t part = 0; part < 3; ++part)
  {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    const std::string_view word = rest.substr(0, end);
    long long index = 0;
    const bool isLeftOut = word.empty() && part > 0;
    const bool isThere = ParseInteger(word, index) && ((index > 0 && index <= all[part]) ||
                                                       (index < 0 && -index <= above[part]));
    if (!isLeftOut && !isThere)
    {
      return Result::Error(location + "expected an index of " + std::to_string(all[part]) +
                           (part == 0   ? " points"
                            : part == 1 ? " texture coordinates"
                                        : " normals") +
                           ", found " + Quoted(corner));
    }
    if (end == rest.size())
    {
      return Result::Ok();
    }
    rest.remove_prefix(end + 1);
  }
  return Result::Error(location + "expected point/texture/normal, found " + Quoted(corner));
}

// Which of the counts a line adds to; 3: none.
std::size_t ObjKind(std::string_view line)
{
  const std::size_t at = std::min(line.find_first_not_of(" \t"), line.size());
  const std::string_view word = line.substr(at, line.find_first_of(" \t", at) - at);
  return word == "v" ? 0 : word == "vt" ? 1 : word == "vn" ? 2 : 3;
}

} // namespace

Result CheckObj(std::string_view file)
{
  ObjCounts all{};
  std::string_view line;
  for (TextLines lines(file); lines.Next(line);)
  {
    if (const std::size_t kind = ObjKind(line); kind < all.size())
    {
      ++all[kind];
    }
  }
  ObjCounts above{};
  TextLines lines(file);
  while (lines.Next(line))
  {
    const std::vector<std::string_view> words = WordsOf(line);
    const std::string_view kind = words.empty() ? std::string_view() : words[0];
    if (const std::size_t at = ObjKind(line); at < above.size())
    {
      WAFT_RETURN_IF_FAILED(CheckCoordinates(words, 1, at == 1 ? 2 : 3, lines.Location()));
      ++above[at];
    }
    else if (kind == "f" || kind == "l" || kind == "p")
    {
      const std::size_t least = kind == "f" ? 3 : kind == "l" ? 2 : 1;
      // A backslash goes on in the next line, which readers do not agree about.
      if (words.size() < 1 + least)
      {
        return Result::Error(lines.Location() + "expected at least " + std::to_string(least) +
                             " corners, found " + std::to_string(words.size() - 1));
      }
      for (std::size_t i = 1; i < words.size(); ++i)
      {
        WAFT_RETURN_IF_FAILED(CheckCorner(words[i], above, all, lines.Location()));
      }
    }
  }
  return Result::Ok();
}

Result CheckStl(std::string_view file)
{
  constexpr std::size_t header = 84;
  constexpr std::uint64_t triangle = 50;
  const std::uint64_t count =
    file.size() >= header ? ReadUnsigned(file, 80, 4, ByteOrder::Little) : 0;
  const bool isWhole = file.size() >= header && Holds(file, header, triangle * count);
  const bool isText =
    file.substr(0, 5) == "solid" && file.substr(0, 1024).find("facet") != std::string_view::npos;
  if (!isText)
  {
    if (!isWhole)
    {
      return Result::Error("expected 84 bytes and 50 for each of " + std::to_string(count) +
                           " triangles, found " + std::to_string(file.size()));
    }
    for (std::uint64_t i = 0; i < count; ++i)
    {
      for (int k = 3; k < 12; ++k) // behind the normal
      {
        const double number = ReadReal(
          file, header + triangle * i + 4 * static_cast<std::uint64_t>(k), 4, ByteOrder::Little);
        if (!limits::Coordinate.Holds(number))
        {
          return Result::Error("triangle " + std::to_string(i) +
                               ": expected coordinates of at most 1e6, found others");
        }
      }
    }
    return Result::Ok();
  }
  std::string_view line;
  bool hasEnd = false;
  for (TextLines lines(file); lines.Next(line);)
  {
    const std::vector<std::string_view> words = WordsOf(line);
    hasEnd = hasEnd || (!words.empty() && words[0] == "endsolid");
    if (!words.empty() && words[0] == "vertex")
    {
      WAFT_RETURN_IF_FAILED(CheckCoordinates(words, 1, 3, lines.Location()));
    }
  }
  return hasEnd ? Result::Ok() : Result::Error("expected `endsolid`, found the end of the file");
}

} // namespace waft
