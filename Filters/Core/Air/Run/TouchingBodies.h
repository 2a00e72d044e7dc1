// SPDX-License-Identifier: BSD-3-Clause
// Bodies that touch, solved as one problem by all ranks and their threads.
#pragma once

#include "Air/Drift/DriftContacts.h"
#include "Air/Run/AirElsewhere.h"
#include "Air/Run/AirState.h"
#include "Base/SharedWork.h"

#include <vector>

namespace waft
{

/// How bodies that touch give way.
struct TouchingTask
{
  std::vector<char> Which;      // by body: whether it may move, unless an edit leaves it as it was
  std::vector<double> Barriers; // by body, in place of the weight; empty: that
  DriftWeights Weights;
  bool HoldsToBalls = false; // BodyProblem::HoldToBalls; what misses none does not move
  int Iterations = 0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Which...);
    visit(of.Barriers...);
    visit(of.Weights...);
    visit(of.HoldsToBalls...);
    visit(of.Iterations...);
  }
};

/// Moves the paths by SolveTogether. False: stopped.
bool SolveTouching(const AirContext& run, const HalfSeries& air, const TouchingTask& task,
                   const std::vector<DriftContact>& contacts, AirBodies& bodies, Monitor& monitor);

inline constexpr const char* TouchingKind = "touching bodies";
/// Does so with rank 0.
Result ServeTouching(ReadingStream& inputs, Communicator& ranks, const ParallelFor& parallel,
                     AirElsewhere& elsewhere);

} // namespace waft
