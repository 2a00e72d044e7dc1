// SPDX-License-Identifier: BSD-3-Clause
// How bodies move that an air carries: what tells a lively air from a calm one.
#pragma once

#include "Base/BodyLaw.h"
#include "Base/HalfSeries.h"
#include "Base/Parallel.h"
#include "Base/Types.h"

#include <array>
#include <vector>

namespace waft
{

struct AirStatistics
{
  static constexpr int Bins = 8;
  /// Distances of the pairs of a bin, in widths of the volume: from FirstBin on, as wide each.
  static constexpr double FirstBin = 0.075;
  static constexpr double BinWidth = 0.0375;

  double VelocityVariance = 0.0;     // about the mean of each frame [m^2/s^2]
  double AccelerationVariance = 0.0; // about the mean of each frame [m^2/s^4]
  /// About each body's own mean over windows of OwnSeconds (in a volume of 4 m), as few bodies have
  /// it; 0 where none flies freely as long.
  static constexpr double OwnSeconds = 2.0;
  double OwnVelocityVariance = 0.0;     // [m^2/s^2]
  double OwnAccelerationVariance = 0.0; // [m^2/s^4]
  /// S2(r) / 2 var v; 0 where there is no pair.
  std::array<double, Bins> Structure{};

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.VelocityVariance...);
    visit(of.AccelerationVariance...);
    visit(of.OwnVelocityVariance...);
    visit(of.OwnAccelerationVariance...);
    visit(of.Structure...);
  }
};

/// Paths of bodies, one position a frame [m], and where each flies freely.
struct FreeFlights
{
  std::vector<std::vector<Vec3>> Paths;
  std::vector<std::vector<char>> IsFree;
};

/// width: of the volume [m].
AirStatistics StatisticsOf(const FreeFlights& flights, double framesPerSecond, double width);

/// Of bodies of a law, without inertia, let go at random and, where they leave the volume of the
/// lattice, again. The same on any number of threads.
AirStatistics DriftStatistics(const HalfSeries& air, double framesPerSecond, const BodyLaw& law,
                              const ParallelFor& parallel);

/// Mean of |ln| of the ratio of the structures where both are known; 0 where none is.
double StructureDistance(const AirStatistics& one, const AirStatistics& other);

} // namespace waft
