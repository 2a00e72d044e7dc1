// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/FontFiles.h"

#include "Base/Characters.h"
#include "Scene/TextLetters.h"

#include <vtkFreeTypeTools.h>
#include <vtkPath.h>
#include <vtkPoints.h>
#include <vtkTextProperty.h>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <set>

namespace waft
{
namespace
{

using LetterOutline = vtkFreeTypeTools::GlyphOutline;

vtkPoints* PointsOf(const LetterOutline& outline)
{
  return outline.Path != nullptr ? outline.Path->GetPoints() : nullptr;
}

bool IsSame(const LetterOutline& a, const LetterOutline& b)
{
  vtkPoints* p = PointsOf(a);
  vtkPoints* q = PointsOf(b);
  const vtkIdType count = p != nullptr ? p->GetNumberOfPoints() : 0;
  if (a.HorizAdvance != b.HorizAdvance || count != (q != nullptr ? q->GetNumberOfPoints() : 0))
  {
    return false;
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double* x = p->GetPoint(i);
    const double* y = q->GetPoint(i);
    if (x[0] != y[0] || x[1] != y[1])
    {
      return false;
    }
  }
  return true;
}

} // namespace

Result CheckLetters(vtkTextProperty* style, const std::string& font, const std::string& letters)
{
  constexpr std::size_t most = 12; // that are named
  constexpr char32_t noLetter = 0x10FFFF;
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  // A font has one outline for all that it lacks.
  const LetterOutline lack = tools->GetUnscaledGlyphOutline(style, noLetter);
  std::set<char32_t> seen;
  std::string missing;
  std::size_t count = 0;
  for (std::size_t at = 0; at < letters.size();)
  {
    const Character character = CharacterAt(letters, at);
    at += character.Bytes;
    if (IsBlank(character.Code) || !seen.insert(character.Code).second ||
        !IsSame(tools->GetUnscaledGlyphOutline(style, character.Code), lack))
    {
      continue;
    }
    if (++count <= most)
    {
      missing += (count == 1 ? "" : ", ") + LetterText(character.Code);
    }
  }
  const std::string more = count > most ? " and " + std::to_string(count - most) + " more" : "";
  return count == 0 ? Result::Ok()
                    : Result::Error("expected a text that the font \"" + font +
                                    "\" can draw, found letters that it lacks: " + missing + more +
                                    "; name a font file that has them");
}

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
