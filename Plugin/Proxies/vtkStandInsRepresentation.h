// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStandInsRepresentation
 * @brief   shows objects without their shapes: as leaves of their size, turned as they begin
 *
 * The size is the point data `ClearanceRadius`, which is half the largest extent, the attitude
 * `Orientation` (w, x, y, z) where `OrientationGiven` says so or is absent.
 */
#ifndef vtkStandInsRepresentation_h
#define vtkStandInsRepresentation_h

#include "vtkPartsRepresentation.h"
#include "vtkWaftProxiesModule.h"

class VTKWAFTPROXIES_EXPORT vtkStandInsRepresentation : public vtkPartsRepresentation
{
public:
  static vtkStandInsRepresentation* New();
  vtkTypeMacro(vtkStandInsRepresentation, vtkPartsRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkStandInsRepresentation() = default;
  ~vtkStandInsRepresentation() override = default;

  void AddParts(vtkPolyData* block, double time, Parts& parts) override;

private:
  vtkStandInsRepresentation(const vtkStandInsRepresentation&) = delete;
  void operator=(const vtkStandInsRepresentation&) = delete;
};

#endif
