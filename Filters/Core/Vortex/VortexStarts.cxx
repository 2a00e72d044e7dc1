// SPDX-License-Identifier: BSD-3-Clause
#include "Vortex/VortexStarts.h"

#include "Base/Random.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace waft
{

namespace
{

Vec3 PerpendicularTo(const Vec3& axis)
{
  return axis.unitOrthogonal();
}

VortexParameters Perturb(const VortexParameters& base, double width, double amount, Random& random)
{
  VortexParameters p = base;
  const auto normal = [&] { return amount * random.Normal(); };
  for (int axis = 0; axis < 3; ++axis)
  {
    p.Center[axis] += 0.1 * width * normal();
  }
  const Vec3 side =
    Eigen::AngleAxisd(random.Uniform(0.0, 2.0 * M_PI), p.Direction) * PerpendicularTo(p.Direction);
  p.Direction = (p.Direction + 0.4 * normal() * side).normalized();
  p.Shape[LogHalfLength] += 0.5 * normal();
  p.Shape[PeakTime] += 0.4 * std::exp(p.Shape[LogDuration]) * normal();
  p.Shape[LogDuration] += 0.4 * normal();
  p.Shape[LogCore] += 0.6 * normal();
  return p;
}

} // namespace

VortexParameters GuessFromSamples(const std::vector<VortexSample>& samples)
{
  Mat3 spread = Mat3::Zero();
  double total = 0.0;
  double time = 0.0;
  Vec3 mean = Vec3::Zero();
  for (const VortexSample& s : samples)
  {
    const double w = s.Weight * s.Acceleration.norm();
    spread += s.Weight * s.Acceleration * s.Acceleration.transpose();
    total += w;
    time += w * s.Time;
    mean += w * s.Position;
  }
  VortexParameters p;
  if (!(total > 0.0))
  {
    return p;
  }
  time /= total;
  mean /= total;
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(spread);
  p.Direction = eigen.eigenvectors().col(0);
  // f . c = f . x, about the mean position; the ridge decides along the axis.
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  double spreadOfTime = 0.0;
  for (const VortexSample& s : samples)
  {
    normal += s.Weight * s.Acceleration * s.Acceleration.transpose();
    right += s.Weight * s.Acceleration.dot(s.Position - mean) * s.Acceleration;
    const double dt = s.Time - time;
    spreadOfTime += s.Weight * s.Acceleration.norm() * dt * dt;
  }
  normal.diagonal().array() += 0.02 * normal.trace() + 1e-12;
  p.Center = mean + normal.ldlt().solve(right);
  double distance = 0.0;
  for (const VortexSample& s : samples)
  {
    const Vec3 arm = s.Position - p.Center;
    distance += s.Weight * s.Acceleration.norm() * arm.cross(p.Direction).norm();
  }
  distance = std::max(distance / total, 1e-3);
  p.Shape[LogCore] = std::log(0.5 * distance);
  p.Shape[LogHalfLength] = std::log(2.0 * distance);
  p.Shape[PeakTime] = time;
  p.Shape[LogDuration] = 0.5 * std::log(std::max(spreadOfTime / total, 1e-4));
  p.Shape[LinearStrength] = 1.0;
  return p;
}

double FitStrength(const std::vector<VortexSample>& samples, double scale,
                   VortexParameters& parameters)
{
  using Mat4 = Eigen::Matrix4d;
  using Vec4 = Eigen::Vector4d;
  parameters.Shape[LinearStrength] = 1.0;
  std::vector<Vec3> fields(samples.size());
  Mat4 normal = Mat4::Zero();
  Vec4 right = Vec4::Zero();
  double weights = 0.0;
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    const VortexSample& s = samples[n];
    fields[n] = EvaluateVortex(parameters.Center.data(), parameters.Direction.data(),
                               parameters.Shape.data(), s.Position, s.Time, nullptr);
    normal(0, 0) += s.Weight * fields[n].squaredNorm();
    normal.block<1, 3>(0, 1) += s.Weight * fields[n].transpose();
    right(0) += s.Weight * fields[n].dot(s.Acceleration);
    right.tail<3>() += s.Weight * s.Acceleration;
    weights += s.Weight;
  }
  normal.block<3, 1>(1, 0) = normal.block<1, 3>(0, 1).transpose();
  normal.diagonal().tail<3>().array() += 1.5 * weights; // ridge: mostly vortex, some background
  normal(0, 0) += 1e-12 + 1e-9 * normal(0, 0);
  const Vec4 best = normal.ldlt().solve(right);
  parameters.Shape[LinearStrength] = best(0);
  double cost = 0.0;
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    const Vec3 rest = samples[n].Acceleration - best(0) * fields[n] - best.tail<3>();
    cost += samples[n].Weight * std::log1p(rest.squaredNorm() / (scale * scale));
  }
  return cost;
}

std::vector<VortexParameters> ChooseStarts(const std::vector<VortexSample>& samples,
                                           const VortexParameters* prior,
                                           const VortexFitOptions& options,
                                           const VortexLimits& limits, double scale,
                                           std::uint64_t stream)
{
  struct Candidate
  {
    VortexParameters Parameters;
    double Cost;
    std::size_t Number;
  };
  std::vector<Candidate> candidates;
  const auto consider = [&](VortexParameters p)
  {
    limits.Clamp(p);
    const double cost = FitStrength(samples, scale, p);
    limits.Clamp(p);
    if (std::isfinite(cost))
    {
      candidates.push_back({ p, cost, candidates.size() });
    }
  };
  Random random(options.Seed, stream);
  const double width = options.Bounds.Width();
  const VortexParameters guess = GuessFromSamples(samples);
  const int tries = options.NumberOfStarts > 1 ? 8 * options.NumberOfStarts : 0;
  consider(guess);
  for (int n = 0; n < tries; ++n)
  {
    consider(
      Perturb(prior && n % 2 == 0 ? *prior : guess, width, n < tries / 2 ? 0.5 : 1.0, random));
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& l, const Candidate& r)
            { return l.Cost != r.Cost ? l.Cost < r.Cost : l.Number < r.Number; });
  std::vector<VortexParameters> starts;
  if (prior)
  {
    starts.push_back(*prior);
    limits.Clamp(starts.back());
  }
  for (const Candidate& candidate : candidates)
  {
    if (static_cast<int>(starts.size()) < options.NumberOfStarts)
    {
      starts.push_back(candidate.Parameters);
    }
  }
  return starts;
}

} // namespace waft
