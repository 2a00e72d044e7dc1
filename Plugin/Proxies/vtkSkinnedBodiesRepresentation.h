// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSkinnedBodiesRepresentation
 * @brief   shows bodies in the skins of their shapes, with a draw call a shape
 *
 * The field data `Color`, `Tint`, `Opacity` and `Texture` have a tuple a shape, the point data
 * `ShapeId` say whose a body is; without these all is of the first shape. A texture is cut out
 * where its alpha says so, and bodies let light through; where a picture cannot be read, and
 * without one, a body has its plain colour.
 */
#ifndef vtkSkinnedBodiesRepresentation_h
#define vtkSkinnedBodiesRepresentation_h

#include "vtkPartsRepresentation.h"
#include "vtkWaftProxiesModule.h"

#include <map>
#include <string>

class VTKWAFTPROXIES_EXPORT vtkSkinnedBodiesRepresentation : public vtkPartsRepresentation
{
public:
  static vtkSkinnedBodiesRepresentation* New();
  vtkTypeMacro(vtkSkinnedBodiesRepresentation, vtkPartsRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSkinnedBodiesRepresentation() = default;
  ~vtkSkinnedBodiesRepresentation() override;

  void AddParts(vtkPolyData* block, double time, Parts& parts) override;

private:
  vtkSkinnedBodiesRepresentation(const vtkSkinnedBodiesRepresentation&) = delete;
  void operator=(const vtkSkinnedBodiesRepresentation&) = delete;

  vtkTexture* TextureOf(const std::string& path);

  std::map<std::string, vtkSmartPointer<vtkTexture>> Textures; // by path and the time of the file
};

#endif
