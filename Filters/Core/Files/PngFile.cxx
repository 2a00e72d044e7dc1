// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PngFile.h"

#include "Files/FileBytes.h"
#include "Files/PictureFile.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <vector>

namespace waft
{
namespace
{

constexpr std::string_view Signature("\x89PNG\r\n\x1a\n", 8);

std::uint32_t Read32(std::string_view bytes, std::size_t at)
{
  return static_cast<std::uint32_t>(ReadUnsigned(bytes, at, 4, ByteOrder::Big));
}

// What the header says of the pixels.
struct Header
{
  std::uint32_t Width = 0;
  std::uint32_t Height = 0;
  int Depth = 0;
  int Color = 0;
  bool IsInterlaced = false;

  int Channels() const
  {
    return this->Color == 2 ? 3 : this->Color == 4 ? 2 : this->Color == 6 ? 4 : 1;
  }
  int BitsOfPixel() const { return this->Channels() * this->Depth; }
};

Result ReadHeader(std::string_view data, Header& header)
{
  if (data.size() != 13)
  {
    return Result::Error("chunk IHDR: expected 13 bytes, found " + std::to_string(data.size()));
  }
  header.Width = Read32(data, 0);
  header.Height = Read32(data, 4);
  header.Depth = static_cast<unsigned char>(data[8]);
  header.Color = static_cast<unsigned char>(data[9]);
  header.IsInterlaced = data[12] == 1;
  const int depth = header.Depth;
  const bool isWhole = depth == 8 || depth == 16;
  const bool isPart = depth == 1 || depth == 2 || depth == 4;
  const int color = header.Color;
  const bool isKnown = color == 0                               ? isWhole || isPart
                       : color == 3                             ? isPart || depth == 8
                       : color == 2 || color == 4 || color == 6 ? isWhole
                                                                : false;
  if (!isKnown)
  {
    return Result::Error("chunk IHDR: expected a colour type with a depth that it may have, found "
                         "type " +
                         std::to_string(color) + " with " + std::to_string(depth) + " bits");
  }
  // Colours of a palette are unpacked, and parts of a byte to a byte.
  const int unpacked = (color == 3 ? 4 : header.Channels()) * (depth == 16 ? 2 : 1);
  WAFT_RETURN_IF_FAILED(
    CheckPictureSize(header.Width, header.Height, static_cast<std::uint64_t>(unpacked)));
  if (data[10] != 0 || data[11] != 0 || static_cast<unsigned char>(data[12]) > 1)
  {
    return Result::Error("chunk IHDR: expected a known compression, filter and interlacing");
  }
  return Result::Ok();
}

// The rows of each pass with their bytes, the filter's one included.
struct Pass
{
  std::uint64_t Rows = 0;
  std::uint64_t Stride = 0;
};

std::vector<Pass> PassesOf(const Header& header)
{
  const auto pass = [&](std::uint32_t x, std::uint32_t y, std::uint32_t dx, std::uint32_t dy)
  {
    const std::uint64_t width = header.Width > x ? (header.Width - x + dx - 1) / dx : 0;
    const std::uint64_t rows = header.Height > y ? (header.Height - y + dy - 1) / dy : 0;
    const auto bits = static_cast<std::uint64_t>(header.BitsOfPixel());
    return Pass{ width > 0 ? rows : 0, 1 + (width * bits + 7) / 8 };
  };
  if (!header.IsInterlaced)
  {
    return { pass(0, 0, 1, 1) };
  }
  return { pass(0, 0, 8, 8), pass(4, 0, 8, 8), pass(0, 4, 4, 8), pass(2, 0, 4, 4),
           pass(0, 2, 2, 4), pass(1, 0, 2, 2), pass(0, 1, 1, 2) };
}

// Counts unpacked bytes off against the rows and looks at the filter of each.
class RowCount
{
public:
  explicit RowCount(const Header& header) : Passes(PassesOf(header)) {}

  bool Take(const unsigned char* bytes, std::size_t size)
  {
    while (size > 0)
    {
      this->SkipFinished();
      if (this->At == this->Passes.size() || (this->Used == 0 && bytes[0] > 4))
      {
        return false;
      }
      const std::uint64_t part =
        std::min<std::uint64_t>(size, this->Passes[this->At].Stride - this->Used);
      bytes += part;
      size -= part;
      this->Used += part;
      if (this->Used == this->Passes[this->At].Stride)
      {
        this->Used = 0;
        --this->Passes[this->At].Rows;
      }
    }
    return true;
  }
  bool IsWhole()
  {
    this->SkipFinished();
    return this->At == this->Passes.size();
  }

private:
  void SkipFinished()
  {
    while (this->At < this->Passes.size() && this->Passes[this->At].Rows == 0)
    {
      ++this->At;
    }
  }

  std::vector<Pass> Passes;
  std::size_t At = 0;
  std::uint64_t Used = 0; // bytes of the current row
};

Result CheckPixels(const std::string& packed, const Header& header)
{
  z_stream stream = {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  if (inflateInit(&stream) != Z_OK)
  {
    return Result::Error("chunk IDAT: cannot be unpacked");
  }
  RowCount rows(header);
  std::array<unsigned char, 65536> part;
  int state = Z_OK;
  bool fits = true;
  while (state == Z_OK && fits)
  {
    stream.next_out = part.data();
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    fits = rows.Take(part.data(), part.size() - stream.avail_out);
  }
  const bool isWhole = state == Z_STREAM_END && fits && rows.IsWhole() && stream.avail_in == 0;
  inflateEnd(&stream);
  return isWhole
           ? Result::Ok()
           : Result::Error("chunk IDAT: expected packed rows of " + std::to_string(header.Width) +
                           " x " + std::to_string(header.Height) + " pixels, found damaged ones");
}

// The chunks that pixels need, as they are gathered.
struct Chunks
{
  Header Head;
  std::string Palette;
  std::string Transparency;
  std::string Pixels;
};

Result CheckPalette(const Chunks& chunks)
{
  const int color = chunks.Head.Color;
  const std::size_t entries = chunks.Palette.size() / 3;
  if (color == 3 && (chunks.Palette.size() % 3 != 0 || entries < 1 ||
                     entries > (std::size_t{ 1 } << chunks.Head.Depth)))
  {
    return Result::Error("chunk PLTE: expected 1 to " + std::to_string(1 << chunks.Head.Depth) +
                         " colours of 3 bytes, found " + std::to_string(chunks.Palette.size()) +
                         " bytes");
  }
  const std::size_t size = chunks.Transparency.size();
  const bool fits = size == 0 || (color == 0   ? size == 2
                                  : color == 2 ? size == 6
                                               : color == 3 && size <= entries);
  return fits ? Result::Ok()
              : Result::Error("chunk tRNS: expected the size that goes with colour type " +
                              std::to_string(color) + ", found " + std::to_string(size) + " bytes");
}

void AppendChunk(std::string& png, std::string_view type, std::string_view data)
{
  const auto append32 = [&png](std::uint32_t value)
  {
    for (int shift = 24; shift >= 0; shift -= 8)
    {
      png += static_cast<char>(value >> shift);
    }
  };
  append32(static_cast<std::uint32_t>(data.size()));
  const std::size_t start = png.size();
  png.append(type).append(data);
  const auto* bytes = reinterpret_cast<const Bytef*>(png.data() + start);
  append32(static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(png.size() - start))));
}

} // namespace

Result SoundPng(std::string_view file, std::string& sound)
{
  if (file.substr(0, Signature.size()) != Signature)
  {
    return Result::Error("expected the signature of a PNG picture, found another file");
  }
  Chunks chunks;
  std::string_view header;
  bool hasEnd = false;
  for (std::size_t at = Signature.size(); !hasEnd;)
  {
    const std::string location = "byte " + std::to_string(at) + ": ";
    if (!Holds(file, at, 12) || !Holds(file, at + 12, Read32(file, at)))
    {
      return Result::Error(location + "expected a whole chunk, found the end of the file");
    }
    const std::uint32_t size = Read32(file, at);
    const std::string_view type = file.substr(at + 4, 4);
    const std::string_view data = file.substr(at + 8, size);
    const auto* bytes = reinterpret_cast<const Bytef*>(file.data() + at + 4);
    if (crc32(0, bytes, size + 4) != Read32(file, at + 8 + size))
    {
      return Result::Error(location + "chunk " + Quoted(type) + ": its checksum is wrong");
    }
    if (header.empty() != (type == "IHDR"))
    {
      return Result::Error(location + "expected one chunk IHDR, the first");
    }
    if (type == "IHDR")
    {
      WAFT_RETURN_IF_FAILED(ReadHeader(data, chunks.Head));
      header = data;
    }
    else if (type == "PLTE")
    {
      chunks.Palette = data;
    }
    else if (type == "tRNS")
    {
      chunks.Transparency = data;
    }
    else if (type == "IDAT")
    {
      chunks.Pixels += data;
    }
    else if (type != "IEND" && type[0] >= 'A' && type[0] <= 'Z')
    {
      return Result::Error(location + "expected a known chunk, found " + Quoted(type));
    }
    hasEnd = type == "IEND";
    at += 12 + std::size_t{ size };
  }
  WAFT_RETURN_IF_FAILED(CheckPalette(chunks));
  WAFT_RETURN_IF_FAILED(CheckPixels(chunks.Pixels, chunks.Head));
  sound = Signature;
  AppendChunk(sound, "IHDR", header);
  if (chunks.Head.Color == 3)
  {
    AppendChunk(sound, "PLTE", chunks.Palette);
  }
  if (!chunks.Transparency.empty())
  {
    AppendChunk(sound, "tRNS", chunks.Transparency);
  }
  AppendChunk(sound, "IDAT", chunks.Pixels);
  AppendChunk(sound, "IEND", {});
  return Result::Ok();
}

} // namespace waft
