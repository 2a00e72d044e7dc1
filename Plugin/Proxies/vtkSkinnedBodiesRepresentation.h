// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSkinnedBodiesRepresentation
 * @brief   shows bodies in the skins of their shapes, with a draw call a shape
 *
 * The field data `Color`, `Tint`, `Opacity` and `Texture` have a tuple a shape, the point data
 * `ShapeId` say whose a body is; without these all is of the first shape. A texture is cut out where
 * its alpha says so, and lets light through; where its picture cannot be read, and without one, a
 * body has its plain colour. What is coloured by an array is drawn as any surface.
 */
#ifndef vtkSkinnedBodiesRepresentation_h
#define vtkSkinnedBodiesRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkSmartPointer.h"
#include "vtkWaftProxiesModule.h"

#include <map>
#include <string>
#include <vector>

class vtkActor;
class vtkActorOfParts;
class vtkDataObject;
class vtkPolyData;
class vtkTexture;

class VTKWAFTPROXIES_EXPORT vtkSkinnedBodiesRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkSkinnedBodiesRepresentation* New();
  vtkTypeMacro(vtkSkinnedBodiesRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* input,
                         vtkInformation* output) override;

protected:
  vtkSkinnedBodiesRepresentation();
  ~vtkSkinnedBodiesRepresentation() override;

private:
  vtkSkinnedBodiesRepresentation(const vtkSkinnedBodiesRepresentation&) = delete;
  void operator=(const vtkSkinnedBodiesRepresentation&) = delete;

  struct Skin // of a shape of a block
  {
    double Color[3] = { 1.0, 1.0, 1.0 };
    double Opacity = 1.0;
    vtkSmartPointer<vtkActor> Part;
  };
  bool IsColoredByArray();
  void Dress(vtkDataObject* data);
  void DressBlock(vtkPolyData* bodies, std::vector<Skin>& skins);
  void Paint(const Skin& skin);
  vtkTexture* TextureOf(const std::string& path);

  std::vector<Skin> Skins;
  std::map<std::string, vtkSmartPointer<vtkTexture>> Textures; // by path and the time of the file
  vtkSmartPointer<vtkDataObject> Dressed;
  vtkTimeStamp DressTime;
  vtkTimeStamp PaintTime;
};

#endif
