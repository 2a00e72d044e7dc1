// SPDX-License-Identifier: BSD-3-Clause
#include "Base/ReadingStream.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

enum class Mood : unsigned char
{
  Calm,
  Wild
};

struct Inner
{
  Quat Turn = Quat(0.5, 0.5, -0.5, 0.5);
  std::array<float, 3> Colour{ 1.0f, 2.0f, 3.0f };

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Turn...);
    visit(of.Colour...);
  }
};

struct Sample
{
  int Number = 7;
  bool Flag = true;
  Mood State = Mood::Wild;
  Vec3 Place{ 1.0, -0.0, 1e-300 };
  std::string Name = "leaf";
  std::vector<float> Row{ 1.0f, 2.0f, 3.0f };
  std::vector<Vec3> Points{ Vec3(1, 2, 3) };
  std::vector<std::vector<double>> Rows{ { 1.0 }, {}, { 2.0, 3.0 } };
  std::vector<std::array<std::string, 2>> Words{ { "a", "" }, { "b", "c" } };
  std::vector<Inner> Inners{ 2 };
  Eigen::MatrixXd Matrix = Eigen::MatrixXd::Constant(2, 3, 0.25);
  Eigen::VectorXd Vector = Eigen::VectorXd::Constant(4, -1.0);

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Number...);
    visit(of.Flag...);
    visit(of.State...);
    visit(of.Place...);
    visit(of.Name...);
    visit(of.Row...);
    visit(of.Points...);
    visit(of.Rows...);
    visit(of.Words...);
    visit(of.Inners...);
    visit(of.Matrix...);
    visit(of.Vector...);
  }
};

template <class Value>
std::vector<char> BytesOf(Value& value)
{
  MemoryStream stream;
  stream.Values(value);
  EXPECT_TRUE(stream.IsGood());
  return stream.Content;
}

Sample Other()
{
  Sample other;
  other.Number = 0;
  other.Flag = false;
  other.State = Mood::Calm;
  other.Place = Vec3::Zero();
  other.Name.clear();
  other.Row = { 4.0f, 4.0f, 4.0f, 4.0f };
  other.Points.clear();
  other.Rows = { { 9.0 } };
  other.Words.clear();
  other.Inners.clear();
  other.Matrix.resize(0, 0);
  other.Vector.resize(1);
  return other;
}

} // namespace

TEST(StateArchive, ReadsBackWhatWasWrittenOfAConstValueToo)
{
  const Sample sample;
  const std::vector<char> bytes = BytesOf(sample);
  Sample changeable;
  EXPECT_EQ(BytesOf(changeable), bytes);
  Sample read = Other();
  EXPECT_NE(BytesOf(read), bytes);
  ReadingStream stream(bytes);
  stream.Values(read);
  EXPECT_TRUE(stream.IsGood());
  EXPECT_EQ(stream.Left(), 0u);
  EXPECT_EQ(BytesOf(read), bytes);
  EXPECT_EQ(read.Flag, sample.Flag);
  EXPECT_EQ(read.Name, sample.Name);
  EXPECT_EQ(read.Rows, sample.Rows);
  EXPECT_EQ(read.Words, sample.Words);
  EXPECT_EQ(read.Matrix, sample.Matrix);
  EXPECT_EQ(read.Vector, sample.Vector);
  EXPECT_EQ(read.Inners[1].Turn.coeffs(), sample.Inners[1].Turn.coeffs());
}

TEST(StateArchive, ReadsNothingIntoAConstValue)
{
  const int seven = 7;
  ReadingStream stream(BytesOf(seven));
  const int kept = 1;
  stream.Values(kept);
  EXPECT_FALSE(stream.IsGood());
  EXPECT_EQ(kept, 1);
}

TEST(StateArchive, BelievesNoNumberOfItems)
{
  const Sample sample;
  const std::vector<char> whole = BytesOf(sample);
  for (std::size_t at = 0; at < whole.size(); ++at)
  {
    std::vector<char> damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
    ReadingStream stream(damaged); // must not ask for petabytes
    Sample read;
    stream.Values(read);
    ReadingStream cut({ whole.begin(), whole.begin() + static_cast<long>(at) });
    cut.Values(read);
    EXPECT_FALSE(cut.IsGood()) << at;
  }
}

TEST(StateArchive, OfADigestTellsValuesApart)
{
  const Sample sample;
  EXPECT_EQ(DigestOf(sample), DigestOf(Sample()));
  EXPECT_NE(DigestOf(sample), DigestOf(Other()));
  EXPECT_NE(DigestOf(1, 2), DigestOf(2, 1));
}
