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

/// The stem without the digits at its end.
std::string PrefixOf(const std::string& stem)
{
  const std::size_t last = stem.find_last_not_of("0123456789");
  return last == std::string::npos ? std::string() : stem.substr(0, last + 1);
}

} // namespace

std::vector<std::pair<int, std::string>> SeriesFiles(const std::string& path)
{
  const std::filesystem::path given(path);
  const std::string stem = given.stem().string();
  const std::string prefix = PrefixOf(stem);
  std::vector<std::pair<int, std::string>> files;
  if (prefix == stem || stem.size() - prefix.size() > MostDigits)
  {
    files.emplace_back(0, path);
    return files;
  }
  std::error_code error;
  const std::filesystem::path folder =
    given.parent_path().empty() ? std::filesystem::path(".") : given.parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
  {
    const std::string other = entry.path().stem().string();
    const bool isOne = entry.path().extension() == given.extension() &&
                       other.size() > prefix.size() && other.size() <= prefix.size() + MostDigits &&
                       PrefixOf(other) == prefix;
    if (isOne)
    {
      files.emplace_back(std::stoi(other.substr(prefix.size())), entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
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
