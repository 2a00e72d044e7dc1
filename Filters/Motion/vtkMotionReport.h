// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionReport
 * @brief   what became of each constraint over a whole run, for scripts that join stages
 *
 * Takes the Report of the stage that moves the objects, that of StylisticPlannerFilter, that of
 * RotationRefineFilter, and the Constraints with their touch-downs (AirAssimilationFilter's, or
 * else the planner's). `joined` gets a line for each of the first: the planner's reasons stand
 * before how near the motion comes, an orientation row is as the bodies are turned, a rest has its
 * `TouchDown`, `Settled` and `LiftOff` (-1: of other rows, and where no stage says). Columns may
 * be texts, as of a file that was read. Gives what is wrong with the inputs, or an empty text;
 * `joined` stays as it was then.
 */
#ifndef vtkMotionReport_h
#define vtkMotionReport_h

#include "vtkObject.h"
#include "vtkWaftFiltersModule.h"

#include <string>

class vtkPolyData;
class vtkTable;

class VTKWAFTFILTERS_EXPORT vtkMotionReport : public vtkObject
{
public:
  static vtkMotionReport* New();
  vtkTypeMacro(vtkMotionReport, vtkObject);

  static std::string Join(vtkTable* moved, vtkTable* planned, vtkTable* turned,
                          vtkPolyData* constraints, vtkTable* joined);

protected:
  vtkMotionReport() = default;
  ~vtkMotionReport() override = default;

private:
  vtkMotionReport(const vtkMotionReport&) = delete;
  void operator=(const vtkMotionReport&) = delete;
};

#endif
