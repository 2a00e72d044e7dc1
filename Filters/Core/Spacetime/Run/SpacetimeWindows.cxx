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
  SpacetimeTerms terms;         // E of the whole, now
  std::vector<double> energies; // after each sweep
  const int sweeps =
    std::max(2, static_cast<int>(std::lround(SweepsOfAll * stage.Iterations / IterationsAtOnce)));
  StageProgress monitor(this->Progress, this->FractionAt(this->State.Next),
                        this->FractionAt(this->State.Next + 1), sweeps + 1);
  monitor.Text = "spacetime: " + name;
  whole.Constraints.SetLeash(stage.Leash / this->Problem.Spacing);
  const auto record = [&]()
  {
    this->Record(stage.Pass, name, static_cast<int>(energies.size()) - 1, terms,
                 whole.Constraints.MaxViolation(state), stage.Leash);
  };
  whole.Constraints.Project(state);
  if (!whole.Objective.Evaluate(state, nullptr, terms, &monitor))
  {
    this->Stopped = true;
    return false;
  }
  energies = { terms.E };
  record();
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    const auto windows = this->Windows(sweep);
    monitor.Done = sweep + 1; // the first is to measure the whole
    for (std::size_t k = 0; k < windows.size(); ++k)
    {
      const double done = static_cast<double>(k) / static_cast<double>(windows.size());
      const bool isUp = this->TimeIsUp();
      this->IsCut = this->IsCut || isUp;
      this->Stopped = this->Stopped || (!isUp && !monitor.Tick(done, {}));
      if (isUp || this->Stopped || !this->SolveWindow(stage, windows[k], done, monitor, terms))
      {
        return false;
      }
    }
    energies.push_back(terms.E);
    record();
    char text[160];
    std::snprintf(text, sizeof(text), "spacetime: %s, sweep %d, E = %.4g", name.c_str(), sweep + 1,
                  terms.E);
    monitor.Text = text;
    // A sweep and the shifted one after it reach every frame's neighbours.
    const std::size_t last = energies.size() - 1;
    if (last >= 2 && energies[last - 2] - terms.E < this->Options.Tolerance * energies[last - 2])
    {
      break;
    }
  }
  return true;
}

bool SpacetimeRun::SolveWindow(const Stage& stage, std::pair<std::size_t, std::size_t> window,
                               double done, Monitor& monitor, SpacetimeTerms& terms)
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
  const auto observer = [&](int iteration, const SpacetimeTerms& now)
  {
    (iteration == 0 ? first : last) = now;
    last = now;
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
  this->Stopped = this->Stopped || end == LbfgsEnd::Stopped;
  if (last.E <= first.E)
  {
    view.Merge(std::move(own), state);
    SpacetimeTerms::Visit([](double& all, double now, double before) { all += now - before; },
                          terms, last, first);
  }
  return end != LbfgsEnd::Stopped;
}

} // namespace waft
