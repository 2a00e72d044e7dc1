// SPDX-License-Identifier: BSD-3-Clause
// Runs of the optimiser that tests share.
#pragma once

#include "Spacetime/Run/SpacetimeRun.h"
#include "SpacetimeScenes.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace waft
{

inline SpacetimeOptions QuickOptions()
{
  SpacetimeOptions options;
  options.NumberOfGasParticles = 216;
  options.NumberOfObjectParticles = 25;
  options.LeashIterations = 8;
  options.MaximumNumberOfIterations = 40;
  return options;
}

inline SpacetimeOutput RunScene(const SpacetimeInput& input, const SpacetimeOptions& options,
                                int threads = 2)
{
  SilentMonitor monitor;
  SpacetimeOutput output;
  const Result result = RunSpacetime(input, options, ThreadedFor(threads), monitor, output);
  EXPECT_TRUE(result) << result.Message();
  EXPECT_FALSE(result.IsStopped());
  return output;
}

/// A run whose last state is looked at.
inline SolverState LastState(const SpacetimeInput& input, const SpacetimeOptions& options,
                             SpacetimeOutput& output)
{
  SpacetimeSetup setup;
  EXPECT_TRUE(MakeSetup(input, options, setup));
  StateVector start = std::move(setup.Start);
  const ParallelFor parallel = ThreadedFor(2);
  SilentMonitor monitor;
  SpacetimeRun run(input, options, setup, parallel, monitor, output);
  EXPECT_TRUE(run.Run(std::move(start)));
  return run.Last();
}

/// Asks a run to stop once it has come so far; what it says of its progress never falls.
class StopAt : public Monitor
{
public:
  explicit StopAt(double fraction) : Fraction(fraction) {}
  bool Tick(double fraction, const std::string&) override
  {
    EXPECT_GE(fraction, this->Last - 1e-9);
    this->Last = fraction;
    return fraction < this->Fraction;
  }

private:
  double Fraction, Last = 0.0;
};

/// Every bit of what moves and of the way there.
inline void ExpectSameMotion(const SpacetimeOutput& a, const SpacetimeOutput& b)
{
  ASSERT_EQ(a.Convergence.size(), b.Convergence.size());
  for (std::size_t k = 0; k < a.Convergence.size(); ++k)
  {
    EXPECT_EQ(a.Convergence[k].Stage, b.Convergence[k].Stage);
    SpacetimeTerms::Visit([&](double one, double other)
                          { EXPECT_EQ(one, other) << a.Convergence[k].Stage; },
                          a.Convergence[k], b.Convergence[k]);
  }
  ASSERT_EQ(a.Tracks.size(), b.Tracks.size());
  for (std::size_t o = 0; o < a.Tracks.size(); ++o)
  {
    EXPECT_EQ(a.Tracks[o].Positions, b.Tracks[o].Positions);
    EXPECT_EQ(a.Tracks[o].SphVelocities, b.Tracks[o].SphVelocities);
    EXPECT_EQ(a.Tracks[o].AirVelocities, b.Tracks[o].AirVelocities);
  }
  EXPECT_EQ(a.Wind.Values, b.Wind.Values);
  ASSERT_EQ(a.Particles.Frames.size(), b.Particles.Frames.size());
  for (std::size_t k = 0; k < a.Particles.Frames.size(); ++k)
  {
    EXPECT_EQ(a.Particles.Frames[k].Positions, b.Particles.Frames[k].Positions);
    EXPECT_EQ(a.Particles.Frames[k].Velocities, b.Particles.Frames[k].Velocities);
  }
}

} // namespace waft
