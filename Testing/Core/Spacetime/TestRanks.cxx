// SPDX-License-Identifier: BSD-3-Clause
// Several ranks: the same bits as one, whatever is asked for.
#include "Base/TemporaryFolder.h"
#include "Spacetime/Run/RankedObjective.h"
#include "Spacetime/Run/SpacetimeBudget.h"
#include "SpacetimeRuns.h"
#include "ThreadRanks.h"
#include "TurningAir.h"

#include <gtest/gtest.h>

#include <string>

using namespace waft;

namespace
{

SpacetimeOptions Options()
{
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 216;
  options.NumberOfObjectParticles = 9;
  options.LeashIterations = 3;
  options.MaximumNumberOfIterations = 9;
  options.Tolerance = 0.0;
  return options;
}

/// Every kind of row; those of the second object bind frames on both sides of the middle, where two
/// ranks meet.
SpacetimeInput Scene(int frames = 40)
{
  SceneOptions scene;
  scene.NumberOfFrames = frames;
  scene.Land = true;
  SpacetimeInput input = MakeScene(scene);
  const int middle = frames / 2;
  const auto add = [&](int object, int frame, ConstraintKind kind, const Vec3& value, double radius)
  {
    Constraint row;
    row.ObjectId = input.Objects[object].ObjectId;
    row.Frame = frame;
    row.Kind = kind;
    row.Value = value;
    row.Radius = radius;
    row.Row = 10 + static_cast<int>(input.Constraints.size());
    input.Constraints.push_back(row);
  };
  const Vec3 near = input.Tracks[0].Positions[middle] + Vec3(0.1, 0.05, 0.0);
  add(0, middle, ConstraintKind::Position, near, 0.03);
  add(1, middle - 1, ConstraintKind::Velocity, Vec3(0.1, 0.2, -0.3), 0.0);
  add(1, middle, ConstraintKind::Velocity, Vec3(0.15, 0.2, -0.3), 0.02);
  add(1, middle / 2, ConstraintKind::Acceleration, Vec3(0.0, 0.5, 0.25), 0.0);
  add(2, middle / 2, ConstraintKind::Position, input.Tracks[2].Positions[middle / 2], 0.0);
  return input;
}

/// Rank 0's output; of input, options, monitor and memory the other ranks are given nothing of use.
SpacetimeOutput RunOn(int size, const SpacetimeInput& input, const SpacetimeOptions& options,
                      SpacetimeWarmStart* memory = nullptr, Monitor* monitor = nullptr,
                      bool stops = false)
{
  SilentMonitor silent;
  SpacetimeOutput output;
  EXPECT_TRUE(RunRanks(
    size,
    [&](Communicator& ranks)
    {
      if (ranks.IsFirst())
      {
        const Result result = RunSpacetime(input, options, SerialFor(), monitor ? *monitor : silent,
                                           output, memory, &ranks);
        EXPECT_TRUE(result) << result.Message();
        EXPECT_EQ(result.IsStopped(), stops);
        return;
      }
      class Never : public Monitor
      {
        bool Tick(double, const std::string&) override { return false; }
      } never;
      SpacetimeOutput none;
      const Result result = RunSpacetime(SpacetimeInput(), SpacetimeOptions(), ThreadedFor(2),
                                         never, none, nullptr, &ranks);
      EXPECT_TRUE(result) << result.Message();
      EXPECT_EQ(result.IsStopped(), stops);
      EXPECT_TRUE(none.Tracks.empty() && none.Particles.Frames.empty() && none.Report.empty());
    }));
  return output;
}

void ExpectSame(const SpacetimeOutput& a, const SpacetimeOutput& b)
{
  ExpectSameMotion(a, b);
  EXPECT_EQ(a.PositionResiduals, b.PositionResiduals);
  EXPECT_EQ(a.VelocityResiduals, b.VelocityResiduals);
  EXPECT_EQ(a.Warnings, b.Warnings);
  ASSERT_EQ(a.Convergence.size(), b.Convergence.size());
  for (std::size_t k = 0; k < a.Convergence.size(); ++k)
  {
    EXPECT_EQ(a.Convergence[k].MaxViolation, b.Convergence[k].MaxViolation);
  }
  ASSERT_EQ(a.Vortices.size(), b.Vortices.size());
  for (std::size_t k = 0; k < a.Vortices.size(); ++k)
  {
    EXPECT_EQ(a.Vortices[k].P1, b.Vortices[k].P1);
    EXPECT_EQ(a.Vortices[k].Strength, b.Vortices[k].Strength);
  }
  ASSERT_EQ(a.Report.size(), b.Report.size());
  for (std::size_t k = 0; k < a.Report.size(); ++k)
  {
    EXPECT_EQ(a.Report[k].Residual, b.Report[k].Residual);
    EXPECT_EQ(a.Report[k].Status, b.Report[k].Status);
  }
}

} // namespace

TEST(RankedObjective, GivesTheBitsOfOneRank)
{
  SpacetimeSetup setup;
  ASSERT_TRUE(MakeSetup(Scene(), Options(), setup));
  const SpacetimeModel& model = setup.Model;
  for (const int window : { 1, 3 })
  {
    const TimeLevel level = TimeLevel::Full(model.NumberOfFrames, window);
    // The fields change between two evaluations, and what is read afterwards is that of the second.
    const auto evaluate = [&](Communicator& ranks)
    {
      struct
      {
        StateVector Gradient;
        SpacetimeTerms First, Second;
        std::vector<double> Ex, Ev;
        std::vector<double> Rows;
        std::vector<char> Lists;
      } found;
      AirFields fields = model.Fields;
      found.Gradient.resize(setup.Start.size());
      const auto objective = RankedObjectives(model, SerialFor(), ranks)(fields, level, true);
      EXPECT_TRUE(objective->Evaluate(setup.Start, &found.Gradient, found.First));
      for (Vortex& vortex : fields.Vortices)
      {
        vortex.Strength *= 2.0;
      }
      EXPECT_TRUE(objective->Evaluate(setup.Start, nullptr, found.Second));
      objective->BringRows();
      std::vector<int> steps;
      objective->ObjectResiduals(found.Ex, found.Ev, steps);
      for (std::size_t j = 1; j < level.NumberOfFrames(); ++j)
      {
        double rv[3];
        objective->VelocityResidual(j, j, rv);
        found.Rows.insert(found.Rows.end(), rv, rv + 3);
      }
      MemoryStream stream;
      objective->SerialiseLists(stream);
      found.Lists = stream.Content;
      return found;
    };
    SerialCommunicator alone;
    const auto one = evaluate(alone);
    EXPECT_FALSE(model.Fields.Vortices.empty());
    EXPECT_NE(one.First.E, one.Second.E);
    EXPECT_FALSE(one.Lists.empty());
    for (const int size : { 2, 3, 45 }) // more than frames: some have none
    {
      EXPECT_TRUE(RunRanks(size,
                           [&](Communicator& ranks)
                           {
                             if (!ranks.IsFirst())
                             {
                               const Result result = ServeEvaluations(model, SerialFor(), ranks);
                               EXPECT_EQ(result.Message(), "done");
                               return;
                             }
                             const auto many = evaluate(ranks);
                             EndEvaluations(Result::Error("done"), ranks);
                             EXPECT_EQ(many.Gradient, one.Gradient);
                             EXPECT_EQ(many.First.E, one.First.E);
                             EXPECT_EQ(many.Second.E, one.Second.E);
                             EXPECT_EQ(many.Ex, one.Ex);
                             EXPECT_EQ(many.Ev, one.Ev);
                             EXPECT_EQ(many.Rows, one.Rows);
                             EXPECT_EQ(many.Lists, one.Lists);
                           }));
    }
  }
}

TEST(Ranks, AWholeRunGivesTheSameBitsOnOneTwoAndThree)
{
  const SpacetimeInput input = Scene();
  const SpacetimeOutput one = RunScene(input, Options());
  EXPECT_LT(one.Convergence.back().E, 0.5 * one.Convergence[2].E); // where the rows are met first
  for (const ReportRow& row : one.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Message;
  }
  ExpectSame(RunOn(1, input, Options()), one);
  ExpectSame(RunOn(2, input, Options()), one);
  ExpectSame(RunOn(3, input, Options()), one);
}

TEST(Ranks, AWholeRunInADrawnAirGivesTheSameBits)
{
  SpacetimeInput input = Scene();
  input.Air = TurningAir(input.Scene.Bounds, 40, input.Scene.Time.Step());
  const SpacetimeOutput one = RunScene(input, Options());
  ASSERT_FALSE(one.Tracks.empty());
  ExpectSame(RunOn(2, input, Options()), one);
  ExpectSame(RunOn(3, input, Options()), one);
}

TEST(Ranks, MoreOfThemThanFramesAndAWindowWiderThanTheirShares)
{
  SpacetimeOptions options = Options();
  const SpacetimeInput few = Scene(14);
  ExpectSame(RunOn(11, few, options), RunScene(few, options));
  options.TemporalWindow = 6;
  options.XsphFactor = 0.3;
  ExpectSame(RunOn(5, few, options), RunScene(few, options));
}

TEST(Ranks, SolveInWindowsToTheSameBits)
{
  const SpacetimeInput input = Scene(60);
  SpacetimeOptions options = Options();
  options.UseLeash = false;
  options.Passes = 1;
  options.MaximumNumberOfIterations = 1;
  SpacetimeSetup setup;
  ASSERT_TRUE(MakeSetup(input, options, setup));
  const SpacetimeBudget budget(setup.Model, options);
  options.MemoryLimit = 1e-6 * budget.Of(24);
  ASSERT_LT(budget.WindowOf(60, options.MemoryLimit), 30u);
  ExpectSame(RunOn(2, input, options), RunScene(input, options));
}

TEST(Ranks, GoOnFromAMotionAndEditItToTheSameBits)
{
  SpacetimeInput input = Scene(60);
  SpacetimeOptions options = Options();
  options.EditDuration = 0.3;
  SpacetimeWarmStart one, two;
  const SpacetimeOutput first = RunScene(input, options, 1, &one);
  ExpectSame(RunOn(2, input, options, &two), first);
  EXPECT_EQ(one.State.Motion, two.State.Motion);
  // A target is moved: a part of the motion is solved again.
  input.Constraints.back().Value.x() += 0.05;
  const SpacetimeOutput edited = RunScene(input, options, 1, &one);
  EXPECT_EQ(edited.Convergence[1].Stage, "edit");
  ExpectSame(RunOn(3, input, options, &two), edited);
  // Other physics: all of it, from what is there.
  options.CoherenceWeight = 0.5;
  const SpacetimeOutput again = RunScene(input, options, 1, &one);
  EXPECT_EQ(again.Convergence[1].Stage, "again a");
  ExpectSame(RunOn(2, input, options, &two), again);
}

TEST(Ranks, StopTogetherWhenTheFirstIsAskedTo)
{
  const SpacetimeInput input = Scene();
  for (const double fraction : { 0.001, 0.4, 0.9 })
  {
    StopAt one(fraction), two(fraction);
    SpacetimeOutput output;
    const Result result = RunSpacetime(input, Options(), SerialFor(), one, output);
    ASSERT_TRUE(result && result.IsStopped());
    ExpectSame(RunOn(2, input, Options(), nullptr, &two, true), output);
  }
}

TEST(Ranks, LeaveACheckpointThatAnyNumberOfThemGoesOnFrom)
{
  const SpacetimeInput input = Scene();
  const SpacetimeOutput whole = RunScene(input, Options());
  SpacetimeOptions options = Options();
  const test::TemporaryFolder folder;
  options.CheckpointFile = folder.File("state");
  options.CheckpointInterval = 0.0;
  for (const auto& [left, taken] : { std::pair(2, 3), std::pair(3, 1), std::pair(1, 2) })
  {
    StopAt monitor(left == 3 ? 0.9 : 0.4); // on the fine level, and on the coarse one
    (void)RunOn(left, input, options, nullptr, &monitor, true);
    ASSERT_TRUE(FileExists(options.CheckpointFile));
    ExpectSame(RunOn(taken, input, options), whole);
    EXPECT_FALSE(FileExists(options.CheckpointFile));
  }
}

TEST(Ranks, ATimeLimitEndsThemTogether)
{
  SpacetimeOptions options = Options();
  options.TimeLimit = 1e-9; // up at each look
  const SpacetimeOutput output = RunOn(2, Scene(), options);
  ASSERT_EQ(output.Warnings.size(), 1u);
  EXPECT_NE(output.Warnings[0].find("TimeLimit: reached"), std::string::npos);
  EXPECT_EQ(output.Convergence.back().Stage, "final");
  for (const ReportRow& row : output.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Message;
  }
}

TEST(Ranks, AllSayWhatIsWrongWithTheInputOfTheFirst)
{
  SpacetimeInput input = Scene();
  input.Tracks[1].Positions.pop_back();
  std::vector<std::string> messages(3);
  EXPECT_TRUE(RunRanks(3,
                       [&](Communicator& ranks)
                       {
                         SilentMonitor monitor;
                         SpacetimeOutput output;
                         const Result result =
                           RunSpacetime(ranks.IsFirst() ? input : Scene(), Options(), SerialFor(),
                                        monitor, output, nullptr, &ranks);
                         EXPECT_FALSE(result);
                         messages[ranks.Rank()] = result.Message();
                       }));
  EXPECT_NE(messages[0].find("object 11: 39 points"), std::string::npos) << messages[0];
  EXPECT_EQ(messages[1], messages[0]);
  EXPECT_EQ(messages[2], messages[0]);
}
