// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSkinnedBodiesRepresentation
 * @brief   shows bodies in the skins of their shapes, with a draw call a shape
 *
 * The field data `Color`, `Tint`, `Opacity`, `Texture` and `SkinSize` have a tuple a shape, the
 * point data `ShapeId` say whose a body is; without these all is of the first shape. Without a
 * `Texture` a shape has its part of the `Skin`, bytes of PNG files. A texture is cut out where its
 * alpha says so, and bodies let light through; where a picture cannot be read, and without one, a
 * body has its plain colour. Where the field data `Ground` give its height, bodies have soft
 * shadows there.
 */
#ifndef vtkSkinnedBodiesRepresentation_h
#define vtkSkinnedBodiesRepresentation_h

#include "vtkPartsRepresentation.h"
#include "vtkWaftProxiesModule.h"

#include <map>
#include <string>

class vtkFieldData;

class VTKWAFTPROXIES_EXPORT vtkSkinnedBodiesRepresentation : public vtkPartsRepresentation
{
public:
  static vtkSkinnedBodiesRepresentation* New();
  vtkTypeMacro(vtkSkinnedBodiesRepresentation, vtkPartsRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSkinnedBodiesRepresentation();
  ~vtkSkinnedBodiesRepresentation() override;

  void AddParts(vtkPolyData* block, double time, Parts& parts) override;

private:
  vtkSkinnedBodiesRepresentation(const vtkSkinnedBodiesRepresentation&) = delete;
  void operator=(const vtkSkinnedBodiesRepresentation&) = delete;

  void AddShadows(vtkPolyData* block, Parts& parts);
  vtkTexture* TextureOf(vtkFieldData* fields, vtkIdType shape);

  // By path and the time of the file, or by the bytes of all skins and whose it is.
  std::map<std::string, vtkSmartPointer<vtkTexture>> Textures;
  vtkSmartPointer<vtkTexture> Spot;
};

#endif
