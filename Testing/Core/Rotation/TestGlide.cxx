// SPDX-License-Identifier: BSD-3-Clause
// Bodies drawn by their weight: how fast they come down, how they sweep, and that poses that came
// with a path stay.
#include "Refining.h"
#include "Shapes/ThinShape.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{

constexpr int Bodies = 12;
constexpr int LongFall = 600;

/// Bodies of a built-in shape in still air for twenty seconds.
RotationInput InStillAir(const std::string& builtin)
{
  RotationInput input;
  input.Scene.Time = { LongFall, 30.0 };
  input.Shapes.resize(1);
  EXPECT_TRUE(MakeBuiltinShape(builtin, 0.0, input.Shapes[0]));
  ShellProperties shell;
  EXPECT_TRUE(ComputeShellProperties(input.Shapes[0], shell));
  for (int o = 0; o < Bodies; ++o)
  {
    MotionObject object;
    object.ObjectId = o;
    object.OrientationGiven = 0;
    object.SettlingSpeed = input.Shapes[0].SettlingSpeed;
    object.Mass = input.Shapes[0].AreaDensity * shell.Area;
    input.Objects.push_back(object);
    Track track;
    track.ObjectId = o;
    track.Positions.assign(LongFall, Vec3(0.0, 0.0, 50.0));
    input.Tracks.push_back(track);
  }
  input.Glides = true;
  return input;
}

RotationOptions Unlimited()
{
  RotationOptions options;
  options.MaximumTurn = 180.0;
  return options;
}

/// Mean fall after the start [m/s].
double MeanFall(const RotationOutput& output)
{
  double sum = 0.0;
  int count = 0;
  for (const PoseTrack& poses : output.Poses)
  {
    for (std::size_t k = 45; k < poses.Slips.size(); ++k)
    {
      sum -= poses.Slips[k].z();
      ++count;
    }
  }
  return sum / count;
}

/// Root mean square of where it is, sideways, about the mean of the second and a half around, from
/// side to side [m].
double Sweep(const PoseTrack& poses, double step)
{
  constexpr std::size_t Half = 22;
  std::vector<Vec3> way(1, Vec3::Zero());
  for (const Vec3& slip : poses.Slips)
  {
    way.push_back(way.back() + step * slip);
  }
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 45 + Half; k + Half < way.size(); ++k)
  {
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = k - Half; i <= k + Half; ++i)
    {
      mean += way[i] / (2 * Half + 1);
    }
    sum += (way[k] - mean).head<2>().squaredNorm();
    ++count;
  }
  return 2.0 * std::sqrt(sum / count);
}

TEST(Glide, BodiesComeDownAtTheirSettlingSpeed)
{
  for (const char* builtin : { "leaf", "feather", "petal", "disc" })
  {
    const RotationInput input = InStillAir(builtin);
    const RotationOutput output = Refine(input, Unlimited(), 2);
    const double wanted = input.Objects[0].SettlingSpeed;
    EXPECT_NEAR(MeanFall(output), wanted, 0.06 * wanted) << builtin;
  }
}

TEST(Glide, LeavesSweepFromSideToSide)
{
  for (const char* builtin : { "leaf", "maple" })
  {
    const RotationInput input = InStillAir(builtin);
    const RotationOutput output = Refine(input, Unlimited(), 2);
    double sweep = 0.0;
    for (const PoseTrack& poses : output.Poses)
    {
      sweep += Sweep(poses, 1.0 / 30.0) / Bodies;
    }
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (const Vec3& p : input.Shapes[0].Mesh.Points)
    {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double length = (high - low).maxCoeff();
    EXPECT_GT(sweep, 0.5 * length) << builtin;
    EXPECT_LT(sweep, 4.0 * length) << builtin;
  }
}

TEST(Glide, RoundBodiesSinkStraightDown)
{
  RotationInput input = InStillAir("bubble");
  const RotationOutput output = Refine(input);
  for (const Vec3& slip : output.Poses[0].Slips)
  {
    EXPECT_EQ(slip, Vec3(0.0, 0.0, -input.Objects[0].SettlingSpeed));
  }
}

TEST(Glide, PosesThatCameWithAPathStayAndAgree)
{
  RotationInput input = InStillAir("leaf");
  const RotationOutput first = Refine(input, Unlimited());
  input.Glides = false;
  for (std::size_t i = 0; i < input.Tracks.size(); ++i)
  {
    input.Tracks[i].Slips = first.Poses[i].Slips;
    input.Tracks[i].Orientations = first.Poses[i].Orientations;
    input.Tracks[i].AngularVelocities = first.Poses[i].AngularVelocities;
    for (std::size_t k = 0; k < input.Tracks[i].Positions.size(); ++k) // wherever the path went
    {
      input.Tracks[i].Positions[k].x() += 0.01 * static_cast<double>(k);
    }
  }
  const RotationOutput second = Refine(input, Unlimited(), 3);
  for (std::size_t i = 0; i < input.Tracks.size(); ++i)
  {
    ASSERT_EQ(second.Away[i].size(), (LongFall - 16) / 10 + 1u);
    for (std::size_t k = 0; k < first.Poses[i].Orientations.size(); ++k)
    {
      EXPECT_LT(first.Poses[i].Orientations[k].angularDistance(second.Poses[i].Orientations[k]),
                1e-6);
    }
    for (const double away : second.Away[i])
    {
      EXPECT_LT(away, 1e-6);
    }
  }
  EXPECT_TRUE(first.Away[0].empty());
}

TEST(Glide, SlipsAreFoundAnewByThePoses)
{
  RotationInput input = InStillAir("maple");
  const RotationOutput flown = Refine(input, Unlimited(), 2);
  input.SlipsAlone = true;
  double slips = 0.0;
  for (std::size_t i = 0; i < input.Tracks.size(); ++i)
  {
    Track& track = input.Tracks[i];
    track.Orientations = flown.Poses[i].Orientations;
    track.AngularVelocities = flown.Poses[i].AngularVelocities;
    track.Slips = flown.Poses[i].Slips;
    for (std::size_t k = 1; k < track.Slips.size(); ++k) // as of another air
    {
      slips += track.Slips[k].squaredNorm();
      track.Slips[k] *= 0.5;
    }
  }
  const RotationOutput found = Refine(input, Unlimited(), 2);
  double off = 0.0;
  for (std::size_t i = 0; i < input.Tracks.size(); ++i)
  {
    const PoseTrack& poses = found.Poses[i];
    EXPECT_EQ(poses.AngularVelocities, flown.Poses[i].AngularVelocities);
    for (std::size_t k = 0; k < poses.Slips.size(); ++k)
    {
      EXPECT_EQ(poses.Orientations[k].coeffs(), flown.Poses[i].Orientations[k].coeffs());
      off += (poses.Slips[k] - flown.Poses[i].Slips[k]).squaredNorm();
    }
  }
  EXPECT_LT(std::sqrt(off / slips), 1e-3);
}

TEST(Glide, SlipsGoOverToThoseOfAHold)
{
  RotationInput input = InStillAir("maple");
  input.Tracks.resize(1);
  input.Objects.resize(1);
  const RotationOutput flown = Refine(input, Unlimited(), 2);
  Track& track = input.Tracks[0];
  track.Orientations = flown.Poses[0].Orientations;
  track.AngularVelocities = flown.Poses[0].AngularVelocities;
  track.Slips.assign(LongFall, Vec3(0.0, 0.0, -0.1));
  track.Slips[0] = flown.Poses[0].Slips[0];
  Constraint hold;
  hold.ObjectId = 0;
  hold.Kind = ConstraintKind::Position;
  hold.Frame = 300;
  hold.Until = 400;
  hold.Hold = 100;
  hold.Value = track.Positions[300];
  input.Constraints.push_back(hold);
  input.SlipsAlone = true;
  const std::vector<Vec3> slips = Refine(input, Unlimited(), 2).Poses[0].Slips;
  EXPECT_GT((slips[200] - track.Slips[200]).norm(), 0.1);
  for (std::size_t k = 300; k <= 400; ++k)
  {
    EXPECT_EQ(slips[k], track.Slips[k]) << k;
  }
  const auto off = [&](std::size_t k) { return Vec3(slips[k] - flown.Poses[0].Slips[k]); };
  for (std::size_t k = 250; k < 300; ++k)
  {
    EXPECT_LT((off(k + 1) - off(k)).norm(), 0.1 * off(300).norm()) << k; // a fifteenth of it
  }
}

TEST(Glide, TracksWithoutAllOfAPoseAreRefused)
{
  RotationInput input = InStillAir("leaf");
  input.Tracks[3].Slips.assign(LongFall, Vec3::Zero());
  SilentMonitor silent;
  RotationOutput output;
  const Result result = RunRotationRefine(input, {}, SerialFor(), silent, output);
  EXPECT_EQ(result.Message(), "track of object 3: expected Slip, Orientation and AngularVelocity "
                              "of one length with the positions");
}

} // namespace
