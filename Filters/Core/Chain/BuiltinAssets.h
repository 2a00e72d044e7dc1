// SPDX-License-Identifier: BSD-3-Clause
// What a scene may name without any reader of files: the built-in shapes.
#pragma once

#include "Scene/SceneAssets.h"

namespace waft
{

/// Built-in shapes; what else a scene names fails with a sentence that says so. Derive from it to
/// bring readers of files.
class BuiltinAssets : public SceneAssets
{
public:
  Result LoadBuiltinShape(const std::string& builtin, double size, Shape& shape) const override;
  Result LoadShapeMesh(const std::string& path, double size, Shape& shape) const override;
  Result LoadAlignedShape(const std::string& path, Shape& shape) const override;
  Result LoadMesh(const std::string& path, TriangleMesh& mesh) const override;
  Result LoadPicture(const std::string& path, Picture& picture) const override;
  Result DrawText(const std::string& text, const std::string& font,
                  Picture& picture) const override;
  Result LoadWind(const WindFile& file, const SceneInfo& scene, FieldSeries& wind) const override;
};

} // namespace waft
