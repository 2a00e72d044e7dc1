// SPDX-License-Identifier: BSD-3-Clause
// Vortices and winds that are made by hand.
#include "PipelineTesting.h"

#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkAppendPolyData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkVortexSource.h>
#include <vtkWindSource.h>

#include <gtest/gtest.h>

#include <cmath>

TEST(VortexSource, GivesTheVortexThatItsPropertiesSay)
{
  vtkNew<vtkVortexSource> source;
  source->SetVortexId(7);
  source->SetP1(0.5, 0.0, 1.0);
  source->SetP2(-0.5, 0.25, 2.0);
  source->SetStrength(-1.5);
  source->SetCoreRadius(0.25);
  source->SetCenterTime(2.0);
  source->SetDuration(0.5);
  source->Update();
  std::vector<waft::Vortex> vortices;
  ASSERT_TRUE(waft::VorticesFromPolyData(source->GetOutput(), vortices));
  ASSERT_EQ(vortices.size(), 1u);
  const waft::Vortex& vortex = vortices.front();
  EXPECT_EQ(vortex.VortexId, 7);
  EXPECT_EQ(vortex.P1, waft::Vec3(0.5, 0.0, 1.0));
  EXPECT_EQ(vortex.P2, waft::Vec3(-0.5, 0.25, 2.0));
  EXPECT_EQ(vortex.Strength, -1.5);
  EXPECT_EQ(vortex.CoreRadius, 0.25);
  EXPECT_EQ(vortex.CenterTime, 2.0);
  EXPECT_EQ(vortex.Duration, 0.5);
  EXPECT_EQ(TimeSteps(source).size(), 300u);
}

// The documentation says where the acceleration is largest, and which way it turns.
TEST(VortexSource, TurnsAirAsTheFingersOfARightHandHardestAtItsCore)
{
  vtkNew<vtkVortexSource> source;
  source->Update();
  std::vector<waft::Vortex> vortices;
  ASSERT_TRUE(waft::VorticesFromPolyData(source->GetOutput(), vortices));
  const auto across = [&](double r)
  { return vortices[0].Acceleration(waft::Vec3(r, 0.0, 2.0), vortices[0].CenterTime).y(); };
  EXPECT_GT(across(0.3), 0.0);
  EXPECT_GT(across(0.3), across(0.25));
  EXPECT_GT(across(0.3), across(0.36));
}

TEST(VortexSource, SeveralAreAppended)
{
  vtkNew<vtkAppendPolyData> all;
  vtkNew<vtkVortexSource> sources[2];
  for (int k = 0; k < 2; ++k)
  {
    sources[k]->SetVortexId(k);
    sources[k]->SetStrength(1.0 + k);
    all->AddInputConnection(sources[k]->GetOutputPort());
  }
  all->Update();
  std::vector<waft::Vortex> vortices;
  ASSERT_TRUE(waft::VorticesFromPolyData(all->GetOutput(), vortices));
  ASSERT_EQ(vortices.size(), 2u);
  EXPECT_EQ(vortices[1].Strength, 2.0);
}

TEST(VortexSource, AsksForTwoPoles)
{
  const std::string text =
    ErrorsAfter<vtkVortexSource>([](vtkVortexSource* source) { source->SetP2(source->GetP1()); });
  EXPECT_NE(text.find("P2: expected another place than P1"), std::string::npos) << text;
}

TEST(WindSource, IsABellAboutAPlaceAndATime)
{
  vtkNew<vtkWindSource> source;
  source->SetDirection(0.0, 3.0, 0.0);
  source->SetStrength(2.0);
  source->SetCenter(0.0, 0.0, 2.0);
  source->SetRadius(0.75);
  source->SetCenterTime(4.0);
  source->SetDuration(2.0);
  for (const double time : { 4.0, 6.0 })
  {
    source->UpdateTimeStep(time);
    vtkImageData* image = source->GetOutput();
    waft::SceneInfo info;
    EXPECT_TRUE(waft::SceneInfoFromFieldData(image, info));
    double peak[3];
    double beside[3];
    vtkDataArray* wind = image->GetPointData()->GetArray("Wind");
    ASSERT_NE(wind, nullptr);
    wind->GetTuple(PointAt(image, 0.0, 0.0, 2.0), peak);
    const vtkIdType at = PointAt(image, 0.75, 0.0, 2.0);
    wind->GetTuple(at, beside);
    double x[3];
    image->GetPoint(at, x);
    const double s = (time - 4.0) / 2.0;
    const double bell = 2.0 * std::exp(-0.5 * s * s);
    EXPECT_NEAR(peak[1], bell, 1e-6);
    EXPECT_EQ(peak[0], 0.0);
    EXPECT_NEAR(beside[1], bell * std::exp(-0.5 * x[0] * x[0] / (0.75 * 0.75)), 1e-6);
  }
}

TEST(WindSource, AsksForADirection)
{
  const std::string text =
    ErrorsAfter<vtkWindSource>([](vtkWindSource* source) { source->SetDirection(0.0, 0.0, 0.0); });
  EXPECT_NE(text.find("Direction: expected one, found 0, 0, 0"), std::string::npos) << text;
}
