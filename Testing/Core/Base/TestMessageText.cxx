// SPDX-License-Identifier: BSD-3-Clause
#include "Base/MessageText.h"
#include "Base/Result.h"

#include <gtest/gtest.h>

using namespace waft;

TEST(MessageText, LeavesGoodTextAlone)
{
  for (const std::string text : { "", "a: expected 1, found 2",
                                  "Bl\xC3\xA4tter \xE2\x82\xAC "
                                  "\xF0\x9F\x8D\x83",
                                  "two\nlines\tand a tab" })
  {
    EXPECT_EQ(MessageText(text), text);
  }
}

TEST(MessageText, MarksBytesThatAreNoCharacter)
{
  const std::string mark = "\xEF\xBF\xBD";
  EXPECT_EQ(MessageText("a\xFFz"), "a" + mark + "z");
  EXPECT_EQ(MessageText("\xC3"), mark);                                  // cut
  EXPECT_EQ(MessageText("\xC0\xAF"), mark + mark);                       // longer than need be
  EXPECT_EQ(MessageText("\xED\xA0\x80"), mark + mark + mark);            // a surrogate
  EXPECT_EQ(MessageText("\xF4\x90\x80\x80"), mark + mark + mark + mark); // beyond the last
  EXPECT_EQ(MessageText(std::string("a\0\x1B\x7Fz", 5)), "a\\x00\\x1b\\x7fz");
  EXPECT_EQ(MessageText("a\xC2\x85\xE2\x80\xAE\xEF\xBF\xBFz"), "a\\x85\\u202e\\uffffz");
}

TEST(MessageText, LosesTheMiddleOfALongText)
{
  const std::string long1 = "begin" + std::string(1000000, 'x') + "end";
  const std::string text = MessageText(long1);
  EXPECT_LE(text.size(), 1800u);
  EXPECT_EQ(text.substr(0, 5), "begin");
  EXPECT_EQ(text.substr(text.size() - 3), "end");
  std::string wide;
  for (int i = 0; i < 5000; ++i)
  {
    wide += "\xE2\x82\xAC";
  }
  EXPECT_EQ(MessageText(wide).find("\xEF\xBF\xBD"), std::string::npos); // cut between characters
  EXPECT_LE(MessageText(std::string(1700, '\xFF')).size(), 1800u);
}

TEST(MessageText, IsWhatResultsSay)
{
  EXPECT_LE(Result::Error(std::string(5000, 'x')).Message().size(), 1800u);
}
