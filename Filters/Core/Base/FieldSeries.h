// SPDX-License-Identifier: BSD-3-Clause
// A vector field on a regular lattice at a sequence of times: a user's wind, a coarse estimated
// wind.
#pragma once

#include "Base/PointLattice.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

enum class FieldMeaning
{
  Acceleration, // array `Wind`: acts as an acceleration [m/s^2]
  Velocity      // array `Velocity`: draws by drag towards it [m/s]
};

/// The times at which the points of a lattice have values.
struct SeriesLattice : PointLattice
{
  FieldMeaning Meaning = FieldMeaning::Acceleration;
  std::vector<double> Times; // s, increasing

  template <class Visitor, class... Holder>
  static void VisitLattice(Visitor&& visit, Holder&... of)
  {
    visit(of.Meaning...);
    visit(of.Dimensions...);
    visit(of.Origin...);
    visit(of.Spacing...);
    visit(of.Times...);
  }
};

/// One list of values per time. Sampling is trilinear in space and linear in time, clamped to the
/// lattice and to the first and last time.
struct FieldSeries : SeriesLattice
{
  using Field = std::vector<std::array<float, 3>>; // [point]

  std::vector<Field> Values; // [time]

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    VisitLattice(visit, of...);
    visit(of.Values...);
  }

  FieldSeries() = default;
  explicit FieldSeries(const SeriesLattice& lattice) : SeriesLattice(lattice) {}
  bool IsEmpty() const { return this->Values.empty(); }
  /// A lattice that can be, sizes agree, times increase, every value is within the limits of
  /// accelerations or velocities.
  Result Validate(const std::string& name) const;
  Vec3 Sample(const Vec3& x, double time) const;
  /// The same and its Jacobian d value_i / d x_j.
  Vec3 Sample(const Vec3& x, double time, Mat3& jacobian) const;
  /// At a time at all points; empty where the series is.
  Field At(double time) const;
};

} // namespace waft
