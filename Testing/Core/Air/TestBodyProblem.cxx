// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/BodyProblem.h"
#include "Air/Run/AirAssimilation.h"
#include "Base/Primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

using namespace waft;

namespace
{

constexpr int Frames = 61;
constexpr int LiesAt = 40;      // the frame of its rest
constexpr int ComesDownAt = 25; // its touch-down
constexpr double WallTop = 0.8; // m

/// A body that is to come to lie behind a wall 2 cm thick, and its plan, which goes over the wall.
struct BehindAWall
{
  SceneInfo Scene;
  ObstacleSet Obstacles;
  MotionObject Object;
  Constraint Row;
  std::vector<Vec3> Plan;

  BehindAWall()
  {
    this->Scene.Time = { Frames, 30.0 };
    ObstacleMesh ground, wall;
    ground.Mesh = MakeBox({ Vec3(-3.0, -3.0, -1.0), Vec3(3.0, 3.0, 0.0) });
    wall.ObstacleId = 1;
    wall.Mesh = MakeBox({ Vec3(-0.01, -2.5, 0.001), Vec3(0.01, 2.5, WallTop) });
    EXPECT_TRUE(this->Obstacles.Build({ ground, wall }));
    this->Object.ObjectId = this->Row.ObjectId = 3;
    this->Object.Position = Vec3(-1.0, 0.0, 0.7);
    this->Object.SettlingSpeed = 0.5;
    this->Object.RestHeight = 0.01;
    this->Row.Kind = ConstraintKind::Rest;
    this->Row.Frame = LiesAt;
    this->Row.Until = Frames - 1;
    this->Row.Value = Vec3(1.0, 0.0, 0.5);
    for (int f = 0; f < Frames; ++f)
    {
      const double s = std::min(1.0, f / double(LiesAt));
      const double x = -1.0 + 2.0 * s;
      const double z = 0.01 + 0.69 * (1.0 - s) + 0.8 * (1.0 - x * x);
      this->Plan.emplace_back(x, 0.0, z);
    }
  }
};

std::vector<Vec3> Straight(const std::vector<Vec3>& path, int last)
{
  std::vector<Vec3> straight;
  for (int f = 0; f < Frames; ++f)
  {
    straight.push_back(path.front() +
                       std::min(1.0, f / double(last)) * (path.back() - path.front()));
  }
  return straight;
}

/// Looks at what there is so far.
class Watcher : public SilentMonitor
{
public:
  bool Publishes() const override { return true; }
};

double LongestStep(const std::vector<Vec3>& path)
{
  double longest = 0.0;
  for (std::size_t f = 0; f + 1 < path.size(); ++f)
  {
    longest = std::max(longest, (path[f + 1] - path[f]).norm());
  }
  return longest;
}

} // namespace

TEST(BodyProblem, SeesAWallThatIsThinnerThanAStep)
{
  const BehindAWall scene;
  const DriftScene around{ scene.Scene, scene.Obstacles, false };
  const BodyProblem body(around, scene.Object, scene.Plan, { scene.Row });
  EXPECT_FALSE(body.PassesThrough(scene.Plan));
  EXPECT_TRUE(body.PassesThrough(Straight(scene.Plan, LiesAt)));
}

TEST(BodyProblem, FallsBackOnThePlanBroughtToItsTouchDown)
{
  const BehindAWall scene;
  const DriftScene around{ scene.Scene, scene.Obstacles, false };
  BodyProblem body(around, scene.Object, scene.Plan, { scene.Row });
  body.SetTouchDown(0, ComesDownAt);
  std::vector<Vec3> path = Straight(scene.Plan, ComesDownAt); // cannot be pushed out of the wall
  EXPECT_TRUE(body.MakeExact(path));
  EXPECT_FALSE(body.PassesThrough(path));
  for (int f = ComesDownAt; f < Frames; ++f)
  {
    EXPECT_EQ(path[static_cast<std::size_t>(f)], *body.HeldAt(f)) << f;
  }
  const double hastening = double(LiesAt) / ComesDownAt;
  EXPECT_LT(LongestStep(path), 1.5 * hastening * LongestStep(scene.Plan));
}

/// What keeps it off a wall and its mark's ball, which leaves it no room there, are at odds: it is
/// told, and comes to the ball in a bow all the same.
TEST(BodyProblem, DoesNotJumpIntoABallThatItIsPushedOutOf)
{
  constexpr std::size_t mark = 30;
  BehindAWall scene;
  scene.Object.ClearanceRadius = 0.3;
  Constraint row;
  row.ObjectId = scene.Object.ObjectId;
  row.Frame = static_cast<int>(mark);
  row.Value = Vec3(-0.06, 0.0, 0.5);
  row.Radius = 0.02;
  std::vector<Vec3> path;
  for (int f = 0; f < Frames; ++f)
  {
    path.emplace_back(-0.06, -1.5 + 0.05 * f, 0.5);
  }
  scene.Object.Position = path.front();
  const DriftScene around{ scene.Scene, scene.Obstacles, false };
  const BodyProblem body(around, scene.Object, path, { row });
  EXPECT_FALSE(body.MakeExact(path));
  EXPECT_LE((path[mark] - row.Value).norm(), row.Radius * (1.0 + 1e-12));
  for (std::size_t f = mark - 2; f <= mark + 2; ++f)
  {
    EXPECT_LT(900.0 * (path[f - 1] - 2.0 * path[f] + path[f + 1]).norm(), 30.0) << f;
  }
}

/// Where the window of a landing opens the step before still asks for all of the radius, to its
/// end: a drift that dived there was pushed by nothing, and its end was the plan's path, in a
/// second.
TEST(BodyProblem, AsksForItsRadiusOnTheWholeStepToALanding)
{
  const BehindAWall scene;
  const DriftScene around{ scene.Scene, scene.Obstacles, false };
  BodyProblem body(around, scene.Object, scene.Plan, { scene.Row });
  FieldSeries still;
  still.Meaning = FieldMeaning::Velocity;
  still.Dimensions = { 2, 2, 2 };
  still.Origin = Vec3(-2.0, -2.0, 0.0);
  still.Spacing = Vec3::Constant(4.0);
  for (int f = 0; f < Frames; ++f)
  {
    still.Times.push_back(scene.Scene.Time.Time(f));
    still.Values.emplace_back(8, std::array<float, 3>{});
  }
  const HalfSeries air(still);
  const DriftProblem problem = body.In(AirSampler(air));
  const int opens = LiesAt - 30;
  const Vec3 low(-1.5, 0.0, 0.5 * scene.Object.ClearanceRadius);
  const auto depths = [&](int frame)
  {
    std::vector<DriftDepth> found;
    problem.TooNear(frame, low, found);
    return found.size();
  };
  EXPECT_GT(depths(opens), 0u);
  EXPECT_EQ(depths(opens + 1), 0u);
  const auto dives = [&](int frame)
  {
    std::vector<Vec3> path = scene.Plan;
    for (int f = frame; f < frame + 3; ++f)
    {
      path[static_cast<std::size_t>(f)].z() = low.z();
    }
    return path;
  };
  EXPECT_TRUE(body.IsClear(dives(opens + 1)));
}

TEST(BodyProblem, CountsTheStepsThatItFlies)
{
  BehindAWall scene;
  const DriftScene around{ scene.Scene, scene.Obstacles, false };
  BodyProblem body(around, scene.Object, scene.Plan, { scene.Row });
  EXPECT_EQ(body.NumberOfFlownSteps(), LiesAt);
  body.SetTouchDown(0, ComesDownAt);
  EXPECT_EQ(body.NumberOfFlownSteps(), ComesDownAt);
  scene.Row.Frame = 0;
  scene.Row.Until = 20;
  BodyProblem leaving(around, scene.Object, scene.Plan, { scene.Row });
  EXPECT_EQ(leaving.NumberOfFlownSteps(), Frames - 1 - 20);
  leaving.SetLiftOff(0, 30);
  EXPECT_EQ(leaving.NumberOfFlownSteps(), Frames - 1 - 30);
}

/// Bodies whose marks are nearer to each other than they are wide, one after the other.
TEST(AssimilationContacts, NoBodyJumpsOutOfACrowd)
{
  AssimilationInput input;
  input.Scene.Time = { Frames, 30.0 };
  for (int o = 0; o < 45; ++o)
  {
    MotionObject object;
    object.ObjectId = o;
    object.SettlingSpeed = 0.5;
    const Vec3 offset(o % 5 - 2.0, o / 5 % 3 - 1.0, o / 15 - 1.0);
    object.Position = Vec3(0.0, 0.0, 2.0) + 1.5 * object.ClearanceRadius * offset;
    input.Objects.push_back(object);
    Constraint row;
    row.ObjectId = o;
    row.Row = o;
    row.Frame = LiesAt;
    row.Value = Vec3(0.1, 0.0, 1.7) + object.ClearanceRadius * offset.reverse();
    input.Constraints.push_back(row);
    Track track;
    track.ObjectId = o;
    for (int f = 0; f < Frames; ++f)
    {
      const double s = f / double(LiesAt);
      track.Positions.push_back((1.0 - s) * object.Position + s * row.Value);
    }
    input.Tracks.push_back(track);
  }
  AssimilationOptions options;
  options.Resolution = options.LatticeResolution = 16;
  options.Rounds = 1;
  Watcher monitor;
  AssimilationOutput output;
  ASSERT_TRUE(AssimilateAir(input, options, {}, SerialFor(), monitor, output));
  ASSERT_EQ(output.Tracks.size(), input.Tracks.size()); // what was shown is not given out besides
  for (const Track& track : output.Tracks)
  {
    for (int f = 1; f + 1 < Frames; ++f)
    {
      const auto at = static_cast<std::size_t>(f);
      const Vec3 bend =
        track.Positions[at - 1] - 2.0 * track.Positions[at] + track.Positions[at + 1];
      EXPECT_LT(900.0 * bend.norm(), 60.0) << "object " << track.ObjectId << ", frame " << f;
    }
  }
}

/// A wall of leaves whose marks, balls, are nearer to each other than they are wide.
TEST(AssimilationContacts, NoBodyJumpsIntoItsBall)
{
  AssimilationInput input;
  input.Scene.Time = { Frames, 30.0 };
  const double apart = 0.086, radius = 0.02;
  for (int o = 0; o < 49; ++o)
  {
    MotionObject object;
    object.ObjectId = o;
    object.SettlingSpeed = 0.8;
    object.ClearanceRadius = 0.0775;
    const Vec3 offset(o % 7 - 3.0, 0.0, o / 7 - 3.0);
    object.Position = Vec3(0.0, 0.0, 2.6) + 0.2 * Vec3(offset.z(), offset.x(), 0.3 * (o % 3));
    input.Objects.push_back(object);
    Constraint row;
    row.ObjectId = o;
    row.Row = o;
    row.Frame = LiesAt;
    row.Radius = radius;
    row.Value = Vec3(0.1, 0.0, 1.7) + apart * offset;
    input.Constraints.push_back(row);
    Track track;
    track.ObjectId = o;
    for (int f = 0; f < Frames; ++f)
    {
      const double s = f / double(LiesAt);
      track.Positions.push_back((1.0 - s) * object.Position + s * row.Value);
    }
    input.Tracks.push_back(track);
  }
  AssimilationOptions options;
  options.Resolution = options.LatticeResolution = 16;
  options.Rounds = 1;
  options.Starts = 0;
  SilentMonitor monitor;
  AssimilationOutput output;
  ASSERT_TRUE(AssimilateAir(input, options, {}, SerialFor(), monitor, output));
  for (std::size_t o = 0; o < output.Tracks.size(); ++o)
  {
    const std::vector<Vec3>& x = output.Tracks[o].Positions;
    EXPECT_LE((x[LiesAt] - input.Constraints[o].Value).norm(), radius * (1.0 + 1e-12)) << o;
    for (std::size_t f = LiesAt - 10; f <= LiesAt + 10; ++f)
    {
      EXPECT_LT(900.0 * (x[f - 1] - 2.0 * x[f] + x[f + 1]).norm(), 25.0) << o << ", frame " << f;
    }
  }
}
