// SPDX-License-Identifier: BSD-3-Clause
// Bodies in an air that is given as a field: its velocity, its shear, its vorticity.
#include "Base/EvenWind.h"
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
/// u = gradient x, which the lattice has exactly.
FieldSeries LinearAir(const Mat3& gradient)
{
  FieldSeries air = test::EvenWind({ Vec3(-2.0, -2.0, -2.0), Vec3(2.0, 2.0, 2.0) },
                                   FieldMeaning::Velocity, { 0.0F, 0.0F, 0.0F });
  for (std::size_t i = 0; i < 8; ++i)
  {
    const Vec3 corner(i % 2 ? 2.0 : -2.0, (i / 2) % 2 ? 2.0 : -2.0, i / 4 ? 2.0 : -2.0);
    const Vec3 u = gradient * corner;
    for (std::size_t c = 0; c < 3; ++c)
    {
      air.Values[0][i][c] = static_cast<float>(u[static_cast<int>(c)]);
    }
  }
  return air;
}

void ExpectSamePoses(const PoseTrack& a, const PoseTrack& b, double tolerance)
{
  ASSERT_EQ(a.Orientations.size(), b.Orientations.size());
  for (std::size_t k = 0; k < a.Orientations.size(); ++k)
  {
    EXPECT_LE((a.Orientations[k].coeffs() - b.Orientations[k].coeffs()).norm(), tolerance) << k;
    EXPECT_LE((a.AngularVelocities[k] - b.AngularVelocities[k]).norm(), 30.0 * tolerance) << k;
  }
}

RotationInput LeafInAir()
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  input.Objects[0].Orientation = Quat(0.8, 0.1, -0.5, 0.3).normalized();
  return input;
}
} // namespace

TEST(AirAbout, ItCountsInPlaceOfWhatTracksAndWindSay)
{
  RotationInput said = LeafInAir();
  said.Tracks[0].AirVelocities.assign(60, Vec3(0.5, -0.25, 0.125));
  const FieldSeries air =
    test::EvenWind(said.Scene.Bounds, FieldMeaning::Velocity, { 0.5F, -0.25F, 0.125F });
  const FieldSeries wind =
    test::EvenWind(said.Scene.Bounds, FieldMeaning::Velocity, { 3.0F, 0.0F, 1.0F });
  RotationInput given = LeafInAir();
  given.Tracks[0].AirVelocities.assign(60, Vec3(-2.0, 4.0, 1.0));
  given.Wind = &wind;
  given.Air = &air;
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    ExpectSamePoses(Refine(said, WithModel(model)).Poses[0],
                    Refine(given, WithModel(model)).Poses[0], 1e-9); // sampling rounds
  }
}

TEST(AirAbout, AnEmptyOneIsNone)
{
  const FieldSeries none;
  RotationInput input = LeafInAir();
  const PoseTrack before = Refine(input).Poses[0];
  input.Air = &none;
  ExpectSamePoses(before, Refine(input).Poses[0], 0.0);
}

TEST(AirAbout, DampingDrawsABodyToHalfTheVorticity)
{
  // Without pressure only the stickiness acts, and omega = curl u / 2 (1 - exp(-Damping t)).
  const double shear = 6.0; // 1/s
  Mat3 gradient = Mat3::Zero();
  gradient(1, 0) = shear; // curl along z
  const FieldSeries air = LinearAir(gradient);
  RotationInput input = OneObject(Sheet(0.1, 0.05), StraightPath(Vec3::Zero(), Vec3::Zero(), 91));
  input.Scene.AirDensity = 0.0;
  input.Shapes[0].Damping = 0.0;
  input.Air = &air;
  RotationOptions options;
  options.Damping = 1.5;
  const PoseTrack poses = Refine(input, options).Poses[0];
  for (const int k : { 10, 30, 90 })
  {
    const double expected = 0.5 * shear * (1.0 - std::exp(-options.Damping * k / 30.0));
    EXPECT_LT((poses.AngularVelocities[k] - expected * Vec3::UnitZ()).norm(), 1e-9) << k;
  }
}

TEST(AirAbout, ABodyTurnsAlongInAirThatTurnsAsAWhole)
{
  // A ball has no side to prefer: pressure and stickiness end at the turning of the air.
  const Vec3 turning(0.0, 2.0, 0.0);
  const FieldSeries air = LinearAir(CrossMatrix(turning));
  RotationInput input = OneObject(Ball(0.05, 12), StraightPath(Vec3::Zero(), Vec3::Zero(), 151));
  input.Air = &air;
  RotationOptions options;
  options.Damping = 2.0;
  const PoseTrack poses = Refine(input, options).Poses[0];
  EXPECT_LT((poses.AngularVelocities[150] - turning).norm(), 0.02);
}

TEST(AirAbout, ShearTurnsAPlateAndWithTheMirroredOneItTurnsTheOtherWay)
{
  RotationInput input = OneObject(Sheet(0.1, 0.06), StraightPath(Vec3::Zero(), Vec3::Zero(), 16));
  Mat3 gradient = Mat3::Zero();
  gradient(0, 2) = 8.0; // u_x grows with height: curl along y
  const FieldSeries air = LinearAir(gradient);
  const FieldSeries mirrored = LinearAir(-gradient);
  input.Air = &air;
  const Vec3 one = Refine(input).Poses[0].AngularVelocities[15];
  input.Air = &mirrored;
  const Vec3 other = Refine(input).Poses[0].AngularVelocities[15];
  EXPECT_GT(one.y(), 0.1);
  EXPECT_LT((one + other).norm(), 1e-3 * one.norm());
}

TEST(AirAbout, AFieldOfAccelerationsIsRefused)
{
  RotationInput input = LeafInAir();
  const FieldSeries air =
    test::EvenWind(input.Scene.Bounds, FieldMeaning::Acceleration, { 1.0F, 0.0F, 0.0F });
  input.Air = &air;
  SilentMonitor silent;
  RotationOutput output;
  const Result result = RunRotationRefine(input, {}, SerialFor(), silent, output);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.Message(), "Air: expected velocities, found accelerations");
}
