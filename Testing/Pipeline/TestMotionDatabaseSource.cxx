// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/TemporaryFolder.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Database/DatabaseBuild.h"

#include <vtkMotionDatabaseSource.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <unistd.h>

using namespace waft;

namespace
{

void MakeSmall(vtkMotionDatabaseSource* source)
{
  source->SetNumberOfSimulations(2);
  source->SetNumberOfFrames(45);
  source->SetResolution(16);
  source->SetWarmUpSeconds(1.0);
  source->SetSeedStride(2);
}

} // namespace

TEST(MotionDatabaseSource, GivesTheDatabaseOfCore)
{
  vtkNew<vtkMotionDatabaseSource> source;
  MakeSmall(source);
  source->SetSeed(3);
  source->WorkInSlices(); // as a window wants it
  source->Update();
  EXPECT_EQ(source->GetComplete(), 0);
  EXPECT_EQ(source->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_NE(source->GetWorkText(), "");
  for (int k = 0; k < 10000 && source->GetComplete() == 0; ++k)
  {
    source->GoOn();
    source->Update();
  }
  MotionDatabase database;
  const Result result = DatabaseFromMultiBlock(source->GetOutput(), database);
  ASSERT_TRUE(result) << result.Message();

  DatabaseOptions options;
  options.NumberOfSimulations = 2;
  options.NumberOfFrames = 45;
  options.Resolution = 16;
  options.WarmUpSeconds = 1.0;
  options.Trace.SeedStride = 2;
  options.Seed = 3;
  MotionDatabase direct;
  std::vector<CoveragePoint> coverage;
  SilentMonitor monitor;
  ASSERT_TRUE(BuildDatabase(options, SerialFor(), monitor, direct, coverage));
  EXPECT_EQ(database.Provenance, direct.Provenance);
  ASSERT_EQ(database.Segments.size(), direct.Segments.size());
  for (std::size_t s = 0; s < direct.Segments.size(); ++s)
  {
    ASSERT_EQ(database.Segments[s].Coefficients, direct.Segments[s].Coefficients);
  }
  auto* table = vtkTable::SafeDownCast(source->GetOutputDataObject(1));
  ASSERT_EQ(table->GetNumberOfRows(), 1);
  EXPECT_EQ(table->GetValueByName(0, "Simulations").ToInt(), 1);
  EXPECT_EQ(table->GetValueByName(0, "NewSegments").ToInt(), coverage[0].NewSegments);
  EXPECT_EQ(table->GetValueByName(0, "NewShare").ToDouble(), coverage[0].NewShare);
  EXPECT_GT(coverage[0].NewShare, 0.0);
}

TEST(MotionDatabaseSource, AbortedItGivesNothing)
{
  vtkNew<vtkMotionDatabaseSource> source;
  MakeSmall(source);
  const AbortBeyond stop(source, 0.05);
  source->Update();
  EXPECT_EQ(source->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(MotionDatabaseSource, AbortedLaterItGivesTheSimulationsThatAreWholeAndGoesOn)
{
  const test::TemporaryFolder folder;
  vtkNew<vtkMotionDatabaseSource> source;
  MakeSmall(source);
  source->SetNumberOfSimulations(64); // more than run at once
  source->SetNumberOfFrames(30);
  source->SetWarmUpSeconds(0.5);
  source->SetKeptIn(folder.File("kept"));
  {
    const AbortBeyond stop(source, 0.3);
    source->Update();
  }
  MotionDatabase database;
  Result result = DatabaseFromMultiBlock(source->GetOutput(), database);
  ASSERT_TRUE(result) << result.Message();
  const int whole = std::stoi(database.Provenance.at("NumberOfSimulations"));
  EXPECT_GE(whole, 1);
  EXPECT_LT(whole, 64);
  EXPECT_EQ(vtkTable::SafeDownCast(source->GetOutputDataObject(1))->GetNumberOfRows(), whole - 1);

  source->SetNumberOfSimulations(whole + 1);
  source->Update();
  result = DatabaseFromMultiBlock(source->GetOutput(), database);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_EQ(std::stoi(database.Provenance.at("NumberOfSimulations")), whole + 1);
}

TEST(MotionDatabaseSource, EndsAtItsTimeLimit)
{
  vtkNew<vtkMotionDatabaseSource> source;
  MakeSmall(source);
  source->SetNumberOfSimulations(100000);
  source->SetTimeLimit(3.0);
  source->Update();
  MotionDatabase database;
  const Result result = DatabaseFromMultiBlock(source->GetOutput(), database);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_LT(std::stoi(database.Provenance.at("NumberOfSimulations")), 1000);
}

TEST(MotionDatabaseSource, NamesTheParameterThatIsWrong)
{
  vtkNew<vtkMotionDatabaseSource> source;
  MakeSmall(source);
  source->SetBounds(-2.0, 2.0, -2.0, 2.0, 0.0, 3.9);
  ErrorLog errors(source);
  source->Update();
  EXPECT_TRUE(errors.Contains("Bounds")) << errors.Text;
  EXPECT_EQ(source->GetOutput()->GetNumberOfBlocks(), 0u);
}
