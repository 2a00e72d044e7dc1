// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Volumes/VolumeSequence.h"

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <fstream>

using namespace waft;

namespace
{

// One active voxel of a value.
template <class Grid>
openvdb::GridBase::Ptr Voxel(const std::string& name, const openvdb::Coord& at,
                             const typename Grid::ValueType& value, double size = 0.5)
{
  auto grid = Grid::create();
  grid->setName(name);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(size));
  grid->getAccessor().setValue(at, value);
  return grid;
}

void Write(const std::string& path, const openvdb::GridPtrVec& grids)
{
  openvdb::initialize();
  openvdb::io::File file(path);
  file.write(grids);
  file.close();
}

} // namespace

TEST(VolumeSequence, IsOneLatticeOverAllItsFiles)
{
  const test::TemporaryFolder folder;
  Write(folder.File("puff_10.vdb"),
        { Voxel<openvdb::FloatGrid>("density", { 2, 3, 4 }, 1.0f),
          Voxel<openvdb::Vec3SGrid>("vel", { 1, 5, 4 }, { 1.0f, 2.0f, 3.0f }) });
  Write(folder.File("puff_12.vdb"), { Voxel<openvdb::DoubleGrid>("density", { -1, 5, 6 }, 2.0),
                                      Voxel<openvdb::FloatGrid>("fine", { 0, 0, 0 }, 1.0f, 0.25),
                                      Voxel<openvdb::Int64Grid>("ids", { 0, 0, 0 }, 7) });
  VolumeSequence sequence;
  Result result = sequence.Open(folder.File("puff_12.vdb"), 0.0);
  ASSERT_TRUE(result) << result.Message();
  ASSERT_EQ(sequence.NumberOfSteps(), 2u);
  EXPECT_EQ(sequence.Time(0), 10.0 / 30.0);
  EXPECT_EQ(sequence.Scene().Time.NumberOfFrames, 13);
  EXPECT_EQ(sequence.Lattice().Dimensions, (std::array<int, 3>{ 4, 3, 3 }));
  EXPECT_EQ(sequence.Lattice().Origin, Vec3(-0.5, 1.5, 2.0));
  EXPECT_EQ(sequence.Scene().Bounds.Min, Vec3(-0.75, 1.25, 1.75));
  EXPECT_EQ(sequence.Scene().Bounds.Max, Vec3(1.25, 2.75, 3.25));
  ASSERT_EQ(sequence.LeftOut().size(), 2u); // another lattice, another kind
  EXPECT_NE(sequence.LeftOut()[0].find("puff_12.vdb: grid `fine`"), std::string::npos);

  Volume volume;
  ASSERT_TRUE(sequence.Read(0, volume));
  ASSERT_EQ(volume.Fields.size(), 2u);
  EXPECT_EQ(volume.Fields[0].Name, "Density");
  EXPECT_EQ(volume.Fields[0].Values[3], 1.0f);
  EXPECT_EQ(volume.Fields[1].Name, "Velocity");
  EXPECT_EQ(volume.Fields[1].Values[3 * (2 + 4 * 2) + 1], 2.0f);
  ASSERT_TRUE(sequence.Read(1, volume));
  ASSERT_EQ(volume.Fields.size(), 2u) << "the same at each step";
  EXPECT_EQ(volume.Fields[0].Values[4 * (2 + 3 * 2)], 2.0f);
  EXPECT_EQ(volume.Fields[1].Name, "Velocity");
  EXPECT_EQ(volume.Fields[1].Components, 3);
  EXPECT_EQ(volume.Fields[1].Values, std::vector<float>(3 * 4 * 3 * 3, 0.0f));

  ASSERT_TRUE(sequence.Open(folder.File("puff_10.vdb"), 24.0));
  EXPECT_EQ(sequence.Time(1), 0.5);
}

TEST(VolumeSequence, BeginsBeforeThereIsAnything)
{
  const test::TemporaryFolder folder;
  Write(folder.File("air_0.vdb"),
        { Voxel<openvdb::FloatGrid>("density", { 1, 1, 1 }, 1.0f, 0.25) });
  const auto empty = openvdb::Vec3SGrid::create(openvdb::Vec3s(0.0f, 1.0f, 0.0f));
  empty->setName("velocity");
  Write(folder.File("air_1.vdb"), { empty });
  // The same voxels, counted from elsewhere.
  const auto moved = Voxel<openvdb::Vec3SGrid>("velocity", { 0, 0, 0 }, { 1.0f, 0.0f, 0.0f });
  moved->transform().postTranslate(openvdb::Vec3d(1.0, 0.0, 0.0));
  Write(folder.File("air_2.vdb"),
        { Voxel<openvdb::Vec3SGrid>("velocity", { 0, 0, 0 }, { 2.0f, 0.0f, 0.0f }) });
  Write(folder.File("air_3.vdb"), { moved });
  VolumeSequence sequence;
  const Result result = sequence.Open(folder.File("air_0.vdb"), 0.0);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_EQ(sequence.Lattice().Dimensions, (std::array<int, 3>{ 3, 1, 1 }));
  const std::vector<std::vector<float>> wanted = { std::vector<float>(9, 0.0f),
                                                   { 0, 1, 0, 0, 1, 0, 0, 1, 0 },
                                                   { 2, 0, 0, 0, 0, 0, 0, 0, 0 },
                                                   { 0, 0, 0, 0, 0, 0, 1, 0, 0 } };
  for (std::size_t step = 0; step < wanted.size(); ++step)
  {
    Volume volume;
    ASSERT_TRUE(sequence.Read(step, volume));
    ASSERT_EQ(volume.Fields.size(), 1u);
    EXPECT_EQ(volume.Fields[0].Values, wanted[step]) << step;
  }
  EXPECT_EQ(sequence.LeftOut().size(), 1u) << "density, of other voxels";
}

TEST(VolumeSequence, NamesThatAreTakenStayAsTheyAre)
{
  const test::TemporaryFolder folder;
  Write(folder.File("air.vdb"),
        { Voxel<openvdb::Vec3SGrid>("v", { 0, 0, 0 }, { 1.0f, 0.0f, 0.0f }),
          Voxel<openvdb::Vec3SGrid>("Velocity", { 0, 0, 0 }, { 2.0f, 0.0f, 0.0f }) });
  VolumeSequence sequence;
  ASSERT_TRUE(sequence.Open(folder.File("air.vdb"), 0.0));
  Volume volume;
  ASSERT_TRUE(sequence.Read(0, volume));
  EXPECT_EQ(volume.Fields[0].Name, "Velocity");
  EXPECT_EQ(volume.Fields[0].Values[0], 2.0f);
  EXPECT_EQ(volume.Fields[1].Name, "v");
}

TEST(VolumeSequence, SaysWhatIsWrong)
{
  const test::TemporaryFolder folder;
  VolumeSequence sequence;
  const auto message = [&](const std::string& name)
  {
    const Result result = sequence.Open(folder.File(name), 0.0);
    EXPECT_FALSE(result);
    EXPECT_EQ(sequence.NumberOfSteps(), 0u);
    return result.Message();
  };
  EXPECT_NE(message("none_1.vdb").find("none_1.vdb"), std::string::npos);
  std::ofstream(folder.File("text_1.vdb")) << "no volume";
  EXPECT_NE(message("text_1.vdb").find("OpenVDB"), std::string::npos);
  Write(folder.File("empty.vdb"), { openvdb::FloatGrid::create() });
  EXPECT_NE(message("empty.vdb").find("active voxels"), std::string::npos);
  const auto turned = Voxel<openvdb::FloatGrid>("density", { 1, 1, 1 }, 1.0f);
  turned->transform().preRotate(0.4);
  Write(folder.File("turned.vdb"), { turned });
  EXPECT_NE(message("turned.vdb").find("grid `density`"), std::string::npos);
  Write(folder.File("far.vdb"), { Voxel<openvdb::FloatGrid>("density", { 1, 1, 1 }, 1.0f),
                                  Voxel<openvdb::FloatGrid>("smoke", { 9000, 9000, 9000 }, 1.0f) });
  EXPECT_NE(message("far.vdb").find("512^3"), std::string::npos);
  Write(folder.File("twice_1.vdb"), { Voxel<openvdb::FloatGrid>("density", { 1, 1, 1 }, 1.0f) });
  Write(folder.File("twice_01.vdb"), { Voxel<openvdb::FloatGrid>("density", { 1, 1, 1 }, 1.0f) });
  EXPECT_NE(message("twice_1.vdb").find("one file a frame"), std::string::npos);
}
