// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Primitives.h"
#include "Base/ShapeMeasures.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

// Two triangles of areas 0.5 and 1, the second one raised by 3 cm.
Shape TwoTriangles()
{
  Shape shape;
  shape.Mesh.Points = { { 0.0, 0.0, -0.02 }, { 1.0, 0.0, -0.02 }, { 0.0, 1.0, -0.02 },
                        { 0.0, 0.0, 0.01 },  { 2.0, 0.0, 0.01 },  { 0.0, 1.0, 0.01 } };
  shape.Mesh.Triangles = { { 0, 1, 2 }, { 3, 4, 5 } };
  shape.AreaDensity = 0.2;
  return shape;
}

} // namespace

TEST(ShapeMeasures, OfTwoTriangles)
{
  const Shape shape = TwoTriangles();
  EXPECT_DOUBLE_EQ(SurfaceArea(shape.Mesh), 1.5);
  EXPECT_DOUBLE_EQ(ShellMass(shape), 0.3);
  EXPECT_DOUBLE_EQ(LargestExtent(shape.Mesh), 2.0);
  EXPECT_DOUBLE_EQ(ClearanceRadius(shape), 1.0);
  EXPECT_DOUBLE_EQ(RestHeight(shape), 0.02);
  const Vec3 expected((0.5 / 3.0 + 2.0 / 3.0) / 1.5, 1.0 / 3.0, 0.0);
  EXPECT_LT((ShellCentroid(shape.Mesh) - expected).norm(), 1e-15);
}

TEST(ShapeMeasures, OnlyALightClosedFilmLetsLightThrough)
{
  Shape bubble;
  bubble.Mesh = MakeBox({ Vec3(0.0, 0.0, 0.0), Vec3(1.0, 1.0, 1.0) });
  bubble.AreaDensity = 0.002;
  EXPECT_LT(Opacity(bubble), 0.5);
  EXPECT_GT(Opacity(bubble), 0.1);
  Shape heavy = bubble;
  heavy.AreaDensity = 0.1;
  EXPECT_EQ(Opacity(heavy), 1.0);
  Shape open = bubble;
  open.Mesh.Triangles.pop_back();
  EXPECT_EQ(Opacity(open), 1.0);
}

TEST(ShapeMeasures, TrianglesWithoutAreaAreCounted)
{
  TriangleMesh mesh = TwoTriangles().Mesh;
  EXPECT_EQ(RemarkOnFlatTriangles(mesh), "");
  mesh.Points.emplace_back(0.0, 1e-4, -0.02); // a sliver, but a triangle
  mesh.Triangles.push_back({ 0, 1, 6 });
  EXPECT_EQ(RemarkOnFlatTriangles(mesh), "");
  mesh.Triangles.push_back({ 2, 0, 2 });
  EXPECT_NE(RemarkOnFlatTriangles(mesh).find("1 of 4 triangles has no area"), std::string::npos);
  mesh.Points.emplace_back(1.0 / 3.0F, 1e-9, -0.02); // on a line, as a file of floats has it
  mesh.Triangles.push_back({ 0, 1, 7 });
  mesh.Triangles.push_back({ 3, 3, 3 });
  EXPECT_NE(RemarkOnFlatTriangles(mesh).find("3 of 6 triangles have no area"), std::string::npos);
}

TEST(ShapeMeasures, OfAMeshWithoutArea)
{
  TriangleMesh mesh;
  EXPECT_EQ(LargestExtent(mesh), 0.0);
  EXPECT_EQ(ShellCentroid(mesh), Vec3::Zero());
  mesh.Points = { { 1.0, 0.0, 0.0 }, { 3.0, 0.0, 0.0 } };
  EXPECT_EQ(ShellCentroid(mesh), Vec3(2.0, 0.0, 0.0));
}
