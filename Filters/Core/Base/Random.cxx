// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"

#include <cmath>

namespace waft
{

Random::Random(std::uint64_t seed, std::uint64_t stream) : Increment((stream << 1u) | 1u)
{
  this->Bits();
  this->State += seed;
  this->Bits();
}

std::uint32_t Random::Bits()
{
  const std::uint64_t old = this->State;
  this->State = old * 6364136223846793005ull + this->Increment;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
  const auto rotation = static_cast<std::uint32_t>(old >> 59u);
  return (shifted >> rotation) | (shifted << ((32u - rotation) & 31u));
}

double Random::Uniform()
{
  const std::uint64_t high = this->Bits() >> 5u; // 27 bits
  const std::uint64_t low = this->Bits() >> 6u;  // 26 bits
  return static_cast<double>((high << 26u) | low) * (1.0 / 9007199254740992.0);
}

std::uint32_t Random::Index(std::uint32_t count)
{
  const std::uint32_t threshold = (0u - count) % count;
  for (;;)
  {
    const std::uint32_t bits = this->Bits();
    if (bits >= threshold)
    {
      return bits % count;
    }
  }
}

double Random::Normal()
{
  const double u = 1.0 - this->Uniform();
  const double angle = 2.0 * M_PI * this->Uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(angle);
}

Vec3 Random::InBox(const Box& box)
{
  const double x = this->Uniform(box.Min.x(), box.Max.x());
  const double y = this->Uniform(box.Min.y(), box.Max.y());
  const double z = this->Uniform(box.Min.z(), box.Max.z());
  return { x, y, z };
}

Vec3 Random::Direction()
{
  const double z = this->Uniform(-1.0, 1.0);
  const double angle = this->Uniform(0.0, 2.0 * M_PI);
  const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
  return { ring * std::cos(angle), ring * std::sin(angle), z };
}

} // namespace waft
