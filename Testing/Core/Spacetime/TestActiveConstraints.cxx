// SPDX-License-Identifier: BSD-3-Clause
// Directions along touched balls.
#include "Spacetime/Solver/ActiveConstraints.h"

#include "Spacetime/Model/LevelTransfer.h"
#include "Spacetime/Scene/SpacetimeSetup.h"
#include "SpacetimeScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace waft;

namespace
{

constexpr int Frames = 20;

SpacetimeSetup TwoObjects()
{
  SceneOptions scene;
  scene.NumberOfFrames = Frames;
  scene.NumberOfObjects = 2;
  SpacetimeOptions options;
  options.NumberOfGasParticles = 125;
  SpacetimeSetup setup;
  EXPECT_TRUE(MakeSetup(MakeScene(scene), options, setup));
  return setup;
}

} // namespace

TEST(ActiveConstraints, AreFollowedByTheWholeTimeLine)
{
  const SpacetimeSetup setup = TwoObjects();
  const SpacetimeModel& model = setup.Model;
  const TimeLevel level = TimeLevel::Full(Frames, 1);
  const TimelinePreconditioner preconditioner(model, level, SerialFor());
  ActiveConstraints balls(model);
  balls.Add(8, 1);
  balls.Add(11, 1);
  balls.Add(9, 0); // not touched
  const Vec3 normals[2] = { Vec3(1.0, 2.0, -2.0) / 3.0, Vec3(0.0, 0.6, 0.8) };
  balls.Touch(
    { { 1.0f / 3.0f, 2.0f / 3.0f, -2.0f / 3.0f }, { 0.0f, 0.6f, 0.8f }, { 0.0f, 0.0f, 0.0f } });
  const auto place = [&](std::size_t ball, int c)
  {
    const std::size_t frame = ball == 0 ? 8 : 11;
    return frame * model.FrameSize() + c * model.Stride() + model.NumberOfGas + 1;
  };
  const auto beyond = [&](const StateVector& d, std::size_t ball)
  { return normals[ball].dot(Vec3(d[place(ball, 0)], d[place(ball, 1)], d[place(ball, 2)])); };
  Random random(4);
  const auto gradient = [&]
  {
    StateVector g(Frames * model.FrameSize(), 0.0f);
    for (float& value : g)
    {
      value = static_cast<float>(random.Normal());
    }
    return g;
  };
  const auto solved = [&](const StateVector& g)
  {
    StateVector d(g.size(), 0.0f);
    preconditioner.Solve(g, d);
    balls.Project(preconditioner, d);
    return d;
  };
  const auto dot = [](const StateVector& a, const StateVector& b)
  { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); };
  // P M^-1 leaves no ball, is symmetric, and has no answer to what only presses against the balls:
  // this is the least of d.Md / 2 - g.d among the directions along them.
  const StateVector a = gradient();
  const StateVector b = gradient();
  const StateVector da = solved(a);
  const StateVector db = solved(b);
  for (std::size_t ball = 0; ball < 2; ++ball)
  {
    EXPECT_NEAR(beyond(da, ball), 0.0, 1e-4 * std::sqrt(dot(da, da)));
  }
  EXPECT_NEAR(dot(b, da), dot(a, db), 1e-3 * std::sqrt(dot(a, da) * dot(b, db)));
  StateVector press(a.size(), 0.0f);
  for (int c = 0; c < 3; ++c)
  {
    press[place(0, c)] = static_cast<float>(normals[0][c]);
    press[place(1, c)] = static_cast<float>(-2.0 * normals[1][c]);
  }
  StateVector free(a.size(), 0.0f);
  preconditioner.Solve(press, free);
  EXPECT_LT(dot(press, solved(press)), 1e-4 * dot(press, free));
}

TEST(ActiveConstraints, BringAllOfAPathThatMissesThem)
{
  const SpacetimeSetup setup = TwoObjects();
  const SpacetimeModel& model = setup.Model;
  const TimeLevel level = TimeLevel::Full(Frames, 1);
  const TimelinePreconditioner preconditioner(model, level, SerialFor());
  ActiveConstraints balls(model);
  balls.Add(8, 1);
  balls.Add(12, 1);
  balls.Add(9, 0); // not missed
  StateVector state = setup.Start;
  balls.Enter(preconditioner, { { 0.3f, 0.0f, -0.4f }, { 0.0f, 0.2f, 0.0f }, { 0.0f, 0.0f, 0.0f } },
              state);
  const auto moved = [&](int frame, std::size_t object)
  {
    Vec3 d;
    for (int c = 0; c < 3; ++c)
    {
      const std::size_t place =
        frame * model.FrameSize() + c * model.Stride() + model.NumberOfGas + object;
      d[c] = state[place] - setup.Start[place];
    }
    return d;
  };
  EXPECT_NEAR(moved(8, 1).dot(Vec3(0.6, 0.0, -0.8)), -0.5, 1e-4);
  EXPECT_NEAR(moved(12, 1).y(), -0.2, 1e-4);
  // Not those frames alone: as far from one to the next as along a smooth path, and the start
  // stays.
  for (int frame = 1; frame < Frames - 1; ++frame)
  {
    const Vec3 bend = moved(frame + 1, 1) - 2.0 * moved(frame, 1) + moved(frame - 1, 1);
    EXPECT_LT(bend.norm(), 0.1) << frame;
  }
  EXPECT_EQ(moved(0, 1), Vec3::Zero());
  for (int frame = 0; frame < Frames; ++frame)
  {
    EXPECT_EQ(moved(frame, 0), Vec3::Zero());
  }
}
