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

// One file, in a volume that is all within its box.
Result Read(const std::string& path, const std::string& array, FieldSeries& wind)
{
  Timeline line;
  line.FramesPerSecond = 2.0;
  const Vec3 middle(0.0, 0.25, 0.75);
  return ReadVectorVolumes({ { 1, path } }, array, line, Box{ middle, middle }, wind);
}

} // namespace

TEST(VectorVolume, GivesTheLatticeAndTheValues)
{
  const test::TemporaryFolder folder;
  for (const char* name : { "Wind", "Velocity" })
  {
    const std::string path = WriteVolume(folder, name, 0.0);
    FieldSeries step;
    const Result result = Read(path, "", step);
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
    EXPECT_TRUE(Read(WriteVolume(folder, name, 0.0), "", step)) << name;
    EXPECT_EQ(step.Meaning, FieldMeaning::Velocity);
  }
  FieldSeries step;
  const std::string path = WriteVolume(folder, "Pressure", 0.0);
  EXPECT_TRUE(Read(path, "Pressure", step));
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
  const Result result = Read(path, "", step);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_EQ(step.Dimensions, (std::array<int, 3>{ 3, 2, 2 }));
  EXPECT_EQ(step.Meaning, FieldMeaning::Velocity);
  EXPECT_LT((step.Sample(Vec3(0.5, 0.5, 0.5), 0.0) - Vec3(10.0, 20.0, 30.0)).norm(), 1e-5);
  EXPECT_LT((step.Sample(Vec3(0.0, 0.0, 0.0), 0.0) - Vec3(1.0, 0.0, 0.0)).norm(), 1e-5);
  EXPECT_LT((step.Sample(Vec3(1.0, 0.0, 0.0), 0.0) - Vec3(0.0, 0.0, 3.0)).norm(), 1e-5);
}

namespace
{

constexpr int Side = 6; // voxels of 0.4 m, from (-1, -1, 0) to (1, 1, 2)

std::string WriteBox(const test::TemporaryFolder& folder, const std::string& name,
                     const openvdb::CoordBBox& box, const openvdb::Vec3s& wind,
                     const openvdb::Vec3s& background = openvdb::Vec3s(0.0f), int shift = 0)
{
  openvdb::initialize();
  auto grid = openvdb::Vec3SGrid::create(background);
  auto transform = openvdb::math::Transform::createLinearTransform(0.4);
  transform->postTranslate(openvdb::Vec3d(-1.0 + 0.4 * shift, -1.0, 0.0));
  grid->setTransform(transform);
  grid->setName("velocity");
  if (!box.empty())
  {
    const openvdb::Coord moved(-shift, 0, 0);
    grid->fill(openvdb::CoordBBox(box.min() + moved, box.max() + moved), wind);
  }
  const std::string path = folder.File(name);
  openvdb::io::File(path).write({ grid });
  return path;
}

openvdb::CoordBBox Columns(int first, int last)
{
  return { openvdb::Coord(first, 0, 0), openvdb::Coord(last, Side - 1, Side - 1) };
}

double MeanOf(const FieldSeries::Field& values, std::size_t component)
{
  double sum = 0.0;
  for (const std::array<float, 3>& value : values)
  {
    sum += value[component] / static_cast<double>(values.size());
  }
  return sum;
}

} // namespace

TEST(VectorVolume, OfASeriesHasOneLatticeOverAllItsFiles)
{
  const test::TemporaryFolder folder;
  const openvdb::Vec3s x(1.0f, 0.0f, 0.0f);
  auto density = openvdb::FloatGrid::create();
  density->setName("density");
  openvdb::initialize();
  openvdb::io::File(folder.File("none.vdb")).write({ density });
  const std::vector<std::pair<int, std::string>> files = {
    { 0, folder.File("none.vdb") }, // as programs that leave empty grids out
    { 1, WriteBox(folder, "empty.vdb", {}, x) },
    { 2, WriteBox(folder, "left.vdb", Columns(0, 2), x) },
    { 3, WriteBox(folder, "right.vdb", Columns(3, 5), x, openvdb::Vec3s(0.0f), 3) },
    { 4, WriteBox(folder, "all.vdb", Columns(0, 5), x) },
  };
  FieldSeries wind;
  Box volume{ Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0) };
  Result result = ReadVectorVolumes(files, "", Timeline(), volume, wind);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_EQ(wind.Dimensions, (std::array<int, 3>{ Side, Side, Side }));
  EXPECT_LT((wind.Origin - volume.Min).norm(), 1e-9);
  const double means[] = { 0.0, 0.0, 0.5, 0.5, 1.0 };
  for (std::size_t step = 0; step < files.size(); ++step)
  {
    EXPECT_NEAR(MeanOf(wind.Values[step], 0), means[step], 1e-6) << step;
  }
  // It ends at its voxels where the volume does not.
  volume.Max.x() = 5.0;
  ASSERT_TRUE(ReadVectorVolumes(files, "", Timeline(), volume, wind));
  EXPECT_EQ(wind.Dimensions, (std::array<int, 3>{ Side + 1, Side, Side }));
  EXPECT_EQ(wind.Sample(Vec3(3.0, 0.0, 1.0), wind.Times.back()), Vec3(0.0, 0.0, 0.0));

  openvdb::io::File(folder.File("other.vdb"))
    .write({ []
             {
               auto grid = openvdb::Vec3SGrid::create();
               grid->setName("vel");
               return grid;
             }() });
  result = ReadVectorVolumes({ files[1], files[2], { 5, folder.File("other.vdb") } }, "",
                             Timeline(), volume, wind);
  EXPECT_NE(result.Message().find("other.vdb: expected the grid `velocity`"), std::string::npos)
    << result.Message();
  result = ReadVectorVolumes({ files[0], files[1] }, "", Timeline(), volume, wind);
  EXPECT_NE(result.Message().find("active voxels, found none in any file"), std::string::npos)
    << result.Message();
}

TEST(VectorVolume, IsItsBackgroundOutsideOfItsVoxels)
{
  const test::TemporaryFolder folder;
  const std::string path =
    WriteBox(folder, "a.vdb", Columns(0, 2), openvdb::Vec3s(1.0f, 0.0f, 0.0f),
             openvdb::Vec3s(0.0f, 1.0f, 0.0f));
  FieldSeries wind;
  const Box volume{ Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0) };
  ASSERT_TRUE(ReadVectorVolumes({ { 0, path } }, "", Timeline(), volume, wind));
  EXPECT_EQ(wind.Dimensions, (std::array<int, 3>{ Side, Side, Side })) << "all over the volume";
  EXPECT_EQ(wind.Sample(Vec3(-0.5, 0.0, 1.0), 0.0), Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(wind.Sample(Vec3(0.8, 0.0, 1.0), 0.0), Vec3(0.0, 1.0, 0.0));
  const Box street{ Vec3(-1e3, -1.0, 0.0), Vec3(1e3, 1.0, 2.0) };
  ASSERT_TRUE(ReadVectorVolumes({ { 0, path } }, "", Timeline(), street, wind));
  EXPECT_EQ(wind.Sample(Vec3(900.0, 0.0, 1.0), 0.0), Vec3(0.0, 1.0, 0.0));
}

TEST(VectorVolume, SaysWhatIsWrong)
{
  const test::TemporaryFolder folder;
  FieldSeries step;
  step.Times = { 7.0 };
  const std::string other = WriteVolume(folder, "Pressure", 0.0);
  EXPECT_NE(Read(other, "", step).Message().find("`Pressure` (3)"), std::string::npos);
  EXPECT_NE(Read(other, "vel", step).Message().find("expected vectors `vel`"), std::string::npos);
  const std::string turned = WriteVolume(folder, "Wind", 0.3);
  EXPECT_NE(Read(turned, "", step).Message().find("scales and shifts"), std::string::npos);
  EXPECT_FALSE(Read(folder.Write("text.vdb", "no volume"), "", step));
  EXPECT_FALSE(Read("/nowhere.vdb", "", step));
  std::fstream newer(turned, std::ios::binary | std::ios::in | std::ios::out);
  newer.seekp(8).write("\xff\xff\xff\xff", 4);
  newer.close();
  testing::internal::CaptureStderr();
  EXPECT_NE(Read(turned, "", step).Message().find("version 4294967295"), std::string::npos);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(step.Times, std::vector<double>{ 7.0 }) << "left as it was";
}
