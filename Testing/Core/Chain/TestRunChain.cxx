// SPDX-License-Identifier: BSD-3-Clause
// All stages in one call: what they come to, what is kept from run to run, and how a run ends
// early. That the bits are those of the joined stages is held where there is VTK (Pipeline).
#include "Chain/BuiltinAssets.h"
#include "Chain/RunChain.h"
#include "Planning/SwirlDatabase.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

struct Flight
{
  Scene TheScene;
  SceneWind Wind;
  Motion Made;
  ChainMemory Memory;

  explicit Flight(const std::string& more = "")
  {
    const std::string text = R"({"waft": 1, "seed": 7, "time": {"frames": 20},
      "shapes": {"leaf": {"builtin": "maple", "size": 0.12}},
      "objects": [{"shape": "leaf", "position": [-0.4, 0.1, 1.6]},
                  {"shape": "leaf", "position": [0.5, -0.2, 2.0]}],
      "obstacles": [{"kind": "box", "min": [0.1, 0.4, 0], "max": [0.4, 0.7, 0.9]}],
      "constraints": [{"kind": "position", "object": 0, "frame": 15, "value": [-0.3, 0.15, 1.4],
                       "radius": 0.02}])" +
                             more + "}";
    const Result read = ParseScene(text, "scene", ".", BuiltinAssets(), this->TheScene);
    EXPECT_TRUE(read) << read.Message();
    EXPECT_TRUE(this->Wind.Build(this->TheScene, BuiltinAssets()));
  }
  Result Run(const ChainOptions& options)
  {
    SilentMonitor monitor;
    return this->Run(options, monitor);
  }
  Result Run(const ChainOptions& options, Monitor& monitor)
  {
    return RunChain({ this->TheScene, this->Wind, test::SwirlDatabase() }, options, SerialFor(),
                    monitor, this->Made, &this->Memory);
  }
};

ChainOptions Coarse(Quality quality)
{
  ChainOptions options = ChainOptions::At(quality);
  options.Air.Resolution = 16;
  options.Air.LatticeResolution = 12;
  options.Air.Candidates = 2;
  options.Optimiser.NumberOfGasParticles = 216;
  options.Optimiser.LeashIterations = 2;
  options.Optimiser.MaximumNumberOfIterations = 4;
  return options;
}

/// Asks to stop once a text is told that has these words.
class StopAt : public Monitor
{
public:
  explicit StopAt(std::string words) : Words(std::move(words)) {}
  bool Tick(double fraction, const std::string& text) override
  {
    EXPECT_GE(fraction, this->Last - 1e-9);
    this->Last = fraction;
    this->IsStopped = this->IsStopped || text.find(this->Words) != std::string::npos;
    return !this->IsStopped;
  }
  double Last = 0.0;
  bool IsStopped = false;

private:
  std::string Words;
};

} // namespace

TEST(RunChain, FliesTheFewestFramesThatAQualityTakes)
{
  for (const auto& [quality, frames] : { std::pair(Quality::Preview, 2), { Quality::Full, 3 } })
  {
    Flight flight;
    flight.TheScene.Info.Time.NumberOfFrames = frames;
    flight.TheScene.Constraints.clear();
    const Result result = flight.Run(Coarse(quality));
    ASSERT_TRUE(result) << ToString(quality) << ": " << result.Message();
    ASSERT_EQ(flight.Made.Tracks.size(), 2u) << ToString(quality);
    EXPECT_EQ(flight.Made.Tracks[0].Positions.size(), static_cast<std::size_t>(frames));
    EXPECT_TRUE(flight.Made.Tracks[0].Positions.back().allFinite());
  }
  Flight brief;
  brief.TheScene.Info.Time.NumberOfFrames = 2;
  brief.TheScene.Constraints.clear();
  EXPECT_EQ(brief.Run(Coarse(Quality::Full)).Message(),
            "NumberOfFrames: at least 3 expected, found 2");
}

TEST(RunChain, MeetsTheMarkInEachQuality)
{
  for (const Quality quality : Qualities)
  {
    Flight flight;
    const Result result = flight.Run(Coarse(quality));
    ASSERT_TRUE(result) << ToString(quality) << ": " << result.Message();
    const Motion& made = flight.Made;
    ASSERT_EQ(made.Tracks.size(), 2u) << ToString(quality);
    EXPECT_LT((made.Tracks[0].Positions[15] - Vec3(-0.3, 0.15, 1.4)).norm(), 0.021)
      << ToString(quality);
    EXPECT_EQ(made.Turned.Poses.size(), 2u);
    ASSERT_EQ(made.Report.size(), 1u);
    EXPECT_EQ(made.Report[0].Status, ConstraintStatus::Met) << made.Report[0].Message;
    EXPECT_EQ(made.Air.Tracks.empty(), quality == Quality::Paper);
    EXPECT_EQ(made.Optimised.Tracks.empty(), quality < Quality::Full);
  }
}

TEST(RunChain, MakesNothingAgainThatIsThere)
{
  Flight flight;
  ASSERT_TRUE(flight.Run(Coarse(Quality::Preview)));
  EXPECT_EQ(flight.Made.Efforts.size(), 3u);
  const std::vector<Track> before = flight.Made.Tracks;
  ASSERT_TRUE(flight.Run(Coarse(Quality::Preview)));
  EXPECT_TRUE(flight.Made.Efforts.empty());
  EXPECT_EQ(flight.Made.Tracks[0].Positions, before[0].Positions);

  ChainOptions options = Coarse(Quality::Preview);
  options.Rotation.Roll = 2.0;
  ASSERT_TRUE(flight.Run(options));
  EXPECT_EQ(flight.Made.Efforts.size(), 2u) << "the air, in which bodies glide, and the rotation";
  options.Turning = options.Rotation;
  ASSERT_TRUE(flight.Run(options));
  EXPECT_TRUE(flight.Made.Efforts.empty()) << "as it is without";
  ASSERT_TRUE(options.Set(ChainStage::Assimilation, "Roll", 1.0));
  ASSERT_TRUE(options.Set(ChainStage::Assimilation, "Roll", 2.0));
  EXPECT_FALSE(options.Set(ChainStage::Assimilation, "NoSuchOption", 2.0));
  const std::vector<Track> rolling = flight.Made.Tracks;
  options.StopAfter = ChainStage::Planner;
  ASSERT_TRUE(flight.Run(options));
  EXPECT_TRUE(flight.Made.Efforts.empty());
  EXPECT_TRUE(flight.Made.Air.Tracks.empty());
  EXPECT_TRUE(flight.Made.Tracks.empty());
  options.StopAfter = ChainStage::Rotation;
  ASSERT_TRUE(flight.Run(options));
  EXPECT_EQ(flight.Made.Efforts.size(), 2u) << "all after the plan";
  EXPECT_EQ(flight.Made.Tracks[0].Positions, rolling[0].Positions);
}

TEST(RunChain, ASeedIsAnotherMotionAndNoneTheScenes)
{
  Flight flight;
  ChainOptions options = Coarse(Quality::Preview);
  ASSERT_TRUE(flight.Run(options));
  const std::vector<Track> own = flight.Made.Tracks;
  options.Seed = 8;
  ASSERT_TRUE(flight.Run(options));
  EXPECT_NE(flight.Made.Tracks[1].Positions, own[1].Positions);
  options.Seed = 7;
  ASSERT_TRUE(flight.Run(options));
  EXPECT_EQ(flight.Made.Tracks[1].Positions, own[1].Positions);
}

TEST(RunChain, TurnsWhatThereIsWhenItIsStopped)
{
  Flight flight;
  StopAt monitor("Drawing");
  const Result result = flight.Run(Coarse(Quality::Full), monitor);
  ASSERT_TRUE(result) << result.Message();
  ASSERT_TRUE(monitor.IsStopped);
  EXPECT_TRUE(result.IsStopped());
  EXPECT_TRUE(flight.Made.IsStopped);
  EXPECT_TRUE(flight.Made.Optimised.Tracks.empty()) << "no stage begins after a stop";
  EXPECT_EQ(flight.Made.Tracks.size(), 2u);
  EXPECT_EQ(flight.Made.Turned.Poses.size(), 2u);

  // Afterwards the same run comes to what it would have come to.
  ASSERT_TRUE(flight.Run(Coarse(Quality::Full)));
  Flight whole;
  ASSERT_TRUE(whole.Run(Coarse(Quality::Full)));
  EXPECT_FALSE(flight.Made.IsStopped);
  EXPECT_EQ(flight.Made.Tracks[1].Positions, whole.Made.Tracks[1].Positions);
}

TEST(RunChain, GivesTheMotionSoFarAtItsTimeLimit)
{
  Flight flight;
  ChainOptions options = Coarse(Quality::Full);
  options.TimeLimit = 1e-9;
  const Result result = flight.Run(options);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_TRUE(result.IsStopped());
  EXPECT_EQ(flight.Made.MovedBy(), ChainStage::Planner);
  EXPECT_EQ(flight.Made.Turned.Poses.size(), 2u);
}

TEST(RunChain, RefusesASceneThatTheOptimiserHasNoRoomFor)
{
  Flight flight;
  ChainOptions options = Coarse(Quality::Full);
  options.Optimiser.NumberOfGasParticles = 200000;
  options.Optimiser.MemoryLimit = 1.0;
  const Result result = flight.Run(options);
  ASSERT_FALSE(result);
  EXPECT_NE(result.Message().find("MemoryLimit"), std::string::npos) << result.Message();
  EXPECT_TRUE(flight.Made.Plan.Tracks.empty()) << "before anything is planned";
}

TEST(RunChain, NamesWhatAProgramWithoutReadersCannotRead)
{
  Scene scene;
  const std::string text = R"({"waft": 1, "shapes": {"leaf": {"builtin": "maple"}},
    "objects": [{"shape": "leaf", "count": 9, "region": {"min": [-1, -1, 2], "max": [1, 1, 3]}}],
    "constraints": [{"kind": "keyframe", "frame": 200, "targets": {"text": "AIR", "font": "sans",
      "width": 3.2, "origin": [0, 0, 1], "u": [1, 0, 0], "v": [0, 0, 1]}}]})";
  const Result result = ParseScene(text, "scene", ".", BuiltinAssets(), scene);
  ASSERT_FALSE(result);
  EXPECT_NE(result.Message().find("/constraints/0"), std::string::npos) << result.Message();
  EXPECT_NE(result.Message().find("no reader of files"), std::string::npos) << result.Message();
}
