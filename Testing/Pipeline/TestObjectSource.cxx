// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Bridge/Data/SceneData.h"

#include <vtkAppendPolyData.h>
#include <vtkObjectSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

TEST(ObjectSource, GivesOneObjectWithItsScene)
{
  vtkNew<vtkObjectSource> source;
  source->SetPosition(0.5, -1.0, 2.0);
  source->SetOrientation(0.0, 0.0, 0.0, 2.0);
  source->SetObjectId(7);
  source->SetSettlingSpeed(0.3);
  source->SetNumberOfFrames(31);
  source->Update();

  std::vector<waft::MotionObject> objects;
  ASSERT_TRUE(waft::ObjectsFromPolyData(source->GetOutput(), objects));
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].ObjectId, 7);
  EXPECT_EQ(objects[0].Position, waft::Vec3(0.5, -1.0, 2.0));
  EXPECT_EQ(objects[0].Orientation.coeffs(), waft::Quat(0.0, 0.0, 0.0, 1.0).coeffs());
  EXPECT_EQ(objects[0].SettlingSpeed, 0.3);
  waft::SceneInfo info;
  ASSERT_TRUE(waft::SceneInfoFromFieldData(source->GetOutput(), info));
  EXPECT_EQ(info.Time.NumberOfFrames, 31);
  EXPECT_EQ(info.Bounds.Max, waft::Vec3(2.0, 2.0, 4.0));
  EXPECT_EQ(TimeSteps(source).size(), 31u);
}

TEST(ObjectSource, SaysWhetherAPoseIsGiven)
{
  vtkNew<vtkObjectSource> source;
  const auto isGiven = [&]
  {
    source->Update();
    std::vector<waft::MotionObject> objects;
    EXPECT_TRUE(waft::ObjectsFromPolyData(source->GetOutput(), objects));
    return objects.at(0).OrientationGiven;
  };
  EXPECT_EQ(isGiven(), 0);
  source->SetAngles(0.0, 0.0, 30.0);
  EXPECT_EQ(isGiven(), 1);
  source->SetAngles(0.0, 0.0, 0.0);
  source->SetOrientation(-1.0, 0.0, 0.0, 0.0); // level, and asked for
  EXPECT_EQ(isGiven(), 1);
  // Data of others says so by having the array `Orientation`, or not.
  source->GetOutput()->GetPointData()->RemoveArray("OrientationGiven");
  std::vector<waft::MotionObject> objects;
  ASSERT_TRUE(waft::ObjectsFromPolyData(source->GetOutput(), objects));
  EXPECT_EQ(objects[0].OrientationGiven, 1);
  source->GetOutput()->GetPointData()->RemoveArray("Orientation");
  ASSERT_TRUE(waft::ObjectsFromPolyData(source->GetOutput(), objects));
  EXPECT_EQ(objects[0].OrientationGiven, 0);
}

TEST(ObjectSource, RefusesAnOrientationOfZeros)
{
  vtkNew<vtkObjectSource> source;
  source->SetOrientation(0.0, 0.0, 0.0, 0.0);
  ErrorLog errors(source);
  source->Update();
  EXPECT_TRUE(errors.Contains("Orientation: expected a quaternion")) << errors.Text;
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(ObjectSource, SourcesThatAreAppendedAreNumberedInTheirOrder)
{
  vtkNew<vtkObjectSource> first, numbered, second;
  first->SetLayout(vtkObjectSource::ROW);
  first->SetNumberOfObjects(3);
  numbered->SetObjectId(1);
  second->SetPosition(0.0, 1.0, 2.0);
  vtkNew<vtkAppendPolyData> all;
  for (vtkObjectSource* source : { first.Get(), numbered.Get(), second.Get() })
  {
    all->AddInputConnection(source->GetOutputPort());
  }
  all->Update();
  std::vector<waft::MotionObject> objects;
  ASSERT_TRUE(waft::ObjectsFromPolyData(all->GetOutput(), objects));
  std::vector<int> ids;
  for (const waft::MotionObject& object : objects)
  {
    ids.push_back(object.ObjectId);
  }
  EXPECT_EQ(ids, (std::vector<int>{ 0, 2, 3, 1, 4 }));
  second->SetObjectId(1);
  all->Update();
  const waft::Result twice = waft::ObjectsFromPolyData(all->GetOutput(), objects);
  EXPECT_FALSE(static_cast<bool>(twice)); // ids that are given must differ
}
