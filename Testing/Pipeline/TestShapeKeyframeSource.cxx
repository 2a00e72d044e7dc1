// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/Primitives.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"

#include <vtkObjectSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkShapeKeyframeSource.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace
{

std::vector<waft::Constraint> Rows(vtkShapeKeyframeSource* source)
{
  std::vector<waft::Constraint> rows;
  waft::SceneInfo info;
  EXPECT_TRUE(waft::SceneInfoFromFieldData(source->GetOutput(), info));
  EXPECT_TRUE(waft::ConstraintsFromPolyData(source->GetOutput(), info.Time, rows));
  return rows;
}

} // namespace

TEST(ShapeKeyframeSource, DrawsATextThatLiesOnTheGround)
{
  vtkNew<vtkShapeKeyframeSource> source;
  source->SetText("L");
  source->SetNumberOfTargets(30);
  source->SetWidth(1.0);
  source->SetOrigin(0.5, 0.0, 0.2);
  source->Update();
  const std::vector<waft::Constraint> rows = Rows(source);
  ASSERT_EQ(rows.size(), 30u);
  int low = 0;
  int left = 0;
  std::set<int> targets;
  for (const waft::Constraint& row : rows)
  {
    EXPECT_EQ(row.Kind, waft::ConstraintKind::Rest);
    EXPECT_EQ(row.ObjectId, -1);
    EXPECT_EQ(row.Frame, 250);
    EXPECT_EQ(row.Until, 299);
    EXPECT_EQ(row.Group, 0);
    EXPECT_EQ(row.Value.z(), 0.2);
    EXPECT_LE(std::abs(row.Value.x() - 0.5), 0.5);
    targets.insert(row.Target);
    low += row.Value.y() < -0.45 ? 1 : 0;
    left += row.Value.x() < 0.25 ? 1 : 0;
  }
  // An L has a foot and a stem at the left, and nothing at the top right.
  EXPECT_EQ(targets.size(), 30u);
  EXPECT_GE(low, 6);
  EXPECT_GE(left, 12);
  for (const waft::Constraint& row : rows)
  {
    EXPECT_FALSE(row.Value.x() > 0.6 && row.Value.y() > 0.2);
  }
}

TEST(ShapeKeyframeSource, DrawsOnceForAllFrames)
{
  vtkNew<vtkShapeKeyframeSource> source;
  source->SetNumberOfTargets(3);
  source->UpdateTimeStep(1.0);
  const vtkPoints* drawn = source->GetOutput()->GetPoints();
  source->UpdateTimeStep(2.0);
  EXPECT_EQ(source->GetOutput()->GetPoints(), drawn);
  source->SetNumberOfTargets(4);
  source->UpdateTimeStep(3.0);
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 4);
}

TEST(ShapeKeyframeSource, HasAsManyTargetsAsThereAreObjects)
{
  vtkNew<vtkShapeKeyframeSource> source;
  source->Update();
  EXPECT_EQ(Rows(source).size(), 48u);
  vtkNew<vtkObjectSource> objects;
  objects->SetLayout(vtkObjectSource::ROW);
  objects->SetNumberOfObjects(5);
  source->SetInputConnection(vtkShapeKeyframeSource::OBJECTS_PORT, objects->GetOutputPort());
  source->Update();
  EXPECT_EQ(Rows(source).size(), 5u);
  objects->SetNumberOfObjects(7);
  source->Update();
  EXPECT_EQ(Rows(source).size(), 7u);
  source->SetNumberOfTargets(3);
  source->Update();
  EXPECT_EQ(Rows(source).size(), 3u);
}

TEST(ShapeKeyframeSource, DrawsASurfaceWhereItStands)
{
  waft::ObstacleMesh ball;
  ball.Mesh = waft::MakeSphere(waft::Vec3(0.0, 0.0, 2.0), 0.5);
  vtkNew<vtkPolyData> sphere;
  waft::ObstaclesToPolyData({ ball }, 0.0, waft::SceneInfo(), sphere);
  vtkNew<vtkShapeKeyframeSource> source;
  source->SetInputDataObject(sphere);
  source->SetShape(vtkShapeKeyframeSource::SURFACE);
  source->SetNumberOfTargets(100);
  source->RestOff();
  source->SetFrame(120);
  source->Update();
  const std::vector<waft::Constraint> rows = Rows(source);
  ASSERT_EQ(rows.size(), 100u);
  waft::Vec3 sum = waft::Vec3::Zero();
  for (const waft::Constraint& row : rows)
  {
    EXPECT_EQ(row.Kind, waft::ConstraintKind::Position);
    EXPECT_NEAR((row.Value - waft::Vec3(0.0, 0.0, 2.0)).norm(), 0.5, 0.01);
    sum += row.Value - waft::Vec3(0.0, 0.0, 2.0);
  }
  EXPECT_LT(sum.norm() / 100.0, 0.05);
}

TEST(ShapeKeyframeSource, DrawsAPictureByTheColoursOfItsClasses)
{
  vtkNew<vtkShapeKeyframeSource> source;
  source->SetShape(vtkShapeKeyframeSource::IMAGE);
  source->SetImageFile(WAFT_SOURCE_DIR "/Data/Shapes/leaf-gold.png");
  source->SetNumberOfTargets(40);
  source->Update();
  ASSERT_EQ(Rows(source).size(), 40u);
  source->SetClassColor(0, 0.9, 0.7, 0.2);
  source->SetClassColor(1, 0.1, 0.1, 0.9);
  source->Update();
  int gold = 0;
  for (const waft::Constraint& row : Rows(source))
  {
    gold += row.ClassId == 0 ? 1 : 0;
  }
  EXPECT_GE(gold, 36);
}

TEST(ShapeKeyframeSource, SaysWhatIsWrong)
{
  const auto message = [](const auto& change)
  { return ErrorsAfter<vtkShapeKeyframeSource>(change); };
  const auto contains = [](const std::string& text, const char* part)
  { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(contains(message([](auto* s) { s->SetText(""); }), "Text: expected"));
  EXPECT_TRUE(contains(message([](auto* s) { s->SetFrame(400); }), "Frame of at most 299"));
  EXPECT_TRUE(contains(message([](auto* s) { s->SetV(2.0, 0.0, 0.0); }), "U and V"));
  EXPECT_TRUE(contains(message([](auto* s) { s->SetWidth(0.0); }), "Width"));
  EXPECT_TRUE(contains(message([](auto* s) { s->SetShape(vtkShapeKeyframeSource::SURFACE); }),
                       "Input: expected a surface"));
  EXPECT_TRUE(contains(message([](auto* s) { s->SetShape(vtkShapeKeyframeSource::IMAGE); }),
                       "ImageFile: expected"));
}

TEST(ShapeKeyframeSource, HasWindowsOrdersAndHolds)
{
  vtkNew<vtkShapeKeyframeSource> source;
  source->SetText("L");
  source->SetNumberOfTargets(5);
  source->SetRest(false);
  source->SetFrame(150);
  source->SetFrameFrom(110);
  source->SetHold(20);
  source->Update();
  for (const waft::Constraint& row : Rows(source))
  {
    EXPECT_TRUE(row.IsOpenWindow); // the air chooses
    EXPECT_EQ(110, row.FrameFrom);
    EXPECT_EQ(170, waft::LastFrame(row));
  }
  source->SetOrder(2); // from right to left
  source->Update();
  std::vector<waft::Constraint> rows = Rows(source);
  std::sort(rows.begin(), rows.end(),
            [](const waft::Constraint& a, const waft::Constraint& b)
            { return a.Value.x() > b.Value.x(); });
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    EXPECT_FALSE(rows[k].IsOpenWindow);
    EXPECT_EQ(110 + 10 * static_cast<int>(k), rows[k].Frame);
    EXPECT_EQ(170, waft::LastFrame(rows[k]));
  }
}
