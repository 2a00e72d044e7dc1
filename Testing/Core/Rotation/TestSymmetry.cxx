// SPDX-License-Identifier: BSD-3-Clause
// What the turned or mirrored world, and air that moves along, must not change.
#include "Base/EvenWind.h"
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
/// With either model `other` has the poses of `input`, each changed by `image`.
template <class Image>
void ExpectSamePoses(const RotationInput& input, const RotationInput& other, const Image& image,
                     double tolerance)
{
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    const PoseTrack a = Refine(input, WithModel(model)).Poses[0];
    const PoseTrack b = Refine(other, WithModel(model)).Poses[0];
    ASSERT_EQ(a.Orientations.size(), b.Orientations.size());
    for (std::size_t k = 0; k < a.Orientations.size(); ++k)
    {
      EXPECT_LT(Angle(image(a.Orientations[k]), b.Orientations[k]), tolerance) << k;
    }
  }
}
} // namespace

TEST(Symmetry, AirThatMovesAlongTurnsNothing)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(100));
  input.Tracks[0].AirVelocities =
    CentralDifferences(input.Tracks[0].Positions, input.Scene.Time.Step());
  input.Objects[0].Orientation = Quat(0.8, 0.1, -0.5, 0.3).normalized();
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    const PoseTrack poses = Refine(input, WithModel(model)).Poses[0];
    for (const Quat& q : poses.Orientations)
    {
      EXPECT_LT(Angle(q, input.Objects[0].Orientation), 1e-9);
    }
    for (const Vec3& torque : poses.Torques)
    {
      EXPECT_LT(torque.norm(), 1e-15);
    }
  }
}

TEST(Symmetry, WindIsTheAirWhereTracksCarryNone)
{
  RotationInput input =
    OneObject(CurledLeaf(), StraightPath(Vec3::Zero(), Vec3(0.5, 0.2, -0.1), 60));
  FieldSeries wind =
    test::EvenWind(input.Scene.Bounds, FieldMeaning::Velocity, { 0.5F, 0.2F, -0.1F });
  input.Wind = &wind;
  const RotationOutput still = Refine(input);
  for (const Vec3& torque : still.Poses[0].Torques)
  {
    EXPECT_LT(torque.norm(), 1e-12);
  }
  wind.Meaning = FieldMeaning::Acceleration;
  EXPECT_GT(Refine(input).Poses[0].Torques[0].norm(), 1e-9);
}

TEST(Symmetry, SymmetricPlateBroadsideDoesNotTurn)
{
  const RotationInput input =
    OneObject(Sheet(0.1, 0.06), StraightPath(Vec3(0.0, 0.0, 3.0), Vec3(0.0, 0.0, -0.9), 31));
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    const RotationOutput output = Refine(input, WithModel(model));
    for (const Quat& q : output.Poses[0].Orientations)
    {
      EXPECT_LT(Angle(q, Quat::Identity()), 1e-6);
    }
  }
}

TEST(Symmetry, EquivariantUnderRotationOfTheWorld)
{
  const Quat world = Quat(0.3, -0.6, 0.2, 0.7).normalized();
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  input.Objects[0].AngularVelocity = Vec3(1.0, 2.0, -1.0);
  RotationInput turned = input;
  for (Vec3& x : turned.Tracks[0].Positions)
  {
    x = world * x;
  }
  turned.Objects[0].Orientation = world * input.Objects[0].Orientation;
  turned.Objects[0].AngularVelocity = world * input.Objects[0].AngularVelocity;
  ExpectSamePoses(
    input, turned, [&](const Quat& q) { return Quat(world * q); }, 1e-6);
}

TEST(Symmetry, TheMirrorImageMovesInTheMirror)
{
  // Reflected in the plane x = 0: a polar vector changes its x, a turn its other two components.
  const auto mirrored = [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); };
  Shape leaf = CurledLeaf();
  for (Vec3& p : leaf.Mesh.Points)
  {
    p.z() += 2.0 * p.x() * p.y(); // twisted: not its own mirror image
    // No rows and columns: of pieces equally far to one side, the order in the mesh says which
    // panel they go to. With them the two differ by up to 0.03 rad, without by rounding.
    p.x() += 0.131 * p.y();
    p.y() += 0.0713 * p.x();
  }
  RotationInput input = OneObject(leaf, SwayingPath(40));
  input.Objects[0].Orientation = Quat(0.8, 0.1, -0.5, 0.3).normalized();
  input.Objects[0].AngularVelocity = Vec3(1.0, 2.0, -1.0);
  RotationInput other = input;
  for (Vec3& p : other.Shapes[0].Mesh.Points)
  {
    p = mirrored(p);
  }
  for (auto& triangle : other.Shapes[0].Mesh.Triangles)
  {
    std::swap(triangle[1], triangle[2]);
  }
  for (Vec3& x : other.Tracks[0].Positions)
  {
    x = mirrored(x);
  }
  const auto mirroredTurn = [](const Quat& q) { return Quat(q.w(), q.x(), -q.y(), -q.z()); };
  other.Objects[0].Orientation = mirroredTurn(input.Objects[0].Orientation);
  other.Objects[0].AngularVelocity = -mirrored(input.Objects[0].AngularVelocity);
  ExpectSamePoses(input, other, mirroredTurn, 1e-10);
}
