// SPDX-License-Identifier: BSD-3-Clause
#include "Export/ImageFile.h"

#include <fstream>
#include <sstream>

namespace waft
{

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
    image = { all, "image/png" };
  }
  else if (begins("\xff\xd8\xff", 3))
  {
    image = { all, "image/jpeg" };
  }
  else
  {
    return Result::Error("the image " + path + " is neither PNG nor JPEG");
  }
  return Result::Ok();
}

} // namespace waft
