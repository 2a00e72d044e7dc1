// SPDX-License-Identifier: BSD-3-Clause
// Half floats (IEEE 754 binary16) as bits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace waft
{

// Both without branches, so that the compiler takes several at a time.

/// Of a finite half float.
inline float FromHalf(std::uint16_t half)
{
  // The bits of a float of the same digits whose exponent is 112 too low.
  const std::uint32_t low = (half & 0x7fffu) << 13;
  float size;
  std::memcpy(&size, &low, sizeof(size));
  size *= 0x1p112f;
  std::uint32_t bits;
  std::memcpy(&bits, &size, sizeof(bits));
  bits |= (half & 0x8000u) << 16;
  float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

/// The nearest one, the even one of two; the largest where the value is larger or no number.
inline std::uint16_t ToHalf(float value)
{
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  const std::uint32_t sign = (bits >> 16) & 0x8000u;
  const auto size = static_cast<std::int32_t>(bits & 0x7fffffffu);
  const std::int32_t held = std::min(size, std::int32_t{ 0x477fe000 }); // of 65504
  const std::int32_t normal = ((held + 0xfff + ((held >> 13) & 1)) >> 13) - (112 << 10);
  // Below 2^-14 the digits end at 2^-24, as those of floats from 0.5 to 1 do.
  float shifted;
  std::memcpy(&shifted, &held, sizeof(shifted));
  shifted += 0.5f;
  std::int32_t small;
  std::memcpy(&small, &shifted, sizeof(small));
  small -= 0x3f000000;
  const std::int32_t isSmall = (held - 0x38800000) >> 31; // all ones or none
  const std::int32_t digits = (small & isSmall) | (normal & ~isSmall);
  return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(digits));
}

} // namespace waft
