// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"

#include <string>

class vtkTextProperty;

namespace waft
{

/// Fails when the font of a style lacks letters of a text, naming them: VTK leaves some out and
/// draws a box for others. font: as the user called it.
Result CheckLetters(vtkTextProperty* style, const std::string& font, const std::string& letters);

/// Fails on a file that is no font with outlines, in place of which VTK would draw with its own.
Result CheckFontFile(const std::string& path);

} // namespace waft
