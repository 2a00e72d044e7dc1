// SPDX-License-Identifier: BSD-3-Clause
#include "Export/ImageFile.h"

#include <fstream>
#include <sstream>

namespace waft
{

namespace
{

// A number of a picture's file, the high byte first.
std::size_t NumberAt(const std::string& bytes, std::size_t at, std::size_t size)
{
  std::size_t number = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return number;
}

// Without what a camera notes of how it was held: who heeds it would turn the picture below texture
// coordinates, which go by the pixels as they are stored.
std::string PlainPng(const std::string& png)
{
  std::string plain = png.substr(0, 8);
  std::size_t at = 8;
  while (at + 12 <= png.size() && NumberAt(png, at, 4) <= png.size() - at - 12)
  {
    const std::size_t size = 12 + NumberAt(png, at, 4);
    if (png.compare(at + 4, 4, "eXIf") != 0)
    {
      plain.append(png, at, size);
    }
    at += size;
  }
  return plain.append(png, at, std::string::npos);
}

std::string PlainJpeg(const std::string& jpeg)
{
  std::string plain = jpeg.substr(0, 2);
  std::size_t at = 2;
  while (at + 4 <= jpeg.size() && jpeg[at] == '\xff' && jpeg[at + 1] != '\xda' &&
         NumberAt(jpeg, at + 2, 2) <= jpeg.size() - at - 2)
  {
    const std::size_t size = 2 + NumberAt(jpeg, at + 2, 2);
    if (jpeg[at + 1] != '\xe1' || jpeg.compare(at + 4, 4, "Exif") != 0)
    {
      plain.append(jpeg, at, size);
    }
    at += size;
  }
  return plain.append(jpeg, at, std::string::npos);
}

} // namespace

Result ReadImageFile(const std::string& path, ImageFile& image)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (!file)
  {
    return Result::Error("cannot read the image " + path);
  }
  const std::string all = bytes.str();
  const auto begins = [&](const char* signature, std::size_t length)
  { return all.compare(0, length, signature, length) == 0; };
  if (begins("\x89PNG\r\n\x1a\n", 8))
  {
    image = { PlainPng(all), "image/png" };
  }
  else if (begins("\xff\xd8\xff", 3))
  {
    image = { PlainJpeg(all), "image/jpeg" };
  }
  else
  {
    return Result::Error("the image " + path + " is neither PNG nor JPEG");
  }
  return Result::Ok();
}

} // namespace waft
