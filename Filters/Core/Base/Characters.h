// SPDX-License-Identifier: BSD-3-Clause
// Characters of UTF-8 texts, and those of them that no name may hold.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace waft
{

/// A character and how many bytes it takes.
struct Character
{
  char32_t Code = 0;
  std::size_t Bytes = 0; // 0: there is none
};

/// The well-formed character at a byte of a text (RFC 3629).
Character CharacterAt(std::string_view text, std::size_t at);

/// Appends a character.
void AppendCharacter(char32_t code, std::string& text);

/// "U+202E".
std::string CodeText(char32_t code);

/// Whether a character would be read by machines alone: control characters (C0, C1), U+FFFE and
/// U+FFFF, and the controls that turn the direction of writing. XML has no way to say the first
/// ones, and the last ones make a text look like another.
bool IsControl(char32_t code);

/// The first of these in a text as "U+202E"; an empty text when there is none.
std::string FirstControl(std::string_view text);

} // namespace waft
