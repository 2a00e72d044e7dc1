// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/RowCover.h"

#include "Base/Random.h"
#include "PlanScenes.h"
#include "Planning/RowTurns.h"

#include <gtest/gtest.h>

#include <tuple>

using namespace waft;
using namespace waft::test;

namespace
{

constexpr double Rate = 30.0;
const SpeedLimit Limit(2.5 / Rate, Rate, 8, 1e-8);

struct CoverScene : PlanScene
{
  CoverScene() { Check(this->Obstacles.Build(this->Meshes)); }

  std::vector<Constraint> Covered() const
  {
    std::vector<Constraint> rows = this->Constraints;
    CoverRows(this->Objects, std::vector<unsigned char>(rows.size(), 1), this->Obstacles, Limit,
              rows);
    return rows;
  }

  /// Rows that no way leads to, legs in haste, sum of squares; a way through what cannot be flown
  /// counts as a row that none leads to, many times.
  std::tuple<int, int, double> CostOf(const std::vector<Constraint>& rows) const
  {
    int left = 0;
    int hasty = 0;
    double sum = 0.0;
    for (const Constraint& row : rows)
    {
      left += row.ObjectId < 0 ? 1 : 0;
    }
    for (const MotionObject& object : this->Objects)
    {
      std::vector<std::pair<Stop, bool>> stops{ { StartOf(object, this->Obstacles), false } };
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        if (rows[i].ObjectId == object.ObjectId)
        {
          stops.emplace_back(StopOf(rows[i], object.RestHeight, this->Obstacles),
                             this->Constraints[i].ObjectId < 0);
        }
      }
      std::stable_sort(stops.begin(), stops.end(),
                       [](const auto& a, const auto& b) { return a.first.First < b.first.First; });
      for (std::size_t k = 1; k < stops.size(); ++k)
      {
        const double haste = Limit.Haste(stops[k - 1].first, stops[k].first);
        sum += (stops[k].first.Value - stops[k - 1].first.Value).squaredNorm();
        if (stops[k - 1].second || stops[k].second)
        {
          left += haste > 1.0 ? 1000 : 0;
          hasty += haste > 0.85 ? 1 : 0;
        }
      }
    }
    return { left, hasty, sum };
  }

  /// Every choice of an object, or none, for each row that is free.
  std::tuple<int, int, double> TryAll() const
  {
    std::tuple<int, int, double> best{ 1000000, 0, 0.0 };
    std::vector<Constraint> rows = this->Constraints;
    const std::function<void(std::size_t)> extend = [&](std::size_t i)
    {
      if (i == rows.size())
      {
        best = std::min(best, this->CostOf(rows));
        return;
      }
      extend(i + 1);
      for (const MotionObject& object : this->Objects)
      {
        if (this->Constraints[i].ObjectId < 0 &&
            (rows[i].ClassId < 0 || rows[i].ClassId == object.ClassId))
        {
          rows[i].ObjectId = object.ObjectId;
          extend(i + 1);
          rows[i].ObjectId = -1;
        }
      }
    };
    extend(0);
    return best;
  }
};

} // namespace

TEST(RowCover, CostsAsLittleAsEveryChoiceTried)
{
  Random random(5);
  const Box room{ Vec3(-2, -2, 0.5), Vec3(2, 2, 3.5) };
  for (int trial = 0; trial < 150; ++trial)
  {
    CoverScene scene;
    const int kinds = trial % 3; // of classes; the first without
    for (int o = 0; o < 3; ++o)
    {
      scene.AddObject(random.InBox(room));
      scene.Objects.back().ClassId = kinds == 0 ? -1 : o % kinds;
    }
    const int rows = 3 + static_cast<int>(random.Index(3));
    for (int i = 0; i < rows; ++i)
    {
      const bool rests = random.Uniform() < 0.3;
      Constraint& row = scene.AddRow(rests ? ConstraintKind::Rest : ConstraintKind::Position, -1,
                                     10 + static_cast<int>(random.Index(250)), random.InBox(room));
      row.Until = row.Frame + (rests ? static_cast<int>(random.Index(40)) : 0);
      row.ClassId = kinds == 0 || random.Uniform() < 0.5 ? -1 : int(random.Index(kinds));
    }
    for (int o = 0; o < trial % 4; ++o) // rows that have an object already
    {
      scene.AddRow(ConstraintKind::Position, o, 150 + 40 * o, random.InBox(room));
    }
    const auto found = scene.CostOf(scene.Covered());
    const auto best = scene.TryAll();
    // A row that is left over may be given to who has nothing else to do.
    if (std::get<0>(best) == 0)
    {
      EXPECT_EQ(std::get<0>(found), 0) << trial;
      EXPECT_EQ(std::get<1>(found), std::get<1>(best)) << trial;
      EXPECT_NEAR(std::get<2>(found), std::get<2>(best), 1e-9) << trial;
    }
  }
}

TEST(RowCover, SendsAnotherWhereTimeIsShort)
{
  CoverScene scene;
  scene.AddObject(Vec3(0.8, 0.8, 1.5));
  scene.AddObject(Vec3(-0.8, -0.8, 3.9)); // farther from the rest than the mark is
  scene.AddRow(ConstraintKind::Position, -1, 240, Vec3(0.8, 0.8, 1.0));
  scene.AddRow(ConstraintKind::Rest, -1, 280, Vec3(-0.6, -0.6, 0.1)).Until = 299;
  const std::vector<Constraint> rows = scene.Covered();
  EXPECT_EQ(rows[0].ObjectId, 0);
  EXPECT_EQ(rows[1].ObjectId, 1);
}

TEST(RowCover, KeepsToRowsThatHaveAnObject)
{
  CoverScene scene;
  scene.AddObject(Vec3(0, 0, 2));
  scene.AddObject(Vec3(1.5, 0, 2));
  scene.AddRow(ConstraintKind::Position, -1, 100, Vec3(0.1, 0, 2)); // next to 0, but on the way ...
  scene.AddRow(ConstraintKind::Rest, 0, 60, Vec3(-1.5, 0, 0.1)).Until = 200; // ... it lies there
  EXPECT_EQ(scene.Covered()[0].ObjectId, 1);
  scene.Constraints[1].Until = 80;
  EXPECT_EQ(scene.Covered()[0].ObjectId, 1) << "20 frames are too few";
}

TEST(RowCover, LeavesOverWhatNobodyCanReachAndSendsWhoIsIdle)
{
  CoverScene scene;
  scene.AddObject(Vec3(-1.9, 0, 2));
  scene.AddRow(ConstraintKind::Position, -1, 8, Vec3(1.9, 0, 2));
  EXPECT_EQ(scene.Covered()[0].ObjectId, 0) << "it comes as near as it can";
  scene.AddRow(ConstraintKind::Position, -1, 100, Vec3(-1, 0, 2));
  const std::vector<Constraint> rows = scene.Covered();
  EXPECT_EQ(rows[0].ObjectId, -1);
  EXPECT_EQ(rows[1].ObjectId, 0);
}

TEST(RowCover, SendsTheNearestWhereNoRowCanBeMet)
{
  CoverScene scene;
  scene.AddObject(Vec3(-1.9, 0, 2));
  scene.AddObject(Vec3(1, 0, 2));
  scene.AddRow(ConstraintKind::Position, -1, 100, Vec3(1.9, 0, 2));
  std::vector<Constraint> rows = scene.Constraints;
  CoverRows(scene.Objects, { 0 }, scene.Obstacles, Limit, rows);
  EXPECT_EQ(rows[0].ObjectId, 1);
}

TEST(RowCover, CoversThousandsInNoTime)
{
  CoverScene scene;
  Random random(2);
  const Box room{ Vec3(-2, -2, 0.5), Vec3(2, 2, 3.5) };
  for (int i = 0; i < 700; ++i)
  {
    scene.AddObject(random.InBox(room));
    scene.AddRow(ConstraintKind::Position, -1, 40 + static_cast<int>(random.Index(250)),
                 random.InBox(room));
  }
  for (const Constraint& row : scene.Covered())
  {
    EXPECT_GE(row.ObjectId, 0);
  }
}

TEST(RowCover, GivesVeryManyTheirTurnsAndKeepsToWhatCanBeFlown)
{
  CoverScene scene;
  Random random(3);
  const Box room{ Vec3(-2, -2, 0.5), Vec3(2, 2, 3.5) };
  for (int i = 0; i < 2000; ++i) // twice as many as are shared out all together
  {
    scene.AddObject(random.InBox(room));
    scene.AddRow(ConstraintKind::Position, -1, 40 + static_cast<int>(random.Index(250)),
                 random.InBox(room));
  }
  scene.AddRow(ConstraintKind::Position, 7, 150, Vec3(0, 0, 2));
  const std::vector<Constraint> rows = scene.Covered();
  const auto [left, hasty, sum] = scene.CostOf(rows);
  EXPECT_EQ(left, 0);
  EXPECT_LT(hasty, 100);
  EXPECT_LT(sum, 2000.0); // at random, legs are 2.4 m long
}

TEST(RowTurns, TheNearestThatCanBeThereGoes)
{
  std::vector<MotionObject> objects(3);
  std::vector<std::vector<Stop>> stops;
  for (std::size_t o = 0; o < objects.size(); ++o)
  {
    objects[o].ObjectId = static_cast<int>(o);
    objects[o].ClassId = o == 2 ? 1 : 0;
    objects[o].Position = Vec3(static_cast<double>(o), 0, 2);
    stops.push_back({ StartOf(objects[o], ObstacleSet()) });
  }
  Stop busy;
  busy.First = 90;
  busy.Last = 120;
  busy.Value = busy.Position = Vec3(0, 0, 2);
  stops[0].push_back(busy);
  const auto target = [](int frame, const Vec3& place, int classId)
  {
    TargetStops made;
    made.First.First = made.First.Last = frame;
    made.First.Value = made.First.Position = place;
    made.Last = made.First;
    made.ClassId = classId;
    return made;
  };
  const std::vector<TargetStops> targets{ target(60, Vec3(0.1, 0, 2), -1),
                                          target(100, Vec3(0.1, 0, 2), -1),
                                          target(100, Vec3(0.1, 0, 2), 1),
                                          target(101, Vec3(0.6, 0, 2), 0),
                                          target(103, Vec3(-2, 0, 2), -1) };
  // 0 is busy at 100, 1 is at 100 where it is asked for again, and nobody is in time for the last.
  EXPECT_EQ(CoverInTurn(objects, stops, targets, Limit),
            (std::vector<std::size_t>{ 0, 1, 2, NoObject, NoObject }));
}
