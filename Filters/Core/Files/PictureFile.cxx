// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PictureFile.h"

#include "Files/FileBytes.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace waft
{
namespace
{

Result Cut(const std::string& where)
{
  return Result::Error(where + ": expected more, found the end of the file");
}

// A field of a TIFF directory: its numbers, where they are whole.
using TiffFields = std::map<int, std::vector<std::uint64_t>>;

// Sizes of the types of a TIFF by their numbers; 0: no number that is needed here.
int TiffSize(std::uint64_t type)
{
  return type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 0;
}

Result ReadTiffFields(std::string_view file, ByteOrder order, TiffFields& fields)
{
  const std::uint64_t directory = ReadUnsigned(file, 4, 4, order);
  if (!Holds(file, directory, 2))
  {
    return Cut("directory");
  }
  const std::uint64_t count = ReadUnsigned(file, directory, 2, order);
  if (count == 0 || !Holds(file, directory + 2, 12 * count + 4))
  {
    return Cut("directory");
  }
  std::uint64_t total = 0; // of fields that do not lie one upon the other
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t entry = directory + 2 + 12 * i;
    const int tag = static_cast<int>(ReadUnsigned(file, entry, 2, order));
    const int size = TiffSize(ReadUnsigned(file, entry + 2, 2, order));
    const std::uint64_t length = ReadUnsigned(file, entry + 4, 4, order);
    if (size == 0)
    {
      continue;
    }
    const std::uint64_t bytes = static_cast<std::uint64_t>(size) * length;
    const std::uint64_t offset = bytes <= 4 ? entry + 8 : ReadUnsigned(file, entry + 8, 4, order);
    total += bytes;
    if (!Holds(file, offset, bytes) || total > file.size())
    {
      return Cut("field " + std::to_string(tag));
    }
    for (std::uint64_t k = 0; k < length; ++k)
    {
      fields[tag].push_back(
        ReadUnsigned(file, offset + k * static_cast<std::uint64_t>(size), size, order));
    }
  }
  return Result::Ok();
}

std::uint64_t FieldOf(const TiffFields& fields, int tag, std::uint64_t absent)
{
  const auto found = fields.find(tag);
  return found == fields.end() || found->second.empty() ? absent : found->second[0];
}

// Progressive pictures come in scans, and each goes over all pixels, however few its bytes are.
Result CheckJpegFrame(std::string_view file, std::uint64_t width, std::uint64_t height,
                      std::uint64_t channels)
{
  constexpr std::uint64_t mostPerPixel = 32;
  WAFT_RETURN_IF_FAILED(CheckPictureSize(width, height, channels));
  std::uint64_t scans = 0;
  for (std::size_t at = 0; (at = file.find("\xff\xda", at)) != std::string_view::npos; ++at)
  {
    ++scans;
  }
  return scans * width * height <= mostPerPixel * MostPixels
           ? Result::Ok()
           : Result::Error("expected at most " +
                           std::to_string(mostPerPixel * MostPixels / (width * height)) +
                           " scans of " + std::to_string(width) + " x " + std::to_string(height) +
                           " pixels, found " + std::to_string(scans));
}

} // namespace

Result CheckPictureSize(std::uint64_t width, std::uint64_t height, std::uint64_t pixelBytes)
{
  const std::uint64_t most =
    std::min(MostPixels, MostPixelBytes / std::max<std::uint64_t>(1, pixelBytes));
  const bool fits = width > 0 && height > 0 && width <= most && height <= most / width;
  return fits ? Result::Ok()
              : Result::Error("expected a picture of 1 to " + std::to_string(most) + " pixels of " +
                              std::to_string(pixelBytes) + " bytes, found " +
                              std::to_string(width) + " x " + std::to_string(height));
}

Result CheckJpeg(std::string_view file)
{
  if (file.substr(0, 2) != "\xff\xd8")
  {
    return Result::Error("expected the signature of a JPEG picture, found another file");
  }
  for (std::size_t at = 2;;)
  {
    if (!Holds(file, at, 4))
    {
      return Cut("header");
    }
    const int marker = static_cast<unsigned char>(file[at + 1]);
    if (file[at] != '\xff')
    {
      return Result::Error("byte " + std::to_string(at) + ": expected a marker, found none");
    }
    if (marker == 0xff) // a byte that fills up
    {
      ++at;
      continue;
    }
    const std::size_t size = ReadUnsigned(file, at + 2, 2, ByteOrder::Big);
    if (size < 2 || !Holds(file, at + 2, size))
    {
      return Cut("byte " + std::to_string(at));
    }
    const bool isFrame =
      marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (isFrame)
    {
      return size < 8 ? Cut("frame header")
                      : CheckJpegFrame(file, ReadUnsigned(file, at + 7, 2, ByteOrder::Big),
                                       ReadUnsigned(file, at + 5, 2, ByteOrder::Big),
                                       ReadUnsigned(file, at + 9, 1, ByteOrder::Big));
    }
    if (marker == 0xda || marker == 0xd9)
    {
      return Result::Error("expected a frame header before the data, found none");
    }
    at += 2 + size;
  }
}

Result CheckBmp(std::string_view file)
{
  if (file.substr(0, 2) != "BM")
  {
    return Result::Error("expected the signature of a BMP picture, found another file");
  }
  if (file.size() < 54)
  {
    return Cut("header");
  }
  const auto read = [file](std::size_t at, int size)
  { return ReadUnsigned(file, at, size, ByteOrder::Little); };
  const std::uint64_t width = read(18, 4);
  const auto signedHeight = static_cast<std::int32_t>(read(22, 4));
  const std::uint64_t height = signedHeight < 0 ? -static_cast<std::int64_t>(signedHeight)
                                                : static_cast<std::int64_t>(signedHeight);
  const std::uint64_t bits = read(28, 2);
  if (read(14, 4) < 40 || (bits != 8 && bits != 24) || read(30, 4) != 0)
  {
    return Result::Error("expected 8 or 24 bits a pixel, uncompressed, found " +
                         std::to_string(bits) + " bits, compression " +
                         std::to_string(read(30, 4)));
  }
  WAFT_RETURN_IF_FAILED(CheckPictureSize(width, height, 3));
  const std::uint64_t colors = bits == 8 ? (read(46, 4) > 0 ? read(46, 4) : 256) : 0;
  const std::uint64_t stride = (width * bits / 8 + 3) / 4 * 4;
  if (colors > 256 || read(10, 4) < 14 + read(14, 4) + 4 * colors ||
      !Holds(file, read(10, 4), stride * height))
  {
    return Cut("pixels");
  }
  return Result::Ok();
}

Result CheckTiff(std::string_view file)
{
  const bool isLittle = file.substr(0, 4) == std::string_view("II*\0", 4);
  if (!isLittle && file.substr(0, 4) != std::string_view("MM\0*", 4))
  {
    return Result::Error("expected the signature of a .tif picture, found another file");
  }
  if (file.size() < 8)
  {
    return Cut("header");
  }
  TiffFields fields;
  WAFT_RETURN_IF_FAILED(
    ReadTiffFields(file, isLittle ? ByteOrder::Little : ByteOrder::Big, fields));
  const std::uint64_t width = FieldOf(fields, 256, 0);
  const std::uint64_t height = FieldOf(fields, 257, 0);
  const std::uint64_t channels = FieldOf(fields, 277, 1);
  const std::uint64_t bits = FieldOf(fields, 258, 1);
  const auto& allBits = fields[258];
  const bool isEven = std::all_of(allBits.begin(), allBits.end(),
                                  [bits](std::uint64_t other) { return other == bits; });
  const std::uint64_t meaning = FieldOf(fields, 262, 9);
  if (channels < 1 || channels > 4 || (bits != 8 && bits != 16) || !isEven || meaning > 3 ||
      FieldOf(fields, 339, 1) != 1)
  {
    return Result::Error(
      "expected 1 to 4 channels of 8 or 16 bits in grey, colour or with a palette");
  }
  const std::uint64_t pixelBytes = meaning == 3 ? 4 : channels * bits / 8;
  WAFT_RETURN_IF_FAILED(CheckPictureSize(width, height, pixelBytes));
  if (meaning == 3 && (channels != 1 || bits != 8 || fields[320].size() != 3 * 256))
  {
    return Result::Error("field 320: expected a palette of 256 colours");
  }
  // Tiles, where there are some, or strips.
  const bool isTiled = fields.count(324) > 0;
  const auto& offsets = fields[isTiled ? 324 : 273];
  const auto& sizes = fields[isTiled ? 325 : 279];
  const std::uint64_t along = isTiled ? FieldOf(fields, 322, 0) : width;
  const std::uint64_t down =
    isTiled ? FieldOf(fields, 323, 0) : std::min(height, FieldOf(fields, 278, height));
  WAFT_RETURN_IF_FAILED(CheckPictureSize(along, down, pixelBytes));
  const std::uint64_t planes = FieldOf(fields, 284, 1) == 2 ? channels : 1;
  const std::uint64_t parts = ((width + along - 1) / along) * ((height + down - 1) / down) * planes;
  if (offsets.size() != parts || sizes.size() != parts)
  {
    return Result::Error("expected " + std::to_string(parts) + " strips or tiles, found " +
                         std::to_string(offsets.size()));
  }
  const std::uint64_t partBytes = along * down * (channels / planes) * bits / 8;
  for (std::size_t i = 0; i < offsets.size(); ++i)
  {
    const std::uint64_t last = isTiled ? down : height - (i % (parts / planes)) * down;
    const std::uint64_t least =
      FieldOf(fields, 259, 1) == 1 ? partBytes / down * std::min(down, last) : std::uint64_t{ 1 };
    if (sizes[i] < least || !Holds(file, offsets[i], sizes[i]))
    {
      return Cut("strip or tile " + std::to_string(i));
    }
  }
  return Result::Ok();
}

} // namespace waft
