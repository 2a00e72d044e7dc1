// SPDX-License-Identifier: BSD-3-Clause
// Mesh files as other programs write them: what is the same surface is read as the same.
#include "Files/FileBytes.h"
#include "Files/MeshReaders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace waft;

namespace
{

std::string Replaced(std::string text, const std::string& from, const std::string& to)
{
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
  {
    text.replace(at, from.size(), to);
  }
  return text;
}

PolygonSurface Read(Result (*read)(std::string_view, PolygonSurface&), const std::string& file)
{
  PolygonSurface surface;
  EXPECT_EQ(read(file, surface).Message(), "") << file;
  return surface;
}

void ExpectSame(const PolygonSurface& a, const PolygonSurface& b, const std::string& what)
{
  EXPECT_EQ(a.Points, b.Points) << what;
  EXPECT_EQ(a.Corners, b.Corners) << what;
  EXPECT_EQ(a.Ends, b.Ends) << what;
  EXPECT_EQ(a.TextureCoordinates, b.TextureCoordinates) << what;
}

const std::string SquareHead = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                               "property float y\nproperty float z\nelement face 2\n"
                               "property list uchar int vertex_indices\nend_header\n";
const std::string SquareRows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 2 1\n";

template <class Number>
void Append(std::string& bytes, ByteOrder order, Number number)
{
  char raw[sizeof(Number)];
  std::memcpy(raw, &number, sizeof(Number));
  if (order == ByteOrder::Big)
  {
    std::reverse(std::begin(raw), std::end(raw));
  }
  bytes.append(raw, sizeof(Number));
}

// The rows of SquareRows in bytes, each point with a quality behind it, which is no number.
template <class Count, class Index>
std::string PlyBytes(std::string head, ByteOrder order)
{
  const bool isLittle = order == ByteOrder::Little;
  head = Replaced(head, "ascii", isLittle ? "binary_little_endian" : "binary_big_endian");
  std::string file = Replaced(head, "float z", "float z\nproperty double quality");
  for (const Vec3& point : { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0) })
  {
    for (const double x : point)
    {
      Append(file, order, static_cast<float>(x));
    }
    Append(file, order, std::nan(""));
  }
  for (const std::vector<int>& face : { std::vector<int>{ 0, 1, 2, 3 }, { 0, 2, 1 } })
  {
    Append(file, order, static_cast<Count>(face.size()));
    for (const int index : face)
    {
      Append(file, order, static_cast<Index>(index));
    }
  }
  return file;
}

const std::string StlText = "solid plate\n"
                            "facet normal 0 0 1\n  outer loop\n    vertex 0 0 0\n"
                            "    vertex 1 0 0\n    vertex 1 1 0\n  endloop\nendfacet\n"
                            "facet normal 0 0 1\n  outer loop\n    vertex 0 0 0\n"
                            "    vertex 1 1 0\n    vertex 0 1e0 0\n  endloop\nendfacet\n"
                            "endsolid plate\n";

// The same in bytes behind a header.
std::string StlBytes(std::string header)
{
  header.resize(80, ' ');
  Append(header, ByteOrder::Little, std::uint32_t{ 2 });
  for (const std::vector<float>& corners :
       { std::vector<float>{ 0, 0, 0, 1, 0, 0, 1, 1, 0 }, { 0, -0.f, 0, 1, 1, 0, 0, 1, 0 } })
  {
    header.append(12, '\0');
    for (const float x : corners)
    {
      Append(header, ByteOrder::Little, x);
    }
    header.append(2, '\0');
  }
  return header;
}

const std::string ObjPoints = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string ObjSquare = ObjPoints + "f 1 2 3 4\nf 1 3 2\n";

} // namespace

TEST(MeshReaders, ObjForms)
{
  const PolygonSurface square = Read(ReadObj, ObjSquare);
  EXPECT_EQ(square.Points.size(), 4u);
  EXPECT_EQ(square.Corners, (std::vector<int>{ 0, 1, 2, 3, 0, 2, 1 }));
  EXPECT_EQ(square.Ends, (std::vector<std::size_t>{ 4, 7 }));
  const std::string normals = ObjPoints + "vn 0 0 1\nvn nan nan nan\n";
  const std::string coordinates = ObjPoints + "vt 0 0\nvt 1\n";
  for (const std::string& form : {
         ObjSquare.substr(0, ObjSquare.size() - 1),
         Replaced(ObjSquare, "\n", "\r\n"),
         Replaced(ObjSquare, "\n", "\r"),
         Replaced(ObjSquare, "\n", "\n\n"),
         Replaced(ObjSquare, "\n", " \t\n"),
         Replaced(ObjSquare, "\n", " # a remark \\\n"),
         Replaced(ObjSquare, "\n", "#f 1 2 9\n"),
         Replaced(ObjSquare, " 0\n", " 0 1.0\n"),
         Replaced(ObjSquare, " 0\n", " 0 0.5 0.5 0.5\n"),
         Replaced(ObjSquare, "1 ", "\\\n1 "),
         Replaced(ObjSquare, "1 ", "\\\r\n 1 "),
         "\xef\xbb\xbf" + ObjSquare,
         "mtllib C:\\meshes\\\ng a\\\no\nusemtl\ns off\n" + ObjSquare,
         ObjPoints + "f 1/ 2/ 3/ 4/\nf 1/ 3/ 2/\n",
         ObjPoints + "f 1// 2// 3// 4//\nf 1// 3// 2//\n",
         ObjPoints + "f -4 -3 -2 -1\nf -4 -2 -3\n",
         ObjPoints + "l 1 2 3\np 1\nf 1 2 3 4\nf 1 3 2",
         "f 1 2 3 4\nf 1 3 2\n" + ObjPoints,
         normals + "f 1 2 3 4\nf 1//1 3//1 2//1\n",
         normals + "f 1//1 2//2 3//1 4//2\nf 1//2 3//2 2//2\n",
         coordinates + "f 1/1 2/2 3/1 4/2\nf 1 3 2\n",
         coordinates + "f 1 2 3 4\nf 1 3 2\n",
       })
  {
    ExpectSame(Read(ReadObj, form), square, form);
  }
}

TEST(MeshReaders, ObjTextureCoordinatesAreThePoints)
{
  const std::string coordinates = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  const std::string faces = "f 1/1 2/2 3/3 4/4\nf 1/1 3/3 2/2\n";
  const PolygonSurface whole = Read(ReadObj, ObjPoints + coordinates + faces);
  EXPECT_EQ(whole.Corners, Read(ReadObj, ObjSquare).Corners);
  EXPECT_EQ(whole.TextureCoordinates,
            (std::vector<TextureCoordinate>{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }));
  // The last corner lies on a seam.
  const PolygonSurface seam =
    Read(ReadObj, ObjPoints + coordinates + "usemtl\nf 1/1 2/2 3/3 4/4\nf 1/1 3/3 2/4\n");
  ASSERT_EQ(seam.Points.size(), 5u);
  EXPECT_EQ(seam.Points[4], seam.Points[1]);
  EXPECT_EQ(seam.TextureCoordinates[4], (TextureCoordinate{ 0, 1 }));
  EXPECT_EQ(seam.Corners, (std::vector<int>{ 0, 1, 2, 3, 0, 2, 4 }));
}

TEST(MeshReaders, PlyForms)
{
  const std::string whole = SquareHead + SquareRows;
  const PolygonSurface square = Read(ReadPly, whole);
  ExpectSame(square, Read(ReadObj, ObjSquare), "as OBJ");
  const auto typed = [](const char* type)
  { return Replaced(SquareHead, "list uchar int", std::string("list ") + type); };
  for (const std::string& form : {
         whole.substr(0, whole.size() - 1),
         Replaced(whole, "\n", "\r\n"),
         Replaced(whole, "\n", "\r"),
         Replaced(whole, "\n", " \n"),
         Replaced(SquareHead, "\n", "\n\n") + SquareRows,
         SquareHead + Replaced(SquareRows, "\n", "\n\n"),
         SquareHead + Replaced(SquareRows, "\n", "\ncomment 3 0 1 2\n"),
         "\xef\xbb\xbf" + whole,
         Replaced(whole, "vertex_indices", "vertex_index"),
         Replaced(SquareHead, "end_header", "element edge 0\nend_header") + SquareRows,
         Replaced(SquareHead, "float z", "float z\nproperty float nx") +
           Replaced(SquareRows, " 0\n", " 0 nan\n"),
         Replaced(SquareHead, "end_header", "property char kind\nend_header") +
           Replaced(Replaced(SquareRows, "2 3\n", "2 3 -1\n"), "2 1\n", "2 1 7\n"),
         typed("char int") + SquareRows,
         typed("uint16 double") + SquareRows,
         PlyBytes<std::uint8_t, std::int32_t>(SquareHead, ByteOrder::Little),
         PlyBytes<std::uint8_t, std::int32_t>(SquareHead, ByteOrder::Big),
         PlyBytes<std::int8_t, std::uint32_t>(typed("char uint"), ByteOrder::Big),
         PlyBytes<std::uint16_t, std::int16_t>(typed("ushort short"), ByteOrder::Big),
         PlyBytes<std::int32_t, std::uint8_t>(typed("int uchar"), ByteOrder::Little),
         PlyBytes<std::uint32_t, float>(typed("uint32 float32"), ByteOrder::Little),
         PlyBytes<std::uint8_t, std::int32_t>(Replaced(SquareHead, "\n", "\r\n"),
                                              ByteOrder::Little),
         PlyBytes<std::uint8_t, std::int32_t>(Replaced(SquareHead, "\n", "\r"), ByteOrder::Little),
       })
  {
    ExpectSame(Read(ReadPly, form), square, form);
  }
}

TEST(MeshReaders, PlyTextureCoordinatesOfPointsAndCorners)
{
  const std::string ofPoints =
    Replaced(SquareHead, "float z", "float z\nproperty float s\nproperty float t") +
    Replaced(SquareRows, " 0\n", " 0 0.5 0.25\n");
  EXPECT_EQ(Read(ReadPly, ofPoints).TextureCoordinates,
            std::vector<TextureCoordinate>(4, { 0.5, 0.25 }));
  const std::string ofCorners =
    Replaced(SquareHead, "end_header", "property list uchar float texcoord\nend_header") +
    Replaced(Replaced(SquareRows, "2 3\n", "2 3 8 0 0 1 0 1 1 0 1\n"), "2 1\n",
             "2 1 6 0 0 1 1 0 1\n");
  const PolygonSurface seam = Read(ReadPly, ofCorners);
  ASSERT_EQ(seam.Points.size(), 5u);
  EXPECT_EQ(seam.TextureCoordinates[4], (TextureCoordinate{ 0, 1 }));
  EXPECT_EQ(seam.Corners, (std::vector<int>{ 0, 1, 2, 3, 0, 2, 4 }));
}

TEST(MeshReaders, StlForms)
{
  const PolygonSurface plate = Read(ReadStl, StlText);
  EXPECT_EQ(plate.Points.size(), 4u);
  EXPECT_EQ(plate.Corners, (std::vector<int>{ 0, 1, 2, 0, 2, 3 }));
  EXPECT_EQ(plate.Ends, (std::vector<std::size_t>{ 3, 6 }));
  std::string capitals = StlText;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  for (const std::string& form : {
         StlText.substr(0, StlText.size() - 1),
         Replaced(StlText, "\n", "\r\n"),
         Replaced(StlText, "\n", "\r"),
         Replaced(StlText, "\n", "\n\n"),
         Replaced(StlText, "plate", ""),
         Replaced(StlText, "plate", std::string(3000, 'x')),
         Replaced(StlText, "plate", "facet of a plate"),
         Replaced(Replaced(StlText, "endl", "end l"), "endf", "end f"),
         Replaced(StlText, "endfacet\nfacet", "endfacet\nendsolid\nsolid b\nfacet"),
         Replaced(StlText, "0 0 1\n", "nan nan nan\n"),
         capitals,
         " " + StlText,
         "\n\n\t" + StlText,
         "\xef\xbb\xbf" + StlText,
         StlBytes("made by a scanner"),
         StlBytes("solid facet_plate v2"),
         StlBytes("solid plate\nfacet normal 0 0 1\nendsolid"),
         StlBytes("made by a scanner") + "a tail",
         StlBytes("solid plate") + "a tail",
       })
  {
    ExpectSame(Read(ReadStl, form), plate, form);
  }
  // A triangle with a corner twice has no area and no place in a surface.
  const PolygonSurface thin = Read(ReadStl, Replaced(StlText, "vertex 1 0 0", "vertex 1 1 0"));
  EXPECT_EQ(thin.Ends.size(), 1u);
}
