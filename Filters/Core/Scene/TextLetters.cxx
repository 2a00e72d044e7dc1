// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TextLetters.h"

#include "Base/Characters.h"

#include <algorithm>
#include <iterator>

namespace waft
{
namespace
{

struct Composition
{
  char16_t Letter;
  char16_t Mark;
  char16_t Whole;
};

constexpr Composition Compositions[] = {
#include "Scene/ComposedLetters.inc"
};

// 0 where there is no such letter.
char32_t Composed(char32_t letter, char32_t mark)
{
  const auto isBefore = [](const Composition& entry, const std::pair<char32_t, char32_t>& wanted)
  { return std::pair<char32_t, char32_t>(entry.Letter, entry.Mark) < wanted; };
  const std::pair<char32_t, char32_t> wanted(letter, mark);
  const auto* found =
    std::lower_bound(std::begin(Compositions), std::end(Compositions), wanted, isBefore);
  const bool isThere =
    found != std::end(Compositions) && found->Letter == letter && found->Mark == mark;
  return isThere ? found->Whole : 0;
}

struct Block
{
  char32_t First;
  char32_t Last;
};

template <std::size_t count>
bool IsIn(const Block (&blocks)[count], char32_t letter)
{
  return std::any_of(std::begin(blocks), std::end(blocks),
                     [letter](const Block& block)
                     { return letter >= block.First && letter <= block.Last; });
}

// Hebrew, Arabic, Syriac, Thaana, N'Ko and others, and their forms.
constexpr Block FromRightToLeft[] = { { 0x0590, 0x08FF },
                                      { 0xFB1D, 0xFDFF },
                                      { 0xFE70, 0xFEFE },
                                      { 0x10800, 0x10FFF },
                                      { 0x1E800, 0x1EFFF } };

// Indic scripts, Thai, Lao, Tibetan, Myanmar, single parts of Korean syllables, Khmer, Mongolian
// and others.
constexpr Block Joined[] = { { 0x0900, 0x109F },  { 0x1100, 0x11FF }, { 0x1700, 0x18AF },
                             { 0x1900, 0x1C7F },  { 0x1CD0, 0x1CFF }, { 0xA800, 0xA82F },
                             { 0xA840, 0xAAFF },  { 0xABC0, 0xABFF }, { 0xD7B0, 0xD7FF },
                             { 0x11000, 0x11FFF } };

constexpr Block Marks[] = { { 0x0300, 0x036F }, { 0x0483, 0x0489 }, { 0x1AB0, 0x1AFF },
                            { 0x1DC0, 0x1DFF }, { 0x20D0, 0x20FF }, { 0x3099, 0x309A },
                            { 0xFE20, 0xFE2F } };

// Soft hyphens, joiners, selectors of a form.
constexpr Block Unseen[] = { { 0x00AD, 0x00AD },  { 0x034F, 0x034F }, { 0x200B, 0x200D },
                             { 0x2060, 0x2064 },  { 0xFE00, 0xFE0F }, { 0xFEFF, 0xFEFF },
                             { 0xE0000, 0xE0FFF } };

// Three letters that stand twice in Unicode.
char32_t Canonical(char32_t letter)
{
  return letter == 0x2126 ? 0x03A9 : letter == 0x212A ? U'K' : letter == 0x212B ? 0x00C5 : letter;
}

} // namespace

std::string LetterText(char32_t letter)
{
  std::string text = "'";
  AppendCharacter(letter, text);
  return text + "' (" + CodeText(letter) + ")";
}

bool IsBlank(char32_t letter)
{
  constexpr Block blanks[] = { { U'\n', U'\n' },   { U' ', U' ' },     { 0x00A0, 0x00A0 },
                               { 0x1680, 0x1680 }, { 0x2000, 0x200A }, { 0x2028, 0x2029 },
                               { 0x202F, 0x202F }, { 0x205F, 0x205F }, { 0x3000, 0x3000 } };
  return IsIn(blanks, letter);
}

Result LettersOf(const std::string& text, std::string& letters)
{
  std::u32string found;
  for (std::size_t at = 0; at < text.size();)
  {
    const Character character = CharacterAt(text, at);
    const char32_t letter = Canonical(character.Code);
    at += character.Bytes;
    if (character.Bytes == 0 || (IsControl(letter) && letter != '\n'))
    {
      return Result::Error("expected bytes of valid UTF-8 without control characters, found " +
                           (character.Bytes == 0 ? "other bytes" : CodeText(letter)));
    }
    if (IsIn(Unseen, letter))
    {
      continue;
    }
    const char32_t whole = found.empty() ? 0 : Composed(found.back(), letter);
    const char* lack = IsIn(FromRightToLeft, letter) ? "scripts from right to left"
                       : IsIn(Joined, letter)        ? "scripts whose letters join or change places"
                       : whole == 0 && IsIn(Marks, letter) ? "marks on letters that have no form "
                                                             "with that mark"
                                                           : nullptr;
    if (lack != nullptr)
    {
      return Result::Error("expected letters that stand one after the other from left to right, "
                           "found " +
                           LetterText(letter) + ": " + lack + " are not drawn");
    }
    if (whole != 0)
    {
      found.back() = whole;
    }
    else
    {
      found += IsBlank(letter) && letter != '\n' ? U' ' : letter; // which every font has
    }
  }
  letters.clear();
  for (const char32_t letter : found)
  {
    AppendCharacter(letter, letters);
  }
  return Result::Ok();
}

} // namespace waft
