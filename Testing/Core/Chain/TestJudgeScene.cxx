// SPDX-License-Identifier: BSD-3-Clause
// What is found in scenes before they fly, as values. The sentences, and that the command tells
// them, are held by Python.Starting; the time of long lists by Python.Limits.
#include "Chain/BuiltinAssets.h"
#include "Chain/JudgeScene.h"
#include "Planning/SwirlDatabase.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

namespace
{

const std::string Leaf = R"({"shape": "leaf", "position": [-0.4, 0.1, 1.6]})";

Result Judge(const std::string& more, const std::string& objects, SceneJudgement& judged)
{
  const std::string text =
    R"({"waft": 1, "shapes": {"leaf": {"builtin": "maple", "size": 0.12}}, "objects": [)" +
    objects + "]" + more +
    (more.find("\"time\"") == std::string::npos ? R"(, "time": {"frames": 60}})" : "}");
  Scene scene;
  const Result read = ParseScene(text, "scene", ".", BuiltinAssets(), scene);
  EXPECT_TRUE(read) << read.Message();
  return JudgeScene(scene, test::SwirlDatabase(), SerialFor(), judged);
}

/// The first finding of a kind.
Finding FirstOf(const std::string& kind, const std::string& more, const std::string& objects = Leaf)
{
  SceneJudgement judged;
  const Result result = Judge(more, objects, judged);
  EXPECT_TRUE(result) << result.Message();
  const auto found = std::find_if(judged.Findings.begin(), judged.Findings.end(),
                                  [&kind](const Finding& one) { return one.Kind == kind; });
  EXPECT_NE(found, judged.Findings.end()) << kind;
  return found != judged.Findings.end() ? *found : Finding();
}

void ExpectAbout(const Finding& finding, int object, int frame, int row, const Vec3& place)
{
  EXPECT_EQ(finding.ObjectId, object) << finding.Text;
  EXPECT_EQ(finding.Frame, frame) << finding.Text;
  EXPECT_EQ(finding.Row, row) << finding.Text;
  EXPECT_EQ(finding.Target, row < 0 ? -1 : 0) << finding.Text;
  ASSERT_TRUE(finding.Place) << finding.Text;
  EXPECT_LT((*finding.Place - place).norm(), 1e-9) << finding.Text;
}

std::string Rows(const std::string& rows)
{
  return R"(, "constraints": [)" + rows + "]";
}

const std::string Block =
  R"(, "obstacles": [{"kind": "box", "min": [0, 0, 0], "max": [0.5, 0.5, 1]}])";

} // namespace

TEST(JudgeScene, TellsWhomWhereAndWhenARowCannotBeMet)
{
  const std::string rows =
    Rows(R"({"kind": "position", "object": 0, "frame": 20, "value": [-0.4, 0, 1.5]},
                                   {"kind": "position", "object": 0, "frame": 50, "value": [0.2, 0.2, 0.6]})");
  const Finding inside = FirstOf("infeasible", Block + rows);
  EXPECT_FALSE(inside.IsPossible);
  ExpectAbout(inside, 0, 50, 1, { 0.2, 0.2, 0.6 });
  SceneJudgement judged;
  ASSERT_TRUE(Judge(Block + rows, Leaf, judged));
  EXPECT_EQ(judged.NumberOfImpossible(), 1u);
  EXPECT_EQ(judged.Report.size(), 2u);
  EXPECT_EQ(judged.Constraints.size(), 2u);
  EXPECT_EQ(judged.Constraints[1].Status, ConstraintStatus::Infeasible);
  EXPECT_EQ(judged.Lines().front().rfind("cannot be met: row 1 target 0 (object 0", 0), 0u);
}

TEST(JudgeScene, TellsOfABodyThatBeginsInsideSomethingThoughNothingIsAskedOfIt)
{
  const Finding start =
    FirstOf("start", Block, R"({"shape": "leaf", "position": [0.2, 0.2, 0.5]}, )" + Leaf);
  EXPECT_TRUE(start.IsPossible);
  ExpectAbout(start, 0, 0, -1, { 0.2, 0.2, 0.5 });
}

TEST(JudgeScene, TellsWhatWillBeHardAndAboutWhom)
{
  ExpectAbout(
    FirstOf("too fast",
            Rows(R"({"kind": "position", "object": 0, "frame": 30, "value": [1.4, 0.1, 1.6]})")),
    0, 30, 0, { 1.4, 0.1, 1.6 });
  ExpectAbout(
    FirstOf("no time to fall",
            Rows(R"({"kind": "rest", "object": 0, "frame": 30, "value": [-0.4, 0.1, 0]})")),
    0, 30, 0, { -0.4, 0.1, 0.0 });
  const std::string stone =
    R"({"shape": "leaf", "position": [-0.4, 0.1, 1.6], "settlingSpeed": 5})";
  ExpectAbout(
    FirstOf("too heavy",
            Rows(R"({"kind": "position", "object": 0, "frame": 50, "value": [-0.3, 0.1, 1.5]})"),
            stone),
    0, 50, 0, { -0.3, 0.1, 1.5 });
  ExpectAbout(
    FirstOf(
      "too narrow",
      Block +
        Rows(R"({"kind": "position", "object": 0, "frame": 50, "value": [-0.02, 0.2, 0.6]})")),
    0, 50, 0, { -0.02, 0.2, 0.6 });
  ExpectAbout(
    FirstOf("too near",
            Rows(R"({"kind": "position", "object": 1, "frame": 40, "value": [-0.3, 0.1, 1.5]},
                                          {"kind": "position", "object": 0, "frame": 40, "value": [-0.3, 0.15, 1.5]})"),
            Leaf + R"(, {"shape": "leaf", "position": [-0.4, 0.4, 1.6]})"),
    1, 40, 0, { -0.3, 0.1, 1.5 });
  const Finding gap = FirstOf("too narrow", R"(, "obstacles": [
    {"kind": "box", "min": [0, 0, 0.5], "max": [0.5, 0.5, 1]}, {"kind": "box", "min": [0.54, 0, 0.5], "max": [1, 0.5, 1]}])");
  EXPECT_EQ(gap.ObjectId, -1);
  ASSERT_TRUE(gap.Place);
  EXPECT_NEAR(gap.Place->x(), 0.52, 1e-9);
  EXPECT_TRUE(
    FirstOf(
      "too many", R"(, "domain": {"min": [-0.5, -0.5, 0], "max": [0.5, 0.5, 0.5]})",
      R"({"shape": "leaf", "count": 40, "clearanceRadius": 0.06, "region": {"min": [-0.4, -0.4, 0.1], "max": [0.4, 0.4, 0.4]}})")
      .IsPossible);
}

TEST(JudgeScene, CountsThoseThatAreAlike)
{
  std::string rows;
  for (int row = 0; row < 8; ++row)
  {
    rows += (row > 0 ? "," : "") + std::string(R"({"kind": "position", "object": 0, "frame": )") +
            std::to_string(20 + row) + R"(, "value": [0.2, 0.2, 0.6]})";
  }
  SceneJudgement judged;
  ASSERT_TRUE(Judge(Block + Rows(rows), Leaf, judged));
  EXPECT_EQ(judged.NumberOfImpossible(), 8u);
  const std::vector<std::string> lines = judged.Lines();
  EXPECT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines.back(), "cannot be met: infeasible: 3 more");
}

TEST(JudgeScene, RefusesWhatNoQualityFlies)
{
  SceneJudgement judged;
  const Result slow = Judge(R"(, "time": {"frames": 60, "framesPerSecond": 1})", Leaf, judged);
  EXPECT_FALSE(slow);
  EXPECT_EQ(slow.Message().rfind("FramesPerSecond: expected at least ", 0), 0u) << slow.Message();
  EXPECT_EQ(Judge("", "", judged).Message(), "/objects: expected at least one object, found none");
  EXPECT_TRUE(judged.Findings.empty());
}
