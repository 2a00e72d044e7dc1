// SPDX-License-Identifier: BSD-3-Clause
// Pictures as targets and as photographs of a shape. The first byte of an input chooses the kind of
// file.
#include "Fuzz.h"

#include "Bridge/Files/SceneFiles.h"

#include <vtkObject.h>

#include <array>

using namespace waft;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static constexpr std::array<const char*, 4> kinds{ ".png", ".jpg", ".tif", ".bmp" };
  if (size == 0)
  {
    return 0;
  }
  vtkObject::GlobalWarningDisplayOff();
  const FuzzFile file(std::string("fuzz") + kinds[data[0] % kinds.size()],
                      FuzzBytes(data, size, 1));
  Picture picture;
  (void)static_cast<bool>(VtkSceneAssets().LoadPicture(file.Path, picture));
  Shape shape;
  (void)static_cast<bool>(VtkSceneAssets().LoadShapeMesh(file.Path, 0.1, shape));
  return 0;
}
