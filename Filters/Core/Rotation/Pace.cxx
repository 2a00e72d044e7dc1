// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Pace.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{
const double Degree = std::acos(-1.0) / 180.0;
const double FollowedRate = 20.0 * 30.0 * Degree; // rad/s, of steady tumbling, and easily
const double FastestRate = 40.0 * 30.0 * Degree;  // rad/s, of gusts and flutter besides
constexpr double EasingRate = 80.0;               // 1/s, of what is above that
constexpr double TipRatio = 0.8;                  // of the flight's speed: Iversen's, long spans
} // namespace

double MostTurn(double maximumTurn, const Timeline& time)
{
  return maximumTurn > 0.0 ? maximumTurn * Degree
                           : std::min(FastestRate * time.Step(), 180.0 * Degree);
}

double PaceOf(const FlightBody& body, const ShellProperties& properties, double speed)
{
  if (!body.Slips)
  {
    return 1.0;
  }
  // Of the same second moment across its length as a strip of this width.
  const Eigen::SelfAdjointEigenSolver<Mat3> spread(properties.SecondMoment, Eigen::EigenvaluesOnly);
  const double width = std::sqrt(12.0 * std::max(spread.eigenvalues()[1], 0.0));
  return std::min(1.0, FollowedRate * 0.5 * width / std::max(TipRatio * speed, 1e-12));
}

TurningEase EaseAt(double pace)
{
  return { FollowedRate / pace, EasingRate / pace };
}

} // namespace waft
