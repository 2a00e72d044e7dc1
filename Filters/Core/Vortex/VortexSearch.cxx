// SPDX-License-Identifier: BSD-3-Clause
#include "Vortex/VortexSearch.h"

#include "Vortex/VortexCosts.h"
#include "Vortex/VortexStarts.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/sphere_manifold.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <deque>

namespace waft
{

namespace
{

struct Fit
{
  VortexParameters P;
  Vec3 Background = Vec3::Zero();
  double Cost = 1e300;
};

/// One Levenberg-Marquardt run from fit.P; noise: standard deviation of a component [m/s^2].
void Descend(const std::vector<VortexSample>& samples, const VortexBelief& belief,
             const VortexLimits& limits, bool freeBackground, double noise, int iterations,
             Fit& fit)
{
  ceres::Problem::Options problemOptions;
  problemOptions.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problemOptions.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problemOptions.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problemOptions.disable_all_safety_checks = true;
  ceres::CauchyLoss loss(3.0); // in units of the noise
  ceres::SphereManifold<3> sphere;
  BeliefCost beliefCost(belief);
  std::deque<SampleCost> costs; // Ceres keeps addresses
  ceres::Problem problem(problemOptions);
  double* c = fit.P.Center.data();
  double* d = fit.P.Direction.data();
  double* s = fit.P.Shape.data();
  double* b = fit.Background.data();
  problem.AddParameterBlock(c, 3);
  problem.AddParameterBlock(d, 3, &sphere);
  problem.AddParameterBlock(s, ShapeSize);
  problem.AddParameterBlock(b, 3);
  for (const VortexSample& sample : samples)
  {
    costs.emplace_back(sample.Position, sample.Time, sample.Acceleration,
                       std::sqrt(sample.Weight) / noise);
    problem.AddResidualBlock(&costs.back(), &loss, c, d, s, b);
  }
  problem.AddResidualBlock(&beliefCost, nullptr, c, d, s, b);
  for (int k = 0; k < 3; ++k)
  {
    problem.SetParameterLowerBound(c, k, limits.Center.Min[k]);
    problem.SetParameterUpperBound(c, k, limits.Center.Max[k]);
  }
  for (int k = 0; k < ShapeSize; ++k)
  {
    problem.SetParameterLowerBound(s, k, limits.Low[k]);
    problem.SetParameterUpperBound(s, k, limits.High[k]);
  }
  if (!freeBackground)
  {
    problem.SetParameterBlockConstant(b);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.num_threads = 1;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-7;
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  fit.Cost = summary.IsSolutionUsable() ? summary.final_cost : 1e300;
  fit.P.Direction.normalize();
}

VortexBelief BeliefOf(const VortexParameters* prior, const VortexParameters& start,
                      const VortexFitOptions& o, double rms)
{
  VortexBelief belief;
  const double width = o.Bounds.Width();
  belief.BackgroundPrecision = 1.0 / (0.5 * rms);
  if (prior)
  {
    belief.Mean = *prior;
    belief.CenterPrecision = 1.0 / (o.CenterDeviation * width);
    belief.DirectionPrecision = 1.0 / o.AxisDeviation;
    belief.ShapePrecision.setConstant(1.0 / o.ShapeDeviation);
    belief.ShapePrecision[PeakTime] = 1.0 / o.TimeDeviation;
    belief.ShapePrecision[LinearStrength] =
      1.0 / (o.StrengthDeviation * std::max(std::abs(prior->Shape[LinearStrength]), 1e-3));
    return belief;
  }
  // Without a prior only the order of magnitude of the sizes is believed (a vortex is about a third
  // of the volume wide, section 6 of the paper, and about as long as the volume).
  belief.Mean = start;
  belief.Mean.Shape[LogCore] = std::log(0.08 * width);
  belief.Mean.Shape[LogHalfLength] = std::log(0.3 * width);
  belief.ShapePrecision[LogCore] = 1.0;
  belief.ShapePrecision[LogHalfLength] = 1.0;
  belief.ShapePrecision[LogDuration] = 0.5;
  return belief;
}

std::vector<VortexSample> Thinned(const std::vector<VortexSample>& samples, std::size_t most)
{
  const std::size_t stride = (samples.size() + most - 1) / most;
  std::vector<VortexSample> kept;
  for (std::size_t n = 0; n < samples.size(); n += std::max<std::size_t>(stride, 1))
  {
    kept.push_back(samples[n]);
  }
  return kept;
}

Vec3 Remains(const VortexSample& s, const Fit& fit)
{
  return s.Acceleration - fit.Background -
         EvaluateVortex(fit.P.Center.data(), fit.P.Direction.data(), fit.P.Shape.data(), s.Position,
                        s.Time, nullptr);
}

/// Standard deviation of a component from the median of |remains|^2, at least a floor.
double RobustNoise(const std::vector<VortexSample>& samples, const Fit& fit, double floor)
{
  std::vector<double> squares;
  squares.reserve(samples.size());
  for (const VortexSample& s : samples)
  {
    squares.push_back(Remains(s, fit).squaredNorm());
  }
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::max(std::sqrt(*middle / 2.366), floor); // median of chi^2 with 3 degrees
}

/// From the covariance of the data alone, neighbours along a track counted as one in four.
double PrecisionOf(const std::vector<VortexSample>& samples, const Fit& fit, double noise,
                   double width)
{
  constexpr int size = 6 + ShapeSize + 2; // center, tangent of direction (2), shape, background
  using Matrix = Eigen::Matrix<double, size, size>;
  using Block = Eigen::Matrix<double, 3, size>;
  Eigen::Matrix<double, 3, 2> tangent;
  tangent.col(0) = fit.P.Direction.unitOrthogonal();
  tangent.col(1) = fit.P.Direction.cross(tangent.col(0));
  Matrix information = Matrix::Zero();
  for (const VortexSample& s : samples)
  {
    VortexJacobian j;
    EvaluateVortex(fit.P.Center.data(), fit.P.Direction.data(), fit.P.Shape.data(), s.Position,
                   s.Time, &j);
    Block block;
    block.leftCols<3>() = j.Center;
    block.middleCols<2>(3) = j.Direction * tangent;
    block.middleCols<ShapeSize>(5) = j.Shape;
    block.rightCols<3>() = Mat3::Identity();
    information += (0.25 * s.Weight / (noise * noise)) * block.transpose() * block;
  }
  // Nothing is unknown by more than this: the matrix can always be inverted.
  const double strength = std::max(std::abs(fit.P.Shape[LinearStrength]), 1e-6);
  Eigen::Matrix<double, size, 1> widest;
  widest << width, width, width, 1.5, 1.5, 2.0, 3.0 * strength, 5.0, 2.0, 2.0, 10.0, 10.0, 10.0;
  information.diagonal() += widest.cwiseInverse().cwiseAbs2();
  const Matrix covariance = information.ldlt().solve(Matrix::Identity());
  const double center = covariance.diagonal().head<3>().sum() / (0.01 * width * width);
  const double axis = covariance.diagonal().segment<2>(3).sum() / (0.26 * 0.26);
  const double relative =
    covariance(5 + LinearStrength, 5 + LinearStrength) / (0.09 * strength * strength);
  const double time = covariance(5 + PeakTime, 5 + PeakTime) / 0.16;
  return 1.0 / (1.0 + std::max({ center, axis, relative, time }));
}

} // namespace

VortexLimits::VortexLimits(const VortexFitOptions& o)
{
  const double width = o.Bounds.Width();
  const Vec3 margin = Vec3::Constant(0.25 * width);
  this->Center = Box{ o.Bounds.Min - margin, o.Bounds.Max + margin };
  this->Low << std::log(0.5 * o.MinimumLength * width), -o.MaximumStrength, -1e6,
    std::log(o.MinimumDuration), std::log(o.MinimumCoreRadius * width);
  this->High << std::log(0.5 * o.MaximumLength * width), o.MaximumStrength, 1e6,
    std::log(o.MaximumDuration), std::log(o.MaximumCoreRadius * width);
}

void VortexLimits::Clamp(VortexParameters& p) const
{
  p.Center = p.Center.cwiseMax(this->Center.Min).cwiseMin(this->Center.Max);
  p.Shape = p.Shape.cwiseMax(this->Low).cwiseMin(this->High);
}

VortexSearchResult SearchVortex(const std::vector<VortexSample>& samples,
                                const VortexParameters* start, const VortexParameters* prior,
                                const VortexFitOptions& options, std::uint64_t stream,
                                Monitor& monitor, bool& stopped)
{
  const std::vector<VortexSample> all =
    Thinned(samples, static_cast<std::size_t>(options.MaximumSamples));
  const std::vector<VortexSample> few = Thinned(all, 120);
  double energy = 0.0;
  double weights = 0.0;
  for (const VortexSample& s : all)
  {
    energy += s.Weight * s.Acceleration.squaredNorm();
    weights += s.Weight;
  }
  const double rms = std::max(std::sqrt(energy / std::max(weights, 1e-300)), 1e-9);
  const double coarse = 0.2 * rms;
  VortexLimits limits(options);
  limits.Low[PeakTime] = start ? start->Shape[PeakTime] : all.front().Time;
  limits.High[PeakTime] = limits.Low[PeakTime];
  for (const VortexSample& s : all)
  {
    limits.Low[PeakTime] = std::min(limits.Low[PeakTime], s.Time - 2.0);
    limits.High[PeakTime] = std::max(limits.High[PeakTime], s.Time + 2.0);
  }
  const std::vector<VortexParameters> starts =
    ChooseStarts(few, start, options, limits, coarse, stream);
  Fit best;
  best.P = start ? *start : GuessFromSamples(few);
  limits.Clamp(best.P);
  for (std::size_t n = 0; n < starts.size() && !stopped; ++n)
  {
    stopped = !monitor.Tick(0.0, "Searching a vortex");
    Fit fit;
    fit.P = starts[n];
    Descend(few, BeliefOf(prior, starts[n], options, rms), limits, options.UniformBackground,
            coarse, 15, fit);
    best = fit.Cost < best.Cost ? fit : best;
  }
  const VortexBelief belief = BeliefOf(prior, best.P, options, rms);
  double noise = RobustNoise(all, best, 0.02 * rms);
  for (int pass = 0; pass < 2 && !stopped; ++pass)
  {
    stopped = !monitor.Tick(0.0, "Refining a vortex");
    Fit fit = best;
    Descend(all, belief, limits, options.UniformBackground, noise, 25, fit);
    best = fit.Cost < 1e300 ? fit : best;
    noise = RobustNoise(all, best, 0.02 * rms);
  }
  VortexSearchResult result;
  result.Parameters = best.P;
  result.Background = best.Background;
  result.Cost = best.Cost;
  result.Noise = noise;
  double without = 0.0;
  double left = 0.0;
  for (const VortexSample& s : all)
  {
    without += s.Weight * (s.Acceleration - best.Background).squaredNorm();
    left += s.Weight * Remains(s, best).squaredNorm();
  }
  result.Explained = without > 0.0 ? std::clamp(1.0 - left / without, 0.0, 1.0) : 0.0;
  result.Precision = PrecisionOf(all, best, noise, options.Bounds.Width());
  return result;
}

} // namespace waft
