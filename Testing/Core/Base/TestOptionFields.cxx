// SPDX-License-Identifier: BSD-3-Clause
#include "Base/OptionFields.h"
#include "Base/StateArchive.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace waft;

namespace
{

enum class Kind
{
  Rough,
  Smooth
};

struct SampleOptions
{
  double Size = 0.5;
  int Count = 3;
  bool IsOpen = false;
  Kind Surface = Kind::Rough;
  std::string File;
  Box Bounds;
  std::vector<std::array<double, 3>> Places;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Size", { 0.1, 2 }, "m", "How large it is." }, of.Size...);
    visit(OptionField{ "Count", { 1, 9 }, "", "How many there are." }, of.Count...);
    visit(FlagField("IsOpen", "Whether it is open."), of.IsOpen...);
    visit(OptionField{ "Surface", { 0, 1 }, "", "What it feels like." }, of.Surface...);
    visit(TextField("File", "Where it is kept."), of.File...);
    visit(OptionField{ "Bounds", { -9, 9 }, "m", "Where it lies." }, of.Bounds...);
    visit(OptionField{ "Places", { -9, 9 }, "m", "Where else it lies." }, of.Places...);
  }
};

/// A stage of a pipeline keeps plain numbers.
struct Stage
{
  double Size = 1.5;
  int Count = 7;
  bool IsOpen = true;
  int Surface = 1;
  std::string File = "kept";
  double Bounds[6] = { 1, 2, 3, 4, 5, 6 };
  std::vector<std::array<double, 3>> Places{ { 1, 2, 3 }, { 4, 5, 6 } };
};

} // namespace

TEST(OptionFields, SayWhenTheyHaveNoEffect)
{
  const OptionField always{ "Drag", { 0, 9 }, "1/s", "How fast." };
  EXPECT_EQ(always.Text(), "How fast.");
  EXPECT_EQ(always.With("Air").Text(), "How fast. No effect unless Air is joined.");
  EXPECT_EQ(always.Without("Air").Text(), "How fast. No effect where Air is joined.");
  EXPECT_EQ(always.Or("none").Without("Air").Text(),
            "How fast. 0: none. No effect where Air is joined.");
  EXPECT_EQ(always.Without("Air").Range.High, 9);
}

TEST(OptionFields, TheFirstOutOfItsRangeIsNamed)
{
  SampleOptions options;
  EXPECT_TRUE(ValidateFields<SampleOptions>(options));
  options.Count = 10;
  EXPECT_EQ(ValidateFields<SampleOptions>(options).Message(),
            "Count: expected a number from 1 to 9, found 10");
  options.Size = std::nan("");
  EXPECT_EQ(ValidateFields<SampleOptions>(options).Message(),
            "Size: expected a number from 0.1 to 2 m, found nan");
  options.Size = 2.0;
  options.Count = 1;
  options.Bounds.Max.y() = 10;
  EXPECT_EQ(ValidateFields<SampleOptions>(options).Message(),
            "Bounds: expected a number from -9 to 9 m, found 10");
  options.Bounds.Max.y() = 9;
  EXPECT_TRUE(ValidateFields<SampleOptions>(options));
  options.Places = { { 0, 0, 0 }, { 0, -10, 0 } };
  EXPECT_EQ(ValidateFields<SampleOptions>(options).Message(),
            "Places: expected a number from -9 to 9 m, found -10");
}

TEST(OptionFields, AreCopiedByName)
{
  SampleOptions options;
  CopyFields<SampleOptions>(Stage(), options);
  EXPECT_EQ(options.Size, 1.5);
  EXPECT_EQ(options.Count, 7);
  EXPECT_TRUE(options.IsOpen);
  EXPECT_EQ(options.Surface, Kind::Smooth);
  EXPECT_EQ(options.File, "kept");
  EXPECT_EQ(options.Bounds.Min, Vec3(1, 3, 5));
  EXPECT_EQ(options.Bounds.Max, Vec3(2, 4, 6));
  EXPECT_EQ(options.Places, Stage().Places);
}

TEST(OptionFields, EachTellsDigestsApart)
{
  const auto sum = [](const SampleOptions& options) { return DigestOf(options); };
  EXPECT_EQ(sum({}), sum({}));
  const auto changed = [&](auto member, auto value)
  {
    SampleOptions options;
    options.*member = value;
    return sum(options);
  };
  EXPECT_NE(sum({}), changed(&SampleOptions::Size, 0.6));
  EXPECT_NE(sum({}), changed(&SampleOptions::Count, 4));
  EXPECT_NE(sum({}), changed(&SampleOptions::IsOpen, true));
  EXPECT_NE(sum({}), changed(&SampleOptions::Surface, Kind::Smooth));
  EXPECT_NE(sum({}), changed(&SampleOptions::File, "kept"));
  SampleOptions wider;
  wider.Bounds.Max.z() = 5;
  EXPECT_NE(sum({}), sum(wider));
  SampleOptions elsewhere;
  elsewhere.Places = { { 0, 0, 1 } };
  EXPECT_NE(sum({}), sum(elsewhere));
}
