// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Characters.h"

#include <gtest/gtest.h>

using namespace waft;

TEST(Characters, AreReadAsTheyWereWritten)
{
  for (const char32_t code :
       { 0x41, 0x7F, 0x80, 0x7FF, 0x800, 0x20AC, 0xFFFD, 0x10000, 0x1F342, 0x10FFFF })
  {
    std::string text = "a";
    AppendCharacter(code, text);
    const Character character = CharacterAt(text, 1);
    EXPECT_EQ(character.Code, code);
    EXPECT_EQ(character.Bytes, text.size() - 1);
    EXPECT_EQ(CharacterAt(text.substr(0, text.size() - 1), 1).Bytes, 0u);
  }
  for (const char* none : { "\xFF", "\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\x80" })
  {
    EXPECT_EQ(CharacterAt(none, 0).Bytes, 0u);
  }
}

TEST(Characters, OfNoNameAreReported)
{
  EXPECT_EQ(FirstControl(std::string("a\0b", 3)), "U+0000");
  EXPECT_EQ(FirstControl("a\nb"), "U+000A");
  EXPECT_EQ(FirstControl("\xC2\x85"), "U+0085");
  EXPECT_EQ(FirstControl("a\xE2\x80\xAE\x01"), "U+202E");
  EXPECT_EQ(FirstControl("\xEF\xBF\xBE"), "U+FFFE");
  EXPECT_EQ(FirstControl("Bl\xC3\xA4tter \xD7\xA9\xD7\x9C \xE2\x80\x8D \xC2\xA0 \xFF"), "");
}
