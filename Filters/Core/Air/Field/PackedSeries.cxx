// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/PackedSeries.h"

#include "Base/Simd.h"

#include <zstd.h>

#include <algorithm>
#include <array>

namespace waft
{
namespace
{

// Bytes that one packed byte may stand for at most: a block of 128 kB of one value takes four.
constexpr std::uint64_t MostUnpacked = 1ULL << 16U;
constexpr std::size_t FramesAtOnce = 16; // in memory until they are written
constexpr int Level = 1;                 // higher ones cost much and find hardly more

using Frames = std::vector<std::vector<Half3>>;
using Planes = std::array<std::vector<unsigned char>, 2>; // low and high bytes
using PackedPlanes = std::array<std::vector<char>, 2>;

// Half floats in the order of their values, and back.
inline std::uint16_t RankOf(std::uint16_t half)
{
  return static_cast<std::uint16_t>((half & 0x8000U) != 0U ? ~half : half | 0x8000U);
}

inline std::uint16_t HalfOf(std::uint16_t rank)
{
  return static_cast<std::uint16_t>((rank & 0x8000U) != 0U ? rank & 0x7fffU : ~rank);
}

// Small differences of either sign as small numbers, and back.
inline std::uint16_t Folded(std::uint16_t difference)
{
  return static_cast<std::uint16_t>((difference << 1U) ^
                                    ((difference & 0x8000U) != 0U ? 0xffffU : 0U));
}

inline std::uint16_t Unfolded(std::uint16_t folded)
{
  return static_cast<std::uint16_t>((folded >> 1U) ^ ((folded & 1U) != 0U ? 0xffffU : 0U));
}

// The rank that a straight line through the two times before leads to; numbers wrap around.
inline std::uint16_t Expected(std::uint16_t last, std::uint16_t before)
{
  return static_cast<std::uint16_t>(2 * RankOf(last) - RankOf(before));
}

// A frame's numbers and those of the two before it.
struct Numbers
{
  std::vector<Half3> Nothing; // before the first frame
  const std::uint16_t *Last, *Before;

  Numbers(const Frames& values, std::size_t k)
  {
    if (k == 0)
    {
      this->Nothing.resize(values[0].size());
    }
    const auto& last = k > 0 ? values[k - 1] : this->Nothing;
    this->Last = last.data()->data();
    this->Before = k > 1 ? values[k - 2].data()->data() : this->Last;
  }
};

WAFT_SIMD_CLONES void Split(const std::uint16_t* now, const std::uint16_t* last,
                            const std::uint16_t* before, std::size_t count, unsigned char* low,
                            unsigned char* high)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint16_t folded =
      Folded(static_cast<std::uint16_t>(RankOf(now[i]) - Expected(last[i], before[i])));
    low[i] = static_cast<unsigned char>(folded & 0xffU);
    high[i] = static_cast<unsigned char>(folded >> 8U);
  }
}

WAFT_SIMD_CLONES void Join(const unsigned char* low, const unsigned char* high,
                           const std::uint16_t* last, const std::uint16_t* before,
                           std::size_t count, std::uint16_t* now)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto folded = static_cast<std::uint16_t>(low[i] | (high[i] << 8U));
    now[i] = HalfOf(static_cast<std::uint16_t>(Unfolded(folded) + Expected(last[i], before[i])));
  }
}

PackedPlanes Packed(const Frames& values, std::size_t k)
{
  const std::size_t count = 3 * values[k].size();
  PackedPlanes packed;
  if (count == 0)
  {
    return packed;
  }
  const Numbers other(values, k);
  Planes planes;
  planes[0].resize(count);
  planes[1].resize(count);
  Split(values[k].data()->data(), other.Last, other.Before, count, planes[0].data(),
        planes[1].data());
  for (std::size_t p = 0; p < planes.size(); ++p)
  {
    packed[p].resize(ZSTD_compressBound(count));
    const std::size_t size =
      ZSTD_compress(packed[p].data(), packed[p].size(), planes[p].data(), count, Level);
    packed[p].resize(ZSTD_isError(size) != 0U ? 0 : size); // which does not happen: there is room
  }
  return packed;
}

} // namespace

void WritePacked(StateArchive& stream, const Frames& values, const ParallelFor& parallel)
{
  const std::uint64_t points = values.empty() ? 0 : values.front().size();
  stream.Length(values);
  stream.Values(points);
  for (std::size_t first = 0; first < values.size() && stream.IsGood(); first += FramesAtOnce)
  {
    std::vector<PackedPlanes> packed(std::min(FramesAtOnce, values.size() - first));
    parallel(packed.size(),
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t k = begin; k < end; ++k)
               {
                 packed[k] = Packed(values, first + k);
               }
             });
    for (const PackedPlanes& frame : packed)
    {
      stream.Values(frame);
    }
  }
}

void ReadPacked(StateArchive& stream, Frames& values)
{
  std::uint64_t points = 0;
  stream.Length(values);
  stream.Values(points);
  if (points > UINT32_MAX / 3)
  {
    stream.Refuse();
    return;
  }
  const std::size_t count = 3 * points;
  for (std::size_t k = 0; k < values.size() && stream.IsGood(); ++k)
  {
    Planes planes;
    for (auto& plane : planes)
    {
      std::vector<char> packed;
      stream.Values(packed);
      if (count > MostUnpacked * packed.size())
      {
        stream.Refuse();
        return;
      }
      plane.resize(count);
      if (count > 0 && ZSTD_decompress(plane.data(), count, packed.data(), packed.size()) != count)
      {
        stream.Refuse();
        return;
      }
    }
    values[k].resize(points);
    if (points > 0)
    {
      const Numbers other(values, k);
      Join(planes[0].data(), planes[1].data(), other.Last, other.Before, count,
           values[k].data()->data());
    }
  }
}

} // namespace waft
