// SPDX-License-Identifier: BSD-3-Clause
// Thin bodies of known poses keep as far apart as they reach to each other, and no farther than
// balls would.
#include "Air/Drift/DriftContacts.h"
#include "Base/Random.h"
#include "Base/ShapeMeasures.h"
#include "Rotation/MeshContact.h"
#include "Rotation/RotationFixtures.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::fixtures;

namespace
{

constexpr double Radius = 0.05; // m

/// Two bodies at two places, in poses.
struct Two
{
  KeptDistances Kept{ 30.0 };
  std::vector<PoseTrack> Poses{ 2 };
  PosedExtents Extents;

  explicit Two(const TriangleMesh& mesh)
  {
    for (PoseTrack& poses : this->Poses)
    {
      this->Kept.AddBody(Radius, 0.8, 1, {});
      poses.Orientations.assign(1, Quat::Identity());
      this->Extents.HalfAxes.push_back(EllipsoidAbout(mesh));
    }
    this->Extents.Poses = &this->Poses;
  }

  std::vector<DriftContact> At(const Vec3& apart) const
  {
    return FindContacts(this->Kept, { { Vec3::Zero() }, { apart } }, 0.0, SerialFor(),
                        this->Extents);
  }
};

Quat AnyPose(Random& random)
{
  return Quat(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
              random.Uniform(-1, 1))
    .normalized();
}

} // namespace

TEST(PosedExtents, AnEllipsoidHoldsItsMesh)
{
  const TriangleMesh mesh = CurledLeaf(0.1).Mesh;
  const Vec3 half = EllipsoidAbout(mesh);
  double farthest = 0.0;
  for (const Vec3& p : mesh.Points)
  {
    farthest = std::max(farthest, p.cwiseQuotient(half).norm());
  }
  EXPECT_NEAR(farthest, 1.0, 1e-12);
  EXPECT_GE(half.z(), 0.1 * half.x() - 1e-12);
  EXPECT_LT(half.z(), 0.4 * half.x());
  EXPECT_NEAR(EllipsoidAbout(Ball(0.03).Mesh).x(), 0.03, 1e-3);
  EXPECT_EQ(EllipsoidAbout(TriangleMesh()), Vec3(Vec3::Zero()));
}

TEST(PosedExtents, LeavesFaceToFaceMayComeNear)
{
  Two two(CurledLeaf(0.1).Mesh);
  const Vec3 half = two.Extents.HalfAxes[0];
  EXPECT_TRUE(two.At(Vec3(0.0, 0.0, 2.01 * half.z())).empty());
  const std::vector<DriftContact> near = two.At(Vec3(0.0, 0.0, 1.9 * half.z()));
  ASSERT_EQ(near.size(), 1U);
  EXPECT_NEAR(near[0].Kept, 2.0 * half.z(), 1e-12);
  // Tip to tip they are balls; an ellipsoid that is longer than the ball does not push.
  const std::vector<DriftContact> tips = two.At(Vec3(1.9 * Radius, 0.0, 0.0));
  ASSERT_EQ(tips.size(), 1U);
  EXPECT_NEAR(tips[0].Kept, std::min(2.0 * Radius, 2.0 * half.x()), 1e-12);
  // A pose that nobody knows is that of a ball.
  two.Poses[1].Orientations.clear();
  ASSERT_EQ(two.At(Vec3(0.0, 0.0, 0.09)).size(), 1U);
  EXPECT_NEAR(two.At(Vec3(0.0, 0.0, 0.09))[0].Kept, 2.0 * Radius, 1e-12);
}

TEST(PosedExtents, WhatKeepsThemDoesNotCut)
{
  const Shape leaf = CurledLeaf(0.1);
  const ContactMesh mesh(leaf.Mesh);
  Two two(leaf.Mesh);
  Random random(2, 5);
  MeshPair pair;
  int cutNearer = 0;
  for (int k = 0; k < 300; ++k)
  {
    two.Poses[0].Orientations[0] = AnyPose(random);
    two.Poses[1].Orientations[0] = AnyPose(random);
    const Vec3 line = AnyPose(random) * Vec3::UnitX();
    const double needed = two.Extents.Needed(0, 1, 0, line);
    for (const double share : { 0.5, 1.0 })
    {
      pair.Place({ &mesh, Vec3::Zero(), two.Poses[0].Orientations[0] },
                 { &mesh, share * needed * line, two.Poses[1].Orientations[0] }, 0.0);
      EXPECT_TRUE(share < 1.0 || !pair.Cut()) << k;
      cutNearer += share < 1.0 && pair.Cut() ? 1 : 0;
    }
  }
  EXPECT_GT(cutNearer, 30) << "it is not far too much";
}
