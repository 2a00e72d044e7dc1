// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Store/StateFile.h"
#include "TracedDatabase.h"
#include "Trajectory/DatabaseFile.h"
#include "Trajectory/SameDatabase.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace waft;

namespace
{

/// Few segments, so that a file of it can be damaged at many places.
MotionDatabase Sparse()
{
  ClusterOptions options;
  options.MaximumSegments = 60;
  MotionDatabase database = test::Build(test::Traced(1, 6), options);
  database.Provenance = { { "seed", "1" }, { "words", "of \"any\"\nkind" }, { "empty", "" } };
  return database;
}

std::string BytesOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// Refused with a sentence that names the file and has the words; nothing is left of it.
void ExpectRefused(const std::string& path, const std::string& words)
{
  MotionDatabase database;
  database.Segments.resize(3);
  const Result result = ReadDatabase(path, database);
  ASSERT_FALSE(result) << path;
  EXPECT_NE(result.Message().find(path), std::string::npos) << result.Message();
  EXPECT_NE(result.Message().find(words), std::string::npos) << result.Message();
  EXPECT_TRUE(database.Segments.empty());
}

} // namespace

TEST(DatabaseFile, KeepsEveryNumber)
{
  const test::TemporaryFolder folder;
  const MotionDatabase database = Sparse();
  ASSERT_TRUE(database.Validate()) << database.Validate().Message();
  const std::string path = folder.File("a.motions");
  const Result written = WriteDatabase(path, database);
  ASSERT_TRUE(written) << written.Message();
  MotionDatabase read;
  read.Vortices.resize(2); // of before
  const Result result = ReadDatabase(path, read);
  ASSERT_TRUE(result) << result.Message();
  test::ExpectSame(database, read);

  ASSERT_TRUE(WriteDatabase(folder.File("b.motions"), read));
  EXPECT_EQ(BytesOf(path), BytesOf(folder.File("b.motions")));
}

TEST(MotionDatabase, OfAnotherScaleIsTheSameInOtherMetres)
{
  const MotionDatabase database = Sparse();
  const MotionDatabase scaled = database.Scaled(5.0);
  ASSERT_TRUE(scaled.Validate());
  EXPECT_EQ(scaled.Volume.Width(), 5.0 * database.Volume.Width());
  EXPECT_EQ(scaled.TopSpeed, 5.0 * database.TopSpeed);
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    const std::vector<Vec3> was = database.Reconstruct(static_cast<int>(s));
    const std::vector<Vec3> is = scaled.Reconstruct(static_cast<int>(s));
    for (std::size_t k = 0; k < was.size(); ++k)
    {
      ASSERT_LT((is[k] - 5.0 * was[k]).norm(), 1e-9);
    }
  }
  for (std::size_t c = 0; c < database.Connections.size(); ++c)
  {
    EXPECT_EQ(scaled.Connections[c].Cost, database.Connections[c].Cost);
    EXPECT_EQ(scaled.Connections[c].Translation, 5.0 * database.Connections[c].Translation);
  }
  for (std::size_t v = 0; v < database.Vortices.size(); ++v)
  {
    const Vec3 x(0.2, -0.1, 0.4);
    const Vec3 was = database.Vortices[v].SpatialAcceleration(x);
    EXPECT_LT((scaled.Vortices[v].SpatialAcceleration(5.0 * x) - 5.0 * was).norm(),
              1e-9 * (1.0 + was.norm()));
  }
}

TEST(DatabaseFile, IsRefusedWhereItIsDamaged)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("a.motions");
  ASSERT_TRUE(WriteDatabase(path, Sparse()));
  const std::string whole = BytesOf(path);
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 97)
  {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
    ExpectRefused(folder.Write("damaged", bytes), "damaged");
    ExpectRefused(folder.Write("cut", whole.substr(0, at)), "expected a motion database");
  }
  ExpectRefused(folder.Write("longer", whole + "x"), "damaged");
  ExpectRefused(folder.File("none"), "no file");
  ExpectRefused(folder.Path().string(), "no file");
  EXPECT_FALSE(WriteDatabase(folder.File("none/a.motions"), Sparse()));
}

TEST(DatabaseFile, IsRefusedWhereItsNumbersDoNotFit)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("a.motions");
  {
    StateFileWriter file(path, { "motion database", 1 });
    ASSERT_TRUE(file.Commit());
  }
  ExpectRefused(path, "version");
  {
    StateFileWriter file(path, { "motion database", 2 }); // and an enormous number of groups
    const std::vector<double> numbers(40, 1e300);
    file.Raw(numbers.data(), numbers.size() * sizeof(double));
    ASSERT_TRUE(file.Commit());
  }
  ExpectRefused(path, "incomplete");

  MotionDatabase database = Sparse();
  database.Segments[5].Coefficients.conservativeResize(2);
  ASSERT_TRUE(WriteDatabase(path, database));
  ExpectRefused(path, "segment 5: coefficients do not match");
  database = Sparse();
  database.Groups[0].Basis.resize(0, 0);
  ASSERT_TRUE(WriteDatabase(path, database));
  ExpectRefused(path, "group 0");
  database = Sparse();
  database.Segments[0].ForceTypes[0] = static_cast<ForceType>(7);
  ASSERT_TRUE(WriteDatabase(path, database));
  ExpectRefused(path, "incomplete");
}
