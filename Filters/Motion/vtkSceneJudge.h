// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSceneJudge
 * @brief   what of a scene cannot be, and what will be hard, before anything is flown
 *
 * Judge gives `findings` a line for each finding of waft::JudgeScene, in its order:
 * `Possible` (unsigned char; 0: it cannot be met), `Kind`, `Text`, `ObjectId`, `Frame`, `Row`,
 * `Target` (int; -1: of no one), `Place` (double[3], m; NaN: none). Field data: `NumberOfObjects`,
 * `NumberOfConstraints` (int), `Lines` (the sentences as they are told: of each kind the first
 * few). It returns what is wrong with the scene, or an empty text; `findings` stays as it was
 * then. Of a scene file `waft check` says the same.
 */
#ifndef vtkSceneJudge_h
#define vtkSceneJudge_h

#include "vtkObject.h"
#include "vtkWaftFiltersModule.h"

#include <string>

class vtkPolyData;
class vtkTable;

class VTKWAFTFILTERS_EXPORT vtkSceneJudge : public vtkObject
{
public:
  static vtkSceneJudge* New();
  vtkTypeMacro(vtkSceneJudge, vtkObject);

  /** Of Objects, Constraints and Obstacles, of which the last two may be null, beside the database
   * that comes with Waft; obstacles as they stand. */
  static std::string Judge(vtkPolyData* objects, vtkPolyData* constraints, vtkPolyData* obstacles,
                           vtkTable* findings);

protected:
  vtkSceneJudge() = default;
  ~vtkSceneJudge() override = default;

private:
  vtkSceneJudge(const vtkSceneJudge&) = delete;
  void operator=(const vtkSceneJudge&) = delete;
};

#endif
