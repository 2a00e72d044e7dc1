// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSimulation.h"
#include "Air/Field/AirSymmetry.h"
#include "Air/Field/WindCorrection.h"
#include "Air/PlainDrift.h"
#include "Air/Run/AirAssimilation.h"
#include "Air/Run/AssimilationState.h"
#include "Base/Primitives.h"
#include "Base/Random.h"
#include "Base/TemporaryFolder.h"
#include "Grid/SmokeEnsemble.h"
#include "StraightFlights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <utility>

using namespace waft;

namespace
{

constexpr int Frames = 46;

AirScene SmallAir()
{
  AirScene scene;
  scene.Smoke.Resolution = { 16, 16, 16 };
  scene.Smoke.Boundary.fill(BoundaryKind::Closed);
  scene.Smoke.BuoyancyTemperature = 0.0;
  scene.Smoke.WarmUpSeconds = 1.0;
  scene.LatticeDimensions = { 16, 16, 16 };
  scene.Time = { 16, 30.0 };
  EnsembleOptions ensemble;
  ensemble.Seed = 5;
  ensemble.NumberOfObstacles = ensemble.NumberOfEmitters = 0;
  Ensemble made;
  EXPECT_TRUE(static_cast<bool>(MakeEnsemble(ensemble, made)));
  scene.Forces = made.Forces;
  return scene;
}

double Difference(const HalfSeries& one, const HalfSeries& other)
{
  const FieldSeries a = Unpacked(one);
  const FieldSeries b = Unpacked(other);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < a.Values.size(); ++f)
  {
    for (std::size_t i = 0; i < a.Values[f].size(); ++i, ++count)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        sum += std::pow(double(a.Values[f][i][c]) - double(b.Values[f][i][c]), 2);
      }
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

HalfSeries Simulated(const AirScene& scene, AirSteering* steering = nullptr)
{
  SilentMonitor monitor;
  HalfSeries air;
  EXPECT_TRUE(static_cast<bool>(SimulateAir(scene, steering, SerialFor(), monitor, air)));
  return air;
}

/// Leaves that fall from a row in the air to a row on the ground, half a second after one another.
AssimilationInput Leaves()
{
  AssimilationInput input;
  input.Scene.Time = { Frames, 30.0 };
  input.Obstacles.push_back(FlatGround());
  for (int o = 0; o < 6; ++o)
  {
    MotionObject object;
    object.ObjectId = 10 + o;
    object.Position = Vec3(-1.0 + 0.4 * o, 0.2 * o, 0.7);
    object.SettlingSpeed = 0.5;
    object.RestHeight = 0.01;
    Constraint row;
    row.ObjectId = object.ObjectId;
    row.Row = o;
    if (o < 3)
    {
      row.Kind = ConstraintKind::Rest;
      row.Frame = 40;
      row.Until = Frames - 1;
      row.Value = Vec3(-1.1 + 0.45 * o, -0.2 + 0.25 * o, 0.5);
    }
    else
    {
      row.Frame = 30;
      row.Radius = o == 4 ? 0.05 : 0.0;
      row.Value = object.Position + Vec3(0.2, -0.1, -0.2);
    }
    AddStraightFlight(object, row, Frames, input);
  }
  return input;
}

AssimilationOptions Small()
{
  AssimilationOptions options;
  options.Resolution = 16;
  options.LatticeResolution = 16;
  options.Rounds = 2;
  options.Starts = 2;
  return options;
}

AssimilationOutput Assimilated(const AssimilationInput& input, const AssimilationOptions& options,
                               const ParallelFor& parallel = SerialFor())
{
  SilentMonitor monitor;
  AssimilationOutput output;
  const Result result = AssimilateAir(input, options, {}, parallel, monitor, output);
  EXPECT_TRUE(static_cast<bool>(result)) << result.Message();
  return output;
}

std::string ErrorOf(const AssimilationInput& input)
{
  SilentMonitor monitor;
  AssimilationOutput output;
  return AssimilateAir(input, Small(), {}, SerialFor(), monitor, output).Message();
}

TEST(AirSymmetry, ImageOfAnAirIsTheAirOfTheImages)
{
  const AirScene scene = SmallAir();
  const HalfSeries air = Simulated(scene);
  const std::vector<AirSymmetry> all = AirSymmetries(scene.Smoke.Bounds);
  ASSERT_EQ(all.size(), 8u);
  for (const std::size_t k : { 1u, 4u, 7u })
  {
    AirScene turned = scene;
    turned.Forces = Image(all[k], scene.Smoke.Bounds, scene.Forces);
    HalfSeries image;
    SetImage(all[k], air, image);
    EXPECT_LT(Difference(image, Simulated(turned)), 2e-3) << all[k].Text();
  }
  EXPECT_EQ(AirSymmetries({ Vec3(0, 0, 0), Vec3(2, 3, 2) }).size(), 4u);
}

TEST(AirSimulation, FollowsWhatItIsSteeredTo)
{
  const AirScene scene = SmallAir();
  const HalfSeries own = Simulated(scene);
  FieldSeries goal = Unpacked(own);
  for (std::size_t f = 0; f < goal.Values.size(); ++f)
  {
    const double grown = 0.3 * static_cast<double>(f) / 15.0;
    for (std::size_t i = 0; i < goal.Values[f].size(); ++i)
    {
      // A gyre that grows.
      const double x = M_PI * static_cast<double>(i % 16) / 15.0;
      const double y = M_PI * static_cast<double>(i / 16 % 16) / 15.0;
      goal.Values[f][i][0] += static_cast<float>(grown * std::sin(x) * std::cos(y));
      goal.Values[f][i][1] -= static_cast<float>(grown * std::cos(x) * std::sin(y));
    }
  }
  const HalfSeries wanted(goal);
  AirSteering asIs(own, own, 3.0);
  HalfSeries still = own; // beside which what a start on the lattice loses is little
  for (std::vector<Half3>& field : still.Values)
  {
    std::fill(field.begin(), field.end(), Half3{});
  }
  EXPECT_LT(Difference(Simulated(scene, &asIs), own), 0.15 * Difference(still, own));
  AirSteering other(wanted, own, 3.0);
  EXPECT_LT(Difference(Simulated(scene, &other), wanted), 0.4 * Difference(own, wanted));
}

TEST(AirSimulation, HasTheWantedVelocityFromTheFirstFrameOn)
{
  const AirScene scene = SmallAir();
  const HalfSeries own = Simulated(scene);
  FieldSeries goal = Unpacked(own);
  for (FieldSeries::Field& field : goal.Values)
  {
    for (std::size_t i = 0; i < field.size(); ++i)
    {
      // A gyre that is there from the beginning.
      const double x = M_PI * static_cast<double>(i % 16) / 15.0;
      const double y = M_PI * static_cast<double>(i / 16 % 16) / 15.0;
      field[i][0] += static_cast<float>(0.5 * std::sin(x) * std::cos(y));
      field[i][1] -= static_cast<float>(0.5 * std::cos(x) * std::sin(y));
    }
  }
  const HalfSeries wanted(goal);
  AirSteering steering(wanted, own, 3.0);
  const FieldSeries air = Unpacked(Simulated(scene, &steering));
  double missed = 0.0, added = 0.0;
  const FieldSeries before = Unpacked(own);
  for (std::size_t i = 0; i < air.NumberOfPoints(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      missed += std::pow(air.Values[0][i][c] - goal.Values[0][i][c], 2);
      added += std::pow(before.Values[0][i][c] - goal.Values[0][i][c], 2);
    }
  }
  EXPECT_LT(missed, 0.1 * added); // the floor holds what is near it
}

TEST(AirSimulation, ASeriesOnAnotherLatticeIsLinearBetweenItsPoints)
{
  const HalfSeries own = Simulated(SmallAir());
  AirScene scene = SmallAir();
  scene.LatticeDimensions = { 21, 20, 19 };
  const HalfSeries other = OnLattice(own, AirLattice(scene, own.Meaning), SerialFor());
  ASSERT_EQ(other.Values.size(), own.Values.size());
  EXPECT_EQ(other.Times, own.Times);
  const FieldSeries plain = Unpacked(own), found = Unpacked(other);
  for (const std::size_t f : { std::size_t{ 0 }, own.Values.size() - 1 })
  {
    for (std::size_t i = 0; i < found.NumberOfPoints(); i += 7)
    {
      const Vec3 u = plain.Sample(found.PointAt(i), plain.Times[f]);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(found.Values[f][i][static_cast<std::size_t>(c)], u[c], 2e-3);
      }
    }
  }
  EXPECT_EQ(OnLattice(own, own, SerialFor()).Values, own.Values);
}

TEST(AirAssimilation, MeetsEveryRowAndLowersTheControl)
{
  const AssimilationInput input = Leaves();
  const AssimilationOutput output = Assimilated(input, Small());
  ASSERT_EQ(output.Tracks.size(), 6u);
  ASSERT_EQ(output.Report.size(), 6u);
  for (const ReportRow& row : output.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Message;
    EXPECT_LE(row.Residual, 1e-12);
  }
  for (std::size_t o = 0; o < 6; ++o)
  {
    EXPECT_EQ(output.Tracks[o].Positions.front(), input.Objects[o].Position);
  }
  EXPECT_EQ(output.Tracks[3].Positions[30], input.Constraints[3].Value);
  EXPECT_EQ(output.Air->Velocity.Values.size(), std::size_t(Frames));
  EXPECT_EQ(output.Air->Wind.Values.size(), std::size_t(Frames));
  double drifting = 0.0;
  for (const AssimilationRound& row : output.Rounds)
  {
    drifting = row.Stage == "drift" ? row.Control : drifting;
  }
  EXPECT_LT(output.Rounds.back().Control, 0.5 * drifting);
}

TEST(AirAssimilation, IsGivenOnItsLatticeAlsoWhereItIsOnlyDrawn)
{
  AssimilationOptions options = Small();
  options.Resolution = 36; // drawn with 32
  options.LatticeResolution = 34;
  options.Starts = options.WindRounds = 1;
  options.Candidates = 1;
  const std::array<int, 3> wanted = AirLatticeDimensions(Leaves().Scene.Bounds, options);
  const AssimilationOutput simulated = Assimilated(Leaves(), options);
  EXPECT_EQ(simulated.Air->Velocity.Dimensions, wanted);
  EXPECT_EQ(simulated.Air->Wind.Dimensions, wanted);
  options.TimeLimit = 1e-9;
  const AssimilationOutput drawn = Assimilated(Leaves(), options);
  EXPECT_EQ(drawn.Air->Velocity.Dimensions, wanted);
  EXPECT_TRUE(drawn.Air->Wind.IsEmpty());
  EXPECT_EQ(drawn.Tracks[3].Positions[30], Leaves().Constraints[3].Value);
}

TEST(AirAssimilation, BodiesWithInertiaGoInTheAirThatIsLeft)
{
  AssimilationInput input = Leaves();
  AssimilationOptions options = Small();
  options.Inertia = true;
  const AssimilationOutput output = Assimilated(input, options);
  ASSERT_EQ(output.ResponseTimes.size(), 6u);
  const double response = output.ResponseTimes[3];
  EXPECT_NEAR(response, 0.5 / 9.80665, 1e-9);
  EXPECT_EQ(output.Tracks[3].Positions[30], input.Constraints[3].Value);
  // From half a second before its mark on, by the law alone.
  const HalfSeries& air = output.Air->Velocity;
  const double dt = 1.0 / 30.0;
  const auto given = [&](int step, const Vec3& x)
  {
    const double times[] = { step * dt, (step + 1) * dt };
    return Vec3(
      0.5 * (air.Around(times[0]).Sample(x, times[0]) + air.Around(times[1]).Sample(x, times[1])) -
      0.5 * Vec3::UnitZ());
  };
  const std::vector<Vec3>& path = output.Tracks[3].Positions;
  const double e = std::exp(-dt / response);
  const double now = 1.0 - response / dt * (1.0 - e);
  Vec3 x = path[15], velocity = (path[15] - path[14]) / dt;
  Vec3 before = given(14, 0.5 * (path[14] + path[15]));
  for (int k = 15; k < 30; ++k)
  {
    Vec3 next = velocity, there;
    for (int i = 0; i < 20; ++i)
    {
      there = given(k, x + 0.5 * dt * next);
      next = e * velocity + (1.0 - e - now) * before + now * there;
    }
    velocity = next;
    before = there;
    x += dt * velocity;
  }
  EXPECT_LT((x - path[30]).norm(), 0.01);
  EXPECT_LT(output.Rounds.back().Control, 0.2 * output.Rounds.back().Flow);
}

TEST(AirAssimilation, LetsEachBodyLieWhenItsDriftComesDown)
{
  const AssimilationOutput output = Assimilated(Leaves(), Small());
  for (std::size_t o = 0; o < 6; ++o)
  {
    const int down = output.Constraints[o].TouchDown;
    if (o >= 3)
    {
      EXPECT_EQ(down, -1);
      continue;
    }
    ASSERT_GE(down, 0);
    ASSERT_LE(down, 40);
    const std::vector<Vec3>& x = output.Tracks[o].Positions;
    for (int f = down; f < Frames; ++f)
    {
      EXPECT_EQ(x[f], x[down]);
    }
  }
}

TEST(AirAssimilation, IsTheSameOnAnyNumberOfThreads)
{
  const AssimilationOutput one = Assimilated(Leaves(), Small());
  const AssimilationOutput three = Assimilated(Leaves(), Small(), ThreadedFor(3));
  for (std::size_t o = 0; o < one.Tracks.size(); ++o)
  {
    EXPECT_EQ(one.Tracks[o].Positions, three.Tracks[o].Positions);
  }
  EXPECT_EQ(one.Air->Velocity.Values, three.Air->Velocity.Values);
}

TEST(AirAssimilation, AnotherSeedIsAnotherAirAndTheScenesOwnTheSame)
{
  const AssimilationInput input = Leaves();
  AssimilationOptions options = Small();
  options.Rounds = options.WindRounds = options.Starts = 0;
  options.Candidates = 1;
  const AssimilationOutput own = Assimilated(input, options);
  const std::uint64_t key = KeyOf(input, options).Surroundings;
  options.Seed = static_cast<int>(input.Scene.Seed);
  EXPECT_EQ(Assimilated(input, options).Air->Velocity.Values, own.Air->Velocity.Values);
  EXPECT_EQ(KeyOf(input, options).Surroundings, key);
  ++options.Seed;
  EXPECT_NE(Assimilated(input, options).Air->Velocity.Values, own.Air->Velocity.Values);
  EXPECT_NE(KeyOf(input, options).Surroundings, key);
}

TEST(AirAssimilation, ARunWithOtherMarksBeginsWithTheAirThatWasDrawn)
{
  const test::TemporaryFolder folder;
  int found = 0, made = 0;
  AssimilationInput input = Leaves();
  const auto path = [&](std::uint64_t key) { return folder.File("drawn-" + std::to_string(key)); };
  input.Drawn.Found = [&](std::uint64_t key)
  {
    found += std::filesystem::exists(path(key)) ? 1 : 0;
    return path(key);
  };
  input.Drawn.Make = [&](std::uint64_t key, const std::function<Result(const std::string&)>& write)
  {
    ++made;
    EXPECT_TRUE(write(path(key)));
  };
  const AssimilationOutput plain = Assimilated(Leaves(), Small());
  const auto expectSame = [&plain](const AssimilationOutput& other)
  {
    EXPECT_EQ(plain.Air->Velocity.Values, other.Air->Velocity.Values);
    EXPECT_EQ(plain.Tracks[3].Positions, other.Tracks[3].Positions);
  };
  expectSame(Assimilated(input, Small()));
  EXPECT_EQ(std::make_pair(found, made), std::make_pair(0, 1));
  expectSame(Assimilated(input, Small()));
  EXPECT_EQ(std::make_pair(found, made), std::make_pair(1, 1));
  // Other marks: of the eight images another one may be best, but nothing is drawn again.
  AssimilationInput other = input;
  other.Constraints[4].Value += Vec3(0.1, 0.1, 0.0);
  Assimilated(other, Small());
  EXPECT_EQ(std::make_pair(found, made), std::make_pair(2, 1));
  // Another obstacle or seed: another air.
  other.Scene.Seed += 1;
  Assimilated(other, Small());
  EXPECT_EQ(std::make_pair(found, made), std::make_pair(2, 2));
  // What is damaged is drawn anew.
  for (const auto& entry : std::filesystem::directory_iterator(folder.Path()))
  {
    std::filesystem::resize_file(entry.path(), 1000);
  }
  expectSame(Assimilated(input, Small()));
  EXPECT_EQ(made, 3);
}

TEST(AirAssimilation, ControlIsWhatTheAirDoesNotExplain)
{
  const AssimilationInput input = Leaves();
  const AssimilationOutput output = Assimilated(input, Small());
  const std::vector<Vec3>& x = output.Tracks[4].Positions;
  for (int f = 5; f < 25; ++f)
  {
    const Vec3 v = 15.0 * (x[f + 1] - x[f - 1]);
    const Vec3 u =
      output.Air->Velocity.Around(f / 30.0).Sample(x[f], f / 30.0) - 0.5 * Vec3::UnitZ();
    EXPECT_LT((output.Controls[4][f] - (v - u)).norm(), 0.02);
  }
}

TEST(AirAssimilation, NamesWhatIsWrongWithItsInput)
{
  AssimilationInput input = Leaves();
  input.Tracks.clear();
  EXPECT_EQ(ErrorOf(input), "Tracks: no track, at least one expected");
  input = Leaves();
  input.Tracks[1].Positions.pop_back();
  EXPECT_EQ(ErrorOf(input), "Tracks, object 11: 45 points, one a frame (46) expected");
  input = Leaves();
  input.Tracks[2].Positions[3].x() = std::nan("");
  EXPECT_EQ(ErrorOf(input), "Tracks, object 12: not a finite position at frame 3");
  input = Leaves();
  input.Objects.pop_back();
  EXPECT_EQ(ErrorOf(input), "Objects: no object 15, which Tracks has");
  input = Leaves();
  input.Scene.Time.NumberOfFrames = 1;
  EXPECT_EQ(ErrorOf(input), "NumberOfFrames: at least 2 expected, found 1");
  input = Leaves();
  input.Scene.Bounds.Max.y() = input.Scene.Bounds.Min.y() + 0.1;
  EXPECT_EQ(ErrorOf(input), "the volume: expected a shortest side of at least 0.125 m beside its "
                            "longest, room for an eddy, found 0.1 m");
}

// Marks of all in one place, or denser than the lattice, or in the layer in which the air is held
// back beside an obstacle.
TEST(AirAssimilation, MeetsMarksThatLeaveTheAirNoRoom)
{
  for (const double apart : { 0.0, 0.01 })
  {
    AssimilationInput input;
    input.Scene.Time = { Frames, 30.0 };
    input.Obstacles.push_back(FlatGround());
    ObstacleMesh box;
    box.ObstacleId = 1;
    box.Mesh = MakeBox({ Vec3(0.4, -0.5, 0.0), Vec3(1.0, 0.5, 1.5) });
    input.Obstacles.push_back(box);
    for (int o = 0; o < 24; ++o)
    {
      MotionObject object;
      object.ObjectId = o;
      object.Position = Vec3(-1.5 + 0.25 * (o % 6), -0.5 + 0.25 * (o / 6), 1.6);
      object.SettlingSpeed = 0.5;
      object.ClearanceRadius = 0.02;
      Constraint row;
      row.ObjectId = object.ObjectId;
      row.Row = o;
      row.Frame = 40;
      row.Value = Vec3(0.37, apart * (o % 5), 1.0 + apart * (o / 5));
      AddStraightFlight(object, row, Frames, input);
    }
    const AssimilationOutput output = Assimilated(input, Small());
    for (std::size_t o = 0; o < 24; ++o)
    {
      EXPECT_EQ(output.Report[o].Status, ConstraintStatus::Met) << output.Report[o].Message;
      EXPECT_EQ(output.Tracks[o].Positions[40], input.Constraints[o].Value) << o;
      for (const Vec3& x : output.Tracks[o].Positions)
      {
        ASSERT_TRUE(x.allFinite()) << o;
      }
    }
    for (const std::array<float, 3>& u : output.Air->Velocity.At(40))
    {
      ASSERT_TRUE(std::isfinite(u[0]) && std::isfinite(u[1]) && std::isfinite(u[2]));
    }
  }
}

TEST(AirAssimilation, CorrectsTheWindByAsManyNumbersInAnyVolume)
{
  AssimilationOptions options;
  for (const double width : { 0.3, 1.0, 4.0, 40.0, 200.0 })
  {
    const Box volume{ Vec3::Zero(), Vec3::Constant(width) };
    const WindSplines splines(volume, Timeline(), WindSpacingIn(volume, options),
                              options.WindTimeSpacing, 1.0);
    EXPECT_EQ(splines.Coefficients(), std::size_t{ 3 * 13 * 13 * 13 * 23 });
  }
  options.WindSpacing = 0.5;
  EXPECT_EQ(WindSpacingIn(Box(), options), 0.5);
  options.WindSpacing = 0.01;
  AssimilationOutput output;
  SilentMonitor monitor;
  EXPECT_EQ(AssimilateAir(Leaves(), options, {}, SerialFor(), monitor, output).Message(),
            "WindSpacing: expected 0 or a number from 0.01562 m in this volume, found 0.01");
}

TEST(AirAssimilation, StopsWhereItIsAskedTo)
{
  class StopsAt : public Monitor
  {
  public:
    explicit StopsAt(double fraction) : At(fraction) {}
    bool Tick(double fraction, const std::string&) override { return fraction < this->At; }
    double At;
  };
  for (const double at : { 0.05, 0.7 })
  {
    StopsAt monitor(at);
    AssimilationOutput output;
    const Result result = AssimilateAir(Leaves(), Small(), {}, SerialFor(), monitor, output);
    EXPECT_TRUE(result.IsStopped());
    const AssimilationInput input = Leaves();
    ASSERT_EQ(output.Tracks.size(), input.Tracks.size()); // the best so far
    ASSERT_EQ(output.Controls.size(), input.Tracks.size());
    EXPECT_EQ(output.Air->Velocity.IsEmpty(), at < 0.08);
    for (std::size_t o = 0; o < input.Tracks.size() && at < 0.08; ++o)
    {
      EXPECT_EQ(output.Tracks[o].Positions, input.Tracks[o].Positions); // the plan
      EXPECT_EQ(output.Controls[o].size(), input.Tracks[o].Positions.size());
    }
  }
}

} // namespace
