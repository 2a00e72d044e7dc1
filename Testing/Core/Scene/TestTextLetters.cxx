// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TextLetters.h"

#include <gtest/gtest.h>

#include <array>

using namespace waft;

namespace
{

std::string Letters(const std::string& text)
{
  std::string letters;
  const Result result = LettersOf(text, letters);
  EXPECT_TRUE(result) << result.Message();
  return letters;
}

std::string Error(const std::string& text)
{
  std::string letters;
  return LettersOf(text, letters).Message();
}

} // namespace

TEST(TextLetters, AreComposed)
{
  EXPECT_EQ(Letters("E\u0301U\u0308N\u0303 plain"), "\u00c9\u00dc\u00d1 plain");
  EXPECT_EQ(Letters("a\u0302\u0323"), "\u1ead") << "whatever the order of the marks";
  EXPECT_EQ(Letters("a\u0323\u0302"), "\u1ead");
  EXPECT_EQ(Letters("\u0438\u0306 \u03b1\u0301 c\u030c"), "\u0439 \u03ac \u010d");
  EXPECT_EQ(Letters("\u212b\u2126"), "\u00c5\u03a9");
  EXPECT_EQ(Letters("a\u200db\ufe0f\u00ad\nc"), "ab\nc") << "what is never seen";
  EXPECT_EQ(Letters("a\u00a0b\u3000c"), "a b c");
  EXPECT_EQ(Letters("\u4e2d\u6587\uac00\u3042"), "\u4e2d\u6587\uac00\u3042");
}

TEST(TextLetters, ThatWouldStandWronglyAreRefused)
{
  for (const auto& [text, part] :
       { std::array{ "\u05e9\u05dc\u05d5\u05dd", "'\u05e9' (U+05E9): scripts from right to left" },
         std::array{ "\u0645\u0631\u062d\u0628\u0627", "(U+0645): scripts from right to left" },
         std::array{ "\u0928\u092e", "(U+0928): scripts whose letters join" },
         std::array{ "\u0e2a", "(U+0E2A): scripts whose letters join" },
         std::array{ "x\u0301", "(U+0301): marks on letters that have no form" },
         std::array{ "\u0301", "(U+0301): marks on letters" },
         std::array{ "a\u202eb", "without control characters, found U+202E" },
         std::array{ "a\x01", "without control characters, found U+0001" },
         std::array{ "\xff", "valid UTF-8" } })
  {
    EXPECT_NE(Error(text).find(part), std::string::npos) << Error(text);
  }
}
