// SPDX-License-Identifier: BSD-3-Clause
// The frames that are solved for: all of them, or some.
#pragma once

#include "Spacetime/Model/SpacetimeModel.h"

#include <cstddef>
#include <vector>

namespace waft
{

/// Some frames of the time line, in order, the first and the last among them. Steps may differ.
struct TimeLevel
{
  std::vector<int> Frames;
  /// Entry j: frames from level frame j - 1 to j (entry 0 is 0).
  std::vector<double> Steps;
  /// Weights that keep E an integral over time: of the residuals into j, of D^j and of the
  /// smoothness row j. All one at full resolution.
  std::vector<double> StepWeights, FrameWeights, SmoothWeights;
  /// Row j of Eq. 4's second term: v^j - sum of Coefficients[k] v^k over the neighbours in time.
  struct Neighbour
  {
    int Frame;
    double Coefficient;
  };
  std::vector<std::vector<Neighbour>> Rows;    // neighbours of row j
  std::vector<std::vector<Neighbour>> Columns; // rows in which frame j is a neighbour

  /// Unknowns of level frames outside these keep their values.
  std::size_t FirstFree = 0;
  std::size_t LastFree = static_cast<std::size_t>(-1);

  std::size_t NumberOfFrames() const { return this->Frames.size(); }
  bool IsFree(std::size_t j) const { return j >= this->FirstFree && j <= this->LastFree; }
  /// The farthest neighbour in time of any row [level frames].
  int Reach() const;
  /// The level frames from `first` to `last`, whose unknowns are free, and as many beside them as
  /// it takes that E changes by what it changes by on the whole level.
  TimeLevel Part(std::size_t first, std::size_t last) const;
  /// The level frame of this one that is frame 0 of Part(first, ...).
  std::size_t PartBegin(std::size_t first) const;
  /// frames: increasing.
  static TimeLevel Make(std::vector<int> frames, int window);
  /// All frames.
  static TimeLevel Full(int numberOfFrames, int window);
};

/// The gas as a level's steps can follow it: c0 is lowered so far that sound crosses at most one h
/// in the longest step, the viscosity stays. Stiffer gas has no rollout at such steps, and the
/// solver loses particles through the walls.
SphFluid FluidOf(const SpacetimeModel& model, const TimeLevel& level);

/// True when the step into level frame j is not free flight for the object.
bool StepIsBound(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                 std::size_t object);

/// True when its place is given at both ends of the step into level frame j, as where it lies or
/// follows a path that is given frame by frame.
bool StepIsGiven(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                 std::size_t object);

/// True when rv counts in that step: in free flight, in a sampled air without what follows a path
/// that is given frame by frame, which no force has to explain.
bool StepHasLaw(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                std::size_t object);

/// The weight of row j of Eq. 4's second term for an object, or for gas (-1). In a sampled air an
/// object's is that of Control: it keeps what moves it beside the air from jerks, in flight alone.
double SmoothnessWeight(const SpacetimeModel& model, const TimeLevel& level, std::size_t j,
                        long object);

} // namespace waft
