// SPDX-License-Identifier: BSD-3-Clause
#include "Base/MessageText.h"

#include "Base/Characters.h"

#include <cstddef>
#include <cstdio>

namespace waft
{

namespace
{

bool IsContinuation(char c)
{
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// "\\x1b", "\\u202e".
std::string Escape(char32_t code)
{
  char text[16];
  std::snprintf(text, sizeof(text), code < 0x100 ? "\\x%02x" : "\\u%04x",
                static_cast<unsigned>(code));
  return text;
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
    const Character character = CharacterAt(whole, i);
    const bool isHidden =
      IsControl(character.Code) && character.Code != '\n' && character.Code != '\t';
    clean += character.Bytes == 0 ? "\xEF\xBF\xBD"
             : isHidden           ? Escape(character.Code)
                                  : whole.substr(i, character.Bytes);
    i += character.Bytes == 0 ? 1 : character.Bytes;
  }
  // Characters that stand for bytes are longer than these.
  return clean.size() > longest ? MessageText(clean) : clean;
}

} // namespace waft
