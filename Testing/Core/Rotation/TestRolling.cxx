// SPDX-License-Identifier: BSD-3-Clause
// A body on a plane rolls down to where it stands.
#include "Base/Random.h"
#include "Refining.h"
#include "Rotation/Rolling.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
/// A leaf with one corner bent up and a stalk, so that it is not symmetric.
Shape BentLeaf()
{
  Shape leaf = CurledLeaf();
  leaf.Mesh.Points.back().z() += 0.01;
  leaf.Mesh.Points.emplace_back(0.07, 0.004, -0.004);
  return leaf;
}

int Carriers(const Shape& shape, const Quat& q, const Vec3& normal)
{
  const double height = StandingHeight(shape.Mesh.Points, q, normal);
  int carriers = 0;
  for (const Vec3& p : shape.Mesh.Points)
  {
    carriers += normal.dot(q * p) + height < 1e-8 ? 1 : 0;
  }
  return carriers;
}
} // namespace

TEST(Rolling, FromAnyPoseToOneThatNoSmallTurnLowers)
{
  Random random(5);
  for (const Shape& shape : { BentLeaf(), CurledLeaf(), Sheet(0.1, 0.03), Ball(0.05, 8) })
  {
    for (int i = 0; i < 60; ++i)
    {
      const Vec3 normal = (Vec3::UnitZ() + 0.3 * random.Direction()).normalized();
      const Quat start = ExpMap(random.Uniform(0.0, 3.1) * random.Direction());
      const Quat end = RollDown(shape.Mesh.Points, start, normal);
      const double height = StandingHeight(shape.Mesh.Points, end, normal);
      EXPECT_LE(height, StandingHeight(shape.Mesh.Points, start, normal) + 1e-12);
      EXPECT_GE(Carriers(shape, end, normal), 3) << shape.Name << ", start " << i;
      for (int way = 0; way < 24; ++way)
      {
        const Quat near = ExpMap(1e-3 * random.Direction()) * end;
        EXPECT_GE(StandingHeight(shape.Mesh.Points, near, normal), height - 1e-9)
          << shape.Name << ", start " << i;
      }
    }
  }
}

TEST(Rolling, WhatStandsStays)
{
  const Shape leaf = BentLeaf();
  const Quat once = RollDown(leaf.Mesh.Points, ExpMap(Vec3(0.5, -0.8, 2.0)), Vec3::UnitZ());
  EXPECT_LT(Angle(RollDown(leaf.Mesh.Points, once, Vec3::UnitZ()), once), 1e-6);
}

TEST(Rolling, ABalanceFallsWithItsAxisUp)
{
  // A sheet on its edge, and on its corner.
  const Shape sheet = Sheet(0.1, 0.06);
  for (const Vec3& turn :
       { Vec3(0.5 * std::acos(-1.0), 0.0, 0.0), Vec3(0.0, 0.5 * std::acos(-1.0), 0.0) })
  {
    const Quat end = RollDown(sheet.Mesh.Points, ExpMap(turn), Vec3::UnitZ());
    EXPECT_NEAR((end * Vec3::UnitZ()).z(), 1.0, 1e-9);
  }
}

TEST(Rolling, TheHeadingStays)
{
  const Shape leaf = BentLeaf();
  for (int i = 0; i < 12; ++i)
  {
    const Quat start = ExpMap(Vec3(0.0, 0.0, 0.5 * i)) * ExpMap(Vec3(0.6, 0.4, 0.0));
    const Quat end = RollDown(leaf.Mesh.Points, start, Vec3::UnitZ());
    Vec3 before = start * Vec3::UnitX();
    Vec3 after = end * Vec3::UnitX();
    before.z() = after.z() = 0.0;
    EXPECT_GT(before.normalized().dot(after.normalized()), 0.9) << i;
  }
}
