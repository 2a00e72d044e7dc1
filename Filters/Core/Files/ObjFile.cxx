// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshReaders.h"

#include "Files/TextLines.h"

#include <array>
#include <optional>

namespace waft
{
namespace
{

// How many of each an OBJ file has, or which of each a corner is: points, texture coordinates,
// normals.
using ObjNumbers = std::array<long long, 3>;

enum class ObjKind
{
  Point,
  TextureCoordinate,
  Normal,
  Face,
  Line,
  Dot
};

std::optional<ObjKind> KindOf(std::string_view word)
{
  constexpr std::array<std::string_view, 6> names{ "v", "vt", "vn", "f", "l", "p" };
  const auto* found = std::find(names.begin(), names.end(), word);
  return found == names.end() ? std::nullopt
                              : std::optional(static_cast<ObjKind>(found - names.begin()));
}

// The lines of an OBJ file that say something of its surface.
class ObjStatements
{
public:
  explicit ObjStatements(std::string_view file) : Lines(file) {}

  // The next one, with what a backslash at its end joins to it; false after the last.
  bool Next()
  {
    std::string_view line;
    std::optional<ObjKind> kind;
    while (!kind && this->Lines.Next(line))
    {
      this->Words = WordsOf(line.substr(0, line.find('#')));
      // Of other lines the end may be a name's.
      kind = this->Words.empty() ? std::nullopt : KindOf(this->Words[0]);
    }
    if (!kind)
    {
      return false;
    }
    this->Kind = *kind;
    this->Location = this->Lines.Location();
    while (this->Words.back().back() == '\\' && this->Join(line))
    {
    }
    return true;
  }

  ObjKind Kind = ObjKind::Point;
  std::vector<std::string_view> Words; // the first says the kind
  std::string Location;                // of its first line

private:
  bool Join(std::string_view& line)
  {
    this->Words.back().remove_suffix(1);
    if (this->Words.back().empty())
    {
      this->Words.pop_back();
    }
    if (!this->Lines.Next(line))
    {
      return false;
    }
    const std::vector<std::string_view> more = WordsOf(line.substr(0, line.find('#')));
    this->Words.insert(this->Words.end(), more.begin(), more.end());
    return !more.empty();
  }

  TextLines Lines;
};

// One corner, `point/texture/normal`, of which the last two may be left out (then -1). Numbers
// below zero count back from the last line above.
Result ReadCorner(std::string_view corner, const ObjNumbers& above, const ObjNumbers& all,
                  const std::string& location, ObjNumbers& indices)
{
  indices.fill(-1);
  std::string_view rest = corner;
  for (std::size_t part = 0; part < indices.size(); ++part)
  {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    const std::string_view word = rest.substr(0, end);
    if (!word.empty() || part == 0)
    {
      long long index = 0;
      if (!ParseInteger(word, index) || index == 0 || index > all[part] || index < -above[part])
      {
        constexpr std::array<const char*, 3> names{ " points", " texture coordinates", " normals" };
        return Result::Error(location + "expected an index of " + std::to_string(all[part]) +
                             names[part] + ", found " + Quoted(corner));
      }
      indices[part] = index > 0 ? index - 1 : above[part] + index;
    }
    if (end == rest.size())
    {
      return Result::Ok();
    }
    rest.remove_prefix(end + 1);
  }
  return Result::Error(location + "expected point/texture/normal, found " + Quoted(corner));
}

class ObjReading
{
public:
  ObjReading(std::string_view file, PolygonSurface& surface) : Lines(file), Surface(surface)
  {
    for (ObjStatements lines(file); lines.Next();)
    {
      if (const auto kind = static_cast<std::size_t>(lines.Kind); kind < this->All.size())
      {
        ++this->All[kind];
      }
    }
  }

  Result Read()
  {
    if (this->All[0] > static_cast<long long>(MostOfASurface))
    {
      return Result::Error("expected at most " + std::to_string(MostOfASurface) +
                           " points, found " + std::to_string(this->All[0]));
    }
    while (this->Lines.Next())
    {
      WAFT_RETURN_IF_FAILED(this->ReadStatement());
    }
    if (this->AreAllTextured)
    {
      std::vector<TextureCoordinate> ofCorners;
      for (const std::size_t index : this->OfCorners)
      {
        ofCorners.push_back(this->Coordinates[index]);
      }
      this->Surface.SetCornerCoordinates(ofCorners);
    }
    return Result::Ok();
  }

private:
  Result ReadStatement()
  {
    const ObjKind kind = this->Lines.Kind;
    if (kind == ObjKind::Point)
    {
      std::array<double, 3> point{};
      WAFT_RETURN_IF_FAILED(ReadCoordinates(this->Lines.Words, 1, this->Lines.Location, point));
      this->Surface.Points.emplace_back(point[0], point[1], point[2]);
    }
    else if (kind == ObjKind::TextureCoordinate)
    {
      if (this->Lines.Words.size() == 2)
      {
        this->Lines.Words.emplace_back("0"); // the second may be left out
      }
      TextureCoordinate coordinate{};
      WAFT_RETURN_IF_FAILED(
        ReadCoordinates(this->Lines.Words, 1, this->Lines.Location, coordinate));
      this->Coordinates.push_back(coordinate);
    }
    else if (kind != ObjKind::Normal)
    {
      return this->ReadElement();
    }
    ++this->Above[static_cast<std::size_t>(kind)];
    return Result::Ok();
  }

  Result ReadElement()
  {
    const bool isFace = this->Lines.Kind == ObjKind::Face;
    const std::size_t least = isFace ? 3 : this->Lines.Kind == ObjKind::Line ? 2 : 1;
    const std::size_t count = this->Lines.Words.size() - 1;
    if (count < least || (isFace && count > MostCorners))
    {
      return Result::Error(this->Lines.Location + "expected " +
                           (count < least ? "at least " + std::to_string(least)
                                          : "at most " + std::to_string(MostCorners)) +
                           " corners, found " + std::to_string(count));
    }
    for (std::size_t i = 1; i <= count; ++i)
    {
      ObjNumbers corner{};
      WAFT_RETURN_IF_FAILED(
        ReadCorner(this->Lines.Words[i], this->Above, this->All, this->Lines.Location, corner));
      if (isFace)
      {
        this->Surface.Corners.push_back(static_cast<int>(corner[0]));
        this->AreAllTextured = this->AreAllTextured && corner[1] >= 0;
        this->OfCorners.push_back(static_cast<std::size_t>(corner[1]));
      }
    }
    if (isFace)
    {
      this->Surface.Ends.push_back(this->Surface.Corners.size());
    }
    return Result::Ok();
  }

  ObjStatements Lines;
  PolygonSurface& Surface;
  ObjNumbers All{};
  ObjNumbers Above{};
  std::vector<TextureCoordinate> Coordinates;
  std::vector<std::size_t> OfCorners; // indices of Coordinates
  bool AreAllTextured = true;
};

} // namespace

Result ReadObj(std::string_view file, PolygonSurface& surface)
{
  surface = PolygonSurface();
  return ObjReading(file, surface).Read();
}

} // namespace waft
