// SPDX-License-Identifier: BSD-3-Clause
// Local edits: what changed is solved again, all else stays to the bit.
#include "SpacetimeRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ctime>

using namespace waft;

namespace
{

constexpr int Edited = 2;  // object
constexpr int Target = 60; // frame

SpacetimeInput Scene()
{
  SceneOptions scene;
  scene.NumberOfFrames = 120;
  scene.NumberOfObjects = 8;
  SpacetimeInput input = MakeScene(scene);
  Constraint row;
  row.ObjectId = input.Objects[Edited].ObjectId;
  row.Row = 20;
  row.Frame = Target;
  row.Value = input.Tracks[Edited].Positions[Target];
  input.Constraints.push_back(row);
  return input;
}

SpacetimeOptions Options()
{
  SpacetimeOptions options = QuickOptions();
  options.MaximumNumberOfIterations = 20;
  options.EditDuration = 0.5;
  options.EditRadius = 0.6;
  return options;
}

/// Another target, and the plan with it from `first` to `last`.
SpacetimeInput MoveTarget(SpacetimeInput input, const Vec3& shift, int first, int last)
{
  input.Constraints.back().Value += shift;
  for (int k = first; k <= last; ++k)
  {
    const double s = double(k - first) / (last - first);
    input.Tracks[Edited].Positions[k] += std::pow(std::sin(M_PI * s), 2) * shift;
  }
  input.Tracks[Edited].Positions[Target] = input.Constraints.back().Value;
  return input;
}

double Cpu()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

/// Expects every object and gas particle outside the region where it was, to the bit.
void ExpectKept(const SpacetimeInput& input, const SpacetimeOutput& before,
                const SpacetimeOutput& after, int first, int last)
{
  const double radius = Options().EditRadius;
  std::size_t still = 0, moved = 0;
  for (std::size_t i = 0; i < before.Particles.ObjectIds.size(); ++i)
  {
    const auto at = [&](const SpacetimeOutput& output, int k)
    {
      const float* x = output.Particles.Frames[k].Positions.data() + 3 * i;
      return Vec3(x[0], x[1], x[2]);
    };
    double nearest = 1e9;
    for (int k = first; k <= last; ++k)
    {
      nearest = std::min({ nearest, (at(before, k) - before.Tracks[Edited].Positions[k]).norm(),
                           (at(before, k) - after.Tracks[Edited].Positions[k]).norm() });
    }
    for (int k = 0; k < input.Scene.Time.NumberOfFrames; ++k)
    {
      const bool isOutside = k < first || k > last || nearest > 1.5 * radius;
      const bool isSame = at(before, k) == at(after, k);
      if (isOutside)
      {
        ASSERT_TRUE(isSame) << "particle " << i << " at frame " << k;
      }
      ++(isSame ? still : moved);
    }
  }
  EXPECT_GT(still, 2 * moved);
  EXPECT_GT(moved, 300u);
  for (std::size_t o = 0; o < before.Tracks.size(); ++o)
  {
    for (int k = 0; k < input.Scene.Time.NumberOfFrames; ++k)
    {
      if (k < first || k > last)
      {
        EXPECT_EQ(before.Tracks[o].Positions[k], after.Tracks[o].Positions[k]) << o << " " << k;
        EXPECT_EQ(before.Tracks[o].AirVelocities[k], after.Tracks[o].AirVelocities[k]);
      }
    }
  }
}

void ExpectLocal(const SpacetimeInput& edited, const SpacetimeOutput& before, int first, int last,
                 SpacetimeWarmStart& memory, double fullCpu)
{
  const double start = Cpu();
  const SpacetimeOutput after = RunScene(edited, Options(), 2, &memory);
  const double fraction = (Cpu() - start) / fullCpu;
  EXPECT_LT(fraction, 0.25);
  ASSERT_EQ(after.Convergence[1].Stage, "edit");
  EXPECT_TRUE(after.Warnings.empty());
  for (const ReportRow& row : after.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Row << ": " << row.Message;
  }
  EXPECT_EQ(std::memcmp(after.Tracks[Edited].Positions[Target].data(),
                        edited.Constraints.back().Value.data(), sizeof(Vec3)),
            0);
  // E of the whole: no worse than of the edited motion before solving, and not far from what a
  // solve of everything reaches.
  EXPECT_LT(after.Convergence.back().E, after.Convergence.front().E);
  const SpacetimeOutput fresh = RunScene(edited, Options());
  EXPECT_LT(after.Convergence.back().E, 1.5 * fresh.Convergence.back().E);
  ExpectKept(edited, before, after, first, last);
  testing::Test::RecordProperty("edited", std::to_string(after.Convergence.front().E));
  testing::Test::RecordProperty("solved", std::to_string(after.Convergence.back().E));
  testing::Test::RecordProperty("fresh", std::to_string(fresh.Convergence.back().E));
  testing::Test::RecordProperty("fraction", std::to_string(fraction));
}

} // namespace

TEST(Edit, ATargetThatMovesWithItsPlanIsSolvedWhereItChanged)
{
  const SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  const double start = Cpu();
  const SpacetimeOutput before = RunScene(input, Options(), 2, &memory);
  const double cpu = Cpu() - start;
  const SpacetimeInput edited = MoveTarget(input, Vec3(0.12, -0.08, 0.05), 45, 75);
  ExpectLocal(edited, before, 46 - 15, 74 + 15, memory, cpu);
}

TEST(Edit, ATargetAloneMovesTheFramesAboutIt)
{
  const SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  const double start = Cpu();
  const SpacetimeOutput before = RunScene(input, Options(), 2, &memory);
  const double cpu = Cpu() - start;
  SpacetimeInput edited = input;
  edited.Constraints.back().Value += Vec3(0.05, 0.05, -0.03);
  ExpectLocal(edited, before, Target - 15, Target + 15, memory, cpu);
}

TEST(Edit, WithoutARegionAllIsSolvedOn)
{
  const SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  SpacetimeOptions options = Options();
  RunScene(input, options, 2, &memory);
  const SpacetimeInput edited = MoveTarget(input, Vec3(0.1, 0.0, 0.0), 45, 75);
  options.EditRadius = 0.0;
  const SpacetimeOutput all = RunScene(edited, options, 2, &memory);
  EXPECT_EQ(all.Convergence[0].Stage, "so far");
  EXPECT_EQ(all.Convergence[1].Stage, "again a");
  // Something else than tracks and rows changed as well.
  options.EditRadius = 0.5;
  options.CoherenceWeight = 0.5;
  EXPECT_EQ(RunScene(input, options, 2, &memory).Convergence[1].Stage, "again a");
}
