// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVortexSpirals
 * @brief   spirals about the axes of vortices, as tubes that thicken the way they turn
 *
 * A vortex is a line of two points with the cell data `Strength`, whose sign says the sense, seen
 * along the line, and `CoreRadius`, which is the spiral's radius. The cell data go on.
 */
#ifndef vtkVortexSpirals_h
#define vtkVortexSpirals_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftProxiesModule.h"

class VTKWAFTPROXIES_EXPORT vtkVortexSpirals : public vtkPolyDataAlgorithm
{
public:
  static vtkVortexSpirals* New();
  vtkTypeMacro(vtkVortexSpirals, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkVortexSpirals() = default;
  ~vtkVortexSpirals() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation* request, vtkInformationVector** input,
                  vtkInformationVector* output) override;

private:
  vtkVortexSpirals(const vtkVortexSpirals&) = delete;
  void operator=(const vtkVortexSpirals&) = delete;
};

#endif
