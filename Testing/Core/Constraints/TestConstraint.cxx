// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Constraint.h"

#include <gtest/gtest.h>

using namespace waft;

TEST(ConstraintKinds, AreFoundByTheirNames)
{
  for (int k = 0; k < NumberOfConstraintKinds; ++k)
  {
    const auto kind = static_cast<ConstraintKind>(k);
    const ConstraintTraits* found = FindConstraintKind(ToString(kind));
    ASSERT_NE(found, nullptr) << ToString(kind);
    EXPECT_EQ(found->Kind, kind);
    EXPECT_EQ(found->IsPositional, found->Derivative == 0) << found->Name;
  }
  EXPECT_EQ(FindConstraintKind("jump"), nullptr);
  EXPECT_EQ(FindConstraintKind(""), nullptr);
}

TEST(ConstraintKinds, TolerancesAreRelativeToTheirScales)
{
  const MotionScales scales{ 4.0, 2.0, 30.0 };
  EXPECT_DOUBLE_EQ(ToleranceOf(ConstraintKind::Position, scales), 4e-9);
  EXPECT_DOUBLE_EQ(ToleranceOf(ConstraintKind::Rest, scales), 4e-9);
  EXPECT_DOUBLE_EQ(ToleranceOf(ConstraintKind::Velocity, scales), 2e-6);
  EXPECT_DOUBLE_EQ(ToleranceOf(ConstraintKind::Acceleration, scales), 6e-5);
  EXPECT_DOUBLE_EQ(ToleranceOf(ConstraintKind::Orientation, scales), 1e-6);
  // Of what stands still, not nothing.
  EXPECT_GT(ToleranceOf(ConstraintKind::Velocity, { 4.0, 0.0, 30.0 }), 0.0);
}

TEST(ConstraintKinds, StencilsOfAllOrdersFitTheTimeLine)
{
  const Timeline time{ 9, 30.0 };
  for (int derivative = 0; derivative <= 2; ++derivative)
  {
    for (const int first : { 0, 4 })
    {
      for (int frame = first; frame < time.NumberOfFrames; ++frame)
      {
        // Of x = t^derivative the derivative is derivative!, of a constant 0.
        double ofPower = 0.0, ofOne = 0.0;
        for (const auto& [k, weight] : DerivativeStencil(derivative, frame, time, first))
        {
          ASSERT_GE(k, first);
          ASSERT_LT(k, time.NumberOfFrames);
          ofPower += weight * std::pow(k / time.FramesPerSecond, derivative);
          ofOne += weight;
        }
        EXPECT_NEAR(ofPower, derivative == 2 ? 2.0 : 1.0, 1e-9) << derivative << " " << frame;
        EXPECT_NEAR(ofOne, derivative == 0 ? 1.0 : 0.0, 1e-9) << derivative << " " << frame;
      }
    }
  }
  EXPECT_TRUE(DerivativeStencil(1, 0, { 1, 30.0 }).empty());
}

TEST(SetHolds, BeginWithTheLastOfTheirRow)
{
  std::vector<Constraint> rows(4);
  const int frames[] = { 30, 50, 40, 90 };
  for (int i = 0; i < 4; ++i)
  {
    rows[static_cast<std::size_t>(i)].Frame = frames[i];
    rows[static_cast<std::size_t>(i)].Row = i < 3 ? 0 : 1;
    rows[static_cast<std::size_t>(i)].Until = frames[i];
    rows[static_cast<std::size_t>(i)].Hold = i == 2 ? 0 : 20;
  }
  SetHolds(100, rows);
  EXPECT_EQ(70, LastFrame(rows[0]));
  EXPECT_EQ(70, LastFrame(rows[1]));
  EXPECT_EQ(40, LastFrame(rows[2]));  // it is not held
  EXPECT_EQ(100, LastFrame(rows[3])); // no longer than the shot
  SetArrival(35, rows[1].Value, rows[1]);
  SetHolds(100, rows);
  EXPECT_EQ(55, LastFrame(rows[0]));
}
