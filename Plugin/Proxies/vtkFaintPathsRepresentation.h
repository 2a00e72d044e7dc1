// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFaintPathsRepresentation
 * @brief   shows lines so faintly that what flies on them is seen
 *
 * The more there are, the fainter; of a crowd some alone, evenly chosen.
 */
#ifndef vtkFaintPathsRepresentation_h
#define vtkFaintPathsRepresentation_h

#include "vtkPartsRepresentation.h"
#include "vtkWaftProxiesModule.h"

class VTKWAFTPROXIES_EXPORT vtkFaintPathsRepresentation : public vtkPartsRepresentation
{
public:
  static vtkFaintPathsRepresentation* New();
  vtkTypeMacro(vtkFaintPathsRepresentation, vtkPartsRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkFaintPathsRepresentation() = default;
  ~vtkFaintPathsRepresentation() override = default;

  void AddParts(vtkPolyData* block, double time, Parts& parts) override;

private:
  vtkFaintPathsRepresentation(const vtkFaintPathsRepresentation&) = delete;
  void operator=(const vtkFaintPathsRepresentation&) = delete;
};

#endif
