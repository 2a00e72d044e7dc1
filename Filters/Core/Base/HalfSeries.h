// SPDX-License-Identifier: BSD-3-Clause
// A long series of fields in half the memory.
#pragma once

#include "Base/FieldSeries.h"

#include <array>
#include <cstdint>
#include <vector>

namespace waft
{

/// Three half floats: eleven binary digits each, at most 65504.
using Half3 = std::array<std::uint16_t, 3>;

/// A FieldSeries in half floats.
struct HalfSeries : SeriesLattice
{
  using Field = FieldSeries::Field;

  std::vector<std::vector<Half3>> Values; // [time][point]

  HalfSeries() = default;
  explicit HalfSeries(const SeriesLattice& lattice) : SeriesLattice(lattice) {}
  /// Rounds to the nearest half floats.
  explicit HalfSeries(const FieldSeries& series);
  bool IsEmpty() const { return this->Values.empty(); }
  /// The values at the k-th time.
  Field At(std::size_t k) const;
  /// Rounds to the nearest half floats; what is larger than all of them becomes the largest.
  void Set(std::size_t k, const Field& field);
  /// The values from the last time before a given one to the first after it, or the end of the
  /// series that is nearest.
  FieldSeries Around(double time) const;
};

} // namespace waft
