// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GltfScene.h"

#include "Files/PolygonSurface.h"

#include <utility>

namespace waft
{
namespace
{

using Matrix4 = Eigen::Matrix4d;

Matrix4 TransformOf(const std::vector<double>& t, const std::vector<double>& r,
                    const std::vector<double>& s)
{
  Matrix4 transform = Matrix4::Identity();
  const Eigen::Quaterniond turn(r[3], r[0], r[1], r[2]);
  transform.topLeftCorner<3, 3>() =
    turn.normalized().toRotationMatrix() * Vec3(s[0], s[1], s[2]).asDiagonal();
  transform.topRightCorner<3, 1>() = Vec3(t[0], t[1], t[2]);
  return transform;
}

Matrix4 TransformOf(const GltfJson& node, const std::string& location)
{
  if (node.contains("matrix"))
  {
    const std::vector<double> m = NumbersAt(node, "matrix", std::vector<double>(16), location);
    return Eigen::Map<const Matrix4>(m.data());
  }
  return TransformOf(NumbersAt(node, "translation", { 0.0, 0.0, 0.0 }, location),
                     NumbersAt(node, "rotation", { 0.0, 0.0, 0.0, 1.0 }, location),
                     NumbersAt(node, "scale", { 1.0, 1.0, 1.0 }, location));
}

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

// The entry of `owner`, an object.
const GltfJson& ObjectAt(const GltfJson& owner, const char* key, const std::string& location)
{
  const auto found = owner.find(key);
  if (found == owner.end() || !found->is_object())
  {
    Refuse(location + "/" + key, "expected an object");
  }
  return *found;
}

} // namespace

std::vector<GltfNode> NodesOfScene(const GltfFile& file)
{
  const std::uint64_t index = IndexAt(file.Root(), "scene", "", 0);
  const GltfJson& scene = file.Entry("scenes", index, "/scene");
  std::vector<Visit> pending;
  AddChildren(scene, "nodes", "/scenes/" + std::to_string(index), Matrix4::Identity(), pending);
  std::vector<GltfNode> nodes;
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
    nodes.push_back({ visit.Node, transform });
    AddChildren(node, "children", location, transform, pending);
  }
  return nodes;
}

std::vector<Matrix4> InstancesOf(GltfFile& file, const GltfNode& node)
{
  constexpr const char* name = "EXT_mesh_gpu_instancing";
  std::string location = "/nodes/" + std::to_string(node.Index);
  const GltfJson& entry = file.Entry("nodes", node.Index, location);
  if (!entry.contains("extensions") || !ObjectAt(entry, "extensions", location).contains(name))
  {
    return { node.Transform };
  }
  location += "/extensions";
  const GltfJson& extension = ObjectAt(entry["extensions"], name, location);
  location += std::string("/") + name;
  const GltfJson& attributes = ObjectAt(extension, "attributes", location);
  location += "/attributes";
  std::size_t count = 0;
  const auto read =
    [&](const char* key, const char* type, GltfNumbers kept, std::vector<double> absent)
  {
    const std::size_t width = absent.size();
    if (attributes.contains(key))
    {
      absent = file.Read(IndexAt(attributes, key, location), location + "/" + key, type, kept);
      if (count > 0 && absent.size() != count * width)
      {
        Refuse(location + "/" + key, "expected " + std::to_string(count) + " elements");
      }
      count = absent.size() / width;
    }
    return absent;
  };
  const auto t = read("TRANSLATION", "VEC3", GltfNumbers::Reals, { 0.0, 0.0, 0.0 });
  const auto r = read("ROTATION", "VEC4", GltfNumbers::Parts, { 0.0, 0.0, 0.0, 1.0 });
  const auto s = read("SCALE", "VEC3", GltfNumbers::Reals, { 1.0, 1.0, 1.0 });
  if (count == 0)
  {
    Refuse(location, "expected TRANSLATION, ROTATION or SCALE");
  }
  std::vector<Matrix4> instances;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto at = [i](const std::vector<double>& all, std::size_t width)
    {
      const auto first =
        all.begin() + static_cast<std::ptrdiff_t>(all.size() > width ? i * width : 0);
      return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(width));
    };
    instances.push_back(node.Transform * TransformOf(at(t, 3), at(r, 4), at(s, 3)));
  }
  return instances;
}

GltfSkins::GltfSkins(GltfFile& file, const std::vector<GltfNode>& nodes) : File(file)
{
  for (const GltfNode& node : nodes)
  {
    this->Places.emplace(node.Index, node.Transform);
  }
}

const std::vector<Matrix4>& GltfSkins::Joints(std::uint64_t skin, const std::string& user)
{
  const auto [known, isNew] = this->Skins.try_emplace(skin);
  if (!isNew)
  {
    return known->second;
  }
  const GltfJson& entry = this->File.Entry("skins", skin, user);
  const std::string location = "/skins/" + std::to_string(skin);
  const auto joints = entry.find("joints");
  if (joints == entry.end() || !joints->is_array() || joints->empty())
  {
    Refuse(location + "/joints", "expected a list of nodes");
  }
  std::vector<double> bound;
  if (entry.contains("inverseBindMatrices"))
  {
    const std::string at = location + "/inverseBindMatrices";
    bound = this->File.Read(IndexAt(entry, "inverseBindMatrices", location), at, "MAT4",
                            GltfNumbers::Reals);
    if (bound.size() < 16 * joints->size())
    {
      Refuse(at, "expected " + std::to_string(joints->size()) + " elements");
    }
  }
  for (std::size_t i = 0; i < joints->size(); ++i)
  {
    const bool isIndex = (*joints)[i].is_number_unsigned();
    const auto place =
      isIndex ? this->Places.find((*joints)[i].get<std::uint64_t>()) : this->Places.end();
    if (place == this->Places.end())
    {
      Refuse(location + "/joints/" + std::to_string(i),
             "expected the index of a node of the scene");
    }
    const Matrix4 back = bound.empty() ? Matrix4(Matrix4::Identity())
                                       : Matrix4(Eigen::Map<const Matrix4>(&bound[16 * i]));
    known->second.push_back(place->second * back);
  }
  return known->second;
}

} // namespace waft
