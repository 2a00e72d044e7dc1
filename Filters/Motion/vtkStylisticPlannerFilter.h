// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStylisticPlannerFilter
 * @brief   flies objects on segments of a motion database from mark to mark, around obstacles
 *
 * Input port 0, Database (vtkMultiBlockDataSet, optional): a motion database; without it that which
 * comes with Waft, read whole on every rank. Input port 1, Objects (vtkPolyData): one vertex an
 * object; its field data give the volume and the frames. Input port 2, Constraints (vtkPolyData):
 * one vertex a row. Input port 3, Obstacles (vtkPolyData, optional, may move): closed surfaces,
 * `ObstacleId`. Input port 4, Guides (vtkPolyData, optional): a polyline an object, named by the
 * cell data `ObjectId` (without it, line k is for the object of id k): a rough way, followed
 * loosely.
 *
 * Output port 0, Tracks (vtkPolyData): one polyline an object, one point a frame, annotated with
 * what drove the segments (`ForceType`, `VortexId`, `VortexAcceleration`, `WindAcceleration`).
 * Output port 1, Trees (vtkPolyData): one polyline a branch of the two trees of each flight; cell
 * data `ObjectId`, `Span`, `Tree` (0 from the start, 1 from the goal), `Parent`, `Segment`, `Cost`,
 * `Frame`.
 * Output port 2, Report (vtkTable): one line per row and target of the constraints.
 * Output port 3, Constraints (vtkPolyData): the rows, those for any object (-1) assigned.
 * Output port 4, Vortices (vtkPolyData): those of the segments used, moved with them.
 * Output port 5, Takes (vtkTable): one line a take: `Take`, `Seed`, `Met` and `Rows`,
 * `CurvatureDistance`, `AccelerationDistance`, `Score` (less is better).
 * Output port 6, Flights (vtkTable): one line a flight to a mark: `ObjectId`, `Row`, `Target`,
 * `Frame`, `Reached` (1 or 0), `RetimingFactor`, `Cost`, `Branches`, `Seconds`.
 * Output port 7, ObjectReport (vtkTable): one line an object: `ObjectId`, `Rows`, `Met`, `Status`
 * (the worst of its rows and of its start), `Cost`, `Branches`, `Seconds`, `Planned` (0: taken from
 * the run before), `Message`. Seconds are wall time and differ from run to run.
 *
 * Shi et al. 2005, section 4: two rapidly-exploring random trees of database segments, uniform
 * redistribution of what is left over, refinement down the clusters, blending. Each flight lasts
 * exactly its frames. Objects without rows, and the time after an object's last row, fly free.
 * Rows that cannot be met are named in the report and all the others are still met. The same Seed
 * gives the same bytes on any number of threads. A change plans only those objects anew that it
 * touches, with the same bytes as a plan of all: an object's plan depends on its own data, rows and
 * guide, and on what all share (database, obstacles, volume, time, options). Stopped half way, it
 * gives the objects planned so far.
 */
#ifndef vtkStylisticPlannerFilter_h
#define vtkStylisticPlannerFilter_h

#include "WaftProperty.h"
#include "vtkChainStageAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct PlanOptions;
struct TakeOptions;
struct RotationRange;
}

class VTKWAFTFILTERS_EXPORT vtkStylisticPlannerFilter : public vtkChainStageAlgorithm
{
public:
  static vtkStylisticPlannerFilter* New();
  vtkTypeMacro(vtkStylisticPlannerFilter, vtkChainStageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RotationFreedoms
  {
    YAW = 0,
    YAW_AND_TILT = 1,
    ANY = 2
  };

  WaftProperty(int, RotationFreedom);
  WaftProperty(double, MaxTilt);
  WaftOpenProperty(double, ConnectionThreshold);
  WaftOpenProperty(double, JoinThreshold);
  WaftProperty(int, NumberOfCandidates);
  WaftProperty(int, MaximumNumberOfBranches);
  WaftProperty(double, RetimingLimit);
  WaftProperty(double, GuideWeight);
  WaftProperty(int, NumberOfTakes);
  WaftProperty(int, Take);
  WaftProperty(int, Seed);

  /** How many objects the last execution planned; the others were as before. */
  vtkGetMacro(NumberOfPlannedObjects, int);

  ///@{
  /// For ParaView, which connects what is selected to the input that it counts as 0: the objects,
  /// since the database may be left out.
  void SetObjectsConnection(vtkAlgorithmOutput* objects) { this->SetInputConnection(1, objects); }
  void SetDatabaseConnection(int, vtkAlgorithmOutput* database)
  {
    this->SetInputConnection(0, database);
  }
  ///@}

  ///@{
  /// Take an optional input away.
  void RemoveAllDatabase() { this->SetInputConnection(0, nullptr); }
  void RemoveAllObstacles() { this->SetInputConnection(3, nullptr); }
  void RemoveAllGuides() { this->SetInputConnection(4, nullptr); }
  ///@}

protected:
  vtkStylisticPlannerFilter();
  ~vtkStylisticPlannerFilter() override;

  waft::KeptStage& Kept() override;
  std::vector<waft::PropertyRange> Ranges() const override;

private:
  vtkStylisticPlannerFilter(const vtkStylisticPlannerFilter&) = delete;
  void operator=(const vtkStylisticPlannerFilter&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::PlanOptions;
  friend struct waft::RotationRange;
  friend struct waft::TakeOptions;
  int NumberOfPlannedObjects = 0;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
