// SPDX-License-Identifier: BSD-3-Clause
// The lines and words of a text file in memory.
#pragma once

#include "Base/Limits.h"
#include "Files/FileBytes.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace waft
{

class TextLines
{
public:
  explicit TextLines(std::string_view text) : Rest(text) {}

  /// The next line without its end; false after the last.
  bool Next(std::string_view& line)
  {
    if (this->Rest.empty())
    {
      return false;
    }
    const std::size_t end = std::min(this->Rest.find('\n'), this->Rest.size());
    line = this->Rest.substr(0, end);
    if (!line.empty() && line.back() == '\r')
    {
      line.remove_suffix(1);
    }
    this->Rest.remove_prefix(std::min(end + 1, this->Rest.size()));
    ++this->Number;
    return true;
  }
  /// "line 7: ", of the last line given.
  std::string Location() const { return "line " + std::to_string(this->Number) + ": "; }
  /// What follows that line.
  std::string_view Remainder() const { return this->Rest; }

private:
  std::string_view Rest;
  std::size_t Number = 0;
};

/// The words of a line, parted by blanks.
inline std::vector<std::string_view> WordsOf(std::string_view line)
{
  constexpr std::string_view blanks = " \t\v\f\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;)
  {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

/// Are words [first, first + count) there, and coordinates in limits::Coordinate?
inline Result CheckCoordinates(const std::vector<std::string_view>& words, std::size_t first,
                               std::size_t count, const std::string& location)
{
  for (std::size_t i = first; i < first + count; ++i)
  {
    double number = 0.0;
    if (i >= words.size() || !ParseNumber(words[i], number) || !limits::Coordinate.Holds(number))
    {
      return Result::Error(location + "expected " + std::to_string(count) +
                           " numbers of at most 1e6, found " +
                           (i < words.size() ? Quoted(words[i]) : std::to_string(i - first)));
    }
  }
  return Result::Ok();
}

} // namespace waft
