// SPDX-License-Identifier: BSD-3-Clause
// What glTF files may have beside a mesh with indices: each is read, or refused by its name.
#include "Base/TemporaryFolder.h"
#include "Files/GltfMesh.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

// A .gltf with its numbers in a file beside it.
class GltfText
{
public:
  // Numbers of one type as they are; returns the index of their accessor.
  template <class Number>
  int Add(const char* type, int code, std::size_t count, const std::vector<Number>& numbers,
          const std::string& more = "")
  {
    const int view = this->AddView(numbers);
    return this->AddAccessor(type, code, count, ", \"bufferView\": " + std::to_string(view) + more);
  }
  int AddAccessor(const char* type, int code, std::size_t count, const std::string& more)
  {
    this->Accessors += (this->NumberOfAccessors > 0 ? ", " : "") + std::string("{\"type\": \"") +
                       type + "\", \"componentType\": " + std::to_string(code) +
                       ", \"count\": " + std::to_string(count) + more + "}";
    return this->NumberOfAccessors++;
  }
  template <class Number>
  int AddView(const std::vector<Number>& numbers)
  {
    this->Bytes.resize((this->Bytes.size() + 3) / 4 * 4);
    const std::size_t start = this->Bytes.size();
    this->Bytes.append(reinterpret_cast<const char*>(numbers.data()),
                       numbers.size() * sizeof(Number));
    this->Views += (this->NumberOfViews > 0 ? ", " : "") +
                   std::string("{\"buffer\": 0, \"byteOffset\": ") + std::to_string(start) +
                   ", \"byteLength\": " + std::to_string(this->Bytes.size() - start) + "}";
    return this->NumberOfViews++;
  }
  // members: of the root, but for those of the numbers; without any nodes mesh 0 stands at 0.
  std::string Error(const std::string& members, GltfSurface& surface,
                    const std::string& uri = "numbers.bin", const char* file = "numbers.bin") const
  {
    const test::TemporaryFolder folder;
    folder.Write(file, this->Bytes);
    const bool hasNodes = members.find("\"nodes\"") != std::string::npos;
    const std::string text =
      R"({"asset": {"version": "2.0"}, )" + members +
      (hasNodes ? "" : R"(, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])") +
      ", \"accessors\": [" + this->Accessors + "], \"bufferViews\": [" + this->Views +
      "], \"buffers\": [{\"byteLength\": " + std::to_string(this->Bytes.size()) + ", \"uri\": \"" +
      uri + "\"}]}";
    return ReadGltf(folder.Write("mesh.gltf", text), surface).Message();
  }
  GltfSurface Read(const std::string& members) const
  {
    GltfSurface surface;
    EXPECT_EQ(this->Error(members, surface), "") << members;
    return surface;
  }

private:
  std::string Bytes;
  std::string Views;
  std::string Accessors;
  int NumberOfViews = 0;
  int NumberOfAccessors = 0;
};

constexpr int Signed8 = 5120, Unsigned8 = 5121, Signed16 = 5122, Unsigned16 = 5123, Float32 = 5126;

const std::vector<float> Square{ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
const std::string OneMesh = R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])";

using Triangles = std::vector<std::array<int, 3>>;

} // namespace

TEST(GltfForms, TrianglesWithoutIndices)
{
  GltfText text;
  text.Add<float>("VEC3", Float32, 6, { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1 });
  EXPECT_EQ(text.Read(OneMesh).Mesh.Triangles, (Triangles{ { 0, 1, 2 }, { 3, 4, 5 } }));
  // Beside a primitive with indices, points and lines.
  text.Add<std::uint16_t>("SCALAR", Unsigned16, 3, { 2, 1, 0 });
  const auto mixed = text.Read(R"("meshes": [{"primitives": [
    {"attributes": {"POSITION": 0}, "mode": 0},
    {"attributes": {"POSITION": 0}, "indices": 1},
    {"attributes": {"POSITION": 0}, "mode": 1},
    {"attributes": {"POSITION": 0}}]}])");
  EXPECT_EQ(mixed.Mesh.Points.size(), 12u);
  EXPECT_EQ(mixed.Mesh.Triangles, (Triangles{ { 2, 1, 0 }, { 6, 7, 8 }, { 9, 10, 11 } }));
}

TEST(GltfForms, StripsAndFans)
{
  GltfText text;
  text.Add("VEC3", Float32, 4, Square);
  const auto triangles = [&text](const std::string& mode)
  {
    return text
      .Read(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": )" + mode +
            "}]}]")
      .Mesh.Triangles;
  };
  EXPECT_EQ(triangles("5"), (Triangles{ { 0, 1, 2 }, { 2, 1, 3 } }));
  EXPECT_EQ(triangles("6"), (Triangles{ { 0, 1, 2 }, { 0, 2, 3 } }));
}

TEST(GltfForms, SkinsAreWhereTheirJointsAre)
{
  GltfText text;
  text.Add("VEC3", Float32, 4, Square);
  text.Add<std::uint8_t>("VEC4", Unsigned8, 4, { 0, 1, 9, 9, 0, 1, 9, 9, 0, 1, 9, 9, 1, 0, 9, 9 });
  text.Add<float>("VEC4", Float32, 4, { 1, 0, 0, 0, .5, .5, 0, 0, .5, .5, 0, 0, 1, 0, 0, 0 });
  // Bound 2 below; the second joint is the first one's child.
  text.Add<float>("MAT4", Float32, 2, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1,
                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1 });
  const auto skinned = [](const std::string& skin)
  {
    return R"("meshes": [{"primitives": [{"attributes":
      {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}], "scenes": [{"nodes": [0, 2]}],
      "nodes": [{"scale": [100, 100, 100], "children": [1]},
        {"mesh": 0, "skin": 0, "translation": [7, 7, 7]},
        {"translation": [0, 0, 1], "children": [3]}, {"translation": [0, 4, 0]}, {}],
      "skins": [)" +
           skin + "]";
  };
  const auto points =
    text.Read(skinned(R"({"joints": [2, 3], "inverseBindMatrices": 3})")).Mesh.Points;
  EXPECT_EQ(points, (std::vector<Vec3>{ { 0, 0, 3 }, { 1, 2, 3 }, { 1, 3, 3 }, { 0, 5, 3 } }));
  EXPECT_EQ(text.Read(skinned(R"({"joints": [2, 3]})")).Mesh.Points[3], Vec3(0, 5, 1));
  GltfSurface none;
  EXPECT_NE(text.Error(skinned(R"({"joints": [2]})"), none).find("indices of 1 joints, found 1"),
            std::string::npos);
  EXPECT_NE(text.Error(skinned(R"({"joints": [2, 4]})"), none).find("/skins/0/joints/1"),
            std::string::npos);
  EXPECT_NE(text.Error(skinned("{}"), none).find("/skins/0/joints"), std::string::npos);
}

TEST(GltfForms, RequiredExtensionsAreKnownOrNamed)
{
  GltfText text;
  text.Add("VEC3", Float32, 4, Square);
  const auto error = [&text](const std::string& list)
  {
    GltfSurface surface;
    return text.Error(OneMesh + ", \"extensionsRequired\": " + list, surface);
  };
  EXPECT_EQ(error("[]"), "");
  EXPECT_EQ(error(R"(["KHR_materials_unlit", "KHR_texture_basisu", "KHR_mesh_quantization"])"), "");
  EXPECT_EQ(error(R"(["KHR_materials_unlit", "KHR_draco_mesh_compression"])"),
            "/extensionsRequired/1: the mesh is compressed (KHR_draco_mesh_compression): export "
            "without it");
  EXPECT_NE(error(R"(["EXT_meshopt_compression"])").find("is compressed (EXT_meshopt"),
            std::string::npos);
  EXPECT_NE(error(R"(["ACME_warp"])").find("found ACME_warp: export without it"),
            std::string::npos);
  EXPECT_NE(error("[3]").find("list of names"), std::string::npos);
  EXPECT_NE(error("\"ACME_warp\"").find("list of names"), std::string::npos);
}

TEST(GltfForms, QuantizedPoints)
{
  const std::string used = OneMesh + R"(, "extensionsUsed": ["KHR_mesh_quantization"])";
  GltfText parts;
  parts.Add<std::int16_t>("VEC3", Signed16, 3, { 0, 32767, -32768, 32767, 0, 0, 0, 0, -32767 },
                          ", \"normalized\": true");
  EXPECT_EQ(parts.Read(used).Mesh.Points,
            (std::vector<Vec3>{ { 0, 1, -1 }, { 1, 0, 0 }, { 0, 0, -1 } }));
  GltfText whole;
  whole.Add<std::int8_t>("VEC3", Signed8, 3, { 0, 127, -128, 1, 0, 0, 0, 0, 0 });
  EXPECT_EQ(whole.Read(used).Mesh.Points[0], Vec3(0, 127, -128));
  GltfSurface none;
  EXPECT_NE(whole.Error(OneMesh, none).find("expected floats"), std::string::npos);
}

TEST(GltfForms, InstancesAreThereEach)
{
  GltfText text;
  text.Add("VEC3", Float32, 4, Square);
  text.Add<float>("VEC3", Float32, 2, { 0, 0, 0, 3, 0, 0 });
  text.Add<std::int16_t>("VEC4", Signed16, 2, { 0, 0, 0, 32767, 0, 0, 32767, 0 });
  text.Add<float>("VEC3", Float32, 1, { 2, 2, 2 });
  const auto instanced = [](const std::string& attributes)
  {
    return OneMesh + R"(, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0,
      "translation": [0, 0, 5],
      "extensions": {"EXT_mesh_gpu_instancing": {"attributes": )" +
           attributes + "}}}], \"extensionsRequired\": [\"EXT_mesh_gpu_instancing\"]";
  };
  const auto points = text.Read(instanced(R"({"TRANSLATION": 1, "ROTATION": 2})")).Mesh.Points;
  ASSERT_EQ(points.size(), 8u);
  EXPECT_EQ(points[2], Vec3(1, 1, 5));
  EXPECT_LT((points[6] - Vec3(2, -1, 5)).norm(), 1e-6); // half a turn about z
  EXPECT_EQ(text.Read(instanced(R"({"SCALE": 3})")).Mesh.Points[2], Vec3(2, 2, 5));
  GltfSurface none;
  EXPECT_NE(text.Error(instanced(R"({"TRANSLATION": 1, "SCALE": 3})"), none).find("/SCALE"),
            std::string::npos);
  EXPECT_NE(text.Error(instanced("{}"), none).find("TRANSLATION"), std::string::npos);
}

TEST(GltfForms, SparseAccessors)
{
  GltfText text;
  text.AddView(Square);
  text.AddView(std::vector<std::uint16_t>{ 1, 3 });
  text.AddView(std::vector<float>{ 5, 0, 0, 0, 5, 0 });
  const auto sparse = [](int count, const char* more)
  {
    return std::string(more) + ", \"sparse\": {\"count\": " + std::to_string(count) +
           R"(, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 2}})";
  };
  GltfText based = text;
  based.AddAccessor("VEC3", Float32, 4, sparse(2, ", \"bufferView\": 0"));
  EXPECT_EQ(based.Read(OneMesh).Mesh.Points,
            (std::vector<Vec3>{ { 0, 0, 0 }, { 5, 0, 0 }, { 1, 1, 0 }, { 0, 5, 0 } }));
  GltfText ofZeros = text;
  ofZeros.AddAccessor("VEC3", Float32, 4, sparse(2, ""));
  EXPECT_EQ(ofZeros.Read(OneMesh).Mesh.Points,
            (std::vector<Vec3>{ { 0, 0, 0 }, { 5, 0, 0 }, { 0, 0, 0 }, { 0, 5, 0 } }));
  const auto error = [&text](std::size_t elements, int changed)
  {
    GltfText damaged = text;
    damaged.AddAccessor("VEC3", Float32, elements,
                        ", \"sparse\": {\"count\": " + std::to_string(changed) +
                          R"(, "indices": {"bufferView": 1, "componentType": 5123},
                            "values": {"bufferView": 2}})");
    GltfSurface none;
    return damaged.Error(OneMesh, none);
  };
  EXPECT_NE(error(3, 2).find("indices of 3 elements, found 3"), std::string::npos);
  EXPECT_NE(error(4, 3).find("/accessors/0/sparse"), std::string::npos);
  EXPECT_NE(error(4000000000, 2).find("/accessors/0/count"), std::string::npos);
}

TEST(GltfForms, NamesOfFiles)
{
  GltfText text;
  text.Add("VEC3", Float32, 4, Square);
  GltfSurface surface;
  EXPECT_EQ(text.Error(OneMesh, surface, "my%20data%c3%A9.bin", "my data\xc3\xa9.bin"), "");
  EXPECT_EQ(text.Error(OneMesh, surface, "my data.bin", "my data.bin"), "");
  EXPECT_EQ(text.Error(OneMesh, surface, "my%20data.bin", "my%20data.bin"), "");
  EXPECT_EQ(text.Error(OneMesh, surface, "100%.bin", "100%.bin"), "");
  for (const char* name : { "my%2data.bin", "a%00.bin", "%", "%4" })
  {
    EXPECT_NE(text.Error(OneMesh, surface, name).find("/buffers/0/uri"), std::string::npos);
  }
}
