// SPDX-License-Identifier: BSD-3-Clause
// Several plans of one scene, from consecutive seeds, scored so that one can be chosen.
#pragma once

#include "Planning/Planner.h"

#include <vector>

namespace waft
{

struct TakeOptions
{
  int NumberOfTakes = 1;
  int Take = 0;

  Result Validate() const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "NumberOfTakes",
                       { 1, 1000 },
                       "",
                       "Plans to choose from, of consecutive seeds, each with a score." },
          of.NumberOfTakes...);
    visit(OptionField{ "Take",
                       { -1, 999 },
                       "",
                       "The take that is given, from 0; -1 is the one with the least score." },
          of.Take...);
  }
};

/// How one take turned out.
struct TakeScore
{
  int Take = 0;
  std::uint64_t Seed = 1;
  int NumberOfRows = 0;
  int NumberOfMet = 0;
  /// Kolmogorov-Smirnov distances to the database of all flights but those within a second of a
  /// rest; 0 when nothing flies.
  double Curvature = 0.0;
  double Acceleration = 0.0;
  double Score = 0.0; // rows not met plus both distances: less is better
};

/// Take k is the plan of options.Seed + k. Stopped half way: the best of the takes that are whole,
/// or what there is of the first. Errors: those of PlanMotion, and options that are not valid.
Result PlanTakes(const PlanInput& input, const PlanOptions& options, const TakeOptions& takes,
                 const ParallelFor& parallelFor, Monitor& monitor, PlanOutput& output,
                 std::vector<TakeScore>& scores, PlanCache* memory = nullptr);

} // namespace waft
