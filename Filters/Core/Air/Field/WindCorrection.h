// SPDX-License-Identifier: BSD-3-Clause
// A wind that all bodies share: the most probable one that makes their controls needless.
#pragma once

#include "Air/Field/WindEquations.h"
#include "Air/Field/WindSplines.h"
#include "Base/Monitor.h"
#include "Base/Parallel.h"

#include <functional>
#include <vector>

namespace waft
{

/// One of the scales of an air: splines so far apart, and the variance of a component.
struct WindScale
{
  double Spacing = 0.5;     // m
  double TimeSpacing = 0.5; // s
  double Variance = 1.0;    // m^2/s^2
};

/// Scales of an air about one with a spacing: twice, once, half of it, but none below two of the
/// lattice's; times between splines go as the eddies', with the power 2/3 of their size. Variances
/// come from the air's structure function, of which one at r counts what is smaller than r.
std::vector<WindScale> ScalesOf(const HalfSeries& air, double spacing, double timeSpacing);

/// Distance to what air does not pass, and the direction away from it; the reach where nothing is
/// as near.
using DistanceFromSolids =
  std::function<double(const Vec3& x, double frame, double reach, Vec3& away)>;

/// How a fit ended.
struct WindFit
{
  std::size_t Unknowns = 0; // coefficients that samples touch
  int Iterations = 0;
  double Gradient = 0.0; // left, over that of no wind
  double ChiSquared =
    0.0; // of the wind at the samples by the air's covariance, a degree of freedom
};

/// A sum of WindSplines of several scales with independent coefficients of unit variance: kriging
/// with the covariance of the air (Matheron 1963), whose most probable wind given samples has the
/// least squares of coefficients and misfits. Beside solids it is held back as at walls, as far as
/// each scale's spacing.
class WindCorrection
{
public:
  WindCorrection(const Box& volume, const Timeline& time, const std::vector<WindScale>& scales,
                 DistanceFromSolids distance = nullptr, bool solidsMove = true, bool loops = false);

  /// The most probable wind whose samples, in the order of their frames, are off by `error` [m/s]
  /// (rms of a component); goes on from the wind as it is, by conjugate gradients, until so little
  /// is left of the gradient that it has. The same on any number of threads. False: stopped, the
  /// wind fits as well as it does by then.
  bool Fit(const std::vector<WindSamples>& samples, double error, double left, int iterations,
           const ParallelFor& parallel, Monitor& monitor);
  const WindFit& Fitted() const { return this->Last; }
  Vec3 At(const Vec3& x, double frame) const;
  /// sum = air + W at the points of the lattice, of each field's frame; sum is on the same lattice
  /// and has as many fields. False: stopped, at some frames.
  bool AddTo(const HalfSeries& air, HalfSeries& sum, const ParallelFor& parallel,
             Monitor& monitor) const;

private:
  struct Nearness // of solids
  {
    double Distance = 0.0;
    Vec3 Away = Vec3::Zero();
  };

  /// As far as the largest scale is held back.
  Nearness NearnessAt(const Vec3& x, double frame) const;
  WindHold HoldOf(std::size_t scale, const Nearness& near) const;

  std::vector<WindSplines> Scales;
  std::vector<std::size_t> Begins; // of each scale's coefficients
  Timeline Time;
  DistanceFromSolids Distance;
  bool SolidsMove;
  std::vector<double> Coefficients;
  WindFit Last;
};

} // namespace waft
