// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GltfMesh.h"

#include "Base/Limits.h"
#include "Files/GltfFile.h"

#include <cmath>
#include <exception>

namespace waft
{
namespace
{

using Matrix4 = Eigen::Matrix4d;

Matrix4 TransformOf(const GltfJson& node, const std::string& location)
{
  if (node.contains("matrix"))
  {
    const std::vector<double> m = NumbersAt(node, "matrix", std::vector<double>(16), location);
    return Eigen::Map<const Matrix4>(m.data());
  }
  const std::vector<double> t = NumbersAt(node, "translation", { 0.0, 0.0, 0.0 }, location);
  const std::vector<double> r = NumbersAt(node, "rotation", { 0.0, 0.0, 0.0, 1.0 }, location);
  const std::vector<double> s = NumbersAt(node, "scale", { 1.0, 1.0, 1.0 }, location);
  Matrix4 transform = Matrix4::Identity();
  const Eigen::Quaterniond turn(r[3], r[0], r[1], r[2]);
  transform.topLeftCorner<3, 3>() =
    turn.normalized().toRotationMatrix() * Vec3(s[0], s[1], s[2]).asDiagonal();
  transform.topRightCorner<3, 1>() = Vec3(t[0], t[1], t[2]);
  return transform;
}

// Corners of triangles of a primitive's mode (4 list, 5 strip, 6 fan).
std::vector<std::array<int, 3>> TrianglesOf(const std::vector<int>& corners, std::uint64_t mode)
{
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t i = 2; i < corners.size(); i += mode == 4 ? 3 : 1)
  {
    const std::size_t odd = mode == 5 ? i % 2 : 0;
    const std::size_t first = mode == 6 ? 0 : i - 2 + odd;
    triangles.push_back({ corners[first], corners[i - 1 - odd], corners[i] });
  }
  return triangles;
}

class SurfaceBuild
{
public:
  SurfaceBuild(GltfFile& file, GltfSurface& surface) : File(file), Surface(surface) {}

  void Add(const GltfJson& node, const std::string& location, const Matrix4& transform)
  {
    if (!node.contains("mesh"))
    {
      return;
    }
    const std::uint64_t index = IndexAt(node, "mesh", location);
    const GltfJson& mesh = this->File.Entry("meshes", index, location + "/mesh");
    const std::string meshLocation = "/meshes/" + std::to_string(index) + "/primitives";
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array())
    {
      Refuse(meshLocation, "expected a list");
    }
    for (std::size_t i = 0; i < primitives->size(); ++i)
    {
      this->AddPrimitive((*primitives)[i], meshLocation + "/" + std::to_string(i), transform);
    }
  }

private:
  void AddPrimitive(const GltfJson& primitive, const std::string& location,
                    const Matrix4& transform)
  {
    const auto attributes = primitive.is_object() ? primitive.find("attributes") : primitive.end();
    if (!primitive.is_object() || attributes == primitive.end() || !attributes->is_object())
    {
      Refuse(location + "/attributes", "expected an object");
    }
    const std::uint64_t mode = IndexAt(primitive, "mode", location, 4);
    if (mode < 4 || mode > 6)
    {
      return; // points and lines
    }
    const std::string at = location + "/attributes";
    const std::vector<double> coordinates =
      this->File.Read(IndexAt(*attributes, "POSITION", at), at + "/POSITION", "VEC3", 3);
    TriangleMesh& mesh = this->Surface.Mesh;
    const int first = static_cast<int>(mesh.Points.size());
    const std::size_t count = coordinates.size() / 3;
    if (mesh.Points.size() + count > MostOfAKind)
    {
      Refuse(at, "expected at most " + std::to_string(MostOfAKind) + " points in all");
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const Eigen::Vector4d local(coordinates[3 * i], coordinates[3 * i + 1],
                                  coordinates[3 * i + 2], 1.0);
      const Vec3 p = (transform * local).head<3>();
      if (!limits::Coordinate.HoldsAll(p))
      {
        Refuse(at,
               "expected coordinates of at most 1e6, found others at point " + std::to_string(i));
      }
      mesh.Points.push_back(p.cast<float>().cast<double>());
    }
    this->AddTextureCoordinates(*attributes, at, count);
    this->AddTriangles(primitive, location, mode, first, count);
  }

  void AddTextureCoordinates(const GltfJson& attributes, const std::string& at, std::size_t count)
  {
    auto& coordinates = this->Surface.TextureCoordinates;
    const bool isFirst = coordinates.empty() && this->Surface.Mesh.Points.size() == count;
    if (!attributes.contains("TEXCOORD_0") || (!isFirst && coordinates.empty()))
    {
      coordinates.clear(); // all points have them, or none
      return;
    }
    const std::vector<double> numbers =
      this->File.Read(IndexAt(attributes, "TEXCOORD_0", at), at + "/TEXCOORD_0", "VEC2", 2);
    if (numbers.size() != 2 * count)
    {
      Refuse(at + "/TEXCOORD_0", "expected one for each of " + std::to_string(count) + " points");
    }
    for (std::size_t i = 0; i < numbers.size(); i += 2)
    {
      if (!(std::isfinite(numbers[i]) && std::isfinite(numbers[i + 1])))
      {
        Refuse(at + "/TEXCOORD_0", "expected finite numbers");
      }
      coordinates.push_back({ numbers[i], numbers[i + 1] });
    }
  }

  void AddTriangles(const GltfJson& primitive, const std::string& location, std::uint64_t mode,
                    int first, std::size_t count)
  {
    std::vector<int> corners;
    if (primitive.contains("indices"))
    {
      const std::string at = location + "/indices";
      for (const double index :
           this->File.Read(IndexAt(primitive, "indices", location), at, "SCALAR", 1))
      {
        if (index >= static_cast<double>(count))
        {
          Refuse(at, "expected indices of " + std::to_string(count) + " points, found " +
                       std::to_string(static_cast<long long>(index)));
        }
        corners.push_back(first + static_cast<int>(index));
      }
    }
    for (std::size_t i = 0; corners.empty() && i < count; ++i)
    {
      corners.push_back(first + static_cast<int>(i));
    }
    const auto triangles = TrianglesOf(corners, mode);
    auto& all = this->Surface.Mesh.Triangles;
    if (all.size() + triangles.size() > MostOfAKind)
    {
      Refuse(location, "expected at most " + std::to_string(MostOfAKind) + " triangles in all");
    }
    all.insert(all.end(), triangles.begin(), triangles.end());
  }

  // Points or triangles: a mesh that many nodes show must not fill the memory.
  static constexpr std::size_t MostOfAKind = 20'000'000;

  GltfFile& File;
  GltfSurface& Surface;
};

struct Visit
{
  std::uint64_t Node = 0;
  std::string User;
  Matrix4 Parent;
};

// Nodes on `pending` in the order of the file.
void AddChildren(const GltfJson& owner, const char* key, const std::string& location,
                 const Matrix4& transform, std::vector<Visit>& pending)
{
  const auto list = owner.find(key);
  if (list == owner.end())
  {
    return;
  }
  const std::string at = location + "/" + key;
  if (!list->is_array())
  {
    Refuse(at, "expected a list");
  }
  for (std::size_t i = list->size(); i-- > 0;)
  {
    const std::string child = at + "/" + std::to_string(i);
    if (!(*list)[i].is_number_unsigned())
    {
      Refuse(child, "expected the index of a node");
    }
    pending.push_back({ (*list)[i].get<std::uint64_t>(), child, transform });
  }
}

void ReadScene(GltfFile& file, GltfSurface& surface)
{
  const std::uint64_t index = IndexAt(file.Root(), "scene", "", 0);
  const GltfJson& scene = file.Entry("scenes", index, "/scene");
  std::vector<Visit> pending;
  AddChildren(scene, "nodes", "/scenes/" + std::to_string(index), Matrix4::Identity(), pending);
  SurfaceBuild build(file, surface);
  std::vector<bool> seen;
  while (!pending.empty())
  {
    const Visit visit = std::move(pending.back());
    pending.pop_back();
    const GltfJson& node = file.Entry("nodes", visit.Node, visit.User);
    seen.resize(file.Root()["nodes"].size());
    if (seen[visit.Node])
    {
      Refuse(visit.User,
             "expected each node once, found node " + std::to_string(visit.Node) + " again");
    }
    seen[visit.Node] = true;
    const std::string location = "/nodes/" + std::to_string(visit.Node);
    const Matrix4 transform = visit.Parent * TransformOf(node, location);
    build.Add(node, location, transform);
    AddChildren(node, "children", location, transform, pending);
  }
}

} // namespace

Result ReadGltf(const std::string& path, GltfSurface& surface)
{
  try
  {
    GltfSurface read;
    GltfFile file(path);
    ReadScene(file, read);
    surface = std::move(read);
  }
  catch (const GltfError& error)
  {
    return Result::Error(error.Text);
  }
  catch (const std::exception&) // of the JSON library, or no memory
  {
    return Result::Error("expected a glTF 2.0 file that can be read");
  }
  return Result::Ok();
}

} // namespace waft
