// SPDX-License-Identifier: BSD-3-Clause
// Meshes as obstacles and as shapes. The first byte of an input chooses the kind of file.
#include "Fuzz.h"

#include "Bridge/Files/SceneFiles.h"

#include <vtkObject.h>

#include <array>

using namespace waft;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static constexpr std::array<const char*, 6> kinds{
    ".obj", ".ply", ".stl", ".glb", ".vtp", ".gltf"
  };
  if (size == 0)
  {
    return 0;
  }
  vtkObject::GlobalWarningDisplayOff();
  const FuzzFile file(std::string("fuzz") + kinds[data[0] % kinds.size()],
                      FuzzBytes(data, size, 1));
  TriangleMesh mesh;
  (void)static_cast<bool>(VtkSceneAssets().LoadMesh(file.Path, mesh));
  Shape shape;
  (void)static_cast<bool>(VtkSceneAssets().LoadShapeMesh(file.Path, 0.1, shape));
  (void)static_cast<bool>(VtkSceneAssets().LoadAlignedShape(file.Path, shape));
  return 0;
}
