// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/BuiltinAssets.h"

#include "Scene/Scene.h"
#include "Shapes/ThinShape.h"

namespace waft
{
namespace
{

Result NoReader(const std::string& what)
{
  return Result::Error(what +
                       ": expected a built-in shape, a box or a list of points: this program "
                       "has no reader of files and no fonts");
}

} // namespace

Result BuiltinAssets::LoadBuiltinShape(const std::string& builtin, double size, Shape& shape) const
{
  return MakeBuiltinShape(builtin, size, shape);
}

Result BuiltinAssets::LoadShapeMesh(const std::string& path, double, Shape&) const
{
  return NoReader(path);
}

Result BuiltinAssets::LoadAlignedShape(const std::string& path, Shape&) const
{
  return NoReader(path);
}

Result BuiltinAssets::LoadMesh(const std::string& path, TriangleMesh&) const
{
  return NoReader(path);
}

Result BuiltinAssets::LoadPicture(const std::string& path, Picture&) const
{
  return NoReader(path);
}

Result BuiltinAssets::DrawText(const std::string& text, const std::string&, Picture&) const
{
  return NoReader("text \"" + text + "\"");
}

Result BuiltinAssets::LoadWind(const WindFile& file, const SceneInfo&, FieldSeries&) const
{
  return NoReader(file.Path);
}

} // namespace waft
