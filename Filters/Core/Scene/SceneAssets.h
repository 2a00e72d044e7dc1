// SPDX-License-Identifier: BSD-3-Clause
// What a scene names and Core cannot read by itself: files of meshes, pictures and winds, fonts.
// The
// caller brings the readers.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

struct WindFile; // Scene/Scene.h

/// A raster of colours, row 0 at the bottom.
struct Picture
{
  int Width = 0;
  int Height = 0;
  std::vector<std::array<float, 4>> Pixels; // red, green, blue, alpha in 0..1, x fastest

  bool IsEmpty() const { return this->Pixels.empty(); }
};

/// All paths are resolved. A failure's message says what is wrong with the thing; the reader of
/// scenes puts the place in front.
class SceneAssets
{
public:
  virtual ~SceneAssets() = default;

  /// A built-in shape (leaf, maple, ...) with its numbers; size: largest extent [m], 0 the
  /// default one.
  virtual Result LoadBuiltinShape(const std::string& builtin, double size, Shape& shape) const = 0;
  /// A thin body from a mesh file, centred and turned to its body axes, or from a photograph, which
  /// is its texture then; size as above, 0 leaves the file's own (0.1 m for a photograph).
  virtual Result LoadShapeMesh(const std::string& path, double size, Shape& shape) const = 0;
  /// The same as it stands in the file, which has it on its body axes already.
  virtual Result LoadAlignedShape(const std::string& path, Shape& shape) const = 0;
  /// A surface as it is in the file.
  virtual Result LoadMesh(const std::string& path, TriangleMesh& mesh) const = 0;
  /// A picture file.
  virtual Result LoadPicture(const std::string& path, Picture& picture) const = 0;
  /// A line of text, alpha 1 where there is ink, cropped to the ink. font: sans, serif, mono or the
  /// path of a font file.
  virtual Result DrawText(const std::string& text, const std::string& font,
                          Picture& picture) const = 0;
  /// The fields of a wind's file, at their times.
  virtual Result LoadWind(const WindFile& file, const SceneInfo& scene,
                          FieldSeries& wind) const = 0;
};

} // namespace waft
