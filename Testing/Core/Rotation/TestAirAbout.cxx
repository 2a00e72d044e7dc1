// SPDX-License-Identifier: BSD-3-Clause
// Bodies in an air that is given as a field: its velocity, its shear, its vorticity.
#include "Base/EvenWind.h"
#include "Refining.h"

#include <algorithm>

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

AirOnTracks Along(const RotationInput& input, const FieldSeries& fields)
{
  AirOnTracks air(input.Tracks, input.Scene.Time);
  EXPECT_TRUE(air.Add(fields));
  air.Finish();
  return air;
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
  const AirOnTracks taken = Along(given, air);
  given.Air = &taken;
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    ExpectSamePoses(Refine(said, WithModel(model)).Poses[0],
                    Refine(given, WithModel(model)).Poses[0], 1e-9); // sampling rounds
  }
}

TEST(AirAbout, AnEmptyOneIsNone)
{
  RotationInput input = LeafInAir();
  const AirOnTracks none = Along(input, FieldSeries());
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
  RotationInput input = OneObject(Sheet(0.1, 0.05), StraightPath(Vec3::Zero(), Vec3::Zero(), 91));
  const AirOnTracks air = Along(input, LinearAir(gradient));
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
  RotationInput input = OneObject(Ball(0.05, 12), StraightPath(Vec3::Zero(), Vec3::Zero(), 151));
  const AirOnTracks air = Along(input, LinearAir(CrossMatrix(turning)));
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
  const AirOnTracks air = Along(input, LinearAir(gradient));
  const AirOnTracks mirrored = Along(input, LinearAir(-gradient));
  input.Air = &air;
  const Vec3 one = Refine(input).Poses[0].AngularVelocities[15];
  input.Air = &mirrored;
  const Vec3 other = Refine(input).Poses[0].AngularVelocities[15];
  EXPECT_GT(one.y(), 0.1);
  EXPECT_LT((one + other).norm(), 1e-3 * one.norm());
}

TEST(AirOnTracks, IsTheFieldsSampledAtEveryFrame)
{
  RotationInput input = LeafInAir();
  input.Tracks.push_back(input.Tracks[0]);
  std::reverse(input.Tracks[1].Positions.begin(), input.Tracks[1].Positions.end());
  FieldSeries air = LinearAir(CrossMatrix(Vec3(1.0, 2.0, -3.0)));
  const FieldSeries::Field once = air.Values[0];
  air.Times = { 0.1, 0.5, 1.21 }; // the frames begin before and end after them
  air.Values.clear();
  for (const float scale : { 1.0F, -0.5F, 2.0F })
  {
    FieldSeries::Field field = once;
    std::transform(once[0].data(), once[0].data() + 3 * once.size(), field[0].data(),
                   [&](float value) { return scale * value; });
    air.Values.push_back(field);
  }
  const AirOnTracks whole = Along(input, air);
  AirOnTracks stepped(input.Tracks, input.Scene.Time);
  for (std::size_t k = 0; k < air.Values.size(); ++k)
  {
    FieldSeries step(static_cast<const SeriesLattice&>(air));
    step.Times = { air.Times[k] };
    step.Values = { air.Values[k] };
    ASSERT_TRUE(stepped.Add(step));
    ASSERT_TRUE(stepped.Add(FieldSeries())); // a pass without a new one
  }
  stepped.Finish();
  for (std::size_t i = 0; i < input.Tracks.size(); ++i)
  {
    for (std::size_t k = 0; k < input.Tracks[i].Positions.size(); ++k)
    {
      Mat3 gradient;
      const Vec3 velocity = air.Sample(input.Tracks[i].Positions[k],
                                       input.Scene.Time.Time(static_cast<double>(k)), gradient);
      for (const AirOnTracks* one : { &whole, static_cast<const AirOnTracks*>(&stepped) })
      {
        EXPECT_LE((one->Velocity(i, k) - velocity).norm(), 1e-6 * (1.0 + velocity.norm())) << k;
        EXPECT_LE((one->Gradient(i, k) - gradient).norm(), 1e-6 * (1.0 + gradient.norm())) << k;
      }
    }
  }
}

TEST(AirOnTracks, RefusesAccelerationsAndAnEarlierTime)
{
  RotationInput input = LeafInAir();
  AirOnTracks air(input.Tracks, input.Scene.Time);
  EXPECT_EQ(
    air.Add(test::EvenWind(input.Scene.Bounds, FieldMeaning::Acceleration, { 1.0F, 0.0F, 0.0F }))
      .Message(),
    "Air: expected velocities, found accelerations");
  FieldSeries step =
    test::EvenWind(input.Scene.Bounds, FieldMeaning::Velocity, { 1.0F, 0.0F, 0.0F });
  ASSERT_TRUE(air.Add(step));
  EXPECT_EQ(air.Add(step).Message(), "Air: expected times that increase");
}
