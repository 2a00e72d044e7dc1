// SPDX-License-Identifier: BSD-3-Clause
#include "Base/ShapeMeasures.h"
#include "Shapes/AlphaOutline.h"
#include "Shapes/Photograph.h"
#include "Shapes/PngImage.h"
#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"
#include "Shapes/Triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

/// An ellipse with soft edges, turned, and a speck beside it.
AlphaMask TurnedEllipse(double angle)
{
  AlphaMask mask{ 200, 180, {} };
  for (int j = 0; j < mask.Height; ++j)
  {
    for (int i = 0; i < mask.Width; ++i)
    {
      const double x = i + 0.5 - 100.0;
      const double y = j + 0.5 - 90.0;
      const double u = (std::cos(angle) * x + std::sin(angle) * y) / 70.0;
      const double v = (std::cos(angle) * y - std::sin(angle) * x) / 30.0;
      const bool speck = i < 5 && j < 5;
      const double edge = 0.5 + (1.0 - std::hypot(u, v)) * 20.0;
      mask.Values.push_back(speck ? 1.0F : static_cast<float>(std::clamp(edge, 0.0, 1.0)));
    }
  }
  return mask;
}

AlphaMask PaintedLeaf(LeafKind kind)
{
  LeafForm form;
  form.Kind = kind;
  Outline outline;
  EXPECT_TRUE(OutlineOfLeaf(form, outline));
  SkinOptions skin;
  skin.TextureSize = 200;
  constexpr int height = 160;
  std::vector<std::uint8_t> pixels;
  EXPECT_TRUE(PaintTexture(outline, skin, height, pixels));
  AlphaMask mask{ skin.TextureSize, height, {} };
  for (std::size_t k = 3; k < pixels.size(); k += 4)
  {
    mask.Values.push_back(pixels[k] / 255.0F);
  }
  return mask;
}

} // namespace

TEST(AlphaOutline, FollowsTheEdgeOfTheLargestThing)
{
  Polygon outline;
  ASSERT_TRUE(TraceOutline(TurnedEllipse(0.4), 0.5, outline));
  EXPECT_NEAR(SignedArea(outline), M_PI * 70.0 * 30.0, 0.01 * M_PI * 70.0 * 30.0);
  for (const auto& p : outline)
  {
    const double x = p[0] - 100.0;
    const double y = p[1] - 90.0;
    const double u = (std::cos(0.4) * x + std::sin(0.4) * y) / 70.0;
    const double v = (std::cos(0.4) * y - std::sin(0.4) * x) / 30.0;
    EXPECT_NEAR(std::hypot(u, v), 1.0, 0.02);
  }
  const Polygon simple = SimplifyOutline(outline, 0.8);
  EXPECT_LT(simple.size(), outline.size() / 4);
  EXPECT_NEAR(SignedArea(simple), SignedArea(outline), 0.02 * SignedArea(outline));
}

TEST(AlphaOutline, ThingsThatTouchAtACornerAreApartAndHolesAreFilled)
{
  AlphaMask mask{ 20, 20, std::vector<float>(400, 0.0F) };
  const auto fill = [&](int i0, int j0, int i1, int j1, float value)
  {
    for (int j = j0; j < j1; ++j)
    {
      for (int i = i0; i < i1; ++i)
      {
        mask.Values[static_cast<std::size_t>(20 * j + i)] = value;
      }
    }
  };
  fill(0, 0, 8, 8, 1.0F); // to the picture's border
  fill(8, 8, 12, 12, 1.0F);
  fill(3, 3, 5, 5, 0.0F);
  Polygon outline;
  ASSERT_TRUE(TraceOutline(mask, 0.5, outline));
  EXPECT_NEAR(SignedArea(outline), 64.0, 1.5);
  EXPECT_FALSE(TraceOutline(AlphaMask{ 20, 20, std::vector<float>(400, 0.2F) }, 0.5, outline));
  EXPECT_FALSE(TraceOutline(AlphaMask{ 20, 20, {} }, 0.5, outline));
}

TEST(Triangulation, FillsAConcavePolygonWithFairTriangles)
{
  const Polygon corner{ { 0, 0 }, { 4, 0 }, { 4, 1 }, { 1, 1 }, { 1, 4 }, { 0, 4 } };
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<int, 3>> triangles;
  ASSERT_TRUE(TriangulatePolygon(corner, 0.5, points, triangles));
  double area = 0.0;
  for (const auto& t : triangles)
  {
    const Polygon one{ points[t[0]], points[t[1]], points[t[2]] };
    const double part = SignedArea(one);
    area += part;
    for (int c = 0; c < 3; ++c)
    {
      const double side =
        std::hypot(one[c][0] - one[(c + 1) % 3][0], one[c][1] - one[(c + 1) % 3][1]);
      EXPECT_LE(side, 0.5 + 1e-12);
      EXPECT_GT(part / (side * side), 0.15);
    }
  }
  EXPECT_NEAR(area, 7.0, 1e-12);
  const Polygon bow{ { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 } };
  EXPECT_FALSE(TriangulatePolygon(bow, 0.5, points, triangles));
}

TEST(Photograph, BecomesASheetOnItsBodyAxes)
{
  PhotographOptions options;
  options.Length = 0.14;
  for (const double angle : { 0.0, 0.9, 2.2 })
  {
    Shape shape;
    const AlphaMask mask = TurnedEllipse(angle);
    ASSERT_TRUE(MakePhotographSheet(mask, options, shape));
    EXPECT_NEAR(LargestExtent(shape.Mesh), 0.14, 1e-12);
    EXPECT_LT(ShellCentroid(shape.Mesh).norm(), 1e-12);
    EXPECT_NEAR(SurfaceArea(shape.Mesh), M_PI * 0.07 * 0.03, 0.08 * M_PI * 0.07 * 0.03);
    EXPECT_GT(shape.Mesh.Triangles.size(), 250u);
    EXPECT_LT(shape.Mesh.Triangles.size(), 1500u);
    ASSERT_EQ(shape.TextureCoordinates.size(), shape.Mesh.Points.size());
    double edge = -1.0;
    double middle = 1.0;
    for (std::size_t k = 0; k < shape.Mesh.Points.size(); ++k)
    {
      const Vec3& p = shape.Mesh.Points[k];
      (std::abs(p.y()) > 0.02 ? edge : middle) =
        std::abs(p.y()) > 0.02 ? std::max(edge, p.z()) : std::min(middle, p.z());
      // Each point shows the pixel that it came from.
      const double x = shape.TextureCoordinates[k][0] * mask.Width - 100.0;
      const double y = shape.TextureCoordinates[k][1] * mask.Height - 90.0;
      const double along = std::cos(angle) * x + std::sin(angle) * y;
      EXPECT_NEAR(std::abs(along) / 140.0 * 0.14, std::abs(p.x()), 0.003);
    }
    EXPECT_GT(edge, middle + 0.002);
    for (const auto& t : shape.Mesh.Triangles)
    {
      const Vec3& a = shape.Mesh.Points[t[0]];
      EXPECT_GT((shape.Mesh.Points[t[1]] - a).cross(shape.Mesh.Points[t[2]] - a).z(), 0.0);
    }
  }
}

TEST(Photograph, OfLeavesKeepsTheirArea)
{
  for (const LeafKind kind : { LeafKind::Ovate, LeafKind::Maple, LeafKind::Oak, LeafKind::Willow })
  {
    const AlphaMask mask = PaintedLeaf(kind);
    double opaque = 0.0;
    for (const float alpha : mask.Values)
    {
      opaque += alpha;
    }
    PhotographOptions options;
    options.Curl = 0.0;
    options.Camber = 0.0;
    Shape shape;
    const Result made = MakePhotographSheet(mask, options, shape);
    ASSERT_TRUE(made) << made.Message();
    double shown = 0.0;
    for (const auto& t : shape.Mesh.Triangles)
    {
      Polygon one;
      for (const int c : t)
      {
        one.push_back({ shape.TextureCoordinates[c][0] * mask.Width,
                        shape.TextureCoordinates[c][1] * mask.Height });
      }
      shown += SignedArea(one);
    }
    EXPECT_NEAR(shown, opaque, 0.04 * opaque);
  }
}

TEST(Photograph, RefusesWhatShowsNothing)
{
  Shape shape;
  shape.Name = "before";
  const AlphaMask empty{ 30, 30, std::vector<float>(900, 0.0F) };
  const Result result = MakePhotographSheet(empty, {}, shape);
  EXPECT_FALSE(result);
  EXPECT_NE(result.Message().find("pixels"), std::string::npos);
  PhotographOptions options;
  options.Threshold = 1.0;
  EXPECT_FALSE(options.Validate());
}

TEST(Outline, FormsChangeWhatTheySay)
{
  const auto sheet = [](const LeafForm& form)
  {
    Outline outline;
    EXPECT_TRUE(OutlineOfLeaf(form, outline));
    Shape shape;
    EXPECT_TRUE(MakeSheet(outline, {}, shape));
    return shape.Mesh;
  };
  const auto width = [](const TriangleMesh& mesh)
  {
    double most = 0.0;
    for (const Vec3& p : mesh.Points)
    {
      most = std::max(most, std::abs(p.y()));
    }
    return most;
  };
  for (int kind = 0; kind <= 4; ++kind)
  {
    LeafForm form;
    form.Kind = static_cast<LeafKind>(kind);
    LeafForm slender = form;
    slender.Width = 0.5;
    EXPECT_LT(width(sheet(slender)), 0.65 * width(sheet(form))) << kind;
    LeafForm bare = form;
    bare.StemLength = 0.0;
    Outline outline;
    ASSERT_TRUE(OutlineOfLeaf(bare, outline));
    EXPECT_EQ(outline.StemWidth, 0.0);
    EXPECT_GT(width(sheet(bare)), width(sheet(form))) << "no stem: more of the length is blade";
  }
  LeafForm wrong;
  wrong.Width = 9.0;
  Outline outline;
  EXPECT_FALSE(OutlineOfLeaf(wrong, outline));
  FeatherForm even;
  even.Asymmetry = 0.0;
  ASSERT_TRUE(OutlineOfFeather(even, outline));
  EXPECT_EQ(outline.Left(0.5), outline.Right(0.5));
}

TEST(PngImage, BeginsAndEndsAsOne)
{
  const std::string png = EncodePng(std::vector<std::uint8_t>(4 * 6, 200), 3, 2);
  EXPECT_EQ(png.substr(0, 8), std::string("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
}
