// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/FontFiles.h"

#include <ft2build.h>
#include FT_FREETYPE_H

namespace waft
{

Result CheckFontFile(const std::string& path)
{
  FT_Library library = nullptr;
  if (FT_Init_FreeType(&library) != 0)
  {
    return Result::Error("cannot start FreeType");
  }
  FT_Face face = nullptr;
  const bool isFont = FT_New_Face(library, path.c_str(), 0, &face) == 0;
  const bool hasOutlines = isFont && FT_IS_SCALABLE(face);
  FT_Done_FreeType(library); // and the face with it
  return hasOutlines ? Result::Ok()
                     : Result::Error("expected sans, serif, mono or a font file with outlines "
                                     "(.ttf, .otf), found another at \"" +
                                     path + "\"");
}

} // namespace waft
