// SPDX-License-Identifier: BSD-3-Clause
// The letters of a drawn text: room between them, and which of them is where.
#pragma once

#include "Scene/SceneAssets.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

/// Where in a text something is: numbers from 0 of its letter, word and line. Letters are numbered
/// through all lines, as words are.
struct TextPlace
{
  int Letter = 0;
  int Word = 0;
  int Line = 0;
};

/// Moves the letters of a line of text (alpha is ink) apart until the ink of neighbours is at least
/// `gap` pixels apart along each row, rows up to `gap` above and below counted in. Few targets draw
/// a letter with about as much room between them as between the letters of a font, and the letters
/// would run together. Parts above each other (the dot of an i, accents) stay together.
Picture SpreadLetters(const Picture& text, double gap);

/// Of places in a drawn text [pixels, row 0 at the bottom] that of the nearest ink. Letters are
/// what the ink hangs together in (letters that touch count as one), words lie behind the widest
/// gaps of a line, as many as the text has; lines are parted by the widest blank bands.
std::vector<TextPlace> PlacesInText(const Picture& drawn, const std::string& text,
                                    const std::vector<std::array<double, 2>>& pixels);

} // namespace waft
