// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshReaders.h"

#include "Files/PlyHeader.h"

#include <cmath>

namespace waft
{
namespace
{

// What follows the header of a binary file; its last line ends like its first.
std::string_view BytesBehind(const TextLines& header, std::string_view file)
{
  const std::size_t end = std::min(file.find_first_of("\r\n"), file.size());
  const bool isReturn = file.substr(end, 1) == "\r" && file.substr(end, 2) != "\r\n";
  const std::size_t at = file.size() - header.Remainder().size();
  return file.substr(isReturn && file[at - 1] == '\n' ? at - 1 : at);
}

// Gives the numbers of the elements one after the other, from text or bytes.
class PlyNumbers
{
public:
  PlyNumbers(const PlyHeader& header, const TextLines& lines, std::string_view file) :
    Header(header), Lines(lines), Bytes(BytesBehind(lines, file))
  {
  }

  // A line of a text, but for empty ones and remarks.
  bool BeginElement()
  {
    std::string_view line;
    this->Words.clear();
    this->Word = 0;
    while (this->Header.IsText && (this->Words.empty() || this->Words[0] == "comment"))
    {
      if (!this->Lines.Next(line))
      {
        return false;
      }
      this->Words = WordsOf(line);
    }
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
  // Leaves numbers out, whatever they are.
  bool Skip(const PlyType& type, std::uint64_t count)
  {
    if (this->Header.IsText)
    {
      const bool isThere = count <= this->Words.size() - this->Word;
      this->Word += isThere ? count : 0;
      return isThere;
    }
    const std::uint64_t size = count * static_cast<std::uint64_t>(type.Size);
    const bool isThere = Holds(this->Bytes, 0, size);
    this->Bytes.remove_prefix(isThere ? size : 0);
    return isThere;
  }

private:
  const PlyHeader& Header;
  TextLines Lines;
  std::string_view Bytes;
  std::vector<std::string_view> Words;
  std::size_t Word = 0;
};

// What a property of an element is.
enum class Role
{
  X,
  Y,
  Z,
  U,
  V,
  Corners,           // of a face: indices of points
  CornerCoordinates, // of a face: two numbers a corner
  Other
};

Role RoleOf(const PlyElement& element, const PlyProperty& property)
{
  const auto is = [&property](std::initializer_list<const char*> names)
  { return std::find(names.begin(), names.end(), property.Name) != names.end(); };
  if (element.Name == "vertex" && !property.IsList())
  {
    return is({ "x" })                                  ? Role::X
           : is({ "y" })                                ? Role::Y
           : is({ "z" })                                ? Role::Z
           : is({ "u", "s", "texture_u", "texture_s" }) ? Role::U
           : is({ "v", "t", "texture_v", "texture_t" }) ? Role::V
                                                        : Role::Other;
  }
  if (element.Name == "face" && property.IsList())
  {
    return is({ "vertex_indices", "vertex_index" }) ? Role::Corners
           : is({ "texcoord" })                     ? Role::CornerCoordinates
                                                    : Role::Other;
  }
  return Role::Other;
}

class PlyReading
{
public:
  PlyReading(std::string_view file, PolygonSurface& surface) : File(file), Surface(surface) {}

  Result Read()
  {
    TextLines lines(this->File);
    PlyHeader header;
    WAFT_RETURN_IF_FAILED(ReadPlyHeader(lines, header));
    WAFT_RETURN_IF_FAILED(this->CheckElements(header));
    PlyNumbers numbers(header, lines, this->File);
    for (const PlyElement& element : header.Elements)
    {
      std::vector<Role> roles;
      for (const PlyProperty& property : element.Properties)
      {
        roles.push_back(RoleOf(element, property));
      }
      for (long long i = 0; i < element.Count; ++i)
      {
        if (const Result read = this->ReadElement(element, roles, numbers); !read)
        {
          return Result::Error("element " + Printable(element.Name) + " " + std::to_string(i) +
                               ": " + read.Message());
        }
      }
    }
    if (this->AreAllTextured)
    {
      this->Surface.SetCornerCoordinates(this->OfCorners);
    }
    return Result::Ok();
  }

private:
  Result CheckElements(const PlyHeader& header)
  {
    std::array<int, 8> found{};
    std::array<int, 2> elements{}; // vertex, face
    for (const PlyElement& element : header.Elements)
    {
      const bool isVertex = element.Name == "vertex";
      const bool isUsed = isVertex || element.Name == "face";
      if (element.Count > 0 && element.Properties.empty())
      {
        return Result::Error("element " + Quoted(element.Name) + ": expected one with properties");
      }
      if (isUsed && element.Count > static_cast<long long>(MostOfASurface))
      {
        return Result::Error("element " + element.Name + ": expected at most " +
                             std::to_string(MostOfASurface) + ", found " +
                             std::to_string(element.Count));
      }
      for (const PlyProperty& property : element.Properties)
      {
        ++found[static_cast<std::size_t>(RoleOf(element, property))];
      }
      elements[isVertex ? 0 : 1] += isUsed ? 1 : 0;
      this->Points = isVertex ? element.Count : this->Points;
    }
    const auto has = [&found](Role role) { return found[static_cast<std::size_t>(role)] == 1; };
    this->HasCoordinates = has(Role::U) && has(Role::V);
    this->AreAllTextured = has(Role::CornerCoordinates);
    return elements[0] == 1 && elements[1] == 1 && has(Role::X) && has(Role::Y) && has(Role::Z) &&
               has(Role::Corners)
             ? Result::Ok()
             : Result::Error("expected one element `vertex` with x, y, z and one element `face` "
                             "with a list `vertex_indices`");
  }

  Result ReadElement(const PlyElement& element, const std::vector<Role>& roles, PlyNumbers& numbers)
  {
    if (!numbers.BeginElement())
    {
      return Result::Error("expected it, found the end of the file");
    }
    std::array<double, 5> vertex{}; // by their roles
    const std::size_t first = this->Surface.Corners.size();
    this->Row.clear();
    for (std::size_t k = 0; k < roles.size(); ++k)
    {
      const PlyProperty& property = element.Properties[k];
      double count = 1.0;
      if (property.IsList() && (!numbers.Next(property.Count, count) || count < 0.0 ||
                                count != std::floor(count) || count > 4294967295.0))
      {
        return Result::Error("expected the length of `" + Printable(property.Name) + "`");
      }
      bool isThere = true;
      if (roles[k] == Role::Other)
      {
        isThere = numbers.Skip(property.Type, static_cast<std::uint64_t>(count));
      }
      else if (roles[k] == Role::Corners)
      {
        WAFT_RETURN_IF_FAILED(this->ReadCorners(property, count, numbers, isThere));
      }
      else if (roles[k] == Role::CornerCoordinates)
      {
        for (double i = 0.0; i < count && isThere; ++i)
        {
          isThere = numbers.Next(property.Type, this->Row.emplace_back());
        }
      }
      else
      {
        isThere = numbers.Next(property.Type, vertex[static_cast<std::size_t>(roles[k])]);
      }
      if (!isThere)
      {
        return Result::Error("expected all of `" + Printable(property.Name) +
                             "`, found fewer numbers");
      }
    }
    return element.Name == "vertex" ? this->AddPoint(vertex)
           : element.Name == "face" ? this->AddFace(first)
                                    : Result::Ok();
  }

  Result ReadCorners(const PlyProperty& property, double count, PlyNumbers& numbers, bool& isThere)
  {
    if (count < 3.0 || count > static_cast<double>(MostCorners))
    {
      return Result::Error("expected 3 to " + std::to_string(MostCorners) + " corners, found " +
                           std::to_string(static_cast<long long>(count)));
    }
    for (double i = 0.0; i < count && isThere; ++i)
    {
      double index = 0.0;
      isThere = numbers.Next(property.Type, index);
      if (isThere && !(index >= 0.0 && index < static_cast<double>(this->Points) &&
                       index == std::floor(index)))
      {
        return Result::Error("expected indices of " + std::to_string(this->Points) +
                             " points, found another");
      }
      this->Surface.Corners.push_back(static_cast<int>(index));
    }
    return Result::Ok();
  }

  Result AddPoint(const std::array<double, 5>& vertex)
  {
    if (!limits::Coordinate.HoldsAll(vertex))
    {
      return Result::Error("expected coordinates of at most 1e6, found others");
    }
    const auto rounded = [&vertex](std::size_t k) { return static_cast<float>(vertex[k]); };
    this->Surface.Points.emplace_back(rounded(0), rounded(1), rounded(2));
    if (this->HasCoordinates)
    {
      this->Surface.TextureCoordinates.push_back({ rounded(3), rounded(4) });
    }
    return Result::Ok();
  }

  Result AddFace(std::size_t first)
  {
    if (!limits::Coordinate.HoldsAll(this->Row))
    {
      return Result::Error("expected texture coordinates of at most 1e6, found others");
    }
    const std::size_t count = this->Surface.Corners.size() - first;
    this->AreAllTextured = this->AreAllTextured && this->Row.size() == 2 * count;
    for (std::size_t i = 0; this->AreAllTextured && i < count; ++i)
    {
      this->OfCorners.push_back({ this->Row[2 * i], this->Row[2 * i + 1] });
    }
    this->Surface.Ends.push_back(this->Surface.Corners.size());
    return Result::Ok();
  }

  std::string_view File;
  PolygonSurface& Surface;
  long long Points = 0;
  bool HasCoordinates = false;              // of points
  bool AreAllTextured = false;              // the corners, each by itself
  std::vector<TextureCoordinate> OfCorners; // as long as they are
  std::vector<double> Row;                  // texture coordinates of a face
};

} // namespace

Result ReadPly(std::string_view file, PolygonSurface& surface)
{
  surface = PolygonSurface();
  return PlyReading(file, surface).Read();
}

} // namespace waft
