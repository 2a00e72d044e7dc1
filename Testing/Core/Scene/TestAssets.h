// SPDX-License-Identifier: BSD-3-Clause
// Assets without VTK: built-in shapes, a unit cube for any mesh, letters drawn from bars.
#pragma once

#include "Base/Primitives.h"
#include "Base/ShapeMeasures.h"
#include "Scene/Scene.h"
#include "Shapes/ThinShape.h"

#include <gtest/gtest.h>

namespace waft
{

class TestAssets : public SceneAssets
{
public:
  Result LoadBuiltinShape(const std::string& builtin, double size, Shape& shape) const override
  {
    return MakeBuiltinShape(builtin, size, shape);
  }
  Result LoadAlignedShape(const std::string&, Shape& shape) const override
  {
    shape.Mesh = MakeBox(Box{ Vec3(0.0, 0.0, 0.0), Vec3(4.0, 2.0, 1.0) });
    return Result::Ok();
  }
  Result LoadShapeMesh(const std::string&, double size, Shape& shape) const override
  {
    shape.Mesh = MakeBox(Box{ Vec3(0.0, 0.0, 0.0), Vec3(4.0, 2.0, 1.0) });
    return AlignShape(size, shape.Mesh);
  }
  Result LoadMesh(const std::string&, TriangleMesh& mesh) const override
  {
    mesh = MakeBox(Box{ Vec3(0.0, 0.0, 0.0), Vec3(1.0, 1.0, 1.0) });
    return Result::Ok();
  }
  // Red left half, blue right half, on white; the middle fifth of each is drawn.
  Result LoadPicture(const std::string&, Picture& picture) const override
  {
    picture.Width = 100;
    picture.Height = 50;
    for (int y = 0; y < 50; ++y)
    {
      for (int x = 0; x < 100; ++x)
      {
        const bool drawn = y > 9 && y < 40 && x > 4 && x < 95;
        const bool left = x < 50;
        picture.Pixels.push_back(
          drawn ? std::array<float, 4>{ left ? 1.f : 0.f, 0.f, left ? 0.f : 1.f, 1.f }
                : std::array<float, 4>{ 1.f, 1.f, 1.f, 1.f });
      }
    }
    return Result::Ok();
  }
  // The letter L, 60 wide and 100 high, of strokes 10 wide, whatever the text.
  Result DrawText(const std::string&, const std::string&, Picture& picture) const override
  {
    picture.Width = 60;
    picture.Height = 100;
    for (int y = 0; y < 100; ++y)
    {
      for (int x = 0; x < 60; ++x)
      {
        picture.Pixels.push_back({ 0.f, 0.f, 0.f, x < 10 || y < 10 ? 1.f : 0.f });
      }
    }
    return Result::Ok();
  }
  Result LoadWind(const WindFile&, const SceneInfo&, FieldSeries&) const override
  {
    return Result::Error("expected a scene without files of winds");
  }
};

inline Scene Parsed(const std::string& text)
{
  Scene scene;
  const Result result = ParseScene(text, "test.json", WAFT_SOURCE_DIR, TestAssets(), scene);
  EXPECT_TRUE(result) << result.Message();
  return scene;
}

inline std::string ErrorOf(const std::string& text)
{
  Scene scene;
  scene.Title = "before";
  const Result result = ParseScene(text, "test.json", WAFT_SOURCE_DIR, TestAssets(), scene);
  EXPECT_FALSE(result) << text;
  EXPECT_EQ(scene.Title, "before");
  return result.Message();
}

} // namespace waft
