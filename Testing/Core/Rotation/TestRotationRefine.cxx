// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "RotationFixtures.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::fixtures;

namespace
{
RotationOutput Refine(const RotationInput& input, const RotationOptions& options = {},
                      int threads = 1)
{
  SilentMonitor silent;
  RotationOutput output;
  const Result result = RunRotationRefine(input, options, ThreadedFor(threads), silent, output);
  EXPECT_TRUE(result) << result.Message();
  return output;
}

Mat3 BodyInertia(const RotationInput& input)
{
  ShellProperties p;
  EXPECT_TRUE(ComputeShellProperties(input.Shapes[0], p));
  return input.Objects[0].Mass * p.InertiaPerMass;
}

std::vector<Vec3> SwayingPath(int frames, double phase = 0.0)
{
  std::vector<Vec3> path;
  for (int k = 0; k < frames; ++k)
  {
    const double t = k / 30.0;
    path.emplace_back(0.4 * std::sin(1.7 * t + phase), 0.3 * std::cos(1.1 * t), 9.0 - 0.8 * t);
  }
  return path;
}
} // namespace

TEST(RotationRefine, WithoutTorqueAngularMomentumStays)
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

TEST(RotationRefine, DampingRateIsAsStated)
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

TEST(RotationRefine, AirThatMovesAlongTurnsNothing)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(100));
  input.Tracks[0].AirVelocities =
    CentralVelocities(input.Tracks[0].Positions, input.Scene.Time.Step());
  input.Objects[0].Orientation = Quat(0.8, 0.1, -0.5, 0.3).normalized();
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    RotationOptions options;
    options.Model = model;
    const PoseTrack poses = Refine(input, options).Poses[0];
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

TEST(RotationRefine, WindIsTheAirWhereTracksCarryNone)
{
  RotationInput input =
    OneObject(CurledLeaf(), StraightPath(Vec3::Zero(), Vec3(0.5, 0.2, -0.1), 60));
  FieldSeries wind;
  wind.Meaning = FieldMeaning::Velocity;
  wind.Dimensions = { 2, 2, 2 };
  wind.Times = { 0.0 };
  wind.Values = { std::vector<std::array<float, 3>>(8, { 0.5F, 0.2F, -0.1F }) };
  input.Wind = &wind;
  const RotationOutput still = Refine(input);
  for (const Vec3& torque : still.Poses[0].Torques)
  {
    EXPECT_LT(torque.norm(), 1e-12);
  }
  wind.Meaning = FieldMeaning::Acceleration;
  EXPECT_GT(Refine(input).Poses[0].Torques[0].norm(), 1e-9);
}

TEST(RotationRefine, EquivariantUnderRotationOfTheWorld)
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
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    RotationOptions options;
    options.Model = model;
    const PoseTrack a = Refine(input, options).Poses[0];
    const PoseTrack b = Refine(turned, options).Poses[0];
    for (std::size_t k = 0; k < a.Orientations.size(); ++k)
    {
      EXPECT_LT(Angle(world * a.Orientations[k], b.Orientations[k]), 1e-6);
    }
  }
}

TEST(RotationRefine, SymmetricPlateBroadsideDoesNotTurn)
{
  const RotationInput input =
    OneObject(Sheet(0.1, 0.06), StraightPath(Vec3(0.0, 0.0, 3.0), Vec3(0.0, 0.0, -0.9), 31));
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    RotationOptions options;
    options.Model = model;
    const RotationOutput output = Refine(input, options);
    for (const Quat& q : output.Poses[0].Orientations)
    {
      EXPECT_LT(Angle(q, Quat::Identity()), 1e-6);
    }
  }
}

TEST(RotationRefine, LightestBodiesAtGreatSpeedDoNotBlowUp)
{
  Shape down = CurledLeaf(0.02);
  down.AreaDensity = 0.002;
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    RotationInput input = OneObject(down, StraightPath(Vec3::Zero(), Vec3(12.0, 5.0, -9.0), 40));
    input.Objects[0].AngularVelocity = Vec3(50.0, 20.0, 90.0);
    RotationOptions options;
    options.Model = model;
    const PoseTrack poses = Refine(input, options).Poses[0];
    for (std::size_t k = 0; k < poses.Orientations.size(); ++k)
    {
      EXPECT_NEAR(poses.Orientations[k].norm(), 1.0, 1e-12);
      EXPECT_LT(poses.AngularVelocities[k].norm(), 5000.0);
    }
  }
}

TEST(RotationRefine, OrientationRowsAreMetAndTheMotionStaysSmooth)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(180));
  Random random(9);
  std::vector<Quat> wanted;
  for (const int frame : { 0, 60, 110, 179 })
  {
    Constraint key;
    key.ObjectId = 0;
    key.Frame = frame;
    key.Kind = ConstraintKind::Orientation;
    const Vec3 axis = random.Direction();
    key.Orientation = ExpMap(random.Uniform(0.5, 3.0) * axis);
    key.Radius = frame == 110 ? 0.2 : 0.0;
    key.Row = frame;
    input.Constraints.push_back(key);
  }
  const RotationOutput output = Refine(input);
  const std::vector<Quat>& q = output.Poses[0].Orientations;
  for (const Constraint& key : input.Constraints)
  {
    EXPECT_LE(Angle(q[key.Frame], key.Orientation), key.Radius + 1e-9);
  }
  ASSERT_EQ(output.Report.size(), 4u);
  for (const ReportRow& row : output.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Message;
  }
  // Natural between: no faster and no jerkier than the same leaf turns without rows, but for half a
  // turn within the shortest time between two rows.
  RotationInput free = input;
  free.Constraints.clear();
  const std::vector<Vec3> own = Refine(free).Poses[0].AngularVelocities;
  const std::vector<Vec3>& rates = output.Poses[0].AngularVelocities;
  const auto fastest = [](const std::vector<Vec3>& list)
  {
    double most = 0.0;
    for (const Vec3& rate : list)
    {
      most = std::max(most, rate.norm());
    }
    return most;
  };
  const double added = 1.875 * std::acos(-1.0) * 30.0 / 50.0; // the ease's greatest slope
  EXPECT_LT(fastest(rates), 1.5 * fastest(own) + added);
  for (std::size_t k = 1; k < q.size(); ++k)
  {
    EXPECT_GT(q[k].dot(q[k - 1]), 0.0) << k;
    const Vec3 step = LogMap(q[k] * q[k - 1].conjugate()) * 30.0;
    EXPECT_LT((step - 0.5 * (rates[k] + rates[k - 1])).norm(), 0.25 * (fastest(own) + added)) << k;
  }
}

TEST(RotationRefine, RowsThatNoTurningRateCanMeetAreNamed)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  for (const int frame : { 30, 31, 50 })
  {
    Constraint key;
    key.ObjectId = 0;
    key.Frame = frame;
    key.Row = frame;
    key.Kind = ConstraintKind::Orientation;
    key.Orientation = frame == 31 ? Quat(0.0, 1.0, 0.0, 0.0) : Quat::Identity();
    input.Constraints.push_back(key);
  }
  const RotationOutput output = Refine(input);
  ASSERT_EQ(output.Report.size(), 3u);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Met);
  EXPECT_EQ(output.Report[1].Status, ConstraintStatus::Unreachable);
  EXPECT_EQ(output.Report[2].Status, ConstraintStatus::Met);
  EXPECT_NEAR(output.Report[1].Residual, std::acos(-1.0) - 60.0 / 30.0, 1e-9);
  EXPECT_NE(output.Report[1].Message.find("object 0, frame 31"), std::string::npos);
  ASSERT_EQ(output.Warnings.size(), 1u);
  EXPECT_EQ(output.Warnings[0], output.Report[1].Message);
  RotationOptions faster;
  faster.TurningRate = 100.0;
  EXPECT_EQ(Refine(input, faster).Report[1].Status, ConstraintStatus::Met);
}

TEST(RotationRefine, AStartThatIsNotUnitIsMadeSoAndTold)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(5));
  const Quat start = Quat(0.8, 0.1, -0.5, 0.3).normalized();
  input.Objects[0].Orientation.coeffs() = 3.0 * start.coeffs();
  RotationOutput output = Refine(input);
  EXPECT_LT(Angle(output.Poses[0].Orientations[0], start), 1e-12);
  ASSERT_EQ(output.Warnings.size(), 1u);
  EXPECT_NE(output.Warnings[0].find("object 0: its Orientation had length 3"), std::string::npos);
  input.Objects[0].Orientation.coeffs().setZero();
  output = Refine(input);
  EXPECT_LT(Angle(output.Poses[0].Orientations[0], Quat::Identity()), 1e-12);
  EXPECT_EQ(output.Warnings.size(), 1u);
}

TEST(RotationRefine, TrianglesWithoutAreaAreTold)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(5));
  EXPECT_TRUE(Refine(input).Warnings.empty());
  const std::string count = std::to_string(input.Shapes[0].Mesh.Triangles.size() + 1);
  input.Shapes[0].Mesh.Triangles.push_back({ 0, 1, 0 });
  const RotationOutput output = Refine(input);
  ASSERT_EQ(output.Warnings.size(), 1u);
  EXPECT_NE(output.Warnings[0].find("shape 'leaf': 1 of " + count + " triangles"),
            std::string::npos);
}

TEST(RotationRefine, StripsTumbleByTheirWidthAndThicknessInTheWholeStage)
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

TEST(RotationRefine, ACurvedLeafSettlesConvexSideDown)
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
      for (int i = 0; i < 18; ++i)
      {
        RotationInput input =
          OneObject(leaf, StraightPath(Vec3::Zero(), Vec3(0.0, 0.0, -c.Speed), 300));
        const Vec3 axis = random.Direction();
        const Vec3 level = Vec3(axis.x(), axis.y(), 0.0).normalized();
        input.Objects[0].Orientation = i < 12 ? ExpMap(random.Uniform(0.0, 3.1) * axis)
                                              : ExpMap(random.Uniform(2.6, 3.1) * level);
        RotationOptions options;
        options.Model = model;
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

TEST(RotationRefine, TheMirrorImageMovesInTheMirror)
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
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    RotationOptions options;
    options.Model = model;
    const PoseTrack a = Refine(input, options).Poses[0];
    const PoseTrack b = Refine(other, options).Poses[0];
    for (std::size_t k = 0; k < a.Orientations.size(); ++k)
    {
      EXPECT_LT(Angle(mirroredTurn(a.Orientations[k]), b.Orientations[k]), 1e-10) << k;
    }
  }
}

TEST(RotationRefine, KnobsDoWhatTheySay)
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
  EXPECT_GT(std::abs(right), 5.0);
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

TEST(RotationRefine, ObjectsOfOneShapeDifferByTheirSeed)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  input.Objects.push_back(input.Objects[0]);
  input.Objects[1].ObjectId = 1;
  input.Tracks.push_back(input.Tracks[0]);
  input.Tracks[1].ObjectId = 1;
  const auto apart = [&](const RotationOptions& options)
  {
    const RotationOutput output = Refine(input, options);
    return Angle(output.Poses[0].Orientations[59], output.Poses[1].Orientations[59]);
  };
  RotationOptions options;
  EXPECT_GT(apart(options), 1e-3);
  const double first = apart(options);
  options.Seed = 2;
  EXPECT_NE(apart(options), first);
  options.VariationPerObject = 0.0;
  EXPECT_EQ(apart(options), 0.0);
}

TEST(RotationRefine, TwoWishesAtOneFrameAreNamed)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  for (const double angle : { 0.3, 1.0 })
  {
    Constraint key;
    key.ObjectId = 0;
    key.Frame = 30;
    key.Kind = ConstraintKind::Orientation;
    key.Orientation = ExpMap(Vec3(angle, 0.0, 0.0));
    input.Constraints.push_back(key);
  }
  const RotationOutput output = Refine(input);
  ASSERT_EQ(output.Report.size(), 2u);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Met);
  EXPECT_EQ(output.Report[1].Status, ConstraintStatus::Conflict);
  EXPECT_NEAR(output.Report[1].Residual, 0.7, 1e-9);
}

TEST(RotationRefine, SameBitsForAnyNumberOfThreads)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(50));
  for (int i = 1; i < 9; ++i)
  {
    input.Objects.push_back(input.Objects[0]);
    input.Objects[i].ObjectId = i;
    input.Tracks.push_back(input.Tracks[0]);
    input.Tracks[i].ObjectId = i;
    input.Tracks[i].Positions = SwayingPath(50, 0.4 * i);
  }
  const RotationOutput one = Refine(input, {}, 1);
  const RotationOutput two = Refine(input, {}, 2);
  for (std::size_t i = 0; i < one.Poses.size(); ++i)
  {
    for (std::size_t k = 0; k < one.Poses[i].Orientations.size(); ++k)
    {
      EXPECT_EQ(one.Poses[i].Orientations[k].coeffs(), two.Poses[i].Orientations[k].coeffs());
      EXPECT_EQ(one.Poses[i].Torques[k], two.Poses[i].Torques[k]);
    }
  }
}

TEST(RotationRefine, ErrorsNameThePlace)
{
  SilentMonitor silent;
  RotationOutput output;
  const auto message = [&](const RotationInput& input)
  {
    const Result result = RunRotationRefine(input, {}, SerialFor(), silent, output);
    EXPECT_FALSE(result);
    EXPECT_TRUE(output.Poses.empty());
    return result.Message();
  };
  const RotationInput good = OneObject(CurledLeaf(), SwayingPath(10));
  RotationInput bad = good;
  bad.Objects[0].Mass = 0.0;
  EXPECT_NE(message(bad).find("object 0: Mass"), std::string::npos);
  bad = good;
  bad.Tracks[0].ObjectId = 7;
  EXPECT_NE(message(bad).find("object 7"), std::string::npos);
  bad = good;
  bad.Shapes[0].Mesh.Triangles.clear();
  EXPECT_NE(message(bad).find("shape 'leaf'"), std::string::npos);
  bad = good;
  bad.Tracks[0].Positions[3].x() = std::nan("");
  EXPECT_NE(message(bad).find("frame 3"), std::string::npos);
  RotationOptions options;
  options.Damping = -1.0;
  EXPECT_FALSE(options.Validate());
}

TEST(RotationRefine, StopsWhenAsked)
{
  struct Stopper : Monitor
  {
    bool Tick(double, const std::string&) override { return false; }
  };
  Stopper stopper;
  RotationOutput output;
  const RotationInput input = OneObject(CurledLeaf(), SwayingPath(10));
  EXPECT_TRUE(RunRotationRefine(input, {}, SerialFor(), stopper, output).IsStopped());
  EXPECT_TRUE(output.Poses.empty());
}
