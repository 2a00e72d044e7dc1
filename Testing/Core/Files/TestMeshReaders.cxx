// SPDX-License-Identifier: BSD-3-Clause
// Mesh files as other programs write them: what is the same surface is read as the same.
#include "Files/MeshReaders.h"

#include <gtest/gtest.h>

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
