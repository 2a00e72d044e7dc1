// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/WrittenMark.h"

#include "Base/Digest.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace waft
{

std::string WrittenMark(const std::string& bytes)
{
  Digest digest;
  digest.Add(bytes.data(), bytes.size());
  std::string mark = "<!-- written with a Waft scene, ";
  for (const char byte : digest.Text())
  {
    char digits[4];
    std::snprintf(digits, sizeof(digits), "%02x", static_cast<unsigned char>(byte));
    mark += digits;
  }
  return mark + " -->\n";
}

bool IsMarkedAsWritten(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error)))
  {
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string all(std::istreambuf_iterator<char>(stream), {});
  const std::size_t length = WrittenMark({}).size(); // of every mark
  if (all.size() < length)
  {
    return false;
  }
  const std::string bytes = all.substr(0, all.size() - length);
  return all.compare(bytes.size(), length, WrittenMark(bytes)) == 0;
}

} // namespace waft
