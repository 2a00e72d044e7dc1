// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "RasterDrag.h"
#include "Rotation/PanelBody.h"
#include "RotationFixtures.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::fixtures;

namespace
{
struct Prepared
{
  ShellProperties Properties;
  PanelBody Panels;
};

Prepared Prepare(const Shape& shape)
{
  Prepared body;
  EXPECT_TRUE(ComputeShellProperties(shape, body.Properties));
  EXPECT_TRUE(body.Panels.Build(shape, body.Properties, 128, SerialFor()));
  return body;
}

AirCoefficients PaperDrag()
{
  AirCoefficients coefficients;
  coefficients.Model = AirModel::Paper;
  coefficients.Drag = 1.1;
  return coefficients;
}
} // namespace

TEST(ShellProperties, OfARectangle)
{
  Shape sheet = Sheet(0.3, 0.1);
  sheet.Thickness = 0.02;
  ShellProperties p;
  ASSERT_TRUE(ComputeShellProperties(sheet, p));
  EXPECT_NEAR(p.Area, 0.03, 1e-15);
  const double xx = 0.09 / 12.0;
  const double yy = 0.01 / 12.0;
  const double zz = 0.0004 / 12.0;
  const Vec3 box(yy + zz, xx + zz, xx + yy);
  EXPECT_LT((p.InertiaPerMass - Mat3(box.asDiagonal())).norm(), 1e-15);
}

TEST(ShellProperties, ErrorsNameTheShape)
{
  Shape empty;
  empty.Name = "nothing";
  ShellProperties p;
  const Result result = ComputeShellProperties(empty, p);
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("nothing"), std::string::npos);
  Shape flat = Sheet(0.1, 0.0);
  EXPECT_FALSE(ComputeShellProperties(flat, p));
}

TEST(PanelBody, ForeshortenedAreaOfRectangleAndSphere)
{
  const Prepared sheet = Prepare(Sheet(0.3, 0.1));
  const Prepared ball = Prepare(Ball(0.05, 48));
  EXPECT_FALSE(sheet.Panels.HidesItself());
  EXPECT_TRUE(ball.Panels.HidesItself());
  EXPECT_NEAR(sheet.Panels.Flatness(), 1.0, 1e-12);
  EXPECT_NEAR(ball.Panels.Flatness(), 0.0, 0.01);
  Random random(11);
  for (int i = 0; i < 40; ++i)
  {
    const Vec3 d = random.Direction();
    EXPECT_NEAR(sheet.Panels.ForeshortenedArea(d), 0.03 * std::abs(d.z()), 1e-12);
    const double disc = std::acos(-1.0) * 0.05 * 0.05;
    EXPECT_NEAR(ball.Panels.ForeshortenedArea(d), disc, 0.01 * disc);
  }
}

TEST(PanelBody, AgreesWithTheRasterPixelByPixel)
{
  const Shape shape = CurledLeaf();
  const Prepared leaf = Prepare(shape);
  Random random(2);
  for (int i = 0; i < 20; ++i)
  {
    const Vec3 w = 1.5 * random.Direction();
    const Wrench pixels =
      RasterDrag(Rasterise(shape.Mesh, w.normalized(), 256), w, Mat3::Zero(), 1.1, 1.0);
    const Wrench panels = leaf.Panels.Evaluate(w, Mat3::Zero(), PaperDrag());
    const double scale = 0.5 * 1.1 * 1.5 * 1.5 * leaf.Panels.Area();
    EXPECT_LT((pixels.Force - panels.Force).norm(), 0.02 * scale);
    EXPECT_LT((pixels.Torque - panels.Torque).norm(), 0.02 * scale * 0.03);
  }
}

TEST(PanelBody, TurningBroadsidePlateIsDampedByItsSecondMoment)
{
  // Slow turning at omega about y while moving at v along z: torque = -cd v omega int x^2 dA.
  const Prepared sheet = Prepare(Sheet(0.2, 0.1));
  const double v = 2.0;
  const double omega = 1e-3;
  const Wrench drag =
    sheet.Panels.Evaluate(Vec3(0.0, 0.0, v), CrossMatrix(Vec3(0.0, omega, 0.0)), PaperDrag());
  const double expected = -1.1 * v * omega * 0.02 * 0.04 / 12.0;
  EXPECT_NEAR(drag.Torque.y(), expected, 0.02 * std::abs(expected));
}

TEST(PanelBody, AirThatMovesAlongGivesNothing)
{
  const Prepared leaf = Prepare(CurledLeaf());
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    AirCoefficients coefficients;
    coefficients.Model = model;
    const Wrench air = leaf.Panels.Evaluate(Vec3::Zero(), Mat3::Zero(), coefficients);
    EXPECT_EQ(air.Force.norm(), 0.0);
    EXPECT_EQ(air.Torque.norm(), 0.0);
  }
}

TEST(PanelBody, BroadsideSymmetricPlateFeelsNoTorque)
{
  const Prepared sheet = Prepare(Sheet(0.2, 0.1));
  for (const AirModel model : { AirModel::Paper, AirModel::Plate })
  {
    AirCoefficients coefficients;
    coefficients.Model = model;
    const Wrench air = sheet.Panels.Evaluate(Vec3(0.0, 0.0, -1.3), Mat3::Zero(), coefficients);
    EXPECT_LT(air.Torque.norm(), 1e-15);
    EXPECT_NEAR(air.Force.z(), 0.5 * 1.2 * 1.69 * 0.02, 1e-12);
  }
}

TEST(PanelBody, PlateLiftAndCentreOfPressure)
{
  // A plate at angle of attack alpha: C_N = cd sin (1 + lift cos^2) on the centre of pressure,
  // PressureShift half chords times cos(alpha) ahead of the centre.
  const double length = 0.2;
  const Prepared sheet = Prepare(Sheet(length, 0.1));
  AirCoefficients coefficients;
  coefficients.Friction = 0.0;
  coefficients.PressureShift = 0.5;
  for (const double alpha : { 0.1, 0.5, 1.2 })
  {
    const Vec3 w(std::cos(alpha), 0.0, -std::sin(alpha));
    const Wrench air = sheet.Panels.Evaluate(w, Mat3::Zero(), coefficients);
    const double normal = 0.5 * 1.2 * 0.02 * std::sin(alpha) *
                          (1.0 + coefficients.Lift * std::cos(alpha) * std::cos(alpha));
    EXPECT_NEAR(air.Force.z(), normal, 1e-9);
    EXPECT_NEAR(air.Force.x(), 0.0, 1e-9);
    const double ahead = 0.5 * std::cos(alpha) * 2.0 * length / std::sqrt(12.0);
    EXPECT_NEAR(air.Torque.y(), -ahead * normal, 1e-9);
  }
}

TEST(PanelBody, AddedMassOfADisc)
{
  Shape disc;
  const int sides = 256;
  disc.Mesh.Points.emplace_back(0.0, 0.0, 0.0);
  for (int i = 0; i < sides; ++i)
  {
    const double a = 2.0 * std::acos(-1.0) * i / sides;
    disc.Mesh.Points.emplace_back(0.05 * std::cos(a), 0.05 * std::sin(a), 0.0);
    disc.Mesh.Triangles.push_back({ 0, 1 + i, 1 + (i + 1) % sides });
  }
  const Prepared body = Prepare(disc);
  EXPECT_NEAR(body.Panels.AddedMass()(2, 2), 8.0 / 3.0 * std::pow(0.05, 3), 2e-7);
  EXPECT_NEAR(body.Panels.AddedInertia()(0, 0), 16.0 / 45.0 * std::pow(0.05, 5), 1e-10);
  EXPECT_NEAR(body.Panels.AddedInertia()(2, 2), 0.0, 1e-20);
}

TEST(PanelBody, TorqueOfAnOffCentreTwoPanelPlate)
{
  // Two squares of 0.1 m, at x = 0.15 level and at x = -0.1 tilted by 60 degrees about y.
  Shape plate;
  const auto add = [&](const Vec3& center, const Vec3& u, const Vec3& v)
  {
    const int first = static_cast<int>(plate.Mesh.Points.size());
    for (const Vec3& corner : { Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(v - u) })
    {
      plate.Mesh.Points.push_back(center + corner);
    }
    plate.Mesh.Triangles.push_back({ first, first + 1, first + 2 });
    plate.Mesh.Triangles.push_back({ first, first + 2, first + 3 });
  };
  const double tilt = std::acos(-1.0) / 3.0;
  const Vec3 left(-0.1, 0.02, 0.01);
  const Vec3 right(0.15, -0.03, 0.0);
  add(right, 0.05 * Vec3::UnitX(), 0.05 * Vec3::UnitY());
  add(left, 0.05 * Vec3(std::cos(tilt), 0.0, std::sin(tilt)), 0.05 * Vec3::UnitY());
  const Wrench drag =
    Prepare(plate).Panels.Evaluate(Vec3(0.0, 0.0, -1.7), Mat3::Zero(), PaperDrag());
  const double press = 0.5 * 1.1 * 1.7 * 1.7;
  const Vec3 expected = right.cross(Vec3(0.0, 0.0, press * 0.01)) +
                        left.cross(Vec3(0.0, 0.0, press * 0.01 * std::cos(tilt)));
  EXPECT_LT((drag.Torque - expected).norm(), 0.02 * expected.norm());
}
