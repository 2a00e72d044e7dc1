// SPDX-License-Identifier: BSD-3-Clause
// The table of stages: what each quality runs, and who gives what to whom.
#include "Chain/ChainOptions.h"
#include "Chain/ChainTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

using namespace waft;

namespace
{

const ChainInput& InputOf(ChainStage stage, const char* name)
{
  const std::vector<ChainInput>& inputs = TraitsOf(stage).Inputs;
  return *std::find_if(inputs.begin(), inputs.end(),
                       [name](const ChainInput& input)
                       { return std::strcmp(input.Name, name) == 0; });
}

/// "Stage.Output" of each giver.
std::set<std::string> Givers(ChainStage stage, const char* input, Quality quality)
{
  std::set<std::string> names;
  for (const ChainOutput& giver : GiversOf(InputOf(stage, input), quality))
  {
    names.insert(std::string(TraitsOf(giver.Stage).Name) + "." + giver.Name);
  }
  return names;
}

} // namespace

TEST(ChainTable, HasEachStageAtItsPlace)
{
  for (const ChainStageTraits& stage : ChainStages())
  {
    EXPECT_EQ(&TraitsOf(stage.Stage), &stage) << stage.Name;
    EXPECT_FALSE(stage.RunsAt.empty()) << stage.Name;
    EXPECT_FALSE(stage.Options.empty()) << stage.Name;
  }
}

// What an input takes is what its givers give; one that is needed has one in each quality, but a
// motion database, which comes with Waft.
TEST(ChainTable, PortsFitOneAnother)
{
  for (const ChainStageTraits& stage : ChainStages())
  {
    for (const ChainInput& input : stage.Inputs)
    {
      for (const std::vector<ChainOutput>& givers : input.Givers)
      {
        for (const ChainOutput& giver : givers)
        {
          const PortData given =
            TraitsOf(giver.Stage).Outputs[static_cast<std::size_t>(PortOf(giver))].Gives;
          EXPECT_STREQ(DataTypeOf(given), DataTypeOf(input.Takes))
            << stage.Name << " " << input.Name;
        }
      }
      for (const Quality quality : stage.RunsAt)
      {
        EXPECT_TRUE(input.Connections != PortNumber::One || !GiversOf(input, quality).empty())
          << stage.Name << " " << input.Name << " " << ToString(quality);
      }
    }
  }
  for (const MotionPortTraits& port : MotionPorts())
  {
    EXPECT_LT(PortOf(port.Given), static_cast<int>(TraitsOf(port.Given.Stage).Outputs.size()))
      << port.Name;
  }
}

TEST(ChainTable, SaysTheArraysOfEachOutput)
{
  const std::vector<ChainArray> read = ArraysOf(
    { "P", PortData::Merged, "points: Frame int; Value double*4 of the kind; whole: Note text" });
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].Of + read[0].Name + read[0].Type + read[0].Unit, "pointsFrameint");
  EXPECT_EQ(read[0].Components, 1);
  EXPECT_EQ(read[1].Of + read[1].Name + read[1].Type + read[1].Unit,
            "pointsValuedoubleof the kind");
  EXPECT_EQ(read[1].Components, 4);
  EXPECT_EQ(read[2].Of + read[2].Name + read[2].Type, "wholeNotetext");
  const std::set<std::string> kinds = { "points", "cells", "rows", "whole" };
  const std::set<std::string> types = { "byte", "int", "float", "double", "text" };
  for (const ChainStageTraits& stage : ChainStages())
  {
    for (const ChainPort& port : stage.Outputs)
    {
      const std::vector<ChainArray> arrays = ArraysOf(port);
      EXPECT_FALSE(arrays.empty()) << stage.Name << " " << port.Name;
      for (const ChainArray& array : arrays)
      {
        EXPECT_TRUE(kinds.count(array.Of) == 1 && types.count(array.Type) == 1)
          << stage.Name << " " << port.Name << " " << array.Name;
      }
    }
  }
}

TEST(ChainTable, TakesOnlyWhatEarlierStagesThatRunGive)
{
  for (const Quality quality : Qualities)
  {
    for (const ChainStageTraits& stage : ChainStages())
    {
      for (const ChainInput& input : stage.Inputs)
      {
        for (const ChainOutput& giver : GiversOf(input, quality))
        {
          EXPECT_LT(giver.Stage, stage.Stage) << stage.Name << " " << input.Name;
          EXPECT_TRUE(RunsAt(giver.Stage, quality)) << stage.Name << " " << input.Name;
          EXPECT_LT(PortOf(giver), static_cast<int>(TraitsOf(giver.Stage).Outputs.size()))
            << stage.Name << " " << input.Name;
        }
      }
    }
  }
}

TEST(ChainTable, TheLastStageThatMovesObjectsIsTurned)
{
  using Names = std::set<std::string>;
  constexpr ChainStage last = ChainStage::Rotation;
  EXPECT_EQ(Givers(last, "Tracks", Quality::Preview), Names{ "Assimilation.Tracks" });
  EXPECT_EQ(Givers(last, "Tracks", Quality::Full), Names{ "Spacetime.Tracks" });
  EXPECT_EQ(Givers(last, "Constraints", Quality::Full), Names{ "Assimilation.Constraints" });
  EXPECT_EQ(Givers(last, "Constraints", Quality::Paper), Names{ "Planner.Constraints" });
  EXPECT_EQ(Givers(last, "Air", Quality::Paper), Names{});
  EXPECT_EQ(Givers(ChainStage::Spacetime, "Vortices", Quality::Paper),
            (Names{ "Scene.Vortices", "Planner.Vortices" }));
  EXPECT_EQ(Givers(ChainStage::Spacetime, "Vortices", Quality::Full),
            Names{ "Assimilation.Vortices" });
  EXPECT_EQ(Givers(ChainStage::Planner, "Database", Quality::Full), Names{});
}

TEST(ChainTable, VorticesAreFittedToWhatTheOptimiserGivesInAnAir)
{
  for (const Quality quality : Qualities)
  {
    EXPECT_EQ(RunsAt(ChainStage::VortexFit, quality), quality == Quality::Full);
  }
  EXPECT_EQ(Givers(ChainStage::VortexFit, "Input", Quality::Full),
            std::set<std::string>{ "Spacetime.Tracks" });
  EXPECT_EQ(ChainOptions::At(Quality::Full).Fit.Quantity, VortexFitOptions::AirAcceleration);
}

TEST(ChainTable, APreviewIsCoarserThanTheAirAlone)
{
  const ChainOptions coarse = ChainOptions::At(Quality::Preview);
  const ChainOptions fine = ChainOptions::At(Quality::Air);
  EXPECT_LT(coarse.Air.Resolution, fine.Air.Resolution);
  EXPECT_EQ(fine.Air.Resolution, AssimilationOptions().Resolution);
  const std::string json = ChainTableAsJson();
  EXPECT_NE(json.find("\"Resolution\": 32"), std::string::npos) << json;
}

TEST(ChainOptions, NamesWhatIsOutOfItsRange)
{
  ChainOptions options;
  EXPECT_TRUE(options.Validate());
  options.Seed = -2;
  EXPECT_NE(options.Validate().Message().find("Seed: expected"), std::string::npos);
  options.Seed = -1;
  options.Air.Resolution = 1;
  EXPECT_NE(options.Validate().Message().find("Resolution: expected"), std::string::npos);
}
