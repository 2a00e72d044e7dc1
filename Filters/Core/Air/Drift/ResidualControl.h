// SPDX-License-Identifier: BSD-3-Clause
// How much of a body's flight is its control's, and how much the air's.
#pragma once

#include "Air/Drift/BodyProblem.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace waft
{

/// Sums over the steps of free flight.
struct ResidualControl
{
  double Control = 0.0; // of squares [m^2/s^2]
  double Flow = 0.0;    // of squares of the air's velocity there
  std::size_t Steps = 0;
  double Rms(double sum) const
  {
    return this->Steps > 0 ? std::sqrt(sum / static_cast<double>(this->Steps)) : 0.0;
  }
};

ResidualControl ResidualControlOf(const BodyProblem& body, const AirSampler& air,
                                  const std::vector<Vec3>& path);

} // namespace waft
