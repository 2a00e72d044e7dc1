// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PictureOrientation.h"

#include "Files/FileBytes.h"
#include "Files/TiffFields.h"

namespace waft
{
namespace
{

constexpr std::string_view ExifMark("Exif\0\0", 6);

// Of the first directory alone; Exif holds much else, which need not be right.
int OrientationOfTiff(std::string_view tiff)
{
  ByteOrder order = ByteOrder::Little;
  if (!IsTiff(tiff, order) || tiff.size() < 8)
  {
    return 1;
  }
  const std::uint64_t directory = ReadUnsigned(tiff, 4, 4, order);
  const std::uint64_t count =
    Holds(tiff, directory, 2) ? ReadUnsigned(tiff, directory, 2, order) : 0;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    constexpr std::uint64_t tag = 274;
    constexpr std::uint64_t shortNumber = 3;
    const std::uint64_t entry = directory + 2 + 12 * i;
    if (!Holds(tiff, entry, 12))
    {
      return 1;
    }
    if (ReadUnsigned(tiff, entry, 2, order) == tag &&
        ReadUnsigned(tiff, entry + 2, 2, order) == shortNumber)
    {
      const std::uint64_t value = ReadUnsigned(tiff, entry + 8, 2, order);
      return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
    }
  }
  return 1;
}

// The Exif in a JPEG's segments before the picture's data.
std::string_view ExifOfJpeg(std::string_view file)
{
  for (std::size_t at = 2; Holds(file, at, 4) && file[at] == '\xff';)
  {
    const int marker = static_cast<unsigned char>(file[at + 1]);
    const std::size_t size = ReadUnsigned(file, at + 2, 2, ByteOrder::Big);
    if (marker == 0xff)
    {
      ++at;
      continue;
    }
    if (marker == 0xda || size < 2 || !Holds(file, at + 2, size))
    {
      break;
    }
    const std::string_view data = file.substr(at + 4, size - 2);
    if (marker == 0xe1 && data.substr(0, ExifMark.size()) == ExifMark)
    {
      return data.substr(ExifMark.size());
    }
    at += 2 + size;
  }
  return {};
}

std::string_view ExifOfPng(std::string_view file)
{
  for (std::size_t at = 8; Holds(file, at, 12);)
  {
    const std::uint64_t size = ReadUnsigned(file, at, 4, ByteOrder::Big);
    if (!Holds(file, at + 12, size))
    {
      break;
    }
    if (file.substr(at + 4, 4) == "eXIf")
    {
      const std::string_view data = file.substr(at + 8, size);
      return data.substr(0, ExifMark.size()) == ExifMark ? data.substr(ExifMark.size()) : data;
    }
    at += 12 + size;
  }
  return {};
}

} // namespace

int PictureOrientation(std::string_view file)
{
  const bool isPng = file.substr(0, 4) == "\x89PNG";
  const bool isJpeg = file.substr(0, 2) == "\xff\xd8";
  return OrientationOfTiff(isPng ? ExifOfPng(file) : isJpeg ? ExifOfJpeg(file) : file);
}

} // namespace waft
