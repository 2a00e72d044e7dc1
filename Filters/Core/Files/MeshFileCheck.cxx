// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshFileCheck.h"

#include "Base/Limits.h"
#include "Files/TextLines.h"

#include <array>

namespace waft
{
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
      std::array<double, 3> point{};
      WAFT_RETURN_IF_FAILED(ReadCoordinates(words, 1, lines.Location(), point));
    }
  }
  return hasEnd ? Result::Ok() : Result::Error("expected `endsolid`, found the end of the file");
}

} // namespace waft
