// SPDX-License-Identifier: BSD-3-Clause
// How far apart two bodies keep, with marks near to each other in space and in time.
#include "Constraints/KeptDistances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

using namespace waft;

namespace
{

constexpr int Frames = 121;
constexpr double Rate = 30.0;
constexpr double Radius = 0.075;
constexpr double Settling = 0.8;

HeldMark At(int frame, double x, double radius = 0.0)
{
  return { frame, Vec3(x, 0.0, 1.5), radius };
}

KeptDistances Of(std::vector<HeldMark> one, std::vector<HeldMark> other, double settling = Settling)
{
  KeptDistances kept(Rate);
  kept.AddBody(Radius, settling, Frames, std::move(one));
  kept.AddBody(Radius, settling, Frames, std::move(other));
  return kept;
}

} // namespace

TEST(KeptDistances, AreWhatBodiesNeedWhereNoMarkBringsThemNearer)
{
  EXPECT_EQ(Of({}, {}).At(60, 0, 1), 2.0 * Radius);
  EXPECT_EQ(Of({ At(60, 0.0) }, {}).At(60, 0, 1), 2.0 * Radius);
  EXPECT_EQ(Of({ At(60, 0.0) }, { At(60, 0.4) }).At(60, 0, 1), 2.0 * Radius);
  EXPECT_EQ(Of({ At(20, 0.0) }, { At(100, 0.0) }).At(60, 0, 1), 2.0 * Radius);
}

TEST(KeptDistances, AreAtAMarkWhatTheMarksLeaveExactOrBalls)
{
  EXPECT_NEAR(Of({ At(60, 0.0) }, { At(60, 0.086) }).At(60, 0, 1), 0.086, 1e-15);
  EXPECT_NEAR(Of({ At(60, 0.0, 0.02) }, { At(60, 0.086, 0.02) }).At(60, 0, 1), 0.086, 1e-15);
  EXPECT_NEAR(Of({ At(60, 0.0, 0.02) }, { At(60, 0.086) }).At(60, 0, 1), 0.086, 1e-15);
  // In one ball they have the room that the smaller has.
  EXPECT_NEAR(Of({ At(60, 0.0, 0.1) }, { At(60, 0.0, 0.12) }).At(60, 0, 1), 0.1, 1e-15);
  EXPECT_EQ(Of({ At(60, 0.0, 0.4) }, { At(60, 0.0, 0.4) }).At(60, 0, 1), 2.0 * Radius);
  // Of two at a frame the narrower counts, whatever their order.
  const KeptDistances two = Of({ At(60, 1.0, 0.5), At(60, 0.0, 0.01) }, { At(60, 0.05) });
  EXPECT_NEAR(two.At(60, 0, 1), 0.05, 1e-15);
}

TEST(KeptDistances, GrowWithTheTimeNoFasterThanBodiesSettle)
{
  for (const double settling : { Settling, 0.1, 0.02 })
  {
    const KeptDistances kept = Of({ At(60, 0.0) }, { At(60, 0.01) }, settling);
    for (int frame = 60; frame + 1 < Frames; ++frame)
    {
      const double now = kept.At(frame, 0, 1), next = kept.At(frame + 1, 0, 1);
      EXPECT_GE(next, now) << frame;
      EXPECT_LE(next, 2.0 * Radius) << frame;
      // Either by its own speed; what settles very slowly by that of the longest parting.
      EXPECT_LE(Rate * (next - now), 2.0 * std::max(settling, 2.0 * Radius / 3.0) + 1e-12) << frame;
      EXPECT_NEAR(kept.At(120 - frame, 0, 1), now, 1e-15) << frame; // before as after
    }
  }
  // The square of half a second, of both.
  EXPECT_NEAR(Of({ At(60, 0.0) }, { At(60, 0.01) }).At(75, 0, 1), 0.01 + 0.25 * 2.0 * Radius,
              1e-15);
}

TEST(KeptDistances, KnowMarksOfDifferentFrames)
{
  const KeptDistances kept = Of({ At(60, 0.0) }, { At(66, 0.01), At(90, 1.0) });
  EXPECT_NEAR(kept.At(60, 0, 1), 0.01 + Radius * 0.04, 1e-15); // the second by a fifth of a second
  EXPECT_NEAR(kept.At(63, 0, 1), 0.01 + 2.0 * Radius * 0.01, 1e-15);
  EXPECT_EQ(kept.MarkFrames(63, 0), (std::array<int, 2>{ 60, -1 }));
  EXPECT_EQ(kept.MarkFrames(66, 1), (std::array<int, 2>{ -1, 66 }));
  EXPECT_EQ(kept.MarkFrames(70, 1), (std::array<int, 2>{ 66, 90 }));
  EXPECT_EQ(kept.MarkFrames(10, 1), (std::array<int, 2>{ -1, -1 }));
}
