// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
ObstacleSet Ground(double tiltX = 0.0)
{
  ObstacleMesh slab;
  slab.ObstacleId = 0;
  slab.Mesh = MakeBox({ Vec3(-4.0, -4.0, -1.0), Vec3(4.0, 4.0, 0.0) });
  for (Vec3& p : slab.Mesh.Points)
  {
    p.z() += tiltX * p.x();
  }
  ObstacleSet obstacles;
  const Result result = obstacles.Build({ slab });
  EXPECT_TRUE(result) << result.Message();
  return obstacles;
}

Constraint RestFromFrame90()
{
  return RestRow(90, 130, Vec3(0.3, -0.2, 1.0));
}

/// The path of Land is still at the frame of its row, and not before.
RotationOptions AsFastAsItFalls()
{
  RotationOptions options;
  options.MaximumTurn = 60.0;
  return options;
}

struct Landed
{
  RotationInput Input;
  RotationOutput Output;
};

/// A leaf lands at frame 90 and rests to frame 130, then rises again.
Landed Land(const ObstacleSet& obstacles, const Quat& start, double phase, double slope = 0.0)
{
  Landed landed;
  const Shape leaf = CurledLeaf();
  landed.Input = OneObject(leaf, std::vector<Vec3>(1, Vec3::Zero()));
  const double height = RestHeight(leaf) * std::sqrt(1.0 + slope * slope);
  const Vec3 place(0.3, -0.2, 0.3 * slope + height);
  std::vector<Vec3> path = LandingPath(place, 90, 131, phase);
  for (int k = 1; k <= 60; ++k)
  {
    const double t = k / 30.0;
    path.push_back(place + Vec3(0.1 * t * t, 0.05 * t * t, 0.5 * t * t / (1.0 + t)));
  }
  for (Vec3& x : path)
  {
    x.z() = std::max(x.z(), slope * x.x() + height);
  }
  landed.Input.Tracks[0].Positions = path;
  landed.Input.Objects[0].Orientation = start;
  landed.Input.Objects[0].AngularVelocity = Vec3(3.0, 1.0, 2.0);
  landed.Input.Obstacles = &obstacles;
  landed.Input.Constraints = { RestFromFrame90() };
  landed.Output = Refine(landed.Input, AsFastAsItFalls());
  return landed;
}

/// As sheets come from a printer: bent along its length and about one corner.
Shape BentSheet()
{
  Shape sheet = Sheet(0.297, 0.21, 12);
  for (Vec3& p : sheet.Mesh.Points)
  {
    const double corner = std::max(0.0, p.x() / 0.1485 + p.y() / 0.105 - 1.0);
    p.z() = 1.3 * p.x() * p.x() + 0.01 * corner * corner;
  }
  const Vec3 center = ShellCentroid(sheet.Mesh);
  for (Vec3& p : sheet.Mesh.Points)
  {
    p -= center;
  }
  return sheet;
}

Vec3 Centre(const Landed& landed, int frame)
{
  const std::vector<Vec3>& shifts = landed.Output.Shifts[0];
  return landed.Input.Tracks[0].Positions[frame] +
         (shifts.empty() ? Vec3(Vec3::Zero()) : shifts[frame]);
}

double LowestVertex(const Landed& landed, int frame, double slope)
{
  const Vec3 normal = Vec3(-slope, 0.0, 1.0).normalized();
  double lowest = 1e300;
  for (const Vec3& p : landed.Input.Shapes[0].Mesh.Points)
  {
    const Vec3 x = Centre(landed, frame) + landed.Output.Poses[0].Orientations[frame] * p;
    lowest = std::min(lowest, x.dot(normal));
  }
  return lowest;
}

/// It does not hang, and it is not level.
void ExpectOnThreePoints(const Landed& landed, int frame, double slope)
{
  const Vec3 normal = Vec3(-slope, 0.0, 1.0).normalized();
  const Quat& q = landed.Output.Poses[0].Orientations[frame];
  EXPECT_NEAR(LowestVertex(landed, frame, slope), 0.0, 2e-9);
  int carrying = 0;
  for (const Vec3& p : landed.Input.Shapes[0].Mesh.Points)
  {
    carrying += normal.dot(Centre(landed, frame) + q * p) < 1e-7 ? 1 : 0;
  }
  EXPECT_GE(carrying, 3);
  const double tilt = std::acos(std::min(1.0, std::abs((q * Vec3::UnitZ()).dot(normal))));
  EXPECT_LT(tilt, 0.2);
  if ((q * Vec3::UnitZ()).dot(normal) > 0.0) // the other way round this leaf stands level
  {
    EXPECT_GT(tilt, 0.005);
  }
}

void ExpectGoodLanding(const Landed& landed, double slope)
{
  const PoseTrack& poses = landed.Output.Poses[0];
  EXPECT_TRUE(landed.Output.Warnings.empty());
  for (int k = 0; k < static_cast<int>(poses.Orientations.size()); ++k)
  {
    EXPECT_GE(LowestVertex(landed, k, slope), -1e-9) << k;
    if (k > 0)
    {
      EXPECT_GT(poses.Orientations[k].dot(poses.Orientations[k - 1]), 0.0);
    }
  }
  for (int k = 90; k <= 130; ++k)
  {
    EXPECT_EQ(poses.Orientations[k].coeffs(), poses.Orientations[90].coeffs());
    EXPECT_EQ(poses.AngularVelocities[k].norm(), 0.0);
  }
  ExpectOnThreePoints(landed, 90, slope);
  const Vec3 beside = Centre(landed, 90) - landed.Input.Tracks[0].Positions[90];
  EXPECT_EQ(beside.x(), 0.0);
  EXPECT_EQ(beside.y(), 0.0);
  ASSERT_EQ(landed.Output.Constraints.size(), landed.Input.Constraints.size());
  EXPECT_LE(landed.Output.Constraints[0].TouchDown, 90);
  EXPECT_GT(landed.Output.Constraints[0].TouchDown, 60);
  EXPECT_EQ(landed.Output.Constraints[0].Settled, 90);
  // It comes to rest gently and stirs again afterwards.
  EXPECT_LT(poses.AngularVelocities[89].norm(), 3.0);
  EXPECT_GT(Angle(poses.Orientations[150], poses.Orientations[130]), 1e-4);
  for (int k = 70; k < 90; ++k)
  {
    EXPECT_LT(Angle(poses.Orientations[k + 1], poses.Orientations[k]), 0.8) << k;
  }
}
} // namespace

TEST(Landing, OnLevelGroundFromAnyPose)
{
  const ObstacleSet ground = Ground();
  for (int i = 0; i < 12; ++i)
  {
    const Quat start = ExpMap(0.5 * i * Vec3(std::cos(1.0 * i), std::sin(1.0 * i), 0.2));
    ExpectGoodLanding(Land(ground, start, 0.7 * i), 0.0);
  }
}

TEST(Landing, OnASlope)
{
  const ObstacleSet slope = Ground(0.4);
  ExpectGoodLanding(Land(slope, Quat(0.1, 1.0, 0.0, 0.0).normalized(), 1.0, 0.4), 0.4);
}

TEST(Landing, UntilItTouchesItFliesAsOverNoGround)
{
  const ObstacleSet ground = Ground();
  std::vector<double> early, late;
  for (int i = 0; i < 40; ++i)
  {
    const Quat start = ExpMap(0.3 * i * Vec3(std::cos(1.0 * i), std::sin(1.0 * i), 0.2));
    const Landed landed = Land(ground, start, 0.7 * i);
    RotationInput above = landed.Input;
    above.Obstacles = nullptr;
    above.Constraints.clear();
    const RotationOutput flown = Refine(above, AsFastAsItFalls());
    const int touch = landed.Output.Constraints[0].TouchDown;
    const auto& poses = landed.Output.Poses[0].Orientations;
    for (int k = 0; k < std::min(touch, 86); ++k) // it must be still at 90
    {
      EXPECT_LT(Angle(poses[k], flown.Poses[0].Orientations[k]), 0.02) << i << ", frame " << k;
    }
    const auto tilt = [&](int k)
    { return std::acos(std::min(1.0, std::abs((poses[k] * Vec3::UnitZ()).z()))); };
    early.push_back(tilt(touch - 30));
    late.push_back(tilt(touch - 6));
  }
  std::sort(early.begin(), early.end());
  std::sort(late.begin(), late.end());
  EXPECT_NEAR(late[20] / early[20], 1.0, 0.35);
}

TEST(Landing, WhoComesDownEarlierRocksAndIsStillInTime)
{
  const ObstacleSet ground = Ground();
  int rocking = 0;
  for (int i = 0; i < 12; ++i)
  {
    Landed landed = Land(ground, ExpMap(0.5 * i * Vec3(std::cos(1.0 * i), 0.3, 0.2)), 0.7 * i);
    landed.Input.Constraints[0].Frame = 120; // its centre is still from frame 90 on
    landed.Input.Constraints[0].TouchDown = 90;
    landed.Output = Refine(landed.Input, AsFastAsItFalls());
    const Constraint& row = landed.Output.Constraints[0];
    EXPECT_LE(row.TouchDown, 90);
    EXPECT_GE(row.Settled, 90);
    EXPECT_LE(row.Settled, 120);
    rocking += row.Settled > 95 ? 1 : 0;
    const PoseTrack& poses = landed.Output.Poses[0];
    for (int k = 0; k < 130; ++k)
    {
      EXPECT_GE(LowestVertex(landed, k, 0.0), -1e-9) << i << ", frame " << k;
      if (k >= row.Settled)
      {
        EXPECT_EQ(poses.Orientations[k].coeffs(), poses.Orientations[120].coeffs());
        EXPECT_EQ(poses.AngularVelocities[k].norm(), 0.0);
      }
      if (k >= 90) // it rocks where it is, on the ground
      {
        EXPECT_LT(LowestVertex(landed, k, 0.0), 1e-3) << i << ", frame " << k;
        EXPECT_EQ(Centre(landed, k).head<2>(), landed.Input.Tracks[0].Positions[90].head<2>());
      }
    }
    ExpectOnThreePoints(landed, 120, 0.0);
  }
  EXPECT_GT(rocking, 6);
}

TEST(Landing, ComesDownOnTheSideThatIsAskedFor)
{
  const ObstacleSet ground = Ground();
  int up = 0;
  for (int i = 0; i < 12; ++i)
  {
    Landed landed =
      Land(ground, ExpMap(0.5 * i * Vec3(std::cos(1.0 * i), std::sin(1.0 * i), 0.2)), 0.7 * i);
    const auto z = [&] { return (landed.Output.Poses[0].Orientations[90] * Vec3::UnitZ()).z(); };
    up += z() > 0.0 ? 1 : 0;
    for (const FaceUp side : { FaceUp::Up, FaceUp::Down })
    {
      landed.Input.Constraints[0].Side = side;
      landed.Output = Refine(landed.Input, AsFastAsItFalls());
      EXPECT_GT((side == FaceUp::Up ? 1.0 : -1.0) * z(), 0.9) << i;
      ExpectOnThreePoints(landed, 90, 0.0);
    }
  }
  EXPECT_GT(up, 0);
}

TEST(Landing, ARowWithinTheRestChoosesTheHeading)
{
  const ObstacleSet ground = Ground();
  Landed landed = Land(ground, Quat::Identity(), 0.0);
  const Constraint key = OrientationRow(95, ExpMap(Vec3(0.0, 0.0, 2.0)));
  landed.Input.Constraints.push_back(key);
  landed.Input.Scene.Time.NumberOfFrames =
    static_cast<int>(landed.Input.Tracks[0].Positions.size());
  landed.Output = Refine(landed.Input);
  EXPECT_LT(Angle(landed.Output.Poses[0].Orientations[90], key.Orientation), 1e-9);
  EXPECT_EQ(landed.Output.Report[0].Status, ConstraintStatus::Met)
    << landed.Output.Report[0].Message;
}

TEST(Landing, RestFromTheFirstFrame)
{
  const ObstacleSet ground = Ground();
  const Shape leaf = CurledLeaf();
  RotationInput input = OneObject(leaf, std::vector<Vec3>(20, Vec3(0.0, 0.0, RestHeight(leaf))));
  input.Obstacles = &ground;
  input.Objects[0].Orientation = ExpMap(Vec3(0.4, 0.2, 1.0));
  input.Constraints = { RestRow(0, 19, Vec3::Zero()) };
  const RotationOutput output = Refine(input);
  for (const Quat& q : output.Poses[0].Orientations)
  {
    EXPECT_EQ(q.coeffs(), output.Poses[0].Orientations[0].coeffs());
  }
}

TEST(Landing, ABentSheetLiesAndDoesNotStandOnItsEdge)
{
  // Bent by so much that it stands by itself on a bent edge, half its width above the ground.
  const ObstacleSet ground = Ground();
  const Shape sheet = BentSheet();
  const Vec3 place(0.0, 0.0, RestHeight(sheet));
  std::vector<Vec3> path(28, place);
  for (int k = 1; k <= 40; ++k)
  {
    path.push_back(place + Vec3(0.2, 0.0, 0.4) * (k * k / 900.0));
  }
  Landed landed;
  landed.Input = OneObject(sheet, path);
  landed.Input.Obstacles = &ground;
  landed.Input.Constraints = { RestRow(0, 27, Vec3::Zero()) };
  for (int i = -2; i < 30; ++i)
  {
    // On either edge, and as it comes.
    const double quarter = 0.5 * std::acos(-1.0);
    landed.Input.Objects[0].OrientationGiven = i < 0 ? 1 : 0;
    landed.Input.Objects[0].Orientation = ExpMap(Vec3(i == -1 ? quarter : -quarter, 0.0, 0.0));
    RotationOptions options;
    options.Seed = static_cast<std::uint64_t>(i + 3);
    landed.Output = Refine(landed.Input, options);
    EXPECT_TRUE(landed.Output.Warnings.empty()) << i << ": " << landed.Output.Warnings[0];
    const std::vector<Quat>& poses = landed.Output.Poses[0].Orientations;
    for (int k = 0; k < static_cast<int>(path.size()); ++k)
    {
      EXPECT_GE(LowestVertex(landed, k, 0.0), -1e-9) << i << ", frame " << k;
      EXPECT_LT(Angle(poses[k], poses[std::max(k - 1, 0)]), 0.7) << i << ", frame " << k;
    }
    ExpectOnThreePoints(landed, 0, 0.0);
    ExpectOnThreePoints(landed, 27, 0.0);
  }
}

TEST(Landing, WhoComesDownOnItsEdgeFallsOverNoFasterThanAnEyeFollows)
{
  // The centre is not braked before it is where a lying body has it, and an edge touches earlier:
  // the ground holds it up for as long as the body takes to fall over.
  const ObstacleSet ground = Ground();
  const Shape petal = CurledLeaf(0.075);
  const Vec3 place(0.0, 0.0, RestHeight(petal));
  std::vector<Vec3> path;
  for (int k = 0; k < 60; ++k)
  {
    const double left = std::max(0, 8 - k) / 30.0;
    path.push_back(place + Vec3(0.0, 0.0, 0.85 * left));
  }
  Landed landed;
  landed.Input = OneObject(petal, path);
  landed.Input.Obstacles = &ground;
  landed.Input.Constraints = { RestRow(40, 59, Vec3::Zero()) };
  landed.Input.Constraints[0].TouchDown = 8;
  landed.Input.Objects[0].OrientationGiven = 1;
  for (int i = 0; i < 40; ++i)
  {
    RotationOptions options;
    landed.Input.Objects[0].Orientation =
      ExpMap(Vec3(0.0, 0.0, 0.3 * i)) * ExpMap(Vec3(0.0, 1.3 + 0.02 * i, 0.0));
    landed.Output = Refine(landed.Input, options);
    EXPECT_TRUE(landed.Output.Warnings.empty()) << i << ": " << landed.Output.Warnings[0];
    const std::vector<Quat>& poses = landed.Output.Poses[0].Orientations;
    for (int k = 1; k < 60; ++k)
    {
      EXPECT_GE(LowestVertex(landed, k, 0.0), -1e-9) << i << ", frame " << k;
      EXPECT_LT(Angle(poses[k], poses[k - 1]), 0.45) << i << ", frame " << k; // 26 degrees
    }
    ExpectOnThreePoints(landed, 59, 0.0);
  }
}

TEST(Landing, ABodyThatPassesOverTheGroundDoesNotCutIt)
{
  // The centre passes at 0.02 m, less than half the leaf's length.
  const ObstacleSet ground = Ground();
  std::vector<Vec3> path;
  for (int k = 0; k < 90; ++k)
  {
    const double t = (k - 45) / 30.0;
    path.emplace_back(t, 0.1 * t, 0.02 + 0.3 * t * t);
  }
  RotationInput input = OneObject(CurledLeaf(), path);
  input.Obstacles = &ground;
  input.Objects[0].AngularVelocity = Vec3(2.0, 6.0, 0.0);
  Landed landed;
  landed.Input = input;
  landed.Output = Refine(input);
  for (int k = 0; k < 90; ++k)
  {
    EXPECT_GE(LowestVertex(landed, k, 0.0), -1e-9) << k;
  }
}

TEST(Landing, WhoTouchesDownEarlyDoesNotFlip)
{
  // Fast down to the ground and then on it for a second or more before the rest: the turn to the
  // lying pose and the one away from the ground pull together.
  const ObstacleSet ground = Ground();
  const Shape leaf = CurledLeaf(0.17);
  const Vec3 place(0.3, -0.2, RestHeight(leaf));
  Random random(3);
  for (int i = 0; i < 150; ++i)
  {
    const double early = random.Uniform(0.9, 1.3);
    std::vector<Vec3> path;
    for (int k = 0; k <= 130; ++k)
    {
      const double left = std::max(0.0, (90 - k) / 30.0 - early);
      path.push_back(place +
                     Vec3(0.3 * std::sin(2.0 * left), 0.1 * left, left * left / (0.15 + left)));
    }
    RotationInput input = OneObject(leaf, path);
    const Vec3 axis = random.Direction();
    input.Objects[0].Orientation = ExpMap(random.Uniform(0.0, 3.1) * axis);
    input.Objects[0].AngularVelocity = Vec3(3.0, 1.0, 2.0);
    input.Obstacles = &ground;
    input.Constraints = { RestFromFrame90() };
    RotationOptions options = AsFastAsItFalls();
    options.Seed = static_cast<std::uint64_t>(i) + 1;
    options.RasterSize = 32;
    const RotationOutput output = Refine(input, options);
    EXPECT_TRUE(output.Warnings.empty()) << output.Warnings[0];
    const std::vector<Quat>& q = output.Poses[0].Orientations;
    Vec3 before = 30.0 * LogMap(q[1] * q[0].conjugate());
    for (std::size_t k = 2; k < q.size(); ++k)
    {
      const Vec3 rate = 30.0 * LogMap(q[k] * q[k - 1].conjugate());
      EXPECT_LT((rate - before).norm(), 25.0) << "start " << i << ", frame " << k; // a flip: 94
      EXPECT_LT(rate.norm(), k < 30 ? 40.0 : 25.0) << "start " << i << ", frame " << k;
      before = rate;
    }
  }
}
