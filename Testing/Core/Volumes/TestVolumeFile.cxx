// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Base/TemporaryFolder.h"
#include "Volumes/VolumeFile.h"

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

using namespace waft;

namespace
{

// Random values, some of them zero.
VolumeField RandomField(const std::string& name, int components, std::size_t points)
{
  Random random(points, static_cast<std::uint64_t>(components));
  VolumeField field;
  field.Name = name;
  field.Components = components;
  for (std::size_t i = 0; i < points * components; ++i)
  {
    field.Values.push_back(random.Uniform() < 0.3 ? 0.0f
                                                  : static_cast<float>(random.Uniform(-5.0, 5.0)));
  }
  return field;
}

Volume Smoke()
{
  Volume volume;
  volume.Dimensions = { 9, 7, 11 };
  volume.Origin = Vec3(-1.9, 0.3, 0.05);
  volume.Spacing = Vec3(0.1, 0.2, 0.15);
  volume.Fields.push_back(RandomField("Velocity", 3, volume.NumberOfPoints()));
  volume.Fields.push_back(RandomField("Density", 1, volume.NumberOfPoints()));
  return volume;
}

} // namespace

TEST(VolumeFile, GivesBackWhatWasWritten)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.File("smoke.vdb");
  const Volume volume = Smoke();
  SceneInfo scene;
  scene.Bounds = Box{ Vec3(-3, -2, 0.1), Vec3(1, 2, 5) };
  scene.Time = Timeline{ 77, 24.5 };
  scene.AirDensity = 1.1;
  scene.Seed = 123456789012345ull;
  Result result = WriteVolume(file, volume, scene);
  ASSERT_TRUE(result) << result.Message();

  VolumeContents contents;
  result = ListVolume(file, contents);
  ASSERT_TRUE(result) << result.Message();
  ASSERT_EQ(contents.Grids.size(), 2u);
  EXPECT_EQ(contents.Grids[0].Name, "Density");
  EXPECT_EQ(contents.Grids[0].Components, 1);
  const VolumeGrid& velocity = contents.Grids[1];
  EXPECT_EQ(velocity.Name, "Velocity");
  EXPECT_EQ(velocity.Components, 3);
  EXPECT_TRUE(velocity.IsUpright);
  EXPECT_EQ(velocity.Zero, volume.Origin);
  EXPECT_LT((velocity.Spacing - volume.Spacing).norm(), 1e-15);
  EXPECT_EQ(velocity.Active.Dimensions(), volume.Dimensions); // zeros are active, too
  for (const VolumeField& field : volume.Fields)
  {
    VolumeField read;
    result = ReadVolumeGrid(file, field.Name, velocity.Active, read);
    ASSERT_TRUE(result) << result.Message();
    EXPECT_EQ(read.Components, field.Components);
    EXPECT_EQ(read.Values, field.Values);
  }
  ASSERT_TRUE(contents.HasScene);
  EXPECT_EQ(contents.Scene.Bounds.Min, scene.Bounds.Min);
  EXPECT_EQ(contents.Scene.Bounds.Max, scene.Bounds.Max);
  EXPECT_EQ(contents.Scene.Time.NumberOfFrames, 77);
  EXPECT_EQ(contents.Scene.Time.FramesPerSecond, 24.5);
  EXPECT_EQ(contents.Scene.AirDensity, 1.1);
  EXPECT_EQ(contents.Scene.Seed, scene.Seed);
}

TEST(VolumeFile, AirWithoutSmokeTakesNoVoxels)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.File("sparse.vdb");
  Volume volume;
  volume.Dimensions = { 20, 20, 20 };
  VolumeField density;
  density.Name = "Density";
  density.Values.assign(8000, 0.0f);
  volume.Fields = { density };
  ASSERT_TRUE(WriteVolume(file, volume, SceneInfo()));
  VolumeContents contents;
  ASSERT_TRUE(ListVolume(file, contents));
  EXPECT_TRUE(contents.Grids[0].Active.IsEmpty());

  volume.Fields[0].Values[3 + 20 * (4 + 20 * 5)] = 1.0f;
  volume.Fields[0].Values[6 + 20 * (4 + 20 * 9)] = 2.0f;
  ASSERT_TRUE(WriteVolume(file, volume, SceneInfo()));
  ASSERT_TRUE(ListVolume(file, contents));
  const VoxelBox& box = contents.Grids[0].Active;
  EXPECT_EQ(box.First, (std::array<int, 3>{ 3, 4, 5 }));
  EXPECT_EQ(box.Last, (std::array<int, 3>{ 6, 4, 9 }));
  VolumeField read;
  ASSERT_TRUE(ReadVolumeGrid(file, "Density", box, read));
  EXPECT_EQ(read.Values.size(), 20u);
  EXPECT_EQ(read.Values.front(), 1.0f);
  EXPECT_EQ(read.Values.back(), 2.0f);
}

TEST(VolumeFile, TakesStaggeredVelocitiesToTheCentres)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.File("staggered.vdb");
  openvdb::initialize();
  auto grid = openvdb::Vec3DGrid::create();
  grid->setName("vel");
  grid->setGridClass(openvdb::GRID_STAGGERED);
  auto accessor = grid->getAccessor();
  for (int k = 0; k <= 4; ++k)
  {
    for (int j = 0; j <= 4; ++j)
    {
      for (int i = 0; i <= 4; ++i)
      {
        accessor.setValue(openvdb::Coord(i, j, k), openvdb::Vec3d(i * i, 2.0 * j, k + 10.0));
      }
    }
  }
  openvdb::io::File out(file);
  out.write({ grid });
  out.close();
  VolumeField read;
  ASSERT_TRUE(ReadVolumeGrid(file, "vel", { { 2, 1, 3 }, { 3, 1, 3 } }, read));
  EXPECT_EQ(read.Values, (std::vector<float>{ 6.5f, 3.0f, 13.5f, 12.5f, 3.0f, 13.5f }));
  VolumeContents contents;
  ASSERT_TRUE(ListVolume(file, contents));
  EXPECT_FALSE(contents.HasScene);
}

TEST(VolumeFile, SaysWhatIsWrong)
{
  VolumeContents contents;
  EXPECT_NE(ListVolume("/nowhere.vdb", contents).Message().find("OpenVDB"), std::string::npos);
  VolumeField field;
  const test::TemporaryFolder folder;
  const std::string file = folder.File("wrong.vdb");
  ASSERT_TRUE(WriteVolume(file, Smoke(), SceneInfo()));
  EXPECT_FALSE(ReadVolumeGrid(file, "Heat", { { 0, 0, 0 }, { 1, 1, 1 } }, field));
  const VoxelBox huge{ { 0, 0, 0 }, { 600, 600, 600 } };
  EXPECT_NE(ReadVolumeGrid(file, "Density", huge, field).Message().find("512^3"),
            std::string::npos);
  Volume volume = Smoke();
  volume.Fields[1].Values.pop_back();
  EXPECT_NE(WriteVolume(file, volume, SceneInfo()).Message().find("Density"), std::string::npos);
  // What cannot be written leaves nothing behind.
  const std::string inAFile = file + "/smoke.vdb";
  EXPECT_NE(WriteVolume(inAFile, Smoke(), SceneInfo()).Message().find(inAFile), std::string::npos);
  ASSERT_TRUE(ListVolume(file, contents));
  EXPECT_EQ(contents.Grids.size(), 2u);
}
