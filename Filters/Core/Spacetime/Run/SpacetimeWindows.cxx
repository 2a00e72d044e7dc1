// SPDX-License-Identifier: BSD-3-Clause
// Minimisation where memory is bounded or windows are asked for: windows of frames one after the
// other, the frames beside them as they are, every second sweep shifted by half a window (Shi et
// al. 2005, section 5: disjoint subsets of the frames).
#include "Spacetime/Run/SpacetimeRun.h"
#include "Spacetime/Run/StageProgress.h"

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

bool SpacetimeRun::MinimiseInWindows(const Stage& stage)
{
  const std::string name = stage.Name();
  LevelSolver& whole = *this->Solver;
  StateVector& state = this->State.Part;
  WindowSweep& current = this->State.Sweep;
  const int sweeps =
    std::max(2, static_cast<int>(std::lround(SweepsOfAll * stage.Iterations / IterationsAtOnce)));
  StageProgress monitor(this->Progress, this->FractionAt(this->State.Next),
                        this->FractionAt(this->State.Next + 1), sweeps + 1);
  monitor.Text = "spacetime: " + name;
  whole.Constraints.SetLeash(stage.Leash / this->Problem.Spacing);
  const auto record = [&]()
  {
    this->Record(stage.Pass, name, static_cast<int>(current.Energies.size()) - 1, current.Terms,
                 whole.Constraints.MaxViolation(state), stage.Leash);
  };
  if (!std::exchange(this->State.IsInside, true))
  {
    current = WindowSweep();
    whole.Constraints.Project(state);
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
      if (isUp || this->Stopped || !this->SolveWindow(stage, windows[current.Index], done, monitor))
      {
        return false;
      }
    }
    current.Index = 0;
    current.Energies.push_back(current.Terms.E);
    record();
    char text[160];
    std::snprintf(text, sizeof(text), "spacetime: %s, sweep %d, E = %.4g", name.c_str(),
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

bool SpacetimeRun::SolveWindow(const Stage& stage, std::pair<std::size_t, std::size_t> window,
                               double done, Monitor& monitor)
{
  StateVector& state = this->State.Part;
  const FrameView view(this->Problem.Model, this->Solver->Level, window.first, window.second);
  LevelSolver part(this->Problem.Model, this->State.Fields, this->Problem.Table, view.Level(),
                   this->Parallel, this->Options.HistorySize);
  part.Constraints.SetLeash(stage.Leash / this->Problem.Spacing);
  StateVector own = view.Take(state);
  LbfgsMemory memory;
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
  const LbfgsEnd end = part.Minimise(options, observer, &inner, memory, own);
  if (end == LbfgsEnd::Stopped)
  {
    this->Stopped = true;
    this->KeepState(); // the window is to be solved anew
  }
  if (last.E <= first.E)
  {
    view.Merge(std::move(own), state);
    SpacetimeTerms::Visit([](double& all, double now, double before) { all += now - before; },
                          this->State.Sweep.Terms, last, first);
  }
  return end != LbfgsEnd::Stopped;
}

} // namespace waft
