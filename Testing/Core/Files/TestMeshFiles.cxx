// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a mesh file is said, and where.
#include "Base/TemporaryFolder.h"
#include "Files/GltfMesh.h"
#include "Files/MeshReaders.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace waft;

namespace
{

struct Bad
{
  std::string File;
  std::string Part; // of the message
};

const std::string PlyHead = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                            "property float y\nproperty float z\nelement face 1\n"
                            "property list uchar int vertex_indices\nend_header\n";
const std::string PlyPoints = "0 0 0\n1 0 0\n0 1 0\n";

template <class Error>
void ExpectErrors(Error error, const std::vector<Bad>& cases)
{
  for (const Bad& bad : cases)
  {
    const std::string message = error(bad.File);
    EXPECT_NE(message.find(bad.Part), std::string::npos) << bad.File << "\n" << message;
  }
}

std::string ObjError(std::string_view file)
{
  PolygonSurface surface;
  return ReadObj(file, surface).Message();
}

std::string PlyError(std::string_view file)
{
  PolygonSurface surface;
  return ReadPly(file, surface).Message();
}

std::string StlError(std::string_view file)
{
  PolygonSurface surface;
  return ReadStl(file, surface).Message();
}

// A triangle in a .gltf; the text of its JSON may be changed.
std::string Gltf(const std::string& from = "", const std::string& to = "")
{
  // Three points of floats, then three indices of 16 bits.
  std::string text = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "translation": [0, 0, 1]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,)"
                     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"
                     R"("}]})";
  const std::size_t at = from.empty() ? std::string::npos : text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

} // namespace

TEST(MeshFiles, ObjIndicesAndNumbers)
{
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(ObjError(points + "# remark\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 -1\n"), "");
  ExpectErrors(ObjError, { { points + "f 1 2 4\n", "line 4: expected an index of 3 points" },
                           { points + "f 1 2 0\n", "line 4" },
                           { points + "f 1 2 -4\n", "line 4" },
                           { points + "f 1 2 999999999\n", "\"999999999\"" },
                           { points + "f 1 2/1 3\n", "texture coordinates" },
                           { points + "f 1 2\n", "at least 3 corners" },
                           { "v 0 0\n", "line 1: expected 3 numbers" },
                           { points + "f 1 2 3///\n", "point/texture/normal" },
                           { points + "f 1 2 -9223372036854775808\n", "index of 3 points" },
                           { points + "l 1 9\n", "index of 3 points" },
                           { points + "f 1 2 \\\n", "line 4: expected at least 3 corners" },
                           { "v nan 0 0\n", "\"nan\"" },
                           { "v 0 1e308 0\n", "at most 1e6" },
                           { "v 0 a 0\n", "\"a\"" } });
}

TEST(MeshFiles, PlyHeadersAndElements)
{
  EXPECT_EQ(PlyError(PlyHead + PlyPoints + "3 0 1 2\n"), "");
  const auto changed = [](const std::string& from, const std::string& to)
  {
    std::string text = PlyHead + PlyPoints + "3 0 1 2\n";
    return text.replace(text.find(from), from.size(), to);
  };
  ExpectErrors(PlyError, { { "", "signature of a PLY" },
                           { PlyHead, "element vertex 0" },
                           { PlyHead + PlyPoints, "element face 0" },
                           { PlyHead + PlyPoints + "3 0 1 3\n", "indices of 3 points" },
                           { PlyHead + PlyPoints + "3 0 1 -1\n", "indices of 3 points" },
                           { PlyHead + PlyPoints + "300 0 1 2\n", "fewer numbers" },
                           { PlyHead + PlyPoints + "5000 0 1 2\n", "3 to 4096 corners" },
                           { PlyHead + PlyPoints + "2 0 1\n", "3 to 4096 corners" },
                           { PlyHead + PlyPoints + "-1\n", "the length of `vertex_indices`" },
                           { PlyHead + PlyPoints + "3 0 1 1.5\n", "indices of 3 points" },
                           { PlyHead + PlyPoints + "comment\n\n", "end of the file" },
                           { changed("end_header", "element face 1\nproperty list int int "
                                                   "vertex_index\nend_header"),
                             "one element `face`" },
                           { changed("end_header", "element odd 1000000000\nend_header"),
                             "\"odd\": expected one with properties" },
                           { changed("vertex 3", "vertex 30000000"), "at most 20000000" },
                           { PlyHead + PlyPoints + "3 0 1\n", "fewer numbers" },
                           { changed("1 0 0", "nan 0 0"), "element vertex 1" },
                           { changed("1 0 0", "1e9 0 0"), "coordinates of at most 1e6" },
                           { changed("property float z\n", ""), "x, y, z" },
                           { changed("vertex 3", "vertex 1000000000"), "element vertex" },
                           { changed("end_header\n", ""), "line 9" } });
}

TEST(MeshFiles, StlWithAllItsTriangles)
{
  std::string binary(84 + 50, '\0');
  binary[80] = 1;
  EXPECT_EQ(StlError(binary), "");
  binary[80] = 2;
  EXPECT_NE(StlError(binary).find("2 triangles"), std::string::npos);
  binary[80] = 1;
  const float huge = 1e30f;
  std::memcpy(&binary[84 + 12], &huge, 4);
  EXPECT_NE(StlError(binary).find("triangle 0"), std::string::npos);
  const std::string text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                           "vertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_EQ(StlError(text + "endsolid\n"), "");
  ExpectErrors(StlError, { { text, "endsolid" },
                           { text + "endsolid\nsolid b\n", "endsolid" },
                           { "solid a\nfacet\nvertex 0 0\n", "line 3" },
                           { "solid a\nvertex 0 0 0\nvertex 1 0 0\nendloop\n",
                             "line 4: expected a loop of 3 vertices, found 2" } });
}

TEST(MeshFiles, GltfTriangleWhereItsNodeStands)
{
  test::TemporaryFolder folder;
  GltfSurface surface;
  ASSERT_EQ(ReadGltf(folder.Write("good.gltf", Gltf()), surface).Message(), "");
  ASSERT_EQ(surface.Mesh.Points.size(), 3u);
  EXPECT_EQ(surface.Mesh.Points[1], Vec3(1, 0, 1));
  EXPECT_EQ(surface.Mesh.Triangles, (std::vector<std::array<int, 3>>{ { 0, 1, 2 } }));
}

TEST(MeshFiles, GlbSaysItsVersionAndLength)
{
  const auto error = [](int version, int longer)
  {
    std::string json = Gltf();
    json.resize(json.size() + (4 - json.size() % 4) % 4, ' ');
    std::string file = "glTF";
    for (const std::size_t number :
         { std::size_t(version), json.size() + std::size_t(20 + longer), json.size() })
    {
      for (int shift = 0; shift < 32; shift += 8)
      {
        file += static_cast<char>(number >> shift);
      }
    }
    const test::TemporaryFolder folder;
    GltfSurface surface;
    return ReadGltf(folder.Write("file.glb", file + "JSON" + json), surface).Message();
  };
  EXPECT_EQ(error(2, 0), "");
  EXPECT_NE(error(9, 0).find("version 2"), std::string::npos);
  EXPECT_NE(error(2, 4).find("a length of at most"), std::string::npos);
}

TEST(MeshFiles, GltfErrorsNameThePointer)
{
  test::TemporaryFolder folder;
  const std::vector<std::array<std::string, 3>> cases = {
    { "\"count\": 3, \"type\": \"VEC3\"", "\"count\": 4, \"type\": \"VEC3\"", "/accessors/0: " },
    { "\"count\": 3, \"type\": \"VEC3\"", "\"count\": 2147483648, \"type\": \"VEC3\"",
      "/accessors/0: " },
    { "\"count\": 3, \"type\": \"VEC3\"", "\"count\": 2, \"type\": \"VEC3\"", "indices of 2" },
    { "\"bufferView\": 1", "\"bufferView\": 7", "/bufferViews" },
    { "\"byteLength\": 36", "\"byteLength\": 60", "/bufferViews/0" },
    { "\"byteOffset\": 0", "\"byteOffset\": -96", "/bufferViews/0/byteOffset" },
    { "\"type\": \"SCALAR\"", "\"type\": \"VEC3\"", "/accessors/1" },
    { "\"byteLength\": 42", "\"byteLength\": 4200", "/buffers/0/byteLength" },
    { "\"mesh\": 0", "\"mesh\": 0, \"children\": [0]", "/nodes/0/children/0" },
    { "\"nodes\": [0]", "\"nodes\": [3]", "/scenes/0/nodes/0" },
    { "[0, 0, 1]", "[0, 0, 1e300]", "coordinates of at most 1e6" },
    { "base64,AAAA", "base64,!AAA", "base64" },
    { "data:application/octet-stream;base64,", "none.bin", "/buffers/0/uri" },
    { "\"asset\"", "asset", "no JSON object" },
  };
  for (const auto& [from, to, part] : cases)
  {
    GltfSurface surface;
    const std::string message =
      ReadGltf(folder.Write("bad.gltf", Gltf(from, to)), surface).Message();
    EXPECT_NE(message.find(part), std::string::npos) << to << "\n" << message;
  }
}
