// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Export/ImageFile.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

std::string BytesOf(const test::TemporaryFolder& folder, const std::string& file)
{
  ImageFile image;
  const Result result = ReadImageFile(folder.Write("picture", file), image);
  EXPECT_TRUE(result) << result.Message();
  return image.Bytes;
}

} // namespace

TEST(ImageFile, IsTakenWithoutHowItsCameraWasHeld)
{
  const test::TemporaryFolder folder;
  const auto chunk = [](const char* type, const std::string& data)
  { return std::string(3, '\0') + static_cast<char>(data.size()) + type + data + "sums"; };
  const std::string png = "\x89PNG\r\n\x1a\n" + chunk("IHDR", "head");
  EXPECT_EQ(BytesOf(folder, png + chunk("eXIf", "held") + chunk("IDAT", "pixels")),
            png + chunk("IDAT", "pixels"));
  const auto segment = [](char marker, const std::string& data)
  { return std::string("\xff") + marker + '\0' + static_cast<char>(data.size() + 2) + data; };
  const std::string start = "\xff\xd8" + segment('\xe0', "JFIF");
  const std::string rest = segment('\xe1', "http") + segment('\xda', "scan") + "pixels\xff\xe1";
  EXPECT_EQ(BytesOf(folder, start + segment('\xe1', "Exif held") + rest), start + rest);
  for (std::size_t i = 4; i < start.size(); ++i)
  {
    EXPECT_EQ(BytesOf(folder, start.substr(0, i)), start.substr(0, i)) << "cut files as they are";
  }
}
