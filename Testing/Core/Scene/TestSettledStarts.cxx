// SPDX-License-Identifier: BSD-3-Clause
#include "TestAssets.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

Scene With(const std::string& objects, const std::string& rows, const std::string& more = "")
{
  return Parsed(R"({"waft": 1, "shapes": {"leaf": {"builtin": "leaf"}}, "objects": )" + objects +
                R"(, "constraints": )" + rows + more + "}");
}

double HeightAbove(const Scene& scene, int object, double surface)
{
  return scene.Objects[static_cast<std::size_t>(object)].Position.z() - surface;
}

} // namespace

TEST(SettledStarts, WhatRestsFromFrameZeroLiesOnTheSurfaceBelowItsStart)
{
  const Scene scene = With(R"([{"shape": "leaf", "positions": [[0, 0, 0.02], [1, 0, -0.01]]},
                               {"shape": "leaf", "position": [0.5, 0, 0.02]}])",
                           R"([{"kind": "rest", "object": 0, "frame": 0, "value": [0, 0, 0.02]},
                               {"kind": "rest", "object": 1, "frame": 0, "value": [1, 0, 0.5]},
                               {"kind": "rest", "object": 2, "frame": 1, "value": [0.5, 0, 1]}])");
  for (int object = 0; object < 2; ++object)
  {
    EXPECT_NEAR(HeightAbove(scene, object, 0.0),
                scene.Objects[static_cast<std::size_t>(object)].RestHeight, 1e-12);
  }
  EXPECT_EQ(HeightAbove(scene, 2, 0.0), 0.02) << "nothing holds it at frame 0";
  ASSERT_EQ(scene.Warnings.size(), 1u);
  EXPECT_NE(scene.Warnings[0].find("2 objects that rest from frame 0 on are put on the surface"),
            std::string::npos)
    << scene.Warnings[0];
  EXPECT_NE(scene.Warnings[0].find("m away (object "), std::string::npos) << scene.Warnings[0];
}

TEST(SettledStarts, OneOnABoxOrFartherThanItsClearanceIsSoughtAndLeft)
{
  const Scene scene = With(R"([{"shape": "leaf", "positions": [[0, 0, 0.52], [1, 0, 0.3]]}])",
                           R"([{"kind": "rest", "object": 0, "frame": 0, "value": [0, 0, 3]},
                               {"kind": "rest", "object": 1, "frame": 0, "value": [1, 0, 3]}])",
                           R"(, "obstacles": [{"kind": "box", "min": [-0.3, -0.3, 0.1],
                                               "max": [0.3, 0.3, 0.5]}])");
  EXPECT_NEAR(HeightAbove(scene, 0, 0.5), scene.Objects[0].RestHeight, 1e-12);
  EXPECT_EQ(HeightAbove(scene, 1, 0.0), 0.3);
}

TEST(SettledStarts, AKeyframeThatWaitsForItsObjectsHoldsThoseThatStartThere)
{
  const Scene scene =
    With(R"([{"shape": "leaf", "positions": [[0, 0, 0.02], [1, 0, 0.02], [0.5, 0.5, 0.02]]}])",
         R"([{"kind": "keyframe", "frame": 0, "until": 20, "velocity": "rest",
              "targets": {"points": [[1, 0, 0.02], [0, 0, 0.02]]}}])");
  EXPECT_NEAR(HeightAbove(scene, 0, 0.0), scene.Objects[0].RestHeight, 1e-12);
  EXPECT_NEAR(HeightAbove(scene, 1, 0.0), scene.Objects[1].RestHeight, 1e-12);
  EXPECT_EQ(HeightAbove(scene, 2, 0.0), 0.02) << "no target is where it starts";
}
