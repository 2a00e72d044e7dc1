// SPDX-License-Identifier: BSD-3-Clause
#include "Air/PlainDrift.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

// The square roots of all parts of the cost, one after another: half their squares' sum is the
// cost.
Eigen::VectorXd Residuals(const DriftProblem& problem, const FieldSeries& air,
                          const DriftWeights& weights, const std::vector<Vec3>& x)
{
  const double dt = problem.Time.Step();
  const auto frames = static_cast<Eigen::Index>(x.size());
  Eigen::VectorXd all = Eigen::VectorXd::Zero(9 * frames);
  Vec3 before = Vec3::Zero(), lastVelocity = Vec3::Zero(), lastGiven = Vec3::Zero();
  for (std::size_t k = 0; k + 1 < x.size(); ++k)
  {
    const Vec3 middle = 0.5 * (x[k] + x[k + 1]);
    const Vec3 u = 0.5 * (air.Sample(middle, air.Times[k]) + air.Sample(middle, air.Times[k + 1]));
    const double factor = problem.Ground.Factor(middle, static_cast<double>(k) + 0.5);
    const Vec3 velocity = (x[k + 1] - x[k]) / dt;
    const Vec3 given = u - factor * problem.Law.Slip;
    Vec3 c = velocity - given;
    if (problem.ResponseTime > 0.0 && k > 0)
    {
      const double r = dt / problem.ResponseTime;
      const double e = std::exp(-r);
      const double now = 1.0 - (1.0 - e) / r;
      c = (velocity - e * lastVelocity - (1.0 - e - now) * lastGiven - now * given) / (1.0 - e);
    }
    lastVelocity = velocity;
    lastGiven = given;
    const auto at = static_cast<Eigen::Index>(9 * k);
    all.segment<3>(at) = std::sqrt(dt * problem.Flight[k]) * c;
    if (k > 0)
    {
      const double fraction = std::min(problem.Flight[k], problem.Flight[k - 1]);
      all.segment<3>(at + 3) = std::sqrt(weights.Smoothness * fraction / dt) * (c - before);
    }
    if (k > 0)
    {
      const double free = 1.0 - std::min(problem.Flight[k - 1], problem.Flight[k]);
      const bool isGiven = problem.IsFixed[k - 1] && problem.IsFixed[k] && problem.IsFixed[k + 1];
      const Vec3 bend = (x[k - 1] - 2.0 * x[k] + x[k + 1]) / (dt * dt);
      all.segment<3>(at + 6) = std::sqrt(isGiven ? 0.0 : free * weights.Braking * dt) * bend;
    }
    before = c;
  }
  return all;
}

} // namespace

FieldSeries Unpacked(const HalfSeries& air)
{
  FieldSeries series{ static_cast<const SeriesLattice&>(air) };
  for (std::size_t k = 0; k < air.Values.size(); ++k)
  {
    series.Values.push_back(air.At(k));
  }
  return series;
}

double PlainDriftCost(const DriftProblem& problem, const FieldSeries& air,
                      const DriftWeights& weights, const std::vector<Vec3>& path)
{
  return 0.5 * Residuals(problem, air, weights, path).squaredNorm();
}

double PlainSolveDrift(const DriftProblem& problem, const FieldSeries& air,
                       const DriftWeights& weights, int maximumIterations, std::vector<Vec3>& path)
{
  constexpr double h = 1e-5; // m
  std::vector<std::size_t> free;
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    if (problem.IsFixed[f])
    {
      path[f] = problem.Fixed[f];
    }
    else
    {
      free.push_back(f);
    }
  }
  const auto unknowns = static_cast<Eigen::Index>(3 * free.size());
  Eigen::VectorXd now = Residuals(problem, air, weights, path);
  double damping = 1.0 / problem.Time.Step();
  for (int iteration = 0; iteration < maximumIterations && damping < 1e9; ++iteration)
  {
    Eigen::MatrixXd jacobian(now.size(), unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i)
    {
      double& coordinate = path[free[static_cast<std::size_t>(i / 3)]][i % 3];
      const double held = coordinate;
      coordinate = held + h;
      jacobian.col(i) = Residuals(problem, air, weights, path);
      coordinate = held - h;
      jacobian.col(i) -= Residuals(problem, air, weights, path);
      coordinate = held;
    }
    jacobian /= 2.0 * h;
    const Eigen::VectorXd gradient = jacobian.transpose() * now;
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    bool isLower = false;
    while (!isLower && damping < 1e9)
    {
      Eigen::MatrixXd damped = normal;
      damped.diagonal().array() += damping;
      const Eigen::VectorXd step = -damped.ldlt().solve(gradient);
      std::vector<Vec3> moved = path;
      for (Eigen::Index i = 0; i < unknowns; ++i)
      {
        moved[free[static_cast<std::size_t>(i / 3)]][i % 3] += step[i];
      }
      const Eigen::VectorXd then = Residuals(problem, air, weights, moved);
      isLower = then.squaredNorm() < now.squaredNorm();
      damping = isLower ? std::max(1e-7, damping / 5.0) : 8.0 * damping;
      if (isLower)
      {
        path = std::move(moved);
        now = then;
      }
    }
  }
  return 0.5 * now.squaredNorm();
}

} // namespace waft
