// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GltfMesh.h"

#include "Base/Limits.h"
#include "Files/FileBytes.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>

namespace waft
{
namespace
{

using Json = nlohmann::json;
using Matrix4 = Eigen::Matrix4d;

// What is wrong with a file; it does not leave this unit.
struct GltfError
{
  std::string Text;
};

[[noreturn]] void Refuse(const std::string& place, const std::string& what)
{
  throw GltfError{ place + ": " + what };
}

// An entry of one of the lists of the file.
const Json& EntryOf(const Json& root, const char* list, std::uint64_t index,
                    const std::string& user)
{
  const auto found = root.find(list);
  if (found == root.end() || !found->is_array() || index >= found->size() ||
      !(*found)[index].is_object())
  {
    Refuse(user, "expected an index of /" + std::string(list) + ", found " + std::to_string(index));
  }
  return (*found)[index];
}

std::uint64_t IndexAt(const Json& object, const char* key, const std::string& place)
{
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned())
  {
    Refuse(place + "/" + key, "expected a whole number from 0 on");
  }
  return found->get<std::uint64_t>();
}

std::uint64_t IndexAt(const Json& object, const char* key, const std::string& place,
                      std::uint64_t absent)
{
  return object.contains(key) ? IndexAt(object, key, place) : absent;
}

std::vector<double> NumbersAt(const Json& object, const char* key, std::vector<double> absent,
                              const std::string& place)
{
  const auto found = object.find(key);
  if (found == object.end())
  {
    return absent;
  }
  bool isGood = found->is_array() && found->size() == absent.size();
  for (std::size_t i = 0; isGood && i < absent.size(); ++i)
  {
    isGood = (*found)[i].is_number();
    absent[i] = isGood ? (*found)[i].get<double>() : 0.0;
    isGood = isGood && std::isfinite(absent[i]);
  }
  if (!isGood)
  {
    Refuse(place + "/" + key, "expected " + std::to_string(absent.size()) + " numbers");
  }
  return absent;
}

std::string DecodedBase64(std::string_view text, const std::string& place)
{
  constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find_last_not_of('=') + 1))
  {
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos)
    {
      Refuse(place, "expected base64, found " + Quoted({ &c, 1 }));
    }
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8)
    {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xff);
    }
  }
  return bytes;
}

// The file's JSON and its buffers.
class GltfFile
{
public:
  explicit GltfFile(const std::string& path) : Path(path)
  {
    this->Open(this->Whole, path, "");
    std::string_view text = this->Whole.View();
    if (text.substr(0, 4) == "glTF")
    {
      text = this->OpenChunks(text);
    }
    this->Root = Json::parse(text, nullptr, false);
    if (!this->Root.is_object())
    {
      throw GltfError{ "expected a glTF 2.0 file, found no JSON object" };
    }
  }

  Json Root;

  /// Numbers of an accessor, `components` an element.
  std::vector<double> Read(std::uint64_t accessor, const std::string& user, const std::string& type,
                           std::size_t components)
  {
    const Json& entry = EntryOf(this->Root, "accessors", accessor, user);
    const std::string place = "/accessors/" + std::to_string(accessor);
    if (entry.value("type", Json()) != type || entry.contains("sparse"))
    {
      Refuse(place, "expected " + type + ", not sparse");
    }
    const std::uint64_t kind = IndexAt(entry, "componentType", place);
    const int size = kind == 5126 || kind == 5125 ? 4 : kind == 5123 ? 2 : kind == 5121 ? 1 : 0;
    const bool isIndex = components == 1;
    if (size == 0 || (isIndex ? kind == 5126 : components == 3 && kind != 5126))
    {
      Refuse(place + "/componentType", isIndex ? "expected whole numbers" : "expected floats");
    }
    const std::string_view view = this->View(IndexAt(entry, "bufferView", place), place);
    const Json& viewEntry = this->Root["bufferViews"][IndexAt(entry, "bufferView", place)];
    const std::uint64_t element = components * static_cast<std::uint64_t>(size);
    const std::uint64_t stride = IndexAt(viewEntry, "byteStride", place, element);
    const std::uint64_t start = IndexAt(entry, "byteOffset", place, 0);
    const std::uint64_t count = IndexAt(entry, "count", place);
    if (count < 1 || stride < element || stride > 252 || start > view.size() ||
        count > view.size() || !Holds(view, start, (count - 1) * stride + element))
    {
      Refuse(place, "expected " + std::to_string(count) + " elements within its view of " +
                      std::to_string(view.size()) + " bytes");
    }
    const double scale = kind == 5123 ? 65535.0 : kind == 5121 ? 255.0 : 1.0;
    std::vector<double> numbers;
    for (std::uint64_t i = 0; i < count; ++i)
    {
      for (std::size_t c = 0; c < components; ++c)
      {
        const std::size_t at = start + i * stride + c * static_cast<std::size_t>(size);
        const double number =
          kind == 5126 ? ReadReal(view, at, size, ByteOrder::Little)
                       : static_cast<double>(ReadUnsigned(view, at, size, ByteOrder::Little));
        numbers.push_back(isIndex ? number : number / scale);
      }
    }
    return numbers;
  }

private:
  struct Buffer
  {
    std::unique_ptr<FileBytes> File; // beside this one
    std::string Decoded;             // from inside this one
    std::string_view Bytes;
    bool IsOpen = false;
  };

  static void Open(FileBytes& file, const std::string& path, const std::string& place)
  {
    if (const Result opened = file.Open(path); !opened)
    {
      throw GltfError{ place + opened.Message() };
    }
  }

  // The JSON of a .glb; its binary chunk is kept.
  std::string_view OpenChunks(std::string_view file)
  {
    const std::uint64_t size = Holds(file, 0, 12) ? ReadUnsigned(file, 8, 4, ByteOrder::Little) : 0;
    if (size == 0 || size > file.size() || ReadUnsigned(file, 4, 4, ByteOrder::Little) != 2)
    {
      throw GltfError{ "byte 4: expected version 2 and a length of at most " +
                       std::to_string(file.size()) + " bytes, found others" };
    }
    file = file.substr(0, size);
    std::string_view text;
    for (std::uint64_t at = 12; at < file.size();)
    {
      if (!Holds(file, at, 8) || !Holds(file, at + 8, ReadUnsigned(file, at, 4, ByteOrder::Little)))
      {
        throw GltfError{ "byte " + std::to_string(at) +
                         ": expected a whole chunk, found the end of the file" };
      }
      const std::uint64_t size = ReadUnsigned(file, at, 4, ByteOrder::Little);
      const std::string_view type = file.substr(at + 4, 4);
      if (at == 12)
      {
        text = type == "JSON" ? file.substr(at + 8, size) : text;
      }
      else if (type == std::string_view("BIN\0", 4) && this->Binary.empty())
      {
        this->Binary = file.substr(at + 8, size);
      }
      at += 8 + size;
    }
    return text;
  }

  std::string_view BufferBytes(std::uint64_t index, const std::string& user)
  {
    const Json& entry = EntryOf(this->Root, "buffers", index, user);
    const std::string place = "/buffers/" + std::to_string(index);
    this->Buffers.resize(this->Root["buffers"].size());
    Buffer& buffer = this->Buffers[index];
    if (buffer.IsOpen)
    {
      return buffer.Bytes;
    }
    const auto uri = entry.find("uri");
    if (uri == entry.end())
    {
      buffer.Bytes = index == 0 ? this->Binary : std::string_view();
    }
    else if (!uri->is_string())
    {
      Refuse(place + "/uri", "expected a text");
    }
    else if (const auto& name = uri->get_ref<const std::string&>(); name.rfind("data:", 0) == 0)
    {
      const std::size_t comma = name.find(";base64,");
      if (comma == std::string::npos)
      {
        Refuse(place + "/uri", "expected base64, found other data");
      }
      buffer.Decoded = DecodedBase64(std::string_view(name).substr(comma + 8), place + "/uri");
      buffer.Bytes = buffer.Decoded;
    }
    else
    {
      buffer.File = std::make_unique<FileBytes>();
      this->Open(*buffer.File,
                 (std::filesystem::path(this->Path).parent_path() / name.c_str()).string(),
                 place + "/uri: ");
      buffer.Bytes = buffer.File->View();
    }
    const std::uint64_t size = IndexAt(entry, "byteLength", place);
    if (size > buffer.Bytes.size())
    {
      Refuse(place + "/byteLength", "expected at most the " + std::to_string(buffer.Bytes.size()) +
                                      " bytes that are there, found " + std::to_string(size));
    }
    buffer.Bytes = buffer.Bytes.substr(0, size);
    buffer.IsOpen = true;
    return buffer.Bytes;
  }

  std::string_view View(std::uint64_t index, const std::string& user)
  {
    const Json& entry = EntryOf(this->Root, "bufferViews", index, user);
    const std::string place = "/bufferViews/" + std::to_string(index);
    const std::string_view bytes = this->BufferBytes(IndexAt(entry, "buffer", place), place);
    const std::uint64_t start = IndexAt(entry, "byteOffset", place, 0);
    const std::uint64_t size = IndexAt(entry, "byteLength", place);
    if (!Holds(bytes, start, size))
    {
      Refuse(place, "expected bytes within its buffer of " + std::to_string(bytes.size()) +
                      ", found " + std::to_string(size) + " from " + std::to_string(start));
    }
    return bytes.substr(start, size);
  }

  std::string Path;
  FileBytes Whole;
  std::string_view Binary;
  std::vector<Buffer> Buffers;
};

Matrix4 TransformOf(const Json& node, const std::string& place)
{
  if (node.contains("matrix"))
  {
    const std::vector<double> m = NumbersAt(node, "matrix", std::vector<double>(16), place);
    return Eigen::Map<const Matrix4>(m.data());
  }
  const std::vector<double> t = NumbersAt(node, "translation", { 0.0, 0.0, 0.0 }, place);
  const std::vector<double> r = NumbersAt(node, "rotation", { 0.0, 0.0, 0.0, 1.0 }, place);
  const std::vector<double> s = NumbersAt(node, "scale", { 1.0, 1.0, 1.0 }, place);
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

  void Add(const Json& node, const std::string& place, const Matrix4& transform)
  {
    if (!node.contains("mesh"))
    {
      return;
    }
    const std::uint64_t index = IndexAt(node, "mesh", place);
    const Json& mesh = EntryOf(this->File.Root, "meshes", index, place + "/mesh");
    const std::string meshPlace = "/meshes/" + std::to_string(index) + "/primitives";
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array())
    {
      Refuse(meshPlace, "expected a list");
    }
    for (std::size_t i = 0; i < primitives->size(); ++i)
    {
      this->AddPrimitive((*primitives)[i], meshPlace + "/" + std::to_string(i), transform);
    }
  }

private:
  void AddPrimitive(const Json& primitive, const std::string& place, const Matrix4& transform)
  {
    const auto attributes = primitive.is_object() ? primitive.find("attributes") : primitive.end();
    if (!primitive.is_object() || attributes == primitive.end() || !attributes->is_object())
    {
      Refuse(place + "/attributes", "expected an object");
    }
    const std::uint64_t mode = IndexAt(primitive, "mode", place, 4);
    if (mode < 4 || mode > 6)
    {
      return; // points and lines
    }
    const std::string at = place + "/attributes";
    const std::vector<double> places =
      this->File.Read(IndexAt(*attributes, "POSITION", at), at + "/POSITION", "VEC3", 3);
    TriangleMesh& mesh = this->Surface.Mesh;
    const int first = static_cast<int>(mesh.Points.size());
    const std::size_t count = places.size() / 3;
    if (mesh.Points.size() + count > MostOfAKind)
    {
      Refuse(at, "expected at most " + std::to_string(MostOfAKind) + " points in all");
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const Eigen::Vector4d local(places[3 * i], places[3 * i + 1], places[3 * i + 2], 1.0);
      const Vec3 p = (transform * local).head<3>();
      if (!limits::Coordinate.HoldsAll(p))
      {
        Refuse(at,
               "expected coordinates of at most 1e6, found others at point " + std::to_string(i));
      }
      mesh.Points.push_back(p.cast<float>().cast<double>());
    }
    this->AddTextureCoordinates(*attributes, at, count);
    this->AddTriangles(primitive, place, mode, first, count);
  }

  void AddTextureCoordinates(const Json& attributes, const std::string& at, std::size_t count)
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

  void AddTriangles(const Json& primitive, const std::string& place, std::uint64_t mode, int first,
                    std::size_t count)
  {
    std::vector<int> corners;
    if (primitive.contains("indices"))
    {
      const std::string at = place + "/indices";
      for (const double index :
           this->File.Read(IndexAt(primitive, "indices", place), at, "SCALAR", 1))
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
      Refuse(place, "expected at most " + std::to_string(MostOfAKind) + " triangles in all");
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
void AddChildren(const Json& owner, const char* key, const std::string& place,
                 const Matrix4& transform, std::vector<Visit>& pending)
{
  const auto list = owner.find(key);
  if (list == owner.end())
  {
    return;
  }
  const std::string at = place + "/" + key;
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
  const std::uint64_t index = IndexAt(file.Root, "scene", "", 0);
  const Json& scene = EntryOf(file.Root, "scenes", index, "/scene");
  std::vector<Visit> pending;
  AddChildren(scene, "nodes", "/scenes/" + std::to_string(index), Matrix4::Identity(), pending);
  SurfaceBuild build(file, surface);
  std::vector<bool> seen;
  while (!pending.empty())
  {
    const Visit visit = std::move(pending.back());
    pending.pop_back();
    const Json& node = EntryOf(file.Root, "nodes", visit.Node, visit.User);
    seen.resize(file.Root["nodes"].size());
    if (seen[visit.Node])
    {
      Refuse(visit.User,
             "expected each node once, found node " + std::to_string(visit.Node) + " again");
    }
    seen[visit.Node] = true;
    const std::string place = "/nodes/" + std::to_string(visit.Node);
    const Matrix4 transform = visit.Parent * TransformOf(node, place);
    build.Add(node, place, transform);
    AddChildren(node, "children", place, transform, pending);
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
