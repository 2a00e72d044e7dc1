// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PictureFile.h"

#include "Files/FileBytes.h"

#include <algorithm>
#include <string>

namespace waft
{
namespace
{

Result Cut(const std::string& where)
{
  return Result::Error(where + ": expected more, found the end of the file");
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
      if (size < 8)
      {
        return Cut("frame header");
      }
      if (file[at + 9] == 4)
      {
        return Result::Error("expected a picture in grey or colour, found inks (CMYK)");
      }
      return CheckJpegFrame(file, ReadUnsigned(file, at + 7, 2, ByteOrder::Big),
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

} // namespace waft
