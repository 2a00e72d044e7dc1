// SPDX-License-Identifier: BSD-3-Clause
// Minimisation where memory is bounded: windows of frames one after the other, the frames beside
// them as they are, every second sweep shifted by half a window (Shi et al. 2005, section 5:
// disjoint subsets of the frames).
#include "Spacetime/Run/SpacetimeRun.h"
#include "Spacetime/Run/StepMonitor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace waft
{
namespace
{

constexpr int IterationsAtOnce = 30; // in one window, before the next has its turn
constexpr double SweepsOfAll = 4.0;  // iterations of a window, for one of all frames at once

} // namespace

std::vector<std::pair<std::size_t, std::size_t>> SpacetimeRun::Windows(int sweep) const
{
  const std::size_t frames = this->Solver->Level.NumberOfFrames();
  std::vector<std::pair<std::size_t, std::size_t>> windows;
  std::size_t end = sweep % 2 == 0 ? this->Window : (this->Window + 1) / 2;
  for (std::size_t first = 0; first < frames; first = end, end += this->Window)
  {
    windows.emplace_back(first, std::min(frames, end) - 1);
    end = std::min(end, frames);
  }
  return windows;
}

bool SpacetimeRun::MinimizeInWindows(const SpacetimeStep& step)
{
  const SpacetimeModel& model = this->Setup.Model;
  LevelSolver& whole = *this->Solver;
  StateVector& state = this->LevelState();
  CurrentWindow& current = this->Current;
  const int sweeps =
    std::max(2, static_cast<int>(std::lround(SweepsOfAll * step.Iterations / IterationsAtOnce)));
  const double from = 1.0 - this->Program.Work(this->Next, model.NumberOfFrames) / this->AllWork;
  const double to = 1.0 - this->Program.Work(this->Next + 1, model.NumberOfFrames) / this->AllWork;
  StepMonitor monitor(this->Progress, from, to, sweeps + 1);
  monitor.Text = "spacetime: " + step.Name;
  whole.Constraints.SetLeash(step.Leash / this->Setup.Spacing);
  const auto record = [&]()
  {
    this->Record(step.Pass, step.Name, static_cast<int>(current.Energies.size()) - 1, current.Terms,
                 whole.Constraints.MaxViolation(state), step.Leash);
  };
  if (!std::exchange(this->IsInside, true))
  {
    current = CurrentWindow();
    whole.Constraints.Project(state);
    whole.Partition.FillHalo(state, model.FrameSize());
  }
  if (current.Energies.empty())
  {
    if (!whole.Objective.Evaluate(state, nullptr, current.Terms, &monitor))
    {
      this->Stopped = true;
      this->KeepState();
      return false;
    }
    current.Energies = { current.Terms.E };
    record();
  }
  for (; current.Sweep < sweeps; ++current.Sweep)
  {
    const auto windows = this->Windows(current.Sweep);
    monitor.Done = current.Sweep + 1; // the first is to measure the whole
    for (; current.Index < windows.size(); ++current.Index)
    {
      const bool isUp = this->TimeIsUp();
      this->KeepCheckpoint(isUp);
      this->IsCut = this->IsCut || isUp;
      const double done = static_cast<double>(current.Index) / static_cast<double>(windows.size());
      if (!isUp && !monitor.Tick(done, {}))
      {
        this->Stopped = true;
        this->KeepState();
      }
      if (isUp || this->Stopped || !this->SolveWindow(step, windows[current.Index], done, monitor))
      {
        return false;
      }
    }
    current.Index = 0;
    current.Energies.push_back(current.Terms.E);
    record();
    char text[160];
    std::snprintf(text, sizeof(text), "spacetime: %s, sweep %d, E = %.4g", step.Name.c_str(),
                  current.Sweep + 1, current.Terms.E);
    monitor.Text = text;
    // A sweep and the shifted one after it reach every frame's neighbours.
    const std::size_t last = current.Energies.size() - 1;
    if (last >= 2 && current.Energies[last - 2] - current.Terms.E <
                       this->Options.Tolerance * current.Energies[last - 2])
    {
      break;
    }
  }
  return true;
}

bool SpacetimeRun::SolveWindow(const SpacetimeStep& step,
                               std::pair<std::size_t, std::size_t> window, double done,
                               Monitor& monitor)
{
  const std::size_t size = this->Setup.Model.FrameSize();
  StateVector& state = this->LevelState();
  const TimeLevel& level = this->Solver->Level;
  LevelSolver part(this->Setup.Model, this->Setup.Table, level.Part(window.first, window.second),
                   this->Parallel, this->Ranks, this->Options.HistorySize);
  part.Constraints.SetLeash(step.Leash / this->Setup.Spacing);
  float* begin = state.data() + level.PartBegin(window.first) * size;
  StateVector own =
    part.Partition.Take(StateVector(begin, begin + part.Level.NumberOfFrames() * size), size);
  LbfgsOptions options;
  options.MaximumNumberOfIterations = IterationsAtOnce;
  options.Tolerance = 0.0;
  SpacetimeTerms first, last;
  const auto observer = [&](int iteration, const SpacetimeTerms& terms)
  {
    (iteration == 0 ? first : last) = terms;
    last = terms;
    return true;
  };
  class Inner : public Monitor
  {
  public:
    Inner(Monitor& outer, double done) : Outer(outer), Done(done) {}
    bool Tick(double, const std::string&) override { return this->Outer.Tick(this->Done, {}); }

  private:
    Monitor& Outer;
    double Done;
  } inner(monitor, done);
  const LbfgsEnd end = part.Solver->Minimize(part.Objective, part.Preconditioner, part.Constraints,
                                             options, observer, &inner, own);
  if (end == LbfgsEnd::Stopped)
  {
    this->Stopped = true;
    this->KeepState(); // the window is to be solved anew
  }
  if (last.E <= first.E)
  {
    own = part.Partition.Whole(std::move(own), size);
    std::copy(own.begin(), own.end(), begin);
    SpacetimeTerms::Visit([](double& all, double now, double before) { all += now - before; },
                          this->Current.Terms, last, first);
  }
  return end != LbfgsEnd::Stopped;
}

} // namespace waft
