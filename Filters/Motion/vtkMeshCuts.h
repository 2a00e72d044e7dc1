// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshCuts
 * @brief   which bodies of a finished motion cut each other, for scripts
 *
 * Takes the outputs of the stages, or the files that were written of them: Poses, Objects, Shapes
 * and, where there are some, Constraints (else nullptr). `cuts` gets a line for each pair of bodies
 * at each frame of which one is deep in the other, by more than 0.02 of the shorter one's length:
 * `Frame`, `ObjectA`, `ObjectB`, `NearMarks` (1 where marks of both leave less room than bodies so
 * wide need). Gives what is wrong with the inputs, or an empty text; `cuts` stays as it was then.
 */
#ifndef vtkMeshCuts_h
#define vtkMeshCuts_h

#include "vtkObject.h"
#include "vtkWaftFiltersModule.h"

#include <string>

class vtkMultiBlockDataSet;
class vtkPolyData;
class vtkTable;

class VTKWAFTFILTERS_EXPORT vtkMeshCuts : public vtkObject
{
public:
  static vtkMeshCuts* New();
  vtkTypeMacro(vtkMeshCuts, vtkObject);

  static std::string Find(vtkPolyData* poses, vtkPolyData* objects, vtkMultiBlockDataSet* shapes,
                          vtkPolyData* constraints, vtkTable* cuts);

protected:
  vtkMeshCuts() = default;
  ~vtkMeshCuts() override = default;

private:
  vtkMeshCuts(const vtkMeshCuts&) = delete;
  void operator=(const vtkMeshCuts&) = delete;
};

#endif
