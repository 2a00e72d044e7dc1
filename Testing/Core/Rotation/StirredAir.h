// SPDX-License-Identifier: BSD-3-Clause
// Turbulent air by its spectrum alone.
#pragma once

#include "Base/Random.h"
#include "Base/Types.h"

#include <cmath>
#include <vector>

namespace waft::fixtures
{

/// A kinematic simulation (Fung, Hunt, Malik, Perkins 1992): waves of random directions and phases,
/// free of divergence, with von Karman's spectrum between thrice the integral length and the length
/// of the smallest eddies, each turning at half the rate of its eddies. Of fluctuation 0 it is
/// calm.
class StirredAir
{
public:
  /// fluctuation: m/s, root mean square of each component. integral, least: m. sign: +1, or -1 for
  /// the same air blowing the other way.
  StirredAir(double fluctuation, double integral, double least, double sign, Random random)
  {
    constexpr int Number = 80;
    const double first = 2.0 * Pi / (3.0 * integral);
    const double ratio = std::pow(2.0 * Pi / least / first, 1.0 / Number);
    const double peak = 2.0 * Pi / (1.3 * integral);
    double all = 0.0;
    std::vector<double> numbers, shares;
    for (int i = 0; i < Number; ++i)
    {
      const double k = first * std::pow(ratio, i + 0.5);
      const double x = k / peak;
      numbers.push_back(k);
      shares.push_back(std::pow(x, 4) / std::pow(1.0 + x * x, 17.0 / 6.0) * k);
      all += shares.back();
    }
    for (int i = 0; i < Number && fluctuation > 0.0; ++i)
    {
      // Of two amplitudes of any direction across k the sum of squares is 3 u'^2 of this share.
      const double energy = 1.5 * fluctuation * fluctuation * shares[i] / all;
      const Vec3 way = random.Direction();
      const auto across = [&]()
      {
        const Vec3 d = random.Direction();
        return Vec3(sign * std::sqrt(2.0 * energy) * (d - d.dot(way) * way).normalized());
      };
      const double eddies = std::sqrt(energy / std::log(ratio)); // k E(k) is energy over d ln k
      const double rate = 0.5 * numbers[i] * eddies * (random.Uniform() < 0.5 ? -1.0 : 1.0);
      this->Waves.push_back({ numbers[i] * way, across(), across(), rate });
    }
  }

  /// Velocity [m/s] and gradient d u_r / d x_c [1/s].
  Vec3 At(const Vec3& x, double time, Mat3& gradient) const
  {
    Vec3 u = Vec3::Zero();
    gradient.setZero();
    for (const Wave& wave : this->Waves)
    {
      const double phase = wave.Number.dot(x) + wave.Rate * time;
      const double c = std::cos(phase);
      const double s = std::sin(phase);
      u += c * wave.A + s * wave.B;
      gradient += (c * wave.B - s * wave.A) * wave.Number.transpose();
    }
    return u;
  }

private:
  static constexpr double Pi = 3.14159265358979323846;
  struct Wave
  {
    Vec3 Number, A, B;
    double Rate;
  };
  std::vector<Wave> Waves;
};

} // namespace waft::fixtures
