// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/SceneData.h"

#include <vtkAppendPolyData.h>
#include <vtkConstraintSource.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

namespace
{

std::vector<waft::Constraint> Rows(vtkPolyData* data)
{
  std::vector<waft::Constraint> rows;
  waft::SceneInfo info;
  EXPECT_TRUE(waft::SceneInfoFromFieldData(data, info));
  EXPECT_TRUE(waft::ConstraintsFromPolyData(data, info.Time, rows));
  return rows;
}

} // namespace

TEST(ConstraintSource, GivesARowOfEachKind)
{
  for (int kind = 0; kind <= 4; ++kind)
  {
    vtkNew<vtkConstraintSource> source;
    source->SetKind(kind);
    source->SetObjectId(3);
    source->SetFrame(40);
    source->SetUntil(60);
    source->SetValue(0.5, -0.25, 1.0);
    source->SetOrientation(0.0, 0.0, 0.0, 3.0);
    source->SetRadius(0.125);
    source->Update();
    const std::vector<waft::Constraint> rows = Rows(source->GetOutput());
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(static_cast<int>(rows[0].Kind), kind);
    EXPECT_EQ(rows[0].ObjectId, 3);
    EXPECT_EQ(rows[0].Frame, 40);
    EXPECT_EQ(rows[0].Radius, 0.125);
    if (kind == vtkConstraintSource::ORIENTATION)
    {
      EXPECT_EQ(rows[0].Orientation.coeffs(), waft::Quat(0.0, 0.0, 0.0, 1.0).coeffs());
    }
    else
    {
      EXPECT_EQ(rows[0].Value, waft::Vec3(0.5, -0.25, 1.0));
    }
    if (kind == vtkConstraintSource::REST)
    {
      EXPECT_EQ(rows[0].Until, 60);
    }
    EXPECT_EQ(TimeSteps(source).size(), 300u);
  }
}

TEST(ConstraintSource, AsksWhereAPositionFaces)
{
  vtkNew<vtkConstraintSource> source;
  source->Update();
  EXPECT_TRUE(Rows(source->GetOutput())[0].Facing.isZero());
  source->SetFacing(0.0, -2.0, 0.0);
  source->SetFacingTolerance(0.2);
  source->UseWaypointsOn();
  source->Update();
  for (const waft::Constraint& row : Rows(source->GetOutput()))
  {
    EXPECT_EQ(row.Facing, waft::Vec3(0.0, -1.0, 0.0));
    EXPECT_EQ(row.FacingTolerance, 0.2);
  }
  source->SetKind(vtkConstraintSource::REST);
  source->Update();
  EXPECT_TRUE(Rows(source->GetOutput())[0].Facing.isZero()) << "a rest lies as it comes down";
}

TEST(ConstraintSource, SpreadsWaypointsEvenlyInTime)
{
  vtkNew<vtkConstraintSource> source;
  source->SetFrame(20);
  source->SetLastFrame(120);
  source->Update();
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 1) << "waypoints wait to be used";
  source->UseWaypointsOn();
  source->SetNumberOfWaypoints(3);
  for (int k = 0; k < 3; ++k)
  {
    source->SetWaypoint(k, 0.5 * k, 0.0, 2.0);
  }
  source->Update();
  std::vector<waft::Constraint> rows = Rows(source->GetOutput());
  ASSERT_EQ(rows.size(), 3u);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(rows[k].Frame, 20 + 50 * k);
    EXPECT_EQ(rows[k].Value, waft::Vec3(0.5 * k, 0.0, 2.0));
  }
  source->SetNumberOfWaypoints(2);
  source->SetLastFrame(-1);
  source->Update();
  rows = Rows(source->GetOutput());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].Frame, 299);
}

TEST(ConstraintSource, RowsOfAppendedSourcesAreTheirVertices)
{
  vtkNew<vtkConstraintSource> one;
  vtkNew<vtkConstraintSource> other;
  other->SetFrame(200);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(one->GetOutputPort());
  both->AddInputConnection(other->GetOutputPort());
  both->Update();
  vtkPolyData* data = both->GetOutput();
  data->SetFieldData(one->GetOutput()->GetFieldData());
  const std::vector<waft::Constraint> rows = Rows(data);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].Row, 0);
  EXPECT_EQ(rows[1].Row, 1);
}

TEST(ConstraintSource, SaysWhatIsWrong)
{
  const auto message = [](const auto& change) { return ErrorsAfter<vtkConstraintSource>(change); };
  const auto contains = [](const std::string& text, const char* part)
  { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(contains(message([](vtkConstraintSource* s) { s->SetFrame(300); }), "at most 299"));
  EXPECT_TRUE(contains(message(
                         [](vtkConstraintSource* s)
                         {
                           s->UseWaypointsOn();
                           s->SetNumberOfWaypoints(5);
                           s->SetFrame(10);
                           s->SetLastFrame(12);
                         }),
                       "at least 14"));
  EXPECT_TRUE(contains(message(
                         [](vtkConstraintSource* s)
                         {
                           s->SetKind(vtkConstraintSource::VELOCITY);
                           s->UseWaypointsOn();
                         }),
                       "position or rest"));
  EXPECT_TRUE(contains(message(
                         [](vtkConstraintSource* s)
                         {
                           s->UseWaypointsOn();
                           s->SetNumberOfWaypoints(0);
                         }),
                       "expected at least one"));
  EXPECT_TRUE(contains(message(
                         [](vtkConstraintSource* s)
                         {
                           s->SetKind(vtkConstraintSource::ORIENTATION);
                           s->SetOrientation(0.0, 0.0, 0.0, 0.0);
                         }),
                       "quaternion"));
}
