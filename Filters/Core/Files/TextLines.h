// SPDX-License-Identifier: BSD-3-Clause
// The lines and words of a text file in memory.
#pragma once

#include "Base/Limits.h"
#include "Files/FileBytes.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace waft
{

/// Lines end in LF, CR LF or CR. A byte order mark (UTF-8) before the first is left out.
class TextLines
{
public:
  explicit TextLines(std::string_view text) :
    Text(text), At(text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0), Feed(At)
  {
    this->FindFeed();
  }

  /// The next line without its end; false after the last.
  bool Next(std::string_view& line)
  {
    if (this->At >= this->Text.size())
    {
      return false;
    }
    line = this->Text.substr(this->At, this->Feed - this->At);
    line = line.substr(0, line.find('\r'));
    this->At += line.size();
    this->At += this->Text.substr(this->At, 2) == "\r\n" ? 2 : 1;
    if (this->At > this->Feed)
    {
      this->FindFeed();
    }
    ++this->Number;
    return true;
  }
  /// "line 7: ", of the last line given.
  std::string Location() const { return "line " + std::to_string(this->Number) + ": "; }
  /// What follows that line.
  std::string_view Remainder() const
  {
    return this->Text.substr(std::min(this->At, this->Text.size()));
  }

private:
  // Once a line feed, so that a long text without any is not searched for each line.
  void FindFeed() { this->Feed = std::min(this->Text.find('\n', this->At), this->Text.size()); }

  std::string_view Text;
  std::size_t At = 0;
  std::size_t Feed = 0; // the next line feed, or the end
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

/// Words [first, first + N) as coordinates in limits::Coordinate.
template <std::size_t N>
Result ReadCoordinates(const std::vector<std::string_view>& words, std::size_t first,
                       const std::string& location, std::array<double, N>& numbers)
{
  for (std::size_t i = 0; i < N; ++i)
  {
    const bool isThere = first + i < words.size();
    if (!isThere || !ParseNumber(words[first + i], numbers[i]) ||
        !limits::Coordinate.Holds(numbers[i]))
    {
      return Result::Error(location + "expected " + std::to_string(N) +
                           " numbers of at most 1e6, found " +
                           (isThere ? Quoted(words[first + i]) : std::to_string(i)));
    }
  }
  return Result::Ok();
}

} // namespace waft
