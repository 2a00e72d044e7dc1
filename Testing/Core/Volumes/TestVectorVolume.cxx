// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Volumes/VectorVolume.h"

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <fstream>

using namespace waft;

namespace
{

// v = (x, 2 y, 3 z) in metres on voxels of 0.25 m from (-1, 0, 0.5) on.
std::string WriteVolume(const test::TemporaryFolder& folder, const std::string& name, double turn)
{
  openvdb::initialize();
  auto grid = openvdb::Vec3SGrid::create();
  grid->setName(name);
  auto transform = openvdb::math::Transform::createLinearTransform(0.25);
  transform->postTranslate(openvdb::Vec3d(-1.0, 0.0, 0.5));
  if (turn != 0.0)
  {
    transform->preRotate(turn);
  }
  grid->setTransform(transform);
  auto accessor = grid->getAccessor();
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 5; ++i)
      {
        const openvdb::Vec3d x = grid->indexToWorld(openvdb::Coord(i, j, k));
        accessor.setValue(openvdb::Coord(i, j, k),
                          openvdb::Vec3s(float(x.x()), float(2.0 * x.y()), float(3.0 * x.z())));
      }
    }
  }
  const std::string path = folder.File(name + ".vdb");
  openvdb::io::File file(path);
  file.write({ grid });
  file.close();
  return path;
}

} // namespace

TEST(VectorVolume, GivesTheLatticeAndTheValues)
{
  const test::TemporaryFolder folder;
  for (const char* name : { "Wind", "Velocity" })
  {
    const std::string path = WriteVolume(folder, name, 0.0);
    FieldSeries step;
    const Result result = ReadVectorVolume(path, "", 0.5, step);
    ASSERT_TRUE(result) << result.Message();
    EXPECT_EQ(step.Meaning == FieldMeaning::Acceleration, std::string(name) == "Wind");
    EXPECT_EQ(step.Dimensions, (std::array<int, 3>{ 5, 3, 4 }));
    EXPECT_EQ(step.Times, std::vector<double>{ 0.5 });
    const Vec3 x(-0.4, 0.3, 0.9);
    EXPECT_LT((step.Sample(x, 0.0) - Vec3(-0.4, 0.6, 2.7)).norm(), 1e-6);
  }
}

TEST(VectorVolume, TakesTheNamesOfOtherPrograms)
{
  const test::TemporaryFolder folder;
  for (const char* name : { "vel", "velocity", "VELOCITY", "U", "v" })
  {
    FieldSeries step;
    EXPECT_TRUE(ReadVectorVolume(WriteVolume(folder, name, 0.0), "", 0.0, step)) << name;
    EXPECT_EQ(step.Meaning, FieldMeaning::Velocity);
  }
  FieldSeries step;
  const std::string path = WriteVolume(folder, "Pressure", 0.0);
  EXPECT_TRUE(ReadVectorVolume(path, "Pressure", 0.0, step));
  EXPECT_EQ(step.Meaning, FieldMeaning::Velocity);
}

TEST(VectorVolume, TakesThreeGridsOfNumbers)
{
  const test::TemporaryFolder folder;
  openvdb::initialize();
  openvdb::GridPtrVec grids;
  const char* names[] = { "vel.x", "vel.y", "vel.z" };
  for (int part = 0; part < 3; ++part)
  {
    auto grid = openvdb::FloatGrid::create();
    grid->setName(names[part]);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    // Each has other voxels: the box is that of all.
    grid->getAccessor().setValue(openvdb::Coord(part, 0, 0), float(part + 1));
    grid->getAccessor().setValue(openvdb::Coord(1, 1, 1), float(10 * (part + 1)));
    grids.push_back(grid);
  }
  const std::string path = folder.File("parts.vdb");
  openvdb::io::File file(path);
  file.write(grids);
  file.close();
  FieldSeries step;
  const Result result = ReadVectorVolume(path, "", 0.0, step);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_EQ(step.Dimensions, (std::array<int, 3>{ 3, 2, 2 }));
  EXPECT_EQ(step.Meaning, FieldMeaning::Velocity);
  EXPECT_LT((step.Sample(Vec3(0.5, 0.5, 0.5), 0.0) - Vec3(10.0, 20.0, 30.0)).norm(), 1e-5);
  EXPECT_LT((step.Sample(Vec3(0.0, 0.0, 0.0), 0.0) - Vec3(1.0, 0.0, 0.0)).norm(), 1e-5);
  EXPECT_LT((step.Sample(Vec3(1.0, 0.0, 0.0), 0.0) - Vec3(0.0, 0.0, 3.0)).norm(), 1e-5);
}

TEST(VectorVolume, SaysWhatIsWrong)
{
  const test::TemporaryFolder folder;
  FieldSeries step;
  step.Times = { 7.0 };
  const std::string other = WriteVolume(folder, "Pressure", 0.0);
  EXPECT_NE(ReadVectorVolume(other, "", 0.0, step).Message().find("`Pressure` (3)"),
            std::string::npos);
  EXPECT_NE(ReadVectorVolume(other, "vel", 0.0, step).Message().find("expected vectors `vel`"),
            std::string::npos);
  const std::string turned = WriteVolume(folder, "Wind", 0.3);
  EXPECT_NE(ReadVectorVolume(turned, "", 0.0, step).Message().find("scales and shifts"),
            std::string::npos);
  EXPECT_FALSE(ReadVectorVolume(folder.Write("text.vdb", "no volume"), "", 0.0, step));
  EXPECT_FALSE(ReadVectorVolume("/nowhere.vdb", "", 0.0, step));
  std::fstream newer(turned, std::ios::binary | std::ios::in | std::ios::out);
  newer.seekp(8).write("\xff\xff\xff\xff", 4);
  newer.close();
  testing::internal::CaptureStderr();
  EXPECT_NE(ReadVectorVolume(turned, "", 0.0, step).Message().find("version 4294967295"),
            std::string::npos);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(step.Times, std::vector<double>{ 7.0 }) << "left as it was";
}
