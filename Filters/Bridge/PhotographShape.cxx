// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/PhotographShape.h"

#include "Bridge/FileReading.h"
#include "Bridge/SceneFiles.h"
#include "Scene/TargetMask.h"

#include <algorithm>

namespace waft
{

bool IsPictureName(const std::string& path)
{
  const auto known = { ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp" };
  return std::find(known.begin(), known.end(), Extension(path)) != known.end();
}

Result LoadPhotographShape(const std::string& path, const PhotographOptions& options, Shape& shape)
{
  Picture picture;
  WAFT_RETURN_IF_FAILED(VtkSceneAssets().LoadPicture(path, picture));
  TargetMask shown = MaskFromPicture(picture, {});
  WAFT_RETURN_IF_FAILED(
    MakePhotographSheet({ shown.Width, shown.Height, std::move(shown.Weights) }, options, shape));
  shape.Texture = path;
  return Result::Ok();
}

} // namespace waft
