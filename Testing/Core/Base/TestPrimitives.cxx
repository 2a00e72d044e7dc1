// SPDX-License-Identifier: BSD-3-Clause
#include "Base/MeshNormals.h"
#include "Base/Primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

using namespace waft;

namespace
{

// Positive when the triangles are counter-clockwise seen from outside.
double EnclosedVolume(const TriangleMesh& mesh)
{
  double volume = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    volume += mesh.Points[t[0]].dot(mesh.Points[t[1]].cross(mesh.Points[t[2]])) / 6.0;
  }
  return volume;
}

// Each edge is used once in each direction.
bool IsClosed(const TriangleMesh& mesh)
{
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : mesh.Triangles)
  {
    for (int c = 0; c < 3; ++c)
    {
      ++uses[{ t[c], t[(c + 1) % 3] }];
    }
  }
  for (const auto& [edge, count] : uses)
  {
    const auto other = uses.find({ edge.second, edge.first });
    if (count != 1 || other == uses.end() || other->second != 1)
    {
      return false;
    }
  }
  return !uses.empty();
}

} // namespace

TEST(Primitives, AreClosedAndOutward)
{
  const TriangleMesh box = MakeBox(Box{ Vec3(1.0, -2.0, 0.5), Vec3(2.0, 0.0, 3.5) });
  EXPECT_TRUE(IsClosed(box));
  EXPECT_NEAR(EnclosedVolume(box), 6.0, 1e-12);

  const TriangleMesh sphere = MakeSphere(Vec3(0.3, 0.2, -1.0), 0.7);
  EXPECT_TRUE(IsClosed(sphere));
  EXPECT_NEAR(EnclosedVolume(sphere), 4.0 / 3.0 * M_PI * 0.343, 0.02);

  const TriangleMesh cylinder = MakeCylinder(Vec3(0.1, 0.0, 0.0), Vec3(0.5, 0.4, 2.0), 0.3);
  EXPECT_TRUE(IsClosed(cylinder));
  EXPECT_NEAR(EnclosedVolume(cylinder), M_PI * 0.09 * Vec3(0.4, 0.4, 2.0).norm(), 0.005);
}

TEST(Primitives, PointsLieOnTheirSurface)
{
  const Vec3 center(1.0, 2.0, 3.0);
  for (const Vec3& point : MakeSphere(center, 0.5, 7, 5).Points)
  {
    EXPECT_NEAR((point - center).norm(), 0.5, 1e-12);
  }
}

TEST(SmoothNormals, OfASphereAreRadial)
{
  TriangleMesh sphere = MakeSphere(Vec3::Zero(), 2.0, 64, 32);
  sphere.Points.push_back(Vec3::Zero());
  const std::vector<Vec3> normals = SmoothNormals(sphere);
  for (std::size_t i = 0; i + 1 < normals.size(); ++i)
  {
    EXPECT_GT(normals[i].dot(sphere.Points[i]), 2.0 * 0.999);
  }
  EXPECT_EQ(normals.back(), Vec3(Vec3::UnitZ()));
}
