// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that are the same on every compiler and machine: std:: distributions are not.
#pragma once

#include "Base/Types.h"

#include <cstdint>

namespace waft
{

/// PCG-XSH-RR 64/32 (O'Neill 2014). Streams of one seed are independent sequences: give each
/// object, simulation or thread-independent unit of work a stream of its own.
class Random
{
public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint32_t Bits();
  /// Uniform in [0, 1), 53 bits.
  double Uniform();
  double Uniform(double low, double high) { return low + (high - low) * this->Uniform(); }
  /// Uniform integer in [0, count), count >= 1, without bias.
  std::uint32_t Index(std::uint32_t count);
  /// Standard normal (Box-Muller).
  double Normal();
  /// Uniform in the box.
  Vec3 InBox(const Box& box);
  /// Uniform on the unit sphere.
  Vec3 Direction();

private:
  std::uint64_t State = 0;
  std::uint64_t Increment = 1;
};

} // namespace waft
