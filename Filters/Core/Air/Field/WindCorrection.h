// SPDX-License-Identifier: BSD-3-Clause
// A smooth wind that all bodies share: what their controls have in common.
#pragma once

#include "Base/Communicator.h"
#include "Base/HalfSeries.h"
#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Types.h"

#include <array>
#include <vector>

namespace waft
{

inline constexpr int WindStride = 3; // frames between samples of it

struct WindCorrectionOptions
{
  double Spacing = 0.5;     // of the splines, and how far from a wall it holds back [m]
  double TimeSpacing = 0.5; // of the splines [s]
  /// Of coefficients over the spacing [m/s], against a sample each tenth of a second.
  double Ridge = 1e-3;
  double Bending = 0.01;  // of their second differences in space
  double Changing = 0.03; // of their differences in time
  int Iterations = 40;    // of conjugate gradients

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Spacing...);
    visit(of.TimeSpacing...);
    visit(of.Ridge...);
    visit(of.Bending...);
    visit(of.Changing...);
    visit(of.Iterations...);
  }
};

/// What the wind is wanted to be, at one frame (half frames, too).
struct WindSamples
{
  double Frame = 0.0;
  std::vector<Vec3> Positions; // m
  std::vector<Vec3> Values;    // m/s

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Frame...);
    visit(of.Positions...);
    visit(of.Values...);
  }
};

/// W = curl A [m/s] with A in cubic B-splines of space and time: solenoidal. The parts of A along a
/// wall vanish there as Bridson, Houriham, Nordenstam 2007 have it, so that W is tangential there.
class WindCorrection
{
public:
  WindCorrection(const Box& volume, const Timeline& time, const WindCorrectionOptions& options);

  /// Least squares over all samples; goes on from the wind as it is. Where all ranks call it with
  /// the same each does a part of the frames, and the first one's monitor is asked. The same on any
  /// number of threads and ranks. False: stopped, the wind fits as well as it does by then.
  bool Fit(const std::vector<WindSamples>& samples, const ParallelFor& parallel,
           Communicator& ranks, Monitor& monitor);
  Vec3 At(const Vec3& x, double frame) const;
  /// sum = air + W at the points of the lattice, of each field's frame; sum is on the same lattice
  /// and has as many fields. False: stopped, at some frames.
  bool AddTo(const HalfSeries& air, HalfSeries& sum, const ParallelFor& parallel,
             Monitor& monitor) const;
  std::size_t NumberOfCoefficients() const { return this->Coefficients.size(); }
  /// The wind as it is, if another has the same volume, times and options.
  std::vector<double>& Values() { return this->Coefficients; }

private:
  // The four splines that are not zero at a point of an axis: plain, held back at the walls, and
  // the derivative of the latter.
  struct Splines
  {
    int First = 0;
    double Plain[4], Held[4], Slope[4];
  };
  struct Basis
  {
    Splines Along[3];
  };
  struct Level // the splines of time at a frame
  {
    int First = 0;
    double Weight[4];
  };
  using Nodes = std::vector<double>; // three a node

  Splines SplinesAt(int axis, double x) const;
  Level LevelAt(double frame) const;
  Nodes At(const Level& level, const std::vector<double>& coefficients) const;
  /// Where the four nodes along x begin that are the j-th along y and the k-th along z.
  std::size_t RowOf(const Basis& basis, int j, int k) const
  {
    const auto y = static_cast<std::size_t>(basis.Along[1].First + j);
    const auto z = static_cast<std::size_t>(basis.Along[2].First + k);
    return 3 * ((z * this->Count[1] + y) * this->Count[0] + basis.Along[0].First);
  }
  Vec3 Curl(const Basis& basis, const double* nodes) const;
  void AddCurl(const Basis& basis, const Vec3& value, double* nodes) const;
  /// What is penalised, applied: the gradient of half the penalty.
  void Penalise(const std::vector<double>& a, std::vector<double>& sum) const;
  std::size_t NodesPerKnot() const
  {
    return static_cast<std::size_t>(this->Count[0]) * this->Count[1] * this->Count[2];
  }

  Box Volume;
  Timeline Time;
  WindCorrectionOptions Options;
  std::array<int, 3> Count{}; // splines along each axis
  Vec3 Spacing = Vec3::Ones();
  int Knots = 0;
  double FramesPerKnot = 1.0;
  std::vector<double> Coefficients; // [knot][node][x, y, z], x fastest of the nodes [m^2/s]
};

} // namespace waft
