// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "RasterDrag.h"
#include "Rotation/Rasteriser.h"
#include "RotationFixtures.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::fixtures;

TEST(Rasteriser, AreaOfARectangleAtAnyAngle)
{
  const Shape sheet = Sheet(0.3, 0.1, 3);
  Random random(3);
  for (int i = 0; i < 60; ++i)
  {
    const Vec3 d = random.Direction();
    const double expected = 0.03 * std::abs(d.z());
    EXPECT_NEAR(Rasterise(sheet.Mesh, d, 128).Area(), expected, 0.01 * expected) << d.transpose();
  }
  const Vec3 grazing = Vec3(1.0, 0.7, 0.02).normalized();
  const double expected = 0.03 * grazing.z();
  EXPECT_NEAR(Rasterise(sheet.Mesh, grazing, 128).Area(), expected, 0.01 * expected);
}

TEST(Rasteriser, AreaOfASphere)
{
  const Shape ball = Ball(0.05, 48);
  const double expected = std::acos(-1.0) * 0.05 * 0.05;
  Random random(5);
  for (int i = 0; i < 10; ++i)
  {
    EXPECT_NEAR(Rasterise(ball.Mesh, random.Direction(), 128).Area(), expected, 0.01 * expected);
  }
}

TEST(Rasteriser, SharedEdgesGiveEachPixelToOneTriangle)
{
  // The diagonals of the quads run through pixel centres.
  const RasterView view = Rasterise(Sheet(1.0, 1.0, 4).Mesh, Vec3::UnitZ(), 64);
  int covered = 0;
  int visible = 0;
  for (std::size_t t = 0; t < view.Covered.size(); ++t)
  {
    covered += view.Covered[t];
    visible += view.Visible[t];
  }
  EXPECT_EQ(covered, 64 * 64);
  EXPECT_EQ(visible, 64 * 64);
}

TEST(Rasteriser, TheForemostSurfaceIsSeen)
{
  const RasterView view = Rasterise(Ball(1.0, 16).Mesh, Vec3(0.3, -0.2, 1.0), 64);
  for (std::size_t p = 0; p < view.TriangleIds.size(); ++p)
  {
    if (view.TriangleIds[p] >= 0)
    {
      EXPECT_GT(view.Depths[p], -0.05);
    }
  }
}

TEST(Rasteriser, TorqueOfAnOffCentreTwoPanelPlate)
{
  // Two squares of 0.1 m, at x = 0.15 level and at x = -0.1 tilted by 60 degrees about y.
  TriangleMesh mesh;
  const auto add = [&](const Vec3& center, const Vec3& u, const Vec3& v)
  {
    const int first = static_cast<int>(mesh.Points.size());
    for (const Vec3& corner : { Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(v - u) })
    {
      mesh.Points.push_back(center + corner);
    }
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
    mesh.Triangles.push_back({ first, first + 2, first + 3 });
  };
  const double tilt = std::acos(-1.0) / 3.0;
  const Vec3 lean(std::cos(tilt), 0.0, std::sin(tilt));
  const Vec3 left(-0.1, 0.02, 0.01);
  const Vec3 right(0.15, -0.03, 0.0);
  add(right, 0.05 * Vec3::UnitX(), 0.05 * Vec3::UnitY());
  add(left, 0.05 * lean, 0.05 * Vec3::UnitY());
  const Vec3 w(0.0, 0.0, -1.7);
  const Wrench drag = RasterDrag(Rasterise(mesh, w.normalized(), 128), w, Mat3::Zero(), 1.3, 1.2);
  const double press = 0.5 * 1.3 * 1.2 * 1.7 * 1.7;
  const Vec3 expected = right.cross(Vec3(0.0, 0.0, press * 0.01)) +
                        left.cross(Vec3(0.0, 0.0, press * 0.01 * std::cos(tilt)));
  EXPECT_LT((drag.Torque - expected).norm(), 0.02 * expected.norm());
}
