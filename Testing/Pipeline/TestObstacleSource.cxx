// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Bridge/Data/FieldCollectors.h"
#include "Obstacles/ObstacleSet.h"

#include <vtkAppendPolyData.h>
#include <vtkObstacleSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <array>

namespace
{

std::vector<waft::ObstacleMesh> Obstacles(vtkAlgorithm* algorithm)
{
  algorithm->Update();
  auto* data = vtkPolyData::SafeDownCast(algorithm->GetOutputDataObject(0));
  EXPECT_EQ(data->GetPointData()->GetArray("ObstacleId"), nullptr);
  waft::ObstacleCollector collector;
  EXPECT_TRUE(collector.Add(data, 0.0, waft::Timeline()));
  return collector.Take();
}

double DistanceTo(const std::vector<waft::ObstacleMesh>& obstacles, const waft::Vec3& x)
{
  waft::ObstacleSet set;
  EXPECT_TRUE(set.Build(obstacles));
  return set.SignedDistance(x, 0.0);
}

} // namespace

TEST(ObstacleSource, GivesEachKindWhereItIsWanted)
{
  vtkNew<vtkObstacleSource> source;
  source->SetCorner(1.0, 0.0, 0.0);
  source->SetSize(0.5, 1.0, 2.0);
  EXPECT_NEAR(DistanceTo(Obstacles(source), { 0.75, 0.5, 1.0 }), 0.25, 1e-12);
  source->SetKind(vtkObstacleSource::SPHERE);
  source->SetCenter(0.0, 0.0, 2.0);
  source->SetRadius(0.5);
  EXPECT_NEAR(DistanceTo(Obstacles(source), { 0.0, 0.0, 3.0 }), 0.5, 1e-12);
  source->SetKind(vtkObstacleSource::CYLINDER);
  source->SetBase(0.0, 0.0, 1.0);
  source->SetTop(0.0, 0.0, 3.0);
  EXPECT_NEAR(DistanceTo(Obstacles(source), { 0.0, 0.0, 3.5 }), 0.5, 1e-12);
}

TEST(ObstacleSource, HasAGroundWhereItIsAskedTo)
{
  vtkNew<vtkObstacleSource> source;
  source->SetKind(vtkObstacleSource::NONE);
  source->GroundOn();
  source->SetGroundHeight(0.25);
  const std::vector<waft::ObstacleMesh> ground = Obstacles(source);
  ASSERT_EQ(ground.size(), 1u);
  EXPECT_NEAR(DistanceTo(ground, { 3.0, -3.0, 1.0 }), 0.75, 1e-12);
}

TEST(ObstacleSource, WhatStandsOnTheGroundIsAnObstacleOfItsOwn)
{
  vtkNew<vtkObstacleSource> first, second;
  first->GroundOn();
  second->SetKind(vtkObstacleSource::SPHERE);
  second->SetCenter(1.5, 1.5, 0.3);
  vtkNew<vtkAppendPolyData> all;
  all->AddInputConnection(first->GetOutputPort());
  all->AddInputConnection(second->GetOutputPort());
  EXPECT_EQ(Obstacles(all).size(), 3u);
}

TEST(ObstacleSource, SaysWhatIsWrong)
{
  const auto said = [](const auto& change) { return ErrorsAfter<vtkObstacleSource>(change); };
  const std::array<std::string, 3> texts = {
    said([](vtkObstacleSource* s) { s->SetSize(1.0, 0.0, 1.0); }),
    said(
      [](vtkObstacleSource* s)
      {
        s->SetKind(vtkObstacleSource::CYLINDER);
        s->SetTop(s->GetBase());
      }),
    said([](vtkObstacleSource* s) { s->SetKind(vtkObstacleSource::NONE); }),
  };
  EXPECT_NE(texts[0].find("Size: expected extents above 0"), std::string::npos) << texts[0];
  EXPECT_NE(texts[1].find("Top: expected another place than Base"), std::string::npos) << texts[1];
  EXPECT_NE(texts[2].find("Kind: expected an obstacle, or Ground on"), std::string::npos)
    << texts[2];
}
