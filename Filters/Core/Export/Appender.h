// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <streambuf>
#include <string>

namespace waft
{

/// Where a stream writes at the end of a text, which is not copied then.
class Appender : public std::streambuf
{
public:
  explicit Appender(std::string& text) : Text(text) {}

protected:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override
  {
    this->Text.append(bytes, static_cast<std::size_t>(count));
    return count;
  }
  int_type overflow(int_type character) override
  {
    if (!traits_type::eq_int_type(character, traits_type::eof()))
    {
      this->Text.push_back(traits_type::to_char_type(character));
    }
    return traits_type::not_eof(character);
  }

private:
  std::string& Text;
};

} // namespace waft
