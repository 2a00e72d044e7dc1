// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSceneryRepresentation
 * @brief   shows obstacles, and the ground as a soft floor that passes into the background
 *
 * The ground is an obstacle (point data `ObstacleId`) that is a flat slab under the whole volume
 * (field data `Bounds`).
 */
#ifndef vtkSceneryRepresentation_h
#define vtkSceneryRepresentation_h

#include "vtkPartsRepresentation.h"
#include "vtkWaftProxiesModule.h"

class VTKWAFTPROXIES_EXPORT vtkSceneryRepresentation : public vtkPartsRepresentation
{
public:
  static vtkSceneryRepresentation* New();
  vtkTypeMacro(vtkSceneryRepresentation, vtkPartsRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSceneryRepresentation();
  ~vtkSceneryRepresentation() override;

  void AddParts(vtkPolyData* block, double time, Parts& parts) override;

private:
  vtkSceneryRepresentation(const vtkSceneryRepresentation&) = delete;
  void operator=(const vtkSceneryRepresentation&) = delete;

  vtkSmartPointer<vtkTexture> Pool; // the floor's alpha: all in the middle, none at the edge
};

#endif
