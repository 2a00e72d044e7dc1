// SPDX-License-Identifier: BSD-3-Clause
#include "Air/PackedSeries.h"

#include <zlib.h>

#include <array>

namespace waft
{
namespace
{

// Bytes that one packed byte may stand for at most: zlib's are 1032.
constexpr std::uint64_t MostUnpacked = 1100;

using Planes = std::array<std::vector<unsigned char>, 2>; // low and high bytes

// Half floats in the order of their values, and back.
std::uint16_t RankOf(std::uint16_t half)
{
  return static_cast<std::uint16_t>((half & 0x8000U) != 0U ? ~half : half | 0x8000U);
}

std::uint16_t HalfOf(std::uint16_t rank)
{
  return static_cast<std::uint16_t>((rank & 0x8000U) != 0U ? rank & 0x7fffU : ~rank);
}

// Small differences of either sign as small numbers, and back.
std::uint16_t Folded(std::uint16_t difference)
{
  return static_cast<std::uint16_t>((difference << 1U) ^
                                    ((difference & 0x8000U) != 0U ? 0xffffU : 0U));
}

std::uint16_t Unfolded(std::uint16_t folded)
{
  return static_cast<std::uint16_t>((folded >> 1U) ^ ((folded & 1U) != 0U ? 0xffffU : 0U));
}

// The rank that a straight line through the two times before leads to; numbers wrap around.
std::uint16_t Expected(const std::vector<std::vector<Half3>>& values, std::size_t k, std::size_t i,
                       std::size_t axis)
{
  if (k == 0)
  {
    return RankOf(0);
  }
  const std::uint16_t last = RankOf(values[k - 1][i][axis]);
  return k == 1 ? last : static_cast<std::uint16_t>(2 * last - RankOf(values[k - 2][i][axis]));
}

Planes Differences(const std::vector<std::vector<Half3>>& values, std::size_t k)
{
  Planes planes;
  for (auto& plane : planes)
  {
    plane.reserve(3 * values[k].size());
  }
  for (std::size_t i = 0; i < values[k].size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::uint16_t folded = Folded(
        static_cast<std::uint16_t>(RankOf(values[k][i][axis]) - Expected(values, k, i, axis)));
      planes[0].push_back(static_cast<unsigned char>(folded & 0xffU));
      planes[1].push_back(static_cast<unsigned char>(folded >> 8U));
    }
  }
  return planes;
}

void AddDifferences(const Planes& planes, std::vector<std::vector<Half3>>& values, std::size_t k)
{
  for (std::size_t i = 0; i < values[k].size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t offset = 3 * i + axis;
      const auto folded = static_cast<std::uint16_t>(planes[0][offset] | (planes[1][offset] << 8U));
      values[k][i][axis] =
        HalfOf(static_cast<std::uint16_t>(Unfolded(folded) + Expected(values, k, i, axis)));
    }
  }
}

// Low bytes have hardly any repetition, high ones hardly anything else: a search of matches that
// zlib is known for would cost much and find nothing.
std::vector<char> Packed(const std::vector<unsigned char>& bytes, int strategy)
{
  z_stream stream{};
  deflateInit2(&stream, 1, Z_DEFLATED, 15, 8, strategy);
  std::vector<char> packed(deflateBound(&stream, bytes.size()));
  stream.next_in = const_cast<unsigned char*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<unsigned char*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

bool Unpack(const std::vector<char>& packed, std::vector<unsigned char>& bytes)
{
  uLongf size = bytes.size();
  return uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(packed.data()),
                    packed.size()) == Z_OK &&
         size == bytes.size();
}

// What was read cannot be: more is asked for than any stream has.
void Refuse(StateArchive& stream)
{
  stream.Raw(nullptr, SIZE_MAX);
}

void Write(StateArchive& stream, const std::vector<std::vector<Half3>>& values)
{
  for (std::size_t k = 0; k < values.size() && stream.IsGood(); ++k)
  {
    const Planes planes = Differences(values, k);
    for (std::size_t p = 0; p < planes.size(); ++p)
    {
      std::vector<char> packed = Packed(planes[p], p == 0 ? Z_HUFFMAN_ONLY : Z_RLE);
      stream.List(packed);
    }
  }
}

void Read(StateArchive& stream, std::vector<std::vector<Half3>>& values, std::size_t points)
{
  for (std::size_t k = 0; k < values.size() && stream.IsGood(); ++k)
  {
    Planes planes;
    for (auto& plane : planes)
    {
      std::vector<char> packed;
      stream.List(packed);
      if (3 * points > MostUnpacked * packed.size())
      {
        Refuse(stream);
        return;
      }
      plane.resize(3 * points);
      if (!Unpack(packed, plane))
      {
        Refuse(stream);
        return;
      }
    }
    values[k].resize(points);
    AddDifferences(planes, values, k);
  }
}

} // namespace

void SerialisePacked(StateArchive& stream, std::vector<std::vector<Half3>>& values)
{
  std::uint64_t points = values.empty() ? 0 : values.front().size();
  stream.List(values, [](StateArchive&, std::vector<Half3>&) {}); // their number
  stream.Value(points);
  if (!stream.IsReading())
  {
    Write(stream, values);
  }
  else if (points > UINT32_MAX / 3)
  {
    Refuse(stream);
  }
  else
  {
    Read(stream, values, static_cast<std::size_t>(points));
  }
}

} // namespace waft
