// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GltfMesh.h"

#include "Base/Limits.h"
#include "Files/GltfScene.h"
#include "Files/PolygonSurface.h"

#include <cmath>
#include <exception>

namespace waft
{
namespace
{

using Matrix4 = Eigen::Matrix4d;

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

// A primitive as it is in the file.
struct Primitive
{
  std::vector<Vec3> Points;
  std::vector<TextureCoordinate> TextureCoordinates; // one a point, or none
  std::vector<std::array<int, 3>> Triangles;
};

class PrimitiveReading
{
public:
  PrimitiveReading(GltfFile& file, const GltfJson& primitive, std::string location) :
    File(file), Entry(primitive), Location(std::move(location))
  {
    const auto attributes = primitive.is_object() ? primitive.find("attributes") : primitive.end();
    if (!primitive.is_object() || attributes == primitive.end() || !attributes->is_object())
    {
      Refuse(this->Location + "/attributes", "expected an object");
    }
    this->Attributes = &*attributes;
    this->Mode = IndexAt(primitive, "mode", this->Location, 4);
  }

  // Others are points and lines.
  bool HasTriangles() const { return this->Mode >= 4 && this->Mode <= 6; }

  // joints: where those of a skin are, or nothing.
  Primitive Read(const std::vector<Matrix4>* joints)
  {
    const bool isQuantized = this->File.Uses("KHR_mesh_quantization");
    Primitive read;
    const std::vector<double> p = this->Attribute(
      "POSITION", "VEC3", isQuantized ? GltfNumbers::Quantized : GltfNumbers::Reals);
    for (std::size_t i = 0; i < p.size(); i += 3)
    {
      read.Points.emplace_back(p[i], p[i + 1], p[i + 2]);
    }
    if (this->Attributes->contains("TEXCOORD_0"))
    {
      const std::vector<double> t = this->Attribute(
        "TEXCOORD_0", "VEC2", isQuantized ? GltfNumbers::Quantized : GltfNumbers::Parts);
      this->ExpectOneAPoint("TEXCOORD_0", t.size() / 2, read);
      for (std::size_t i = 0; i < t.size(); i += 2)
      {
        if (!(std::isfinite(t[i]) && std::isfinite(t[i + 1])))
        {
          Refuse(this->At() + "/TEXCOORD_0", "expected finite numbers");
        }
        read.TextureCoordinates.push_back({ t[i], t[i + 1] });
      }
    }
    if (joints)
    {
      this->Bend(*joints, read);
    }
    read.Triangles = TrianglesOf(this->CornersOf(read.Points.size()), this->Mode);
    return read;
  }

private:
  std::string At() const { return this->Location + "/attributes"; }

  std::vector<double> Attribute(const char* name, const char* type, GltfNumbers kept)
  {
    return this->File.Read(IndexAt(*this->Attributes, name, this->At()), this->At() + "/" + name,
                           type, kept);
  }

  void ExpectOneAPoint(const char* name, std::size_t count, const Primitive& read) const
  {
    if (count != read.Points.size())
    {
      Refuse(this->At() + "/" + name,
             "expected one for each of " + std::to_string(read.Points.size()) + " points");
    }
  }

  // Points go where their joints are, each by its weight.
  void Bend(const std::vector<Matrix4>& joints, Primitive& read)
  {
    const std::vector<double> which = this->Attribute("JOINTS_0", "VEC4", GltfNumbers::Whole);
    const std::vector<double> weights = this->Attribute("WEIGHTS_0", "VEC4", GltfNumbers::Parts);
    this->ExpectOneAPoint("JOINTS_0", which.size() / 4, read);
    this->ExpectOneAPoint("WEIGHTS_0", weights.size() / 4, read);
    for (std::size_t i = 0; i < read.Points.size(); ++i)
    {
      Matrix4 sum = Matrix4::Zero();
      double whole = 0.0;
      for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
      {
        if (weights[k] == 0.0)
        {
          continue; // whatever joint this names
        }
        if (which[k] >= static_cast<double>(joints.size()))
        {
          Refuse(this->At() + "/JOINTS_0", "expected indices of " + std::to_string(joints.size()) +
                                             " joints, found " +
                                             std::to_string(static_cast<long long>(which[k])));
        }
        sum += weights[k] * joints[static_cast<std::size_t>(which[k])];
        whole += weights[k];
      }
      if (!(whole > 0.0 && std::isfinite(whole)))
      {
        Refuse(this->At() + "/WEIGHTS_0",
               "expected a sum of 1, found another at point " + std::to_string(i));
      }
      read.Points[i] = (sum * read.Points[i].homogeneous()).head<3>() / whole;
    }
  }

  std::vector<int> CornersOf(std::size_t count)
  {
    std::vector<int> corners;
    if (!this->Entry.contains("indices"))
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        corners.push_back(static_cast<int>(i));
      }
      return corners;
    }
    const std::string at = this->Location + "/indices";
    for (const double index : this->File.Read(IndexAt(this->Entry, "indices", this->Location), at,
                                              "SCALAR", GltfNumbers::Whole))
    {
      if (index >= static_cast<double>(count))
      {
        Refuse(at, "expected indices of " + std::to_string(count) + " points, found " +
                     std::to_string(static_cast<long long>(index)));
      }
      corners.push_back(static_cast<int>(index));
    }
    return corners;
  }

  GltfFile& File;
  const GltfJson& Entry;
  std::string Location;
  const GltfJson* Attributes = nullptr;
  std::uint64_t Mode = 4;
};

class SurfaceBuild
{
public:
  SurfaceBuild(GltfFile& file, GltfSurface& surface) :
    File(file), Surface(surface), Nodes(NodesOfScene(file)), Skins(file, this->Nodes)
  {
  }

  void Build()
  {
    for (const GltfNode& node : this->Nodes)
    {
      this->AddNode(node);
    }
    if (!this->AreAllTextured)
    {
      this->Surface.TextureCoordinates.clear();
    }
  }

private:
  void AddNode(const GltfNode& node)
  {
    const std::string location = "/nodes/" + std::to_string(node.Index);
    const GltfJson& entry = this->File.Entry("nodes", node.Index, location);
    if (!entry.contains("mesh"))
    {
      return;
    }
    const std::uint64_t index = IndexAt(entry, "mesh", location);
    const GltfJson& mesh = this->File.Entry("meshes", index, location + "/mesh");
    const std::string meshLocation = "/meshes/" + std::to_string(index) + "/primitives";
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array())
    {
      Refuse(meshLocation, "expected a list");
    }
    // Joints alone say where a mesh with a skin is, not its node.
    const std::vector<Matrix4>* joints =
      entry.contains("skin")
        ? &this->Skins.Joints(IndexAt(entry, "skin", location), location + "/skin")
        : nullptr;
    const std::vector<Matrix4> places =
      joints ? std::vector<Matrix4>{ Matrix4::Identity() } : InstancesOf(this->File, node);
    this->Instances += places.size();
    if (this->Instances > MostOfASurface)
    {
      Refuse(location, "expected at most " + std::to_string(MostOfASurface) + " places in all");
    }
    for (std::size_t i = 0; i < primitives->size(); ++i)
    {
      const std::string at = meshLocation + "/" + std::to_string(i);
      PrimitiveReading reading(this->File, (*primitives)[i], at);
      if (reading.HasTriangles())
      {
        const Primitive primitive = reading.Read(joints);
        for (const Matrix4& place : places)
        {
          this->Append(primitive, place, at);
        }
      }
    }
  }

  void Append(const Primitive& primitive, const Matrix4& transform, const std::string& location)
  {
    TriangleMesh& mesh = this->Surface.Mesh;
    const auto expectAtMost = [&location](std::size_t count, const char* what)
    {
      // A mesh that many nodes show must not fill the memory.
      if (count > MostOfASurface)
      {
        Refuse(location, "expected at most " + std::to_string(MostOfASurface) + what + " in all");
      }
    };
    expectAtMost(mesh.Points.size() + primitive.Points.size(), " points");
    expectAtMost(mesh.Triangles.size() + primitive.Triangles.size(), " triangles");
    const int first = static_cast<int>(mesh.Points.size());
    for (std::size_t i = 0; i < primitive.Points.size(); ++i)
    {
      const Vec3 p = (transform * primitive.Points[i].homogeneous()).head<3>();
      if (!limits::Coordinate.HoldsAll(p))
      {
        Refuse(location + "/attributes",
               "expected coordinates of at most 1e6, found others at point " + std::to_string(i));
      }
      mesh.Points.push_back(p.cast<float>().cast<double>());
    }
    for (const auto& [a, b, c] : primitive.Triangles)
    {
      mesh.Triangles.push_back({ first + a, first + b, first + c });
    }
    // All points have texture coordinates, or none.
    auto& coordinates = this->Surface.TextureCoordinates;
    coordinates.insert(coordinates.end(), primitive.TextureCoordinates.begin(),
                       primitive.TextureCoordinates.end());
    this->AreAllTextured = this->AreAllTextured && !primitive.TextureCoordinates.empty();
  }

  GltfFile& File;
  GltfSurface& Surface;
  std::vector<GltfNode> Nodes;
  GltfSkins Skins;
  std::size_t Instances = 0;
  bool AreAllTextured = true;
};

} // namespace

Result ReadGltf(const std::string& path, GltfSurface& surface)
{
  try
  {
    GltfSurface read;
    GltfFile file(path);
    SurfaceBuild(file, read).Build();
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
