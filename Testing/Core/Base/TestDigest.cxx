// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Digest.h"
#include "Base/StateArchive.h"

#include <gtest/gtest.h>

#include <set>

using namespace waft;

TEST(Digest, DoesNotDependOnHowBytesAreCut)
{
  const std::string bytes = "twenty-nine bytes of anything";
  Digest whole;
  whole.Add(bytes.data(), bytes.size());
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut)
  {
    Digest parts;
    parts.Add(bytes.data(), cut);
    parts.Add(bytes.data() + cut, bytes.size() - cut);
    EXPECT_EQ(parts.Text(), whole.Text()) << cut;
    EXPECT_EQ(parts.Sum(), whole.Sum()) << cut;
  }
  Digest longer;
  longer.Add(bytes.c_str(), bytes.size() + 1); // a zero more
  EXPECT_NE(longer.Sum(), whole.Sum());
}

TEST(Digest, TellsEachChangeOfABitAndOfTheOrder)
{
  std::vector<double> numbers = { 1.0, 2.0, 3.0, 4.0, 5.0 };
  std::set<std::string> texts;
  std::set<std::uint64_t> sums;
  const auto add = [&](const void* bytes, std::size_t size)
  {
    Digest digest;
    digest.Add(bytes, size);
    EXPECT_EQ(digest.Text().size(), 16u);
    texts.insert(digest.Text());
    sums.insert(digest.Sum());
  };
  const std::size_t size = numbers.size() * sizeof(double) - 3;
  auto* bytes = reinterpret_cast<unsigned char*>(numbers.data());
  for (std::size_t bit = 0; bit < 8 * size; ++bit)
  {
    bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
    add(bytes, size);
    bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
  }
  add(bytes, size);
  std::swap(numbers[0], numbers[1]);
  add(bytes, size);
  EXPECT_EQ(texts.size(), 8 * size + 2);
  EXPECT_EQ(sums.size(), 8 * size + 2);
}

TEST(Digest, OfListsSaysWhereOneEnds)
{
  const std::vector<int> one = { 1 }, two = { 1, 2 }, last = { 2 }, none;
  DigestStream a, b, c;
  a.Values(two, none);
  b.Values(one, last);
  c.Values(none, two);
  EXPECT_NE(a.Text(), b.Text());
  EXPECT_NE(a.Text(), c.Text());
  EXPECT_NE(b.Text(), c.Text());
}

namespace
{

struct Part
{
  Vec3 Place = Vec3::Zero();
  Quat Turn = Quat::Identity();
  bool IsThere = false;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Place...);
    visit(of.Turn...);
    visit(of.IsThere...);
  }
};

struct Whole
{
  int Number = 0;
  Eigen::MatrixXd Numbers = Eigen::MatrixXd::Zero(2, 3);
  std::vector<int> Ids{ 1, 2 };
  std::vector<Part> Parts{ 2 };

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Number...);
    visit(of.Numbers...);
    visit(of.Ids...);
    visit(of.Parts...);
  }
};

template <class Change>
std::string DigestAfter(const Change& change)
{
  Whole whole;
  change(whole);
  DigestStream digest;
  digest.Values(whole);
  return digest.Text();
}

} // namespace

TEST(Digest, EveryMemberTellsApart)
{
  const std::string same = DigestAfter([](Whole&) {});
  EXPECT_EQ(same, DigestAfter([](Whole&) {}));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Number = 1; }));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Numbers(1, 2) = 1.0; }));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Ids[1] = 3; }));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Ids.pop_back(); }));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Parts.pop_back(); }));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Parts[1].Place.z() = 1.0; }));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Parts[0].Turn = Quat(0.0, 1.0, 0.0, 0.0); }));
  EXPECT_NE(same, DigestAfter([](Whole& w) { w.Parts[0].IsThere = true; }));
}
