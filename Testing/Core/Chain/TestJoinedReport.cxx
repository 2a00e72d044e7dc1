// SPDX-License-Identifier: BSD-3-Clause
// The report of a run out of those of its stages.
#include "Chain/JoinedReport.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

ReportRow Line(int row, ConstraintStatus status, const std::string& message,
               ConstraintKind kind = ConstraintKind::Position)
{
  ReportRow line;
  line.Row = row;
  line.Kind = kind;
  line.Status = status;
  line.Message = message;
  return line;
}

} // namespace

TEST(JoinedReport, HasThePlannersReasonsAndHowNearTheMotionComes)
{
  const auto unmet = ConstraintStatus::Unreachable;
  const std::vector<JoinedRow> joined = JoinReports(
    { Line(0, unmet, "not met; it comes within 0.2 m"), Line(1, ConstraintStatus::Met, "") },
    { Line(0, unmet, "no path; it comes within 0.9 m; try later") }, {}, {});
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_EQ(joined[0].Message, "no path; try later; it comes within 0.2 m");
  EXPECT_EQ(joined[1].Message, "");
  EXPECT_EQ(joined[0].TouchDown, -1);
}

TEST(JoinedReport, TakesOrientationsAsTheyWereTurned)
{
  const auto orientation = ConstraintKind::Orientation;
  ReportRow turned = Line(0, ConstraintStatus::Unreachable, "too fast", orientation);
  turned.Residual = 0.5;
  const std::vector<ReportRow> moved = { Line(0, ConstraintStatus::Met, "", orientation),
                                         Line(1, ConstraintStatus::Infeasible, "two at once",
                                              orientation) };
  ReportRow other = turned;
  other.Row = 1;
  const std::vector<JoinedRow> joined = JoinReports(moved, {}, { turned, other }, {});
  EXPECT_EQ(joined[0].Status, ConstraintStatus::Unreachable);
  EXPECT_EQ(joined[0].Residual, 0.5);
  EXPECT_EQ(joined[1].Message, "two at once") << "what was judged before stands";
}

TEST(JoinedReport, TellsWhenRestsBeginAndEnd)
{
  Constraint rest;
  rest.Kind = ConstraintKind::Rest;
  rest.Row = 3;
  rest.TouchDown = 28;
  rest.Settled = 33;
  rest.LiftOff = 40;
  const std::vector<JoinedRow> joined =
    JoinReports({ Line(3, ConstraintStatus::Met, "", ConstraintKind::Rest) }, {}, {}, { rest });
  EXPECT_EQ(joined[0].TouchDown, 28);
  EXPECT_EQ(joined[0].Settled, 33);
  EXPECT_EQ(joined[0].LiftOff, 40);
}

TEST(JoinedReport, APlaceThatIsMetMayFaceOtherwise)
{
  ReportRow faces = Line(2, ConstraintStatus::Conflict, "it faces elsewhere");
  faces.Residual = 0.4;
  const std::vector<JoinedRow> joined =
    JoinReports({ Line(2, ConstraintStatus::Met, "") }, {}, { faces }, {});
  EXPECT_EQ(joined[0].Status, ConstraintStatus::Conflict);
  EXPECT_EQ(joined[0].Message, "it faces elsewhere");
  EXPECT_EQ(joined[0].Residual, 0.0) << "of the place";
}
