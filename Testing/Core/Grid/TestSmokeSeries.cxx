// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeSeries.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

namespace
{

// A ball that moves along x and a wind that blows on it.
SmokeSeriesInput MovingBall(std::size_t cacheLimit)
{
  SmokeSeriesInput input;
  input.Options.Resolution = { 12, 12, 12 };
  input.Options.WarmUpSeconds = 0.1;
  AnalyticWind wind;
  wind.Center = Vec3(0.0, 0.0, 2.0);
  input.Forces.Winds = { wind };
  input.NumberOfFrames = 40;
  input.CacheLimit = cacheLimit;
  input.SolidsMove = true;
  const SmokeOptions options = input.Options;
  input.Solids = [options](int frame, std::vector<float>& distances,
                           std::vector<std::array<float, 3>>& velocities)
  {
    for (int k = 0; k <= 12; ++k)
    {
      for (int j = 0; j <= 12; ++j)
      {
        for (int i = 0; i <= 12; ++i)
        {
          const Vec3 x = options.Bounds.Min + Vec3(i, j, k).cwiseProduct(options.Spacing());
          const Vec3 center(-1.0 + 0.02 * frame, 0.1, 1.8);
          distances.push_back(static_cast<float>((x - center).norm() - 0.7));
          velocities.push_back({ 0.6f, 0.0f, 0.0f });
        }
      }
    }
    return Result::Ok();
  };
  return input;
}

} // namespace

TEST(SmokeSeries, FramesOutOfOrderEqualFramesInOrder)
{
  SilentMonitor monitor;
  std::shared_ptr<const SmokeFrame> fields;
  SmokeSeries inOrder;
  ASSERT_TRUE(inOrder.Begin(MovingBall(std::size_t(1) << 30)));
  std::vector<std::shared_ptr<const SmokeFrame>> frames;
  for (int frame = 0; frame < 40; ++frame)
  {
    ASSERT_TRUE(inOrder.At(frame, SerialFor(), monitor, fields));
    frames.push_back(fields);
  }
  EXPECT_EQ(inOrder.FramesComputed(), 40);
  ASSERT_TRUE(inOrder.At(7, SerialFor(), monitor, fields));
  EXPECT_EQ(inOrder.FramesComputed(), 40); // all of them were kept

  SmokeSeries small;
  const std::size_t limit = 900000; // a few frames and checkpoints
  ASSERT_TRUE(small.Begin(MovingBall(limit)));
  for (const int frame : { 39, 3, 38, 16, 20, 0, 33, 32, 17 })
  {
    ASSERT_TRUE(small.At(frame, SerialFor(), monitor, fields));
    ASSERT_TRUE(fields);
    EXPECT_EQ(fields->Frame, frame);
    EXPECT_EQ(fields->Velocity, frames[frame]->Velocity) << "frame " << frame;
    EXPECT_EQ(fields->Pressure, frames[frame]->Pressure) << "frame " << frame;
    EXPECT_EQ(fields->Obstacle, frames[frame]->Obstacle) << "frame " << frame;
    EXPECT_LE(small.BytesKept(), limit);
  }
  EXPECT_FALSE(small.At(40, SerialFor(), monitor, fields));
}

TEST(SmokeSeries, KeepsToAnyLimitThatHoldsAFrame)
{
  SilentMonitor monitor;
  std::shared_ptr<const SmokeFrame> fields;
  SmokeSeries whole;
  ASSERT_TRUE(whole.Begin(MovingBall(std::size_t(1) << 30)));
  ASSERT_TRUE(whole.At(0, SerialFor(), monitor, fields));
  const std::size_t frame = 12 * 12 * 12 * (4 * 3 * 4 + 2 * 4 + 1); // bytes
  const std::size_t state = whole.BytesKept() - frame;
  EXPECT_GT(state, frame / 4);
  std::shared_ptr<const SmokeFrame> last;
  ASSERT_TRUE(whole.At(25, SerialFor(), monitor, last));
  for (const std::size_t limit :
       { std::size_t(1), frame, frame + state - 1, frame + state, 3 * frame + 2 * state })
  {
    SmokeSeries small;
    ASSERT_TRUE(small.Begin(MovingBall(limit)));
    for (const int at : { 20, 3, 25 })
    {
      ASSERT_TRUE(small.At(at, SerialFor(), monitor, fields));
      EXPECT_EQ(fields->Frame, at);
      EXPECT_LE(small.BytesKept(), std::max(limit, frame));
    }
    EXPECT_EQ(fields->Velocity, last->Velocity) << limit;
    // From 3 to 25 it goes on; back to 3 the way is shorter with a checkpoint of frame 0 or 16.
    EXPECT_EQ(small.FramesComputed(), limit >= frame + state ? 21 + 3 + 22 : 21 + 4 + 22) << limit;
  }
}

TEST(SmokeSeries, GivesTheLastFrameReachedWhenStopped)
{
  struct StopLater : Monitor
  {
    double Last = 0.0;
    bool Tick(double fraction, const std::string&) override
    {
      this->Last = fraction;
      return fraction < 0.5;
    }
  };
  SmokeSeries series;
  ASSERT_TRUE(series.Begin(MovingBall(std::size_t(1) << 30)));
  StopLater monitor;
  std::shared_ptr<const SmokeFrame> fields;
  EXPECT_TRUE(series.At(39, SerialFor(), monitor, fields).IsStopped());
  ASSERT_TRUE(fields);
  EXPECT_EQ(fields->Frame, 19);
  EXPECT_NEAR(monitor.Last, 0.5, 0.03);
}
