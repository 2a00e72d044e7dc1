// SPDX-License-Identifier: BSD-3-Clause
// The motion database goes to VTK, to files and back without a bit changed.
#include "Base/Random.h"
#include "Base/TemporaryFolder.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Trajectory/SameDatabase.h"
#include "Trajectory/Style.h"
#include "Trajectory/TrajectoryClusters.h"

#include <vtkCellData.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace waft;

namespace
{

MotionDatabase Small()
{
  Random random(9);
  Vortex vortex;
  vortex.VortexId = 3;
  vortex.Strength = 2.0;
  TracedSimulation simulation;
  simulation.Vortices = { vortex };
  for (int t = 0; t < 12; ++t)
  {
    Track track;
    track.ObjectId = t;
    Vec3 x = random.Direction();
    double heading = random.Uniform(0.0, 6.0);
    double turn = 0.0;
    for (int i = 0; i < 90; ++i)
    {
      track.Positions.push_back(x);
      track.ForceTypes.push_back(i < 40 ? ForceType::Vortex : ForceType::Wind);
      track.VortexIds.push_back(i < 40 ? 3 : -1);
      track.WindAccelerations.push_back(random.Direction());
      turn += 0.02 * random.Normal() - 0.1 * turn;
      heading += turn;
      x += 0.02 * Vec3(std::cos(heading), std::sin(heading), 0.5 * std::sin(0.1 * i + t));
    }
    simulation.Tracks.push_back(std::move(track));
  }
  ClusterInput input;
  input.Simulations = { simulation };
  input.SettlingSpeed = 0.1;
  MotionDatabase database;
  SilentMonitor monitor;
  const Result result =
    ClusterTrajectories(input, ClusterOptions(), SerialFor(), monitor, database);
  EXPECT_TRUE(result) << result.Message();
  database.Provenance = { { "Seed", "1" }, { "Bounds", "-2 2 -2 2 0 4" } };
  return database;
}

} // namespace

TEST(DatabaseConversion, ComesBackBitForBit)
{
  const MotionDatabase database = Small();
  EXPECT_GT(database.Segments.size(), 20u);
  EXPECT_FALSE(database.Vortices.empty());
  vtkNew<vtkMultiBlockDataSet> data;
  DatabaseToMultiBlock(database, data);
  MotionDatabase back;
  const Result result = DatabaseFromMultiBlock(data, back);
  ASSERT_TRUE(result) << result.Message();
  test::ExpectSame(database, back);
}

TEST(DatabaseConversion, ComesBackBitForBitThroughFiles)
{
  MotionDatabase database = Small();
  for (const bool hasVortices : { true, false })
  {
    if (!hasVortices)
    {
      database.Vortices.clear();
      for (Segment& segment : database.Segments)
      {
        std::fill(segment.VortexIds.begin(), segment.VortexIds.end(), -1);
      }
    }
    vtkNew<vtkMultiBlockDataSet> data;
    DatabaseToMultiBlock(database, data);
    const test::TemporaryFolder folder;
    const std::string file = folder.File("small.vtm");
    vtkNew<vtkXMLMultiBlockDataWriter> writer;
    writer->SetInputDataObject(data);
    writer->SetFileName(file.c_str());
    writer->SetDataModeToBinary(); // which any Expat reads
    ASSERT_EQ(writer->Write(), 1);
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    auto* read = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0));
    ASSERT_TRUE(read);
    MotionDatabase back;
    const Result result = DatabaseFromMultiBlock(read, back);
    ASSERT_TRUE(result) << result.Message();
    test::ExpectSame(database, back);
  }
}

TEST(DatabaseConversion, LeavesAreSurfacesAndTables)
{
  vtkNew<vtkMultiBlockDataSet> data;
  DatabaseToMultiBlock(Small(), data);
  ASSERT_EQ(data->GetNumberOfBlocks(), 6u);
  for (unsigned int b = 0; b < 6; ++b)
  {
    vtkDataObject* block = data->GetBlock(b);
    EXPECT_TRUE(vtkPolyData::SafeDownCast(block) || vtkTable::SafeDownCast(block));
    EXPECT_TRUE(block->GetFieldData()->HasArray("Seed"));
  }
}

TEST(DatabaseConversion, NamesWhatIsWrong)
{
  const MotionDatabase database = Small();
  MotionDatabase back;
  vtkNew<vtkMultiBlockDataSet> empty;
  EXPECT_NE(DatabaseFromMultiBlock(empty, back).Message().find("`Segments`"), std::string::npos);

  vtkNew<vtkMultiBlockDataSet> data;
  DatabaseToMultiBlock(database, data);
  vtkTable::SafeDownCast(data->GetBlock(2))->RemoveColumnByName("Medoid");
  const Result missing = DatabaseFromMultiBlock(data, back);
  EXPECT_NE(missing.Message().find("Nodes"), std::string::npos) << missing.Message();
  EXPECT_NE(missing.Message().find("Medoid"), std::string::npos) << missing.Message();

  DatabaseToMultiBlock(database, data);
  vtkPolyData::SafeDownCast(data->GetBlock(0))
    ->GetCellData()
    ->GetArray("Coefficients")
    ->SetComponent(2, 0, std::nan(""));
  const Result wrong = DatabaseFromMultiBlock(data, back);
  EXPECT_NE(wrong.Message().find("segment 2"), std::string::npos) << wrong.Message();
  EXPECT_TRUE(back.Segments.empty());
}

TEST(EmbeddedDatabase, IsWholeAndFliesAsItShould)
{
  const std::filesystem::path folder = std::filesystem::path(WAFT_SOURCE_DIR) / "Data" / "Database";
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((folder / "embedded.vtm").string().c_str());
  reader->Update();
  auto* read = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  ASSERT_TRUE(read);
  MotionDatabase database;
  const Result result = DatabaseFromMultiBlock(read, database);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_GE(database.Segments.size(), 3000u);
  EXPECT_LE(database.Segments.size(), 8000u);
  EXPECT_GE(database.TopNodes.size(), 60u);
  EXPECT_LE(database.TopNodes.size(), 150u);
  EXPECT_GE(std::stoi(database.Provenance.at("NumberOfSimulations")), 8);

  const StyleSamples style = StyleOf(database);
  EXPECT_GE(Quantile(style.Speed, 0.5), 0.4);
  EXPECT_LE(Quantile(style.Speed, 0.5), 0.7);
  EXPECT_GE(Quantile(style.Speed, 0.95), 1.3);

  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    bytes += entry.is_regular_file() ? entry.file_size() : 0;
  }
  EXPECT_LE(bytes, 8u * 1024 * 1024);

  // Nearly every representative can be followed and can follow.
  const std::size_t count = database.TopNodes.size();
  int isolated = 0;
  for (std::size_t a = 0; a < count; ++a)
  {
    int after = 0;
    int before = 0;
    for (std::size_t b = 0; b < count; ++b)
    {
      after += database.At(a, b).IsConnectible;
      before += database.At(b, a).IsConnectible;
    }
    isolated += after == 0 || before == 0;
  }
  EXPECT_LE(isolated, 4);
}
