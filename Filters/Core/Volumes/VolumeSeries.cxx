// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes/VolumeSeries.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace waft
{

namespace
{

constexpr std::size_t MostDigits = 9; // of an int

using Files = std::vector<std::pair<int, std::string>>;

bool IsDigit(char c)
{
  return c >= '0' && c <= '9';
}

/// Where the number that begins at a place ends.
std::size_t EndOfNumber(const std::string& stem, std::size_t at)
{
  return static_cast<std::size_t>(
    std::find_if_not(stem.begin() + static_cast<std::ptrdiff_t>(at), stem.end(), IsDigit) -
    stem.begin());
}

/// Of the files of a folder those whose stems are of two parts with a number between.
Files FilesBetween(const std::vector<std::filesystem::path>& folder, const std::string& before,
                   const std::string& after)
{
  Files files;
  for (const std::filesystem::path& path : folder)
  {
    const std::string stem = path.stem().string();
    if (stem.compare(0, before.size(), before) != 0)
    {
      continue;
    }
    const std::size_t end = EndOfNumber(stem, before.size());
    const std::size_t digits = end - before.size();
    if (digits > 0 && digits <= MostDigits && stem.substr(end) == after)
    {
      files.emplace_back(std::stoi(stem.substr(before.size(), digits)), path.string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

Files SeriesFiles(const std::string& path)
{
  const std::filesystem::path given(path);
  const std::string stem = given.stem().string();
  std::vector<std::filesystem::path> folder; // files of the same ending
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(
         given.parent_path().empty() ? std::filesystem::path(".") : given.parent_path(), error))
  {
    if (entry.path().extension() == given.extension())
    {
      folder.push_back(entry.path());
    }
  }
  Files chosen{ { 0, path } };
  std::size_t most = 0; // digits of the number that differs
  for (std::size_t at = 0, end = 0; at < stem.size(); at = std::max(end, at + 1))
  {
    end = EndOfNumber(stem, at);
    const std::size_t digits = end - at;
    if (digits == 0 || digits > MostDigits)
    {
      continue;
    }
    const Files files = FilesBetween(folder, stem.substr(0, at), stem.substr(end));
    if (files.size() > 1 ? digits >= most : end == stem.size() && most == 0)
    {
      chosen = files;
      most = files.size() > 1 ? digits : 0;
    }
  }
  return chosen;
}

Result ListSeries(const Files& files, std::vector<VolumeContents>& contents)
{
  for (std::size_t f = 0; f < files.size(); ++f)
  {
    const auto& [frame, path] = files[f];
    if (f > 0 && files[f - 1].first == frame)
    {
      return Result::Error(path + ": expected one file a frame, found two");
    }
    const Result listed = ListVolume(path, contents.emplace_back());
    if (!listed)
    {
      return Result::Error(path + ": " + listed.Message());
    }
  }
  return Result::Ok();
}

std::string SeriesFile(const std::string& path, int frame)
{
  const std::filesystem::path given(path);
  char digits[16];
  std::snprintf(digits, sizeof(digits), "_%04d", frame);
  return (given.parent_path() / (given.stem().string() + digits + given.extension().string()))
    .string();
}

} // namespace waft
