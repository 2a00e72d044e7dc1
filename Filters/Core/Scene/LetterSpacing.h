// SPDX-License-Identifier: BSD-3-Clause
// Room between the letters of a drawn text.
#pragma once

#include "Scene/SceneAssets.h"

namespace waft
{

/// Moves the letters of a line of text (alpha is ink) apart until the ink of neighbours is at least
/// `gap` pixels apart along each row, rows up to `gap` above and below counted in. Few targets draw
/// a letter with about as much room between them as between the letters of a font, and the letters
/// would run together. Parts above each other (the dot of an i, accents) stay together.
Picture SpreadLetters(const Picture& text, double gap);

} // namespace waft
