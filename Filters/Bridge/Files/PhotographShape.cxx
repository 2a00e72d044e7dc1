// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/PhotographShape.h"

#include "Bridge/Files/SceneFiles.h"
#include "Scene/TargetMask.h"

namespace waft
{

Result LoadPhotographShape(const std::string& path, const PhotographOptions& options, Shape& shape)
{
  Picture picture;
  WAFT_RETURN_IF_FAILED(ReadStoredPicture(path, picture));
  TargetMask shown = MaskFromPicture(picture, {});
  WAFT_RETURN_IF_FAILED(
    MakePhotographSheet({ shown.Width, shown.Height, std::move(shown.Weights) }, options, shape));
  shape.Texture = path;
  return Result::Ok();
}

} // namespace waft
