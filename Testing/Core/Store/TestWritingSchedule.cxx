// SPDX-License-Identifier: BSD-3-Clause
// Writing keeps within its part of the time on disks of any speed, and comes through on each.
#include "Store/WritingSchedule.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

namespace
{

struct Course
{
  double Spent = 0.0, WorstFraction = 0.0, FirstWhole = 0.0, LargestGap = 0.0;
  int Whole = 0;
};

/// A run of iterations of 0.3 s on a disk where a writing takes so long, which is seen to be too
/// long at most `late` after the moment.
Course Simulate(WritingSchedule schedule, double writing, double late, double duration)
{
  Course course;
  double now = 0.0, last = 0.0;
  while (now < duration)
  {
    now += 0.3;
    if (!schedule.IsDue(now))
    {
      continue;
    }
    const double allowance = schedule.Allowance(now);
    const bool isWhole = writing <= allowance;
    const double taken = isWhole ? writing : std::min(writing, allowance + late);
    now += taken;
    schedule.Record(now, taken);
    course.Spent += taken;
    course.WorstFraction = std::max(course.WorstFraction, (course.Spent - late) / now);
    if (isWhole)
    {
      course.FirstWhole = course.Whole == 0 ? now : course.FirstWhole;
      course.LargestGap = std::max(course.LargestGap, now - last);
      last = now;
      ++course.Whole;
    }
  }
  return course;
}

} // namespace

TEST(WritingSchedule, AQuickDiskIsWrittenAtTheInterval)
{
  const Course course = Simulate(WritingSchedule(10.0, 0.02), 0.05, 0.0, 1000.0);
  EXPECT_GE(course.Whole, 95);
  EXPECT_LE(course.WorstFraction, 0.02);
}

TEST(WritingSchedule, AnyDiskTakesAtMostTheFractionAndComesThrough)
{
  for (const double writing : { 0.15, 0.5, 2.0, 10.0, 40.0 })
  {
    const Course course = Simulate(WritingSchedule(10.0, 0.02), writing, 0.0, 1000.0 * writing);
    EXPECT_LE(course.WorstFraction, 0.02 + 1e-12) << writing;
    EXPECT_GE(course.Whole, 8) << writing;
    EXPECT_LE(course.FirstWhole, std::max(11.0, 250.0 * writing)) << writing;
    EXPECT_LE(course.LargestGap, std::max(11.0, 250.0 * writing)) << writing;
  }
}

TEST(WritingSchedule, ALookAtTheClockThatComesLateIsPaidBack)
{
  const Course course = Simulate(WritingSchedule(10.0, 0.02), 30.0, 0.4, 10000.0);
  EXPECT_LE(course.WorstFraction, 0.02 + 1e-12);
  EXPECT_GE(course.Whole, 3);
}

TEST(WritingSchedule, WithoutAnIntervalOneIsAlwaysDue)
{
  WritingSchedule schedule(0.0, 0.02);
  schedule.Record(1.0, 1.0);
  EXPECT_TRUE(schedule.IsDue(1.0));
  EXPECT_GT(schedule.Allowance(1.0), 1e300);
}
