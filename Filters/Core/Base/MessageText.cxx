// SPDX-License-Identifier: BSD-3-Clause
#include "Base/MessageText.h"

#include <cstddef>

namespace waft
{

namespace
{

// Bytes of the well-formed character at `i` (RFC 3629), 0 where there is none.
std::size_t CharacterLength(const std::string& text, std::size_t i)
{
  const auto byte = [&](std::size_t j) -> unsigned
  { return j < text.size() ? static_cast<unsigned char>(text[j]) : 0u; };
  const auto follows = [&](std::size_t j, unsigned low = 0x80, unsigned high = 0xBF)
  { return byte(j) >= low && byte(j) <= high; };
  const unsigned lead = byte(i);
  if (lead < 0x80)
  {
    return 1;
  }
  if (lead >= 0xC2 && lead <= 0xDF)
  {
    return follows(i + 1) ? 2 : 0;
  }
  if (lead >= 0xE0 && lead <= 0xEF)
  {
    const unsigned low = lead == 0xE0 ? 0xA0 : 0x80;  // no longer than need be
    const unsigned high = lead == 0xED ? 0x9F : 0xBF; // no surrogates
    return follows(i + 1, low, high) && follows(i + 2) ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4)
  {
    const unsigned low = lead == 0xF0 ? 0x90 : 0x80;
    const unsigned high = lead == 0xF4 ? 0x8F : 0xBF;
    return follows(i + 1, low, high) && follows(i + 2) && follows(i + 3) ? 4 : 0;
  }
  return 0;
}

bool IsContinuation(char c)
{
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

} // namespace

std::string MessageText(const std::string& text)
{
  constexpr std::size_t longest = 1800;
  constexpr std::size_t tail = 400;
  constexpr const char* left = " ... ";
  std::string whole = text;
  if (text.size() > longest)
  {
    std::size_t head = longest - tail - 5;
    std::size_t rest = text.size() - tail;
    for (int i = 0; i < 3 && IsContinuation(text[head]); ++i)
    {
      --head;
    }
    for (int i = 0; i < 3 && IsContinuation(text[rest]); ++i)
    {
      ++rest;
    }
    whole = text.substr(0, head) + left + text.substr(rest);
  }
  std::string clean;
  for (std::size_t i = 0; i < whole.size();)
  {
    const std::size_t length = CharacterLength(whole, i);
    const bool isControl =
      length == 1 && (whole[i] == 0x7F || (static_cast<unsigned char>(whole[i]) < 0x20 &&
                                           whole[i] != '\n' && whole[i] != '\t'));
    clean += length == 0 ? "\xEF\xBF\xBD" : isControl ? " " : whole.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  // Characters that stand for bytes are longer than these.
  return clean.size() > longest ? MessageText(clean) : clean;
}

} // namespace waft
