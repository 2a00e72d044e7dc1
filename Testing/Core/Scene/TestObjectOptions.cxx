// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ObjectOptions.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

TEST(ObjectOptions, ARowGoesFromEndToEnd)
{
  ObjectOptions options;
  options.Layout = ObjectLayout::Row;
  options.NumberOfObjects = 5;
  options.Position = Vec3(-1, 0, 3);
  options.RowEnd = Vec3(1, 0.4, 2);
  std::vector<MotionObject> objects;
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(objects)));
  ASSERT_EQ(objects.size(), 5u);
  EXPECT_EQ(objects.front().Position, options.Position);
  EXPECT_EQ(objects[2].Position, Vec3(0, 0.2, 2.5));
  EXPECT_EQ(objects.back().Position, options.RowEnd);
  for (int k = 0; k < 5; ++k)
  {
    EXPECT_EQ(objects[static_cast<std::size_t>(k)].ObjectId, k);
  }
  options.NumberOfObjects = 1;
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(objects)));
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].Position, options.Position);
}

TEST(ObjectOptions, ASpreadKeepsApartAndInside)
{
  ObjectOptions options;
  options.Layout = ObjectLayout::Spread;
  options.NumberOfObjects = 40;
  options.ObjectId = 100;
  std::vector<MotionObject> objects, again;
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(objects)));
  ASSERT_EQ(objects.size(), 40u);
  const Vec3 high = options.RegionMin + options.RegionSize;
  for (const MotionObject& a : objects)
  {
    EXPECT_TRUE((a.Position.array() >= options.RegionMin.array()).all() &&
                (a.Position.array() <= high.array()).all());
    for (const MotionObject& b : objects)
    {
      EXPECT_TRUE(a.ObjectId == b.ObjectId || (a.Position - b.Position).norm() > 0.25);
    }
  }
  EXPECT_EQ(objects.front().ObjectId, 100);
  EXPECT_EQ(objects.back().ObjectId, 139);
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(again)));
  EXPECT_EQ(again[7].Position, objects[7].Position);
  options.Seed = 2;
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(again)));
  EXPECT_NE(again[7].Position, objects[7].Position);
  options.RegionMin = Vec3(5, 5, 5); // outside the volume
  EXPECT_NE(options.MakeObjects(again).Message().find("RegionMin, RegionSize"), std::string::npos);
}

TEST(ObjectOptions, AnglesTurnAboutTheWorldsAxesInTheirOrder)
{
  ObjectOptions options;
  options.Angles = Vec3(90, 0, 90);
  std::vector<MotionObject> objects;
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(objects)));
  // y goes to z by the first turn and stays there; z goes to -y, and on to x.
  EXPECT_LT((objects[0].Orientation * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((objects[0].Orientation * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-12);
}

TEST(ObjectOptions, NumbersBeyondTheLargestAreRefused)
{
  ObjectOptions options;
  options.Layout = ObjectLayout::Row;
  options.ObjectId = 2147483645;
  std::vector<MotionObject> objects;
  EXPECT_NE(options.MakeObjects(objects).Message().find("ObjectId"), std::string::npos);
}

TEST(ObjectOptions, ReleaseOneByOne)
{
  ObjectOptions options;
  options.Layout = ObjectLayout::Row;
  options.NumberOfObjects = 4;
  std::vector<MotionObject> objects;
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(objects)));
  EXPECT_EQ(-1, objects[3].Release);
  options.Release = 10;
  options.LastRelease = 40;
  options.Appears = true;
  ASSERT_TRUE(static_cast<bool>(options.MakeObjects(objects)));
  std::vector<int> frames;
  for (const MotionObject& object : objects)
  {
    frames.push_back(object.Release);
    EXPECT_EQ(object.Release, object.FirstPresent());
  }
  std::sort(frames.begin(), frames.end());
  EXPECT_EQ((std::vector<int>{ 10, 20, 30, 40 }), frames);
  options.LastRelease = 300;
  EXPECT_NE(options.MakeObjects(objects).Message().find("Release, LastRelease: expected at most"),
            std::string::npos);
}
