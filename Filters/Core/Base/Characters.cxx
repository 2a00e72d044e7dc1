// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Characters.h"

#include <cstdio>

namespace waft
{

Character CharacterAt(std::string_view text, std::size_t at)
{
  const auto byte = [&](std::size_t i) -> char32_t
  { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
  const auto follows = [&](std::size_t i, char32_t low = 0x80, char32_t high = 0xBF)
  { return byte(i) >= low && byte(i) <= high; };
  const auto bits = [&](std::size_t i) { return byte(i) & 0x3F; };
  const char32_t lead = byte(0);
  if (at >= text.size())
  {
    return {};
  }
  if (lead < 0x80)
  {
    return { lead, 1 };
  }
  if (lead >= 0xC2 && lead <= 0xDF && follows(1))
  {
    return { (lead & 0x1F) << 6 | bits(1), 2 };
  }
  if (lead >= 0xE0 && lead <= 0xEF)
  {
    const char32_t low = lead == 0xE0 ? 0xA0 : 0x80;  // no longer than need be
    const char32_t high = lead == 0xED ? 0x9F : 0xBF; // no surrogates
    return follows(1, low, high) && follows(2)
             ? Character{ (lead & 0x0F) << 12 | bits(1) << 6 | bits(2), 3 }
             : Character{};
  }
  if (lead >= 0xF0 && lead <= 0xF4)
  {
    const char32_t low = lead == 0xF0 ? 0x90 : 0x80;
    const char32_t high = lead == 0xF4 ? 0x8F : 0xBF;
    return follows(1, low, high) && follows(2) && follows(3)
             ? Character{ (lead & 0x07) << 18 | bits(1) << 12 | bits(2) << 6 | bits(3), 4 }
             : Character{};
  }
  return {};
}

void AppendCharacter(char32_t code, std::string& text)
{
  if (code < 0x80)
  {
    text += static_cast<char>(code);
    return;
  }
  const int following = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  const char32_t lead = following == 1 ? 0xC0 : following == 2 ? 0xE0 : 0xF0;
  text += static_cast<char>(lead | code >> (6 * following));
  for (int i = following - 1; i >= 0; --i)
  {
    text += static_cast<char>(0x80 | (code >> (6 * i) & 0x3F));
  }
}

std::string CodeText(char32_t code)
{
  char text[16];
  std::snprintf(text, sizeof(text), "U+%04X", static_cast<unsigned>(code));
  return text;
}

bool IsControl(char32_t code)
{
  const auto within = [code](char32_t low, char32_t high) { return code >= low && code <= high; };
  return code < 0x20 || within(0x7F, 0x9F) || code == 0x061C || within(0x200E, 0x200F) ||
         within(0x202A, 0x202E) || within(0x2066, 0x2069) || within(0xFFFE, 0xFFFF);
}

std::string FirstControl(std::string_view text)
{
  for (std::size_t at = 0; at < text.size();)
  {
    const Character character = CharacterAt(text, at);
    if (character.Bytes > 0 && IsControl(character.Code))
    {
      return CodeText(character.Code);
    }
    at += character.Bytes > 0 ? character.Bytes : 1;
  }
  return {};
}

} // namespace waft
