// SPDX-License-Identifier: BSD-3-Clause
// The mean motion of the air about an object that flies beside a surface.
#pragma once

namespace waft
{

/// Beside a surface the kernel about an object sees only a fraction 1 - Psi of air, and the sum D
/// over the gas would tell of that much less motion: drag would fade there, and things would drop
/// where they should settle. D is raised to the mean over what air there is.
struct WallCorrection
{
  double Raise; // factor of D: 1 away from surfaces, nearly 1 / (1 - Psi) beside them
  double Slope; // its derivative by Psi

  /// psi: the kernel's mass beyond surfaces, 0 in the open, about 1/2 at a wall; smooth, and 0
  /// where there is no air at all.
  explicit WallCorrection(double psi)
  {
    constexpr double Least = 0.01; // of (1 - Psi)^2
    const double air = 1.0 - psi;
    const double sum = air * air + Least;
    this->Raise = (1.0 + Least) * air / sum;
    this->Slope = (1.0 + Least) * (air * air - Least) / (sum * sum);
  }
};

} // namespace waft
