// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpiralRepresentation
 * @brief   shows vortices by their spirals (vtkVortexSpirals)
 */
#ifndef vtkSpiralRepresentation_h
#define vtkSpiralRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkWaftProxiesModule.h"

class VTKWAFTPROXIES_EXPORT vtkSpiralRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkSpiralRepresentation* New();
  vtkTypeMacro(vtkSpiralRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSpiralRepresentation();
  ~vtkSpiralRepresentation() override;

private:
  vtkSpiralRepresentation(const vtkSpiralRepresentation&) = delete;
  void operator=(const vtkSpiralRepresentation&) = delete;
};

#endif
