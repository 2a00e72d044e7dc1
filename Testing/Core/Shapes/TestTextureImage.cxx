// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/Outline.h"
#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"

#include <gtest/gtest.h>

using namespace waft;

TEST(TextureImage, IsOpaqueInsideTheMeshAndClearOutside)
{
  for (const char* name : { "leaf", "maple", "oak", "willow", "aspen", "petal", "disc" })
  {
    SCOPED_TRACE(name);
    SkinOptions skin;
    Outline outline;
    ASSERT_TRUE(OutlineOf(name, outline));
    skin.TextureSize = 128;
    std::vector<std::uint8_t> pixels;
    ASSERT_TRUE(PaintTexture(outline, skin, 96, pixels));
    ASSERT_EQ(pixels.size(), 4u * 128u * 96u);
    Shape shape;
    ASSERT_TRUE(MakeBuiltinShape(name, 0.0, shape));
    int opaque = 0;
    for (const auto& t : shape.Mesh.Triangles)
    {
      double u = 0.0;
      double v = 0.0;
      for (const int corner : t)
      {
        u += shape.TextureCoordinates[corner][0] / 3.0;
        v += shape.TextureCoordinates[corner][1] / 3.0;
      }
      const auto i = std::min<std::size_t>(static_cast<std::size_t>(u * 128), 127);
      const auto j = std::min<std::size_t>(static_cast<std::size_t>(v * 96), 95);
      opaque += pixels[4 * (j * 128 + i) + 3] > 127;
    }
    // Teeth and the notch of a petal cut a little; thin stems fall between pixels.
    EXPECT_GT(opaque, 0.85 * shape.Mesh.Triangles.size());
    EXPECT_EQ(pixels[4 * (95 * 128 + 127) + 3], 0) << "the upper right corner is outside";
  }
}

TEST(TextureImage, FollowsItsSeed)
{
  SkinOptions skin;
  Outline outline;
  ASSERT_TRUE(OutlineOf("feather", outline));
  skin.TextureSize = 64;
  std::vector<std::uint8_t> first;
  std::vector<std::uint8_t> again;
  std::vector<std::uint8_t> other;
  ASSERT_TRUE(PaintTexture(outline, skin, 32, first));
  ASSERT_TRUE(PaintTexture(outline, skin, 32, again));
  skin.Seed = 2;
  ASSERT_TRUE(PaintTexture(outline, skin, 32, other));
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
}

TEST(TextureImage, RefusesUnknownOutlinesAndColours)
{
  std::vector<std::uint8_t> pixels;
  SkinOptions skin;
  Outline outline;
  EXPECT_FALSE(OutlineOf("bubble", outline));
  ASSERT_TRUE(OutlineOf("leaf", outline));
  skin.EdgeColor[1] = 1.5;
  EXPECT_FALSE(PaintTexture(outline, skin, 96, pixels));
  skin = SkinOptions();
  skin.TextureSize = 3;
  EXPECT_FALSE(PaintTexture(outline, skin, 96, pixels));
  EXPECT_FALSE(PaintTexture(outline, SkinOptions(), 3, pixels));
}
