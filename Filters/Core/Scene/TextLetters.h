// SPDX-License-Identifier: BSD-3-Clause
// A text before it is drawn letter by letter.
#pragma once

#include "Base/Result.h"

#include <string>

namespace waft
{

/// The letters of a text as a font has them: a letter and a mark behind it become one where Unicode
/// has it (Latin, Greek, Cyrillic), characters that are never seen are left out. Fails on a text
/// that is no valid UTF-8 or has control characters other than line breaks, and, naming the first
/// character, on what is not drawn rightly one letter after the other from left to right: scripts
/// from right to left, those whose letters join or change places, marks that are left over.
Result LettersOf(const std::string& text, std::string& letters);

/// 'A' (U+0041), for messages.
std::string LetterText(char32_t letter);

/// Whether a font need not have it: blanks and line breaks.
bool IsBlank(char32_t letter);

} // namespace waft
