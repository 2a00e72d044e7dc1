// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TiffPacking.h"

#include <zlib.h>

#include <algorithm>
#include <array>

namespace waft
{
namespace
{

bool Inflate(std::string_view packed, std::size_t size, std::string& bytes)
{
  bytes.resize(size);
  z_stream stream = {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(size);
  if (inflateInit(&stream) != Z_OK)
  {
    return false;
  }
  const int state = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  return stream.avail_out == 0 && (state == Z_STREAM_END || state == Z_OK || state == Z_BUF_ERROR);
}

bool UnpackRuns(std::string_view packed, std::size_t size, std::string& bytes)
{
  bytes.reserve(size);
  for (std::size_t at = 0; bytes.size() < size && at < packed.size();)
  {
    const auto head = static_cast<signed char>(packed[at++]);
    if (head >= 0)
    {
      const std::size_t count = std::min<std::size_t>(head + 1, packed.size() - at);
      bytes.append(packed.substr(at, count));
      at += count;
    }
    else if (head != -128 && at < packed.size())
    {
      bytes.append(static_cast<std::size_t>(1 - head), packed[at++]);
    }
  }
  const bool isWhole = bytes.size() >= size;
  bytes.resize(size);
  return isWhole;
}

/// The words of an LZW text, each a former one and a byte more.
class LzwWords
{
public:
  static constexpr int Clear = 256;
  static constexpr int End = 257;

  void Forget() { this->Count = End + 1; }
  /// Bits of the next code; one early, as TIFF has it.
  int Width() const
  {
    return this->Count >= 2047 ? 12 : this->Count >= 1023 ? 11 : this->Count >= 511 ? 10 : 9;
  }
  bool Knows(int code) const { return code < 256 || (code > End && code < this->Count); }
  void Add(int former, char last)
  {
    if (this->Count < 4096)
    {
      this->Former[static_cast<std::size_t>(this->Count)] = former;
      this->Last[static_cast<std::size_t>(this->Count)] = last;
      ++this->Count;
    }
  }
  std::string Word(int code) const
  {
    std::string word;
    for (; code >= 256; code = this->Former[static_cast<std::size_t>(code)])
    {
      word += this->Last[static_cast<std::size_t>(code)];
    }
    word += static_cast<char>(code);
    std::reverse(word.begin(), word.end());
    return word;
  }

private:
  int Count = End + 1;
  std::array<int, 4096> Former{};
  std::array<char, 4096> Last{};
};

bool UnpackLzw(std::string_view packed, std::size_t size, std::string& bytes)
{
  LzwWords words;
  bytes.reserve(size);
  std::string former;
  int formerCode = -1;
  std::uint32_t waiting = 0;
  int bits = 0;
  std::size_t at = 0;
  while (bytes.size() < size)
  {
    for (; bits < words.Width() && at < packed.size(); bits += 8)
    {
      waiting = waiting << 8 | static_cast<unsigned char>(packed[at++]);
    }
    const int width = words.Width();
    if (bits < width)
    {
      return false;
    }
    bits -= width;
    const auto code = static_cast<int>(waiting >> bits & ((1u << width) - 1));
    if (code == LzwWords::End)
    {
      return false;
    }
    if (code == LzwWords::Clear)
    {
      words.Forget();
      formerCode = -1;
      continue;
    }
    if (formerCode < 0)
    {
      if (code >= 256)
      {
        return false;
      }
      former = std::string(1, static_cast<char>(code));
    }
    else
    {
      // A code that is just about to be known is the former word and its own first byte.
      const bool isNext = !words.Knows(code);
      const std::string word = isNext ? former + former[0] : words.Word(code);
      words.Add(formerCode, word[0]);
      if (!words.Knows(code))
      {
        return false;
      }
      former = word;
    }
    formerCode = code;
    bytes += former;
  }
  bytes.resize(size);
  return true;
}

} // namespace

bool IsKnownPacking(std::uint64_t packing)
{
  for (const TiffPacking known : { TiffPacking::None, TiffPacking::Lzw, TiffPacking::Deflate,
                                   TiffPacking::PackBits, TiffPacking::OldDeflate })
  {
    if (packing == static_cast<std::uint64_t>(known))
    {
      return true;
    }
  }
  return false;
}

bool UnpackTiff(TiffPacking packing, std::string_view packed, std::size_t size, std::string& bytes)
{
  bytes.clear();
  switch (packing)
  {
    case TiffPacking::None:
      bytes = packed.substr(0, size);
      return bytes.size() == size;
    case TiffPacking::Lzw:
      return UnpackLzw(packed, size, bytes);
    case TiffPacking::PackBits:
      return UnpackRuns(packed, size, bytes);
    case TiffPacking::Deflate:
    case TiffPacking::OldDeflate:
      break;
  }
  return Inflate(packed, size, bytes);
}

} // namespace waft
