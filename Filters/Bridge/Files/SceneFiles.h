// SPDX-License-Identifier: BSD-3-Clause
// What scene files name, read by VTK's readers: meshes, pictures, text.
#pragma once

#include "Scene/SceneAssets.h"

namespace waft
{

/// Built-in shapes of Core; meshes from .vtp, .obj, .ply, .stl and .glb (glTF is y-up and is turned
/// to z-up) and, for shapes, from photographs of them; pictures (.png, .jpg, .tif, .bmp); text by
/// FreeType.
class VtkSceneAssets : public SceneAssets
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

/// A picture whose pixels are where the file stores them, as texture coordinates have it;
/// LoadPicture has them where they are seen.
Result ReadStoredPicture(const std::string& path, Picture& picture);

/// What a shape is painted with: the picture of its Texture as it is seen, or its Skin.
Result LoadPictureOf(const Shape& shape, Picture& picture);

} // namespace waft
