// SPDX-License-Identifier: BSD-3-Clause
// Work in slices, and a stage that works so.
#include "PipelineTesting.h"

#include "Base/Parallel.h"
#include "Bridge/Pipeline/SlicedRun.h"
#include "SceneChain.h"

#include <vtkFieldData.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{

constexpr double OneTick = 1e-9; // s: a slice ends at the first tick

/// Says at most so many times that the work may go on.
struct CountingMonitor : waft::Monitor
{
  bool Tick(double fraction, const std::string& text) override
  {
    this->Thread = std::this_thread::get_id();
    this->Fraction = fraction;
    this->Text = text;
    return ++this->Ticks <= this->Most;
  }
  int Ticks = 0;
  int Most = 1000;
  double Fraction = -1.0;
  std::string Text;
  std::thread::id Thread;
};

/// Counts to ten.
waft::Result Count(int& count, waft::Monitor& monitor)
{
  for (; count < 10; ++count)
  {
    if (!monitor.Tick(0.1 * count, "at " + std::to_string(count)))
    {
      return waft::Result::Stopped();
    }
  }
  return waft::Result::Ok();
}

} // namespace

TEST(SlicedRun, GoesOnWhereItWasHeld)
{
  int count = 0;
  waft::SlicedRun run;
  run.Begin([&](waft::Monitor& monitor) { return Count(count, monitor); });
  CountingMonitor monitor;
  waft::Result result = waft::Result::Error("none yet");
  for (int slice = 0; slice < 10; ++slice)
  {
    ASSERT_FALSE(run.GoOn(OneTick, monitor, result));
    EXPECT_EQ(count, slice);
    EXPECT_EQ(monitor.Text, "at " + std::to_string(slice));
    EXPECT_EQ(monitor.Thread, std::this_thread::get_id());
  }
  EXPECT_TRUE(run.GoOn(OneTick, monitor, result));
  EXPECT_TRUE(result);
  EXPECT_EQ(count, 10);
  EXPECT_FALSE(run.HasWork());
}

TEST(SlicedRun, RunsToTheEndWithoutALimit)
{
  int count = 0;
  waft::SlicedRun run;
  run.Begin([&](waft::Monitor& monitor) { return Count(count, monitor); });
  CountingMonitor monitor;
  waft::Result result = waft::Result::Error("none yet");
  EXPECT_TRUE(run.GoOn(0.0, monitor, result));
  EXPECT_EQ(count, 10);
}

TEST(SlicedRun, StopsWhenTheCallerSaysSo)
{
  int count = 0;
  waft::SlicedRun run;
  run.Begin([&](waft::Monitor& monitor) { return Count(count, monitor); });
  CountingMonitor monitor;
  monitor.Most = 3;
  waft::Result result = waft::Result::Ok();
  EXPECT_TRUE(run.GoOn(0.0, monitor, result));
  EXPECT_TRUE(result.IsStopped());
  EXPECT_EQ(count, 3);
}

TEST(SlicedRun, DiscardsWhatIsHeld)
{
  int count = 0;
  CountingMonitor monitor;
  waft::Result result = waft::Result::Ok();
  {
    waft::SlicedRun run;
    run.Begin([&](waft::Monitor& own) { return Count(count, own); });
    EXPECT_FALSE(run.GoOn(OneTick, monitor, result));
    run.Begin([&](waft::Monitor& own) { return Count(count, own); }); // the first has stopped
    EXPECT_FALSE(run.GoOn(OneTick, monitor, result));
  }
  EXPECT_EQ(count, 0);
  waft::SlicedRun never; // begun, and never gone on with
  never.Begin([&](waft::Monitor& own) { return Count(count, own); });
}

TEST(SlicedRun, ThrowsWhatTheWorkThrows)
{
  waft::SlicedRun run;
  run.Begin([](waft::Monitor&) -> waft::Result { throw std::runtime_error("too large"); });
  CountingMonitor monitor;
  waft::Result result = waft::Result::Ok();
  EXPECT_THROW(run.GoOn(0.0, monitor, result), std::runtime_error);
  EXPECT_FALSE(run.HasWork());
}

namespace
{

using State = waft::SlicedRun::State;

/// Waits until it is so; false where it never is.
template <typename Condition>
bool Comes(const Condition& condition)
{
  using namespace std::chrono_literals;
  for (int k = 0; k < 60000 && !condition(); ++k)
  {
    std::this_thread::sleep_for(1ms);
  }
  return condition();
}

} // namespace

TEST(SlicedRun, GoesOnBesideUntilItIsHeld)
{
  using namespace std::chrono_literals;
  std::atomic<int> count{ 0 };
  waft::SlicedRun run;
  EXPECT_EQ(run.Now(), State::None);
  run.Begin(
    [&](waft::Monitor& monitor)
    {
      while (monitor.Tick(0.5, "at " + std::to_string(count)))
      {
        ++count;
        std::this_thread::sleep_for(100us);
      }
      return waft::Result::Stopped();
    });
  CountingMonitor monitor;
  waft::Result result = waft::Result::Ok();
  ASSERT_FALSE(run.GoOn(OneTick, monitor, result));
  EXPECT_EQ(run.Now(), State::Held);
  EXPECT_EQ(count, 0);
  run.LetGo();
  EXPECT_EQ(run.Now(), State::Beside);
  ASSERT_TRUE(Comes([&] { return count > 5; }));
  EXPECT_EQ(monitor.Ticks, 1) << "by itself it goes on unasked";
  run.Hold();
  ASSERT_TRUE(Comes([&] { return run.Now() == State::Held; })) << "at its next tick";
  const int held = count;
  const double worked = run.SoFar().Seconds;
  EXPECT_GT(worked, 0.0);
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(count, held);
  EXPECT_EQ(run.SoFar().Seconds, worked) << "while it is held it does not work";
  EXPECT_EQ(run.SoFar().Text, "at " + std::to_string(held));
  run.LetGo();
  ASSERT_TRUE(Comes([&] { return count > held + 5; }));
  ASSERT_FALSE(run.GoOn(OneTick, monitor, result)) << "which catches it";
  EXPECT_EQ(run.Now(), State::Held);
  EXPECT_EQ(monitor.Ticks, 2);
  run.LetGo();
  run.Discard();
  EXPECT_EQ(run.Now(), State::None);
}

TEST(SlicedRun, WritesItsLastPartInTheCallersTurn)
{
  using namespace std::chrono_literals;
  std::atomic<bool> writes{ false };
  waft::SlicedRun run;
  run.Begin(
    [&](waft::Monitor& monitor)
    {
      (void)monitor.Tick(0.0, "work");
      run.Rejoin();
      writes = true;
      return waft::Result::Ok();
    });
  CountingMonitor monitor;
  waft::Result result = waft::Result::Stopped();
  ASSERT_FALSE(run.GoOn(OneTick, monitor, result));
  run.LetGo();
  ASSERT_TRUE(Comes([&] { return run.Now() == State::Arrived; }));
  std::this_thread::sleep_for(10ms);
  EXPECT_FALSE(writes);
  run.Hold();
  run.LetGo();
  EXPECT_EQ(run.Now(), State::Arrived);
  EXPECT_TRUE(run.GoOn(OneTick, monitor, result));
  EXPECT_TRUE(writes);
  EXPECT_TRUE(result);
  EXPECT_FALSE(result.IsStopped());
}

TEST(SlicedRun, ThrowsWhatTheWorkThrewBeside)
{
  waft::SlicedRun run;
  run.Begin(
    [](waft::Monitor& monitor) -> waft::Result
    {
      (void)monitor.Tick(0.0, "work");
      throw std::runtime_error("too large");
    });
  CountingMonitor monitor;
  waft::Result result = waft::Result::Ok();
  ASSERT_FALSE(run.GoOn(OneTick, monitor, result));
  run.LetGo();
  ASSERT_TRUE(Comes([&] { return run.Now() == State::Arrived; }));
  EXPECT_THROW(run.GoOn(OneTick, monitor, result), std::runtime_error);
  EXPECT_FALSE(run.HasWork());
}

// While the thread that ticks is held, the others that work for the same kernel wait.
TEST(SlicedRun, HoldsAllThreadsOfAPart)
{
  using namespace std::chrono_literals;
  std::atomic<int> others{ 0 };
  waft::SlicedRun run;
  run.Begin(
    [&](waft::Monitor& monitor)
    {
      waft::PartMonitor part(monitor, 0.0, 1.0);
      std::atomic<bool> goesOn{ true };
      std::thread other(
        [&]
        {
          while (goesOn && part.Tick(0.0, ""))
          {
            ++others;
          }
        });
      bool isAsked = true;
      for (int k = 0; isAsked && k < 50; ++k)
      {
        std::this_thread::sleep_for(1ms);
        isAsked = part.Tick(0.02 * k, "at " + std::to_string(k));
      }
      goesOn = false;
      other.join();
      return waft::Result::Ok();
    });
  CountingMonitor monitor;
  waft::Result result = waft::Result::Ok();
  for (int slice = 0; slice < 3; ++slice)
  {
    ASSERT_FALSE(run.GoOn(OneTick, monitor, result));
    std::this_thread::sleep_for(2ms); // what was between two looks comes to its end
    const int before = others;
    std::this_thread::sleep_for(10ms);
    EXPECT_LE(others, before + 1);
  }
}

namespace
{

const char* const Scene = R"({"waft": 1, "time": {"frames": 20},
  "shapes": {"leaf": {"builtin": "leaf"}},
  "objects": [{"shape": "leaf", "positions": [[-0.5, 0.0, 2.1], [-0.5, 0.4, 2.2]]}],
  "constraints": [{"kind": "position", "object": 0, "frame": 19, "value": [-0.2, 0.05, 2.0]}],
  "obstacles": [{"kind": "sphere", "center": [1, -1, 2], "radius": 0.2, "motion":
    [{"frame": 0, "position": [1, -1, 2]}, {"frame": 19, "position": [1, 1, 2]}]}]})";

/// Planner, assimilation, optimiser and rotation.
struct LongChain : AssimilatedChain
{
  LongChain() : AssimilatedChain(Scene)
  {
    this->Spacetime->SetNumberOfGasParticles(125);
    this->Spacetime->SetLeashIterations(1);
    this->Spacetime->SetMaximumNumberOfIterations(6);
  }
  std::vector<vtkSlicedPolyDataAlgorithm*> Sliced() const
  {
    return { this->Planner, this->Assimilation, this->Spacetime, this->Rotation };
  }
  void SetSlice(double seconds)
  {
    for (vtkSlicedPolyDataAlgorithm* stage : this->Sliced())
    {
      stage->SetSlice(seconds);
    }
  }
  void Update(double time)
  {
    this->Rotation->GetOutputInformation(1)->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
    this->Rotation->Update(1);
  }
  void GoOn()
  {
    for (vtkSlicedPolyDataAlgorithm* stage : this->Sliced())
    {
      stage->GoOn();
    }
  }
  std::string Poses()
  {
    vtkPolyData* poses = Poly(this->Rotation, 1);
    std::string bytes;
    const auto add = [&bytes](vtkDataArray* array)
    {
      bytes.append(static_cast<const char*>(array->GetVoidPointer(0)),
                   static_cast<std::size_t>(array->GetDataSize() * array->GetDataTypeSize()));
    };
    add(poses->GetPoints()->GetData());
    add(poses->GetPointData()->GetArray("Orientation"));
    return bytes;
  }
};

/// The poses of a chain that was never held.
const std::string& AllAtOnce()
{
  static const std::string poses = []
  {
    LongChain chain;
    chain.Update(0.0);
    return chain.Poses();
  }();
  return poses;
}

} // namespace

TEST(Slices, ComeToTheSameBytesAndShowTheMotionSoFar)
{
  const std::string whole = AllAtOnce();
  LongChain chain;
  chain.SetSlice(0.02);
  chain.Spacetime->SetSlice(0.001); // it is soon done
  int slices = 0;
  std::vector<bool> wasHeld(4, false);
  for (chain.Update(0.5); chain.Rotation->GetComplete() == 0 && slices < 10000; ++slices)
  {
    vtkPolyData* poses = SceneChain::Poly(chain.Rotation, 1);
    ASSERT_EQ(poses->GetNumberOfPoints(), 40) << "slice " << slices;
    ASSERT_EQ(poses->GetFieldData()->GetArray("Complete")->GetComponent(0, 0), 0.0);
    ASSERT_GT(SceneChain::Poly(chain.Rotation, 0)->GetNumberOfPoints(), 0);
    for (std::size_t stage = 0; stage < 4; ++stage)
    {
      const double done = chain.Sliced()[stage]->GetWorkDone();
      wasHeld[stage] = wasHeld[stage] || (done > 0.0 && done < 1.0);
    }
    const ExecutionCount count(chain.Assimilation);
    chain.Update(0.6); // another time: nothing goes on
    chain.Update(0.5);
    chain.GoOn();
    chain.Update(0.5);
  }
  EXPECT_GT(slices, 10);
  EXPECT_TRUE(wasHeld[1]) << slices;
  EXPECT_TRUE(wasHeld[2]) << slices;
  EXPECT_EQ(chain.Poses(), whole);
  EXPECT_EQ(SceneChain::Poly(chain.Rotation, 1)->GetFieldData()->GetArray("Complete"), nullptr);
  for (vtkSlicedPolyDataAlgorithm* stage : chain.Sliced())
  {
    EXPECT_STREQ(stage->GetProgressText(), "done") << stage->GetClassName();
    const WorkCount count(stage);
    chain.GoOn(); // there is nothing left
    chain.Update(0.7);
    EXPECT_EQ(count.Value, 0);
  }
}

namespace
{

void WorkBeside(const LongChain& chain)
{
  for (vtkSlicedPolyDataAlgorithm* stage : chain.Sliced())
  {
    stage->WorkInSlices();
  }
}

} // namespace

TEST(Slices, FlyBesideToTheSameBytes)
{
  LongChain chain;
  WorkBeside(chain);
  int updates = 0;
  for (chain.Update(0.5); chain.Rotation->GetComplete() == 0 && updates < 10000; ++updates)
  {
    ASSERT_EQ(SceneChain::Poly(chain.Rotation, 1)->GetNumberOfPoints(), 40);
    ASSERT_GT(SceneChain::Poly(chain.Rotation, 0)->GetNumberOfPoints(), 0);
    chain.Update(0.6); // another time, while the work goes on
    chain.GoOn();
    chain.Update(0.5);
  }
  EXPECT_EQ(chain.Rotation->GetComplete(), 1);
  EXPECT_EQ(chain.Poses(), AllAtOnce());
}

TEST(Slices, AreLetGoOfAndBeginAnew)
{
  using Stage = vtkSlicedPolyDataAlgorithm;
  LongChain chain;
  WorkBeside(chain);
  chain.Update(0.5);
  for (vtkSlicedPolyDataAlgorithm* stage : chain.Sliced())
  {
    stage->LetGo();
    EXPECT_EQ(stage->GetWorkState(), Stage::NO_WORK) << stage->GetClassName();
    EXPECT_EQ(SceneChain::Poly(stage, 0)->GetNumberOfPoints(), 0) << stage->GetClassName();
  }
  for (vtkSlicedPolyDataAlgorithm* stage : chain.Sliced())
  {
    stage->SetSlice(0.0);
  }
  chain.Update(0.5);
  EXPECT_EQ(chain.Poses(), AllAtOnce());
}

// The window looks at the stages alone, and updates them when their work has come to its end.
TEST(Slices, ArriveWithoutAnUpdate)
{
  using Stage = vtkSlicedPolyDataAlgorithm;
  LongChain chain;
  WorkBeside(chain);
  for (vtkSlicedPolyDataAlgorithm* stage : chain.Sliced())
  {
    EXPECT_EQ(stage->GetWorkState(), Stage::NO_WORK) << stage->GetClassName();
    chain.Update(0.0);
    ASSERT_TRUE(Comes([&] { return stage->GetWorkState() != Stage::BESIDE; }));
    if (stage->GetWorkState() == Stage::ARRIVED) // it was not done within the update
    {
      EXPECT_EQ(stage->GetComplete(), 0) << "until it is shown";
    }
    chain.GoOn();
  }
  chain.Update(0.0);
  EXPECT_EQ(chain.Rotation->GetComplete(), 1);
  EXPECT_EQ(chain.Poses(), AllAtOnce());
}

TEST(Slices, BesideAreHeldAndDiscarded)
{
  LongChain chain;
  WorkBeside(chain);
  chain.Update(0.0);
  ASSERT_TRUE(Comes(
    [&]
    {
      chain.GoOn();
      chain.Update(0.0);
      return chain.Assimilation->GetWorkState() == vtkSlicedPolyDataAlgorithm::BESIDE;
    }));
  EXPECT_FALSE(chain.Assimilation->GetWorkText().empty());
  chain.Assimilation->Hold();
  ASSERT_TRUE(
    Comes([&] { return chain.Assimilation->GetWorkState() == vtkSlicedPolyDataAlgorithm::HELD; }));
  chain.GoOn();
  chain.Update(0.0);
  ASSERT_NE(chain.Assimilation->GetWorkState(), vtkSlicedPolyDataAlgorithm::HELD);
  chain.Planner->SetSeed(4);
  chain.Update(0.0); // what was flown is discarded
  EXPECT_EQ(chain.Rotation->GetComplete(), 0);
}

TEST(Slices, BeginAnewAfterAChangeAndMayEndAllAtOnce)
{
  LongChain chain;
  chain.SetSlice(0.02);
  chain.Planner->SetSeed(4);
  chain.Update(0.0);
  for (int k = 0; k < 5; ++k)
  {
    chain.GoOn();
    chain.Update(0.0);
  }
  ASSERT_EQ(chain.Rotation->GetComplete(), 0);
  chain.Planner->SetSeed(1);
  chain.Update(0.0);
  ASSERT_EQ(chain.Rotation->GetComplete(), 0);
  chain.SetSlice(0.0);
  chain.GoOn();
  chain.Update(0.0);
  EXPECT_EQ(chain.Rotation->GetComplete(), 1);
  EXPECT_EQ(chain.Poses(), AllAtOnce());
}

TEST(Slices, AreLeftWhenTheChainGoes)
{
  LongChain chain;
  chain.SetSlice(0.02);
  chain.Update(0.0);
  EXPECT_EQ(chain.Rotation->GetComplete(), 0);
}
