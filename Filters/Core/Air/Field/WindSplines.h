// SPDX-License-Identifier: BSD-3-Clause
// A solenoidal wind of one scale: the curl of splines of space and time.
#pragma once

#include "Base/HalfSeries.h"
#include "Base/Types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// Holds a wind back beside surfaces: a factor of its potential, and that factor's gradient [1/m].
struct WindHold
{
  double Factor = 1.0;
  Vec3 Slope = Vec3::Zero();
};

/// From 0 on a surface to 1 at a distance of 1 (Bridson, Houriham, Nordenstam 2007).
double HoldAt(double distance, double& slope);

/// W = curl A [m/s] with A in cubic B-splines of space and time. The parts of A along a wall vanish
/// there, so that W is tangential there. Coefficients are [knot][x, y, z][node], x fastest of the
/// nodes; of unit variance and independent of each other they make a wind whose components have a
/// given one, away from walls.
class WindSplines
{
public:
  /// The splines that are not zero at a point of an axis: plain, held back at the walls, and the
  /// derivative of the latter.
  struct Axis
  {
    int First = 0;
    alignas(32) double Plain[4], Held[4], Slope[4];
  };
  struct Place
  {
    Axis Along[3];
    WindHold Hold;
  };
  struct Instant // the splines of time at a frame
  {
    std::size_t Knots[4]; // each the one after the one before, or the first one
    double Weight[4];
  };
  /// Where the coefficients of a knot lie in a list: the first of the four nodes along x that are
  /// the j-th along y and the k-th along z ([4 k + j]), those of x; and how far it is from there to
  /// those of y, and on to those of z.
  struct Rows
  {
    std::array<std::size_t, 16> First;
    std::size_t Next;
  };

  /// spacing: of the splines, and how far from a wall they are held back [m]; timeSpacing: s.
  /// loops: the last frame is the first one again, for the splines, too.
  WindSplines(const Box& volume, const Timeline& time, double spacing, double timeSpacing,
              double variance, bool loops = false);

  double Spacing() const { return this->Reach; }
  std::size_t Nodes() const;
  std::size_t Knots() const { return this->KnotCount; }
  std::size_t Coefficients() const { return 3 * this->Nodes() * this->Knots(); }

  Place At(const Vec3& x) const;
  Instant At(double frame) const;
  /// The j-th along y and the k-th along z: [4 k + j].
  std::array<std::size_t, 16> NodesOf(const Place& place) const;
  /// values: of a knot, or summed over the knots with an instant's weights.
  static Vec3 Curl(const Place& place, const Rows& rows, const double* values);
  /// To these, what the product of a value and the curl is of each.
  static void AddCurl(const Place& place, const Rows& rows, const Vec3& value, double* values);
  /// To these, a weight times the square of what each is to the curl, but for the hold's slope.
  static void AddSquares(const Place& place, const Rows& rows, double weight, double* values);

  Vec3 WindAt(const Place& place, double frame, const double* coefficients) const;
  /// The wind at the points of a lattice at a frame, added to a field. holds: by point, or empty.
  void AddTo(const double* coefficients, double frame, const SeriesLattice& lattice,
             const std::vector<WindHold>& holds, HalfSeries::Field& field) const;

private:
  Axis AxisAt(int axis, double x) const;

  Box Volume;
  double Reach;
  std::array<int, 3> Count{}; // splines along each axis
  Vec3 Step = Vec3::Ones();
  std::size_t KnotCount = 0;
  std::size_t Spans = 1; // of time
  double FramesPerKnot = 1.0;
  double Unit = 1.0; // of the coefficients [m^2/s]
};

} // namespace waft
