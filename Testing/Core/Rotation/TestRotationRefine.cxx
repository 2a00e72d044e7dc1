// SPDX-License-Identifier: BSD-3-Clause
// The stage and what it is given: starts, shapes, seeds, threads, errors.
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

TEST(RotationRefine, AStartThatIsNotUnitIsMadeSoAndReported)
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

TEST(RotationRefine, TrianglesWithoutAreaAreReported)
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
