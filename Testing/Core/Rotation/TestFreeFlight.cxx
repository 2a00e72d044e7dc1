// SPDX-License-Identifier: BSD-3-Clause
// How bodies turn while nothing is asked of them, and what the knobs do to it.
#include "Base/Random.h"
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
Mat3 BodyInertia(const RotationInput& input)
{
  ShellProperties p;
  EXPECT_TRUE(ComputeShellProperties(input.Shapes[0], p));
  return input.Objects[0].Mass * p.InertiaPerMass;
}
} // namespace

TEST(FreeFlight, WithoutTorqueAngularMomentumStays)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(301));
  input.Scene.AirDensity = 0.0;
  input.Objects[0].AngularVelocity = Vec3(4.0, -2.0, 7.0);
  input.Objects[0].Orientation = Quat(0.8, 0.1, -0.5, 0.3).normalized();
  RotationOptions options;
  options.Damping = 0.0;
  const PoseTrack poses = Refine(input, options).Poses[0];
  const Mat3 inertia = BodyInertia(input);
  const auto momentum = [&](int k)
  {
    const Mat3 turn = poses.Orientations[k].toRotationMatrix();
    return Vec3(turn * inertia * turn.transpose() * poses.AngularVelocities[k]);
  };
  const auto energy = [&](int k) { return 0.5 * momentum(k).dot(poses.AngularVelocities[k]); };
  double turned = 0.0;
  for (int k = 1; k <= 300; ++k)
  {
    EXPECT_LT((momentum(k) - momentum(0)).norm(), 1e-6 * momentum(0).norm());
    EXPECT_NEAR(energy(k), energy(0), 0.02 * energy(0));
    turned = std::max(turned, Angle(poses.Orientations[k], poses.Orientations[0]));
  }
  EXPECT_GT(turned, 1.0);
}

TEST(FreeFlight, DampingRateIsAsStated)
{
  RotationInput input = OneObject(Sheet(0.1, 0.05), StraightPath(Vec3::Zero(), Vec3::Zero(), 91));
  input.Scene.AirDensity = 0.0;
  input.Objects[0].AngularVelocity = Vec3(0.0, 0.0, 9.0);
  RotationOptions options;
  options.Damping = 1.5;
  const PoseTrack poses = Refine(input, options).Poses[0];
  const double rate = std::log(9.0 / poses.AngularVelocities[90].norm()) / 3.0;
  EXPECT_NEAR(rate, 1.5, 0.02 * 1.5);
}

TEST(FreeFlight, LightestBodiesAtGreatSpeedDoNotBlowUp)
{
  Shape down = CurledLeaf(0.02);
  down.AreaDensity = 0.002;
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    RotationInput input = OneObject(down, StraightPath(Vec3::Zero(), Vec3(12.0, 5.0, -9.0), 40));
    input.Objects[0].AngularVelocity = Vec3(50.0, 20.0, 90.0);
    const PoseTrack poses = Refine(input, WithModel(model)).Poses[0];
    for (std::size_t k = 0; k < poses.Orientations.size(); ++k)
    {
      EXPECT_NEAR(poses.Orientations[k].norm(), 1.0, 1e-12);
      EXPECT_LT(poses.AngularVelocities[k].norm(), 5000.0);
    }
  }
}

TEST(FreeFlight, StripsTumbleByTheirWidthAndThicknessInTheWholeStage)
{
  // Falls at the speed at which weight and drag balance, all knobs as they come but the variation.
  const auto rate = [](double width, double thickness)
  {
    const Shape strip = Sheet(5.0 * width, width, 8);
    const double areaDensity = 500.0 * thickness;
    const double speed = std::sqrt(2.0 * areaDensity * StandardGravity / (1.2 * 1.2));
    RotationInput input = OneObject(strip, StraightPath(Vec3::Zero(), Vec3(0.0, 0.0, -speed), 300));
    input.Shapes[0].Thickness = thickness;
    input.Objects[0].Mass = areaDensity * 5.0 * width * width;
    input.Objects[0].Orientation = ExpMap(Vec3(0.3, 0.0, 0.0));
    RotationOptions options;
    options.VariationPerObject = 0.0;
    options.MaximumTurn = 180.0;
    const PoseTrack poses = Refine(input, options).Poses[0];
    double turned = 0.0;
    for (int k = 150; k < 299; ++k)
    {
      turned += LogMap(poses.Orientations[k + 1] * poses.Orientations[k].conjugate()).x();
    }
    return std::abs(turned) / (149.0 / 30.0);
  };
  EXPECT_NEAR(rate(0.03, 0.0002) / rate(0.06, 0.0002), 2.0, 0.3);
  EXPECT_NEAR(rate(0.05, 0.0004) / rate(0.05, 0.0002), std::sqrt(2.0), 0.15 * std::sqrt(2.0));
}

TEST(FreeFlight, ACurvedLeafSettlesConvexSideDown)
{
  // Edges up is convex side down. From light ones that hang to heavy ones that swing; of the starts
  // a third lie nearly on the wrong side.
  struct Case
  {
    double AreaDensity; // kg/m^2
    double Speed;       // m/s; the three last: weight and drag balance
  };
  Random random(17);
  for (const Case& c :
       { Case{ 0.01, 0.8 }, Case{ 0.01, 0.37 }, Case{ 0.03, 0.64 }, Case{ 0.1, 1.17 } })
  {
    Shape leaf = CurledLeaf();
    leaf.AreaDensity = c.AreaDensity;
    for (const AirModel model : { AirModel::Paper, AirModel::Plate })
    {
      for (int i = 0; i < 3; ++i)
      {
        RotationInput input =
          OneObject(leaf, StraightPath(Vec3::Zero(), Vec3(0.0, 0.0, -c.Speed), 300));
        const Vec3 axis = random.Direction();
        const Vec3 level = Vec3(axis.x(), axis.y(), 0.0).normalized();
        input.Objects[0].Orientation = i < 2 ? ExpMap(random.Uniform(0.0, 3.1) * axis)
                                             : ExpMap(random.Uniform(2.6, 3.1) * level);
        RotationOptions options = WithModel(model);
        options.MaximumTurn = 180.0;
        const PoseTrack poses = Refine(input, options).Poses[0];
        double up = 0.0;
        for (int k = 200; k < 300; ++k)
        {
          up += (poses.Orientations[k] * Vec3::UnitZ()).z() / 100.0;
        }
        EXPECT_GT(up, 0.6) << c.AreaDensity << " kg/m^2, " << c.Speed << " m/s, start " << i;
      }
    }
  }
}

TEST(FreeFlight, KnobsDoWhatTheySay)
{
  // Tumbling strips: Roll 0 stops them; Spin turns a level disc about its normal, either way.
  RotationInput strip =
    OneObject(Sheet(0.15, 0.03, 8), StraightPath(Vec3::Zero(), Vec3(0.0, 0.0, -1.2), 200));
  strip.Objects[0].Mass = 0.1 * 0.15 * 0.03;
  strip.Objects[0].Orientation = ExpMap(Vec3(0.3, 0.0, 0.0));
  const auto turned = [](const PoseTrack& poses, int axis, std::size_t first = 100)
  {
    double sum = 0.0;
    for (std::size_t k = first; k + 1 < poses.Orientations.size(); ++k)
    {
      sum += LogMap(poses.Orientations[k + 1] * poses.Orientations[k].conjugate())[axis];
    }
    return sum;
  };
  RotationOptions options;
  options.VariationPerObject = 0.0;
  EXPECT_GT(std::abs(turned(Refine(strip, options).Poses[0], 0)), 20.0);
  options.Roll = 0.0;
  EXPECT_LT(std::abs(turned(Refine(strip, options).Poses[0], 0)), 7.0);
  const RotationInput flat =
    OneObject(Sheet(0.1, 0.1, 8), StraightPath(Vec3::Zero(), Vec3(0.0, 0.0, -0.8), 42));
  options = {};
  options.Spin = 0.1;
  const double right = turned(Refine(flat, options).Poses[0], 2, 0);
  options.Spin = -0.1;
  const double left = turned(Refine(flat, options).Poses[0], 2, 0);
  EXPECT_GT(std::abs(right), 4.5); // on the slower clock of its width
  // The diagonals of its cells are no mirror image of themselves: 1.2e-4.
  EXPECT_NEAR(right, -left, 1e-3 * std::abs(right));
  // A shape's own damping adds to the stage's.
  RotationInput bubble = OneObject(Sheet(0.1, 0.05), StraightPath(Vec3::Zero(), Vec3::Zero(), 91));
  bubble.Scene.AirDensity = 0.0;
  bubble.Shapes[0].Damping = 0.9;
  bubble.Objects[0].AngularVelocity = Vec3(0.0, 0.0, 9.0);
  const double rate = std::log(9.0 / Refine(bubble).Poses[0].AngularVelocities[90].norm()) / 3.0;
  EXPECT_NEAR(rate, 1.2, 0.02 * 1.2);
}
