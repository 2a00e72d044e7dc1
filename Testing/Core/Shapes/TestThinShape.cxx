// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Base/ShapeMeasures.h"
#include "Shapes/ThinShape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace waft;

namespace
{

Shape Built(const std::string& name, double size = 0.0)
{
  Shape shape;
  const Result result = MakeBuiltinShape(name, size, shape);
  EXPECT_TRUE(result) << result.Message();
  return shape;
}

Vec3 Normal(const TriangleMesh& mesh, const std::array<int, 3>& t)
{
  const Vec3& a = mesh.Points[t[0]];
  return (mesh.Points[t[1]] - a).cross(mesh.Points[t[2]] - a);
}

} // namespace

TEST(ThinShape, EveryBuiltinHasItsSizeAndLiesOnItsBodyAxes)
{
  const std::map<std::string, std::array<double, 3>> published = {
    { "leaf", { 0.10, 0.8, 0.10 } },    { "maple", { 0.14, 0.9, 0.11 } },
    { "oak", { 0.13, 0.8, 0.12 } },     { "willow", { 0.12, 0.7, 0.09 } },
    { "feather", { 0.20, 0.4, 0.04 } }, { "down", { 0.05, 0.15, 0.02 } },
    { "petal", { 0.04, 0.6, 0.06 } },   { "bubble", { 0.06, 0.05, 0.002 } },
    { "disc", { 0.10, 0.9, 0.12 } },    { "aspen", { 0.06, 0.8, 0.09 } }
  };
  ASSERT_EQ(BuiltinShapes().size(), published.size());
  for (const auto& [name, numbers] : published)
  {
    SCOPED_TRACE(name);
    const Shape shape = Built(name);
    EXPECT_NEAR(LargestExtent(shape.Mesh), numbers[0], 1e-12);
    EXPECT_EQ(shape.SettlingSpeed, numbers[1]);
    EXPECT_EQ(shape.AreaDensity, numbers[2]);
    EXPECT_LT(ShellCentroid(shape.Mesh).norm(), 1e-12);
    EXPECT_GE(shape.Mesh.Triangles.size(), 200u);
    EXPECT_LE(shape.Mesh.Triangles.size(), 800u);
    EXPECT_EQ(RemarkOnFlatTriangles(shape.Mesh), "");
    ASSERT_EQ(shape.TextureCoordinates.size(), shape.Mesh.Points.size());
    for (const auto& t : shape.TextureCoordinates)
    {
      EXPECT_TRUE(t[0] >= 0.0 && t[0] <= 1.0 && t[1] >= 0.0 && t[1] <= 1.0);
    }
    for (const auto& t : shape.Mesh.Triangles)
    {
      EXPECT_GT(Normal(shape.Mesh, t).norm(), 0.0);
      if (name != "bubble")
      {
        EXPECT_GT(Normal(shape.Mesh, t).z(), 0.0) << "a triangle of a sheet looks down";
      }
    }
    EXPECT_NEAR(LargestExtent(Built(name, 0.33).Mesh), 0.33, 1e-12);
  }
}

TEST(ThinShape, SheetsCurlUpwardsAndRestOnTheirConvexSide)
{
  for (const char* name : { "leaf", "maple", "oak", "willow", "aspen", "feather", "down", "petal" })
  {
    SCOPED_TRACE(name);
    const Shape shape = Built(name);
    double atCenter = 1e300;
    double nearest = 1e300;
    double highest = -1e300;
    for (const Vec3& p : shape.Mesh.Points)
    {
      if (p.head<2>().norm() < nearest)
      {
        nearest = p.head<2>().norm();
        atCenter = p.z();
      }
      highest = std::max(highest, p.z());
    }
    EXPECT_LT(atCenter, 0.0);
    EXPECT_GT(highest, -atCenter);
    EXPECT_GT(RestHeight(shape), 0.0);
    EXPECT_LT(RestHeight(shape), 0.25 * LargestExtent(shape.Mesh));
  }
  EXPECT_NEAR(RestHeight(Built("disc")), 0.0, 1e-12);
}

TEST(ThinShape, DiscHasTheMassOfADiscAndTheBubbleIsClosed)
{
  // The polygon's area is below the circle's by the polygon's own factor.
  const double sides = 56.0;
  const double polygon = 0.5 * sides * std::sin(2.0 * M_PI / sides) * 0.05 * 0.05;
  EXPECT_NEAR(ShellMass(Built("disc")), 0.12 * polygon, 1e-9);
  const Shape bubble = Built("bubble");
  EXPECT_NEAR(SurfaceArea(bubble.Mesh), M_PI * 0.06 * 0.06, 0.02 * M_PI * 0.06 * 0.06);
  std::set<std::pair<int, int>> edges;
  for (const auto& t : bubble.Mesh.Triangles)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_TRUE(edges.insert({ t[c], t[(c + 1) % 3] }).second);
    }
    EXPECT_GT(Normal(bubble.Mesh, t).dot(bubble.Mesh.Points[t[0]]), 0.0);
  }
  for (const auto& [a, b] : edges)
  {
    EXPECT_TRUE(edges.count({ b, a }));
  }
}

TEST(ThinShape, RefusesUnknownNamesAndOptionsOutOfRange)
{
  Shape shape;
  shape.Name = "before";
  const Result result = MakeBuiltinShape("spoon", 0.0, shape);
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("found \"spoon\""), std::string::npos);
  EXPECT_EQ(shape.Name, "before");
  SheetOptions options;
  options.Columns = 3;
  EXPECT_FALSE(options.Validate());
  options = SheetOptions();
  options.Length = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(options.Validate());
  options = SheetOptions();
  options.Curl = -0.1;
  EXPECT_FALSE(options.Validate());
  EXPECT_TRUE(SheetOptions().Validate());
}

TEST(AlignShape, BringsATurnedLeafBackToItsAxes)
{
  const Shape leaf = Built("oak");
  Random random(11);
  for (int trial = 0; trial < 20; ++trial)
  {
    TriangleMesh turned = leaf.Mesh;
    const Mat3 rotation =
      Eigen::AngleAxisd(random.Uniform(0.0, 3.0), random.Direction()).toRotationMatrix();
    const Vec3 shift = 3.0 * random.Direction();
    for (Vec3& p : turned.Points)
    {
      p = 5.0 * (rotation * p) + shift;
    }
    ASSERT_TRUE(AlignShape(0.2, turned));
    EXPECT_NEAR(LargestExtent(turned), 0.2, 1e-12);
    EXPECT_LT(ShellCentroid(turned).norm(), 1e-12);
    TriangleMesh straight = leaf.Mesh;
    ASSERT_TRUE(AlignShape(0.2, straight));
    double farthest = 0.0;
    for (std::size_t i = 0; i < turned.Points.size(); ++i)
    {
      farthest = std::max(farthest, (turned.Points[i] - straight.Points[i]).norm());
    }
    EXPECT_LT(farthest, 1e-9);
  }
}

TEST(AlignShape, KeepsTheConventionOfTheBuiltins)
{
  Shape leaf = Built("leaf");
  TriangleMesh aligned = leaf.Mesh;
  ASSERT_TRUE(AlignShape(0.0, aligned));
  // The largest extent is kept when no size is given; axes turn by a few degrees at most.
  EXPECT_NEAR(LargestExtent(aligned), 0.1, 0.002);
  for (std::size_t i = 0; i < aligned.Points.size(); ++i)
  {
    EXPECT_GT(aligned.Points[i].x() * leaf.Mesh.Points[i].x(), -1e-4);
  }
}

TEST(AlignShape, RefusesWhatHasNoAreaOrIsNotFinite)
{
  TriangleMesh line;
  line.Points = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 } };
  line.Triangles = { { 0, 1, 2 } };
  EXPECT_FALSE(AlignShape(0.1, line));
  TriangleMesh broken = Built("disc").Mesh;
  broken.Points[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(AlignShape(0.1, broken));
}
