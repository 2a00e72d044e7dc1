// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TiffFile.h"

#include "Files/PictureFile.h"
#include "Files/TiffFields.h"
#include "Files/TiffPacking.h"

#include <algorithm>
#include <string>

namespace waft
{
namespace
{

/// Meanings of a pixel (field 262).
constexpr std::uint64_t WhiteIsZero = 0;
constexpr std::uint64_t Colors = 2;
constexpr std::uint64_t Palette = 3;

constexpr std::uint64_t MostUnpacked = 1400; // bytes from one, by any packing

struct TiffLayout
{
  std::size_t Width = 0;
  std::size_t Height = 0;
  std::size_t Channels = 1; // in the file
  std::size_t Bytes = 1;    // a channel
  std::uint64_t Meaning = 0;
  TiffPacking Packing = TiffPacking::None;
  bool IsDifference = false; // each pixel from the one before
  std::size_t Planes = 1;    // each has all strips or tiles
  bool IsTiled = false;
  std::size_t Along = 0; // pixels of a strip or tile
  std::size_t Down = 0;

  std::size_t Across() const { return (this->Width + this->Along - 1) / this->Along; }
  std::size_t PartsOfPlane() const
  {
    return this->Across() * ((this->Height + this->Down - 1) / this->Down);
  }
  /// Rows that a strip or tile holds, those below the picture included.
  std::size_t Rows(std::size_t part) const
  {
    const std::size_t top = part % this->PartsOfPlane() / this->Across() * this->Down;
    return this->IsTiled ? this->Down : std::min(this->Down, this->Height - top);
  }
};

Result CheckMeaning(const TiffFields& fields)
{
  const std::uint64_t channels = fields.Number(277, 1);
  const std::uint64_t bits = fields.Number(258, 1);
  const std::vector<std::uint64_t>& allBits = fields.Numbers(258);
  const bool isEven = std::all_of(allBits.begin(), allBits.end(),
                                  [bits](std::uint64_t other) { return other == bits; });
  const std::uint64_t meaning = fields.Number(262, 9);
  const std::string expected =
    "expected 1 to 4 channels of 8 or 16 bits in grey, colour or with a palette";
  if (meaning == 5)
  {
    return Result::Error(expected + ", found inks (CMYK)");
  }
  if (channels < (meaning == Colors ? 3 : 1) || channels > 4 || (bits != 8 && bits != 16) ||
      !isEven || meaning > Palette || fields.Number(339, 1) != 1)
  {
    return Result::Error(expected + ", found " + std::to_string(channels) + " of " +
                         std::to_string(bits) + " bits, kind " + std::to_string(meaning));
  }
  if (meaning == Palette &&
      (channels != 1 || bits != 8 || fields.Numbers(320).size() != std::size_t{ 3 } * 256))
  {
    return Result::Error("field 320: expected a palette of 256 colours");
  }
  const std::uint64_t packing = fields.Number(259, 1);
  if (!IsKnownPacking(packing) || fields.Number(317, 1) > 2)
  {
    return Result::Error("field 259: expected pixels that are not packed, or by LZW, Deflate or "
                         "PackBits, found packing " +
                         std::to_string(packing));
  }
  return Result::Ok();
}

Result ReadTiffLayout(const TiffFields& fields, TiffLayout& layout)
{
  const std::uint64_t width = fields.Number(256, 0);
  const std::uint64_t height = fields.Number(257, 0);
  WAFT_RETURN_IF_FAILED(CheckMeaning(fields));
  const std::uint64_t pixelBytes =
    fields.Number(262, 9) == Palette ? 4 : fields.Number(277, 1) * fields.Number(258, 1) / 8;
  WAFT_RETURN_IF_FAILED(CheckPictureSize(width, height, pixelBytes));
  layout.Width = width;
  layout.Height = height;
  layout.Channels = fields.Number(277, 1);
  layout.Bytes = fields.Number(258, 1) / 8;
  layout.Meaning = fields.Number(262, 9);
  layout.Packing = static_cast<TiffPacking>(fields.Number(259, 1));
  layout.IsDifference = fields.Number(317, 1) == 2;
  layout.Planes = fields.Number(284, 1) == 2 ? layout.Channels : 1;
  layout.IsTiled = fields.Has(324);
  layout.Along = layout.IsTiled ? fields.Number(322, 0) : width;
  layout.Down =
    layout.IsTiled ? fields.Number(323, 0) : std::min(height, fields.Number(278, height));
  WAFT_RETURN_IF_FAILED(CheckPictureSize(layout.Along, layout.Down, pixelBytes));
  const std::size_t parts = layout.PartsOfPlane() * layout.Planes;
  const std::size_t found = fields.Numbers(layout.IsTiled ? 324 : 273).size();
  if (found != parts || fields.Numbers(layout.IsTiled ? 325 : 279).size() != parts)
  {
    return Result::Error("expected " + std::to_string(parts) + " strips or tiles, found " +
                         std::to_string(found));
  }
  return Result::Ok();
}

/// Adds up a row whose numbers are differences to those of the pixel before.
void SumRow(const TiffLayout& layout, ByteOrder order, std::size_t stride, std::string& part,
            std::size_t begin, std::size_t end)
{
  const std::size_t low = order == ByteOrder::Little ? 0 : layout.Bytes - 1; // the lesser byte
  for (std::size_t at = begin + stride; at < end; at += layout.Bytes)
  {
    unsigned carry = 0;
    for (std::size_t b = 0; b < layout.Bytes; ++b)
    {
      const std::size_t i = at + (b == 0 ? low : layout.Bytes - 1 - low);
      const unsigned sum =
        carry + static_cast<unsigned char>(part[i]) + static_cast<unsigned char>(part[i - stride]);
      part[i] = static_cast<char>(sum);
      carry = sum >> 8;
    }
  }
}

/// All channels of all pixels as the file has them, 8 bits each.
Result ReadChannels(std::string_view file, const TiffFields& fields, const TiffLayout& layout,
                    std::vector<unsigned char>& values)
{
  const std::size_t together = layout.Channels / layout.Planes; // channels in a part
  const std::size_t stride = together * layout.Bytes;
  const std::size_t high = fields.Order() == ByteOrder::Little ? layout.Bytes - 1 : 0;
  std::uint64_t total = 0;
  for (const std::uint64_t size : fields.Numbers(layout.IsTiled ? 325 : 279))
  {
    total += std::min<std::uint64_t>(size, file.size());
  }
  const std::uint64_t wanted = layout.Width * layout.Height * layout.Channels * layout.Bytes;
  if (total * MostUnpacked < wanted)
  {
    return Result::Error("strips or tiles: expected " + std::to_string(wanted) +
                         " bytes of pixels, found " + std::to_string(total) +
                         ", which cannot unpack to so many");
  }
  values.assign(layout.Width * layout.Height * layout.Channels, 0);
  std::string bytes;
  for (std::size_t part = 0; part < layout.PartsOfPlane() * layout.Planes; ++part)
  {
    const std::uint64_t offset = fields.Numbers(layout.IsTiled ? 324 : 273)[part];
    const std::uint64_t size = fields.Numbers(layout.IsTiled ? 325 : 279)[part];
    const std::size_t rows = layout.Rows(part);
    const std::size_t rowBytes = layout.Along * stride;
    const bool isThere = Holds(file, offset, size);
    if (!isThere || !UnpackTiff(layout.Packing, file.substr(offset, size), rows * rowBytes, bytes))
    {
      return Result::Error("strip or tile " + std::to_string(part) + ": expected " +
                           std::to_string(rows) + " rows, found " +
                           (isThere ? "fewer or damaged ones" : "the end of the file"));
    }
    const std::size_t place = part % layout.PartsOfPlane();
    const std::size_t left = place % layout.Across() * layout.Along;
    const std::size_t top = place / layout.Across() * layout.Down;
    const std::size_t first = part / layout.PartsOfPlane(); // channel
    for (std::size_t y = 0; y < rows && top + y < layout.Height; ++y)
    {
      const std::size_t begin = y * rowBytes;
      if (layout.IsDifference)
      {
        SumRow(layout, fields.Order(), stride, bytes, begin, begin + rowBytes);
      }
      for (std::size_t x = 0; x < layout.Along && left + x < layout.Width; ++x)
      {
        const std::size_t pixel = (top + y) * layout.Width + left + x;
        for (std::size_t c = 0; c < together; ++c)
        {
          values[pixel * layout.Channels + first + c] =
            static_cast<unsigned char>(bytes[begin + x * stride + c * layout.Bytes + high]);
        }
      }
    }
  }
  return Result::Ok();
}

/// What the first channel behind the colours is: alpha that the colours are multiplied by (1),
/// alpha beside them (2), something else (0). A file that does not say so means the second one.
std::uint64_t ExtraOf(const TiffFields& fields, std::size_t extra)
{
  return extra == 0 ? 0 : fields.Number(338, 2);
}

} // namespace

Result ReadTiff(std::string_view file, PictureBytes& picture)
{
  TiffFields fields;
  WAFT_RETURN_IF_FAILED(fields.Read(file));
  TiffLayout layout;
  WAFT_RETURN_IF_FAILED(ReadTiffLayout(fields, layout));
  std::vector<unsigned char> values;
  WAFT_RETURN_IF_FAILED(ReadChannels(file, fields, layout, values));
  const std::size_t colors = layout.Meaning == Colors ? 3 : 1; // in the file
  const std::uint64_t extra = ExtraOf(fields, layout.Channels - colors);
  const bool hasAlpha = extra == 1 || extra == 2;
  const std::vector<std::uint64_t>& palette = fields.Numbers(320);
  // Palettes have 16 bits, but some programs write 8.
  const bool isFine =
    std::any_of(palette.begin(), palette.end(), [](std::uint64_t value) { return value > 255; });
  picture = PictureBytes();
  picture.Width = static_cast<int>(layout.Width);
  picture.Height = static_cast<int>(layout.Height);
  const std::size_t shown = layout.Meaning == Palette ? 3 : colors;
  picture.Channels = static_cast<int>(shown) + (hasAlpha ? 1 : 0);
  picture.Values.reserve(layout.Width * layout.Height * static_cast<std::size_t>(picture.Channels));
  for (std::size_t at = 0; at < values.size(); at += layout.Channels)
  {
    const unsigned alpha = hasAlpha ? values[at + colors] : 255u;
    for (std::size_t c = 0; c < shown; ++c)
    {
      unsigned value = values[at + (layout.Meaning == Palette ? 0 : c)];
      if (layout.Meaning == Palette)
      {
        value = static_cast<unsigned>(palette[256 * c + value] >> (isFine ? 8 : 0));
      }
      if (extra == 1 && alpha > 0)
      {
        value = std::min(255u, (255u * value + alpha / 2) / alpha);
      }
      picture.Values.push_back(
        static_cast<unsigned char>(layout.Meaning == WhiteIsZero ? 255u - value : value));
    }
    if (hasAlpha)
    {
      picture.Values.push_back(static_cast<unsigned char>(alpha));
    }
  }
  return Result::Ok();
}

} // namespace waft
