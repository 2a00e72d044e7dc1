// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshReaders.h"

#include "Files/TextLines.h"

#include <array>
#include <functional>
#include <unordered_map>

namespace waft
{
namespace
{

constexpr std::uint64_t HeaderSize = 84;
constexpr std::uint64_t TriangleSize = 50;

// The word in small letters.
std::string Lowered(std::string_view word)
{
  std::string lowered(word);
  for (char& c : lowered)
  {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return lowered;
}

// Begins it with `solid`, and without the zeros that the numbers of a binary file have?
bool IsText(std::string_view file)
{
  constexpr std::size_t begin = 1024;
  std::string_view line;
  TextLines lines(file.substr(0, begin));
  std::vector<std::string_view> words;
  while (words.empty() && lines.Next(line))
  {
    words = WordsOf(line);
  }
  return !words.empty() && Lowered(words[0]) == "solid" &&
         file.substr(0, begin).find('\0') == std::string_view::npos;
}

// Takes the corners of triangles; equal ones become one point.
class StlTriangles
{
public:
  explicit StlTriangles(PolygonSurface& surface) : Surface(surface) {}

  void Add(const std::array<std::array<double, 3>, 3>& corners)
  {
    std::array<int, 3> indices{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      indices[i] = this->PointAt(corners[i]);
    }
    if (indices[0] != indices[1] && indices[1] != indices[2] && indices[2] != indices[0])
    {
      this->Surface.Corners.insert(this->Surface.Corners.end(), indices.begin(), indices.end());
      this->Surface.Ends.push_back(this->Surface.Corners.size());
    }
  }

private:
  int PointAt(const std::array<double, 3>& place)
  {
    std::array<float, 3> rounded{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      rounded[k] = static_cast<float>(place[k]);
    }
    const auto [point, isNew] =
      this->Points.try_emplace(rounded, static_cast<int>(this->Surface.Points.size()));
    if (isNew)
    {
      this->Surface.Points.emplace_back(rounded[0], rounded[1], rounded[2]);
    }
    return point->second;
  }

  struct Hash
  {
    std::size_t operator()(const std::array<float, 3>& place) const
    {
      std::size_t hash = 0;
      for (const float x : place)
      {
        hash = hash * 1000003 + std::hash<float>()(x);
      }
      return hash;
    }
  };

  PolygonSurface& Surface;
  std::unordered_map<std::array<float, 3>, int, Hash> Points;
};

Result ReadBinary(std::string_view file, std::uint64_t count, PolygonSurface& surface)
{
  StlTriangles triangles(surface);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    std::array<std::array<double, 3>, 3> corners{};
    for (std::size_t k = 0; k < 9; ++k)
    {
      // Behind the normal.
      const std::uint64_t at = HeaderSize + TriangleSize * i + 12 + 4 * k;
      corners[k / 3][k % 3] = ReadReal(file, at, 4, ByteOrder::Little);
      if (!limits::Coordinate.Holds(corners[k / 3][k % 3]))
      {
        return Result::Error("triangle " + std::to_string(i) +
                             ": expected coordinates of at most 1e6, found others");
      }
    }
    triangles.Add(corners);
  }
  return Result::Ok();
}

Result ReadText(std::string_view file, PolygonSurface& surface)
{
  StlTriangles triangles(surface);
  std::array<std::array<double, 3>, 3> corners{};
  std::size_t count = 0; // corners of the loop
  bool hasEnd = false;
  std::string_view line;
  for (TextLines lines(file); lines.Next(line);)
  {
    const std::vector<std::string_view> words = WordsOf(line);
    std::string kind = words.empty() ? std::string() : Lowered(words[0]);
    kind += kind == "end" && words.size() > 1 ? Lowered(words[1]) : "";
    hasEnd = kind == "endsolid" || (hasEnd && kind != "solid");
    if (kind == "vertex")
    {
      WAFT_RETURN_IF_FAILED(
        ReadCoordinates(words, 1, lines.Location(), corners[std::min<std::size_t>(count, 2)]));
      ++count;
    }
    else if (kind == "endloop")
    {
      if (count != 3)
      {
        return Result::Error(lines.Location() + "expected a loop of 3 vertices, found " +
                             std::to_string(count));
      }
      triangles.Add(corners);
      count = 0;
    }
  }
  return hasEnd && count == 0 ? Result::Ok()
                              : Result::Error("expected `endsolid`, found the end of the file");
}

} // namespace

Result ReadStl(std::string_view file, PolygonSurface& surface)
{
  surface = PolygonSurface();
  const std::uint64_t count =
    file.size() >= HeaderSize ? ReadUnsigned(file, 80, 4, ByteOrder::Little) : 0;
  const std::uint64_t size = HeaderSize + TriangleSize * count;
  if (file.size() != size && IsText(file))
  {
    return ReadText(file, surface);
  }
  if (file.size() < size)
  {
    return Result::Error("expected `solid`, or 84 bytes and 50 for each of " +
                         std::to_string(count) + " triangles, found " +
                         std::to_string(file.size()));
  }
  if (count > MostOfASurface)
  {
    return Result::Error("expected at most " + std::to_string(MostOfASurface) +
                         " triangles, found " + std::to_string(count));
  }
  return ReadBinary(file, count, surface);
}

} // namespace waft
