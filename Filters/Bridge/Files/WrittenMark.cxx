// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/WrittenMark.h"

#include "Base/Digest.h"
#include "Shapes/PngImage.h"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace waft
{

namespace
{

std::string MarkText(const std::string& bytes)
{
  Digest digest;
  digest.Add(bytes.data(), bytes.size());
  std::string mark = "written with a Waft scene, ";
  for (const char byte : digest.Text())
  {
    char digits[4];
    std::snprintf(digits, sizeof(digits), "%02x", static_cast<unsigned char>(byte));
    mark += digits;
  }
  return mark;
}

/// Whether bytes are what others, without the mark that stands before their last `end` ones, get by
/// it; all marks of a kind are of one length.
template <typename Marked>
bool IsMarked(const std::string& bytes, std::size_t mark, std::size_t end, const Marked& marked)
{
  return bytes.size() > mark + end && bytes == marked(bytes.substr(0, bytes.size() - mark - end) +
                                                      bytes.substr(bytes.size() - end));
}

} // namespace

std::string WrittenMark(const std::string& bytes)
{
  return "<!-- " + MarkText(bytes) + " -->\n";
}

std::string MarkedPng(const std::string& png)
{
  return WithPngText(png, "Waft", MarkText(png));
}

bool IsMarkedAsWritten(const std::string& path)
{
  constexpr std::size_t pngEnd = 12; // its last chunk
  std::error_code error;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error)))
  {
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string all(std::istreambuf_iterator<char>(stream), {});
  const std::string least(pngEnd, ' ');
  return IsMarked(all, WrittenMark({}).size(), 0,
                  [](const std::string& bytes) { return bytes + WrittenMark(bytes); }) ||
         IsMarked(all, MarkedPng(least).size() - pngEnd, pngEnd, MarkedPng);
}

} // namespace waft
