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

#include "vtkSlicedPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct PlanOptions;
struct TakeOptions;
struct RotationRange;
}

class VTKWAFTFILTERS_EXPORT vtkStylisticPlannerFilter : public vtkSlicedPolyDataAlgorithm
{
public:
  static vtkStylisticPlannerFilter* New();
  vtkTypeMacro(vtkStylisticPlannerFilter, vtkSlicedPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RotationFreedoms
  {
    YAW = 0,
    YAW_AND_TILT = 1,
    ANY = 2
  };
  ///@{
  /** Which rotations may carry a segment to its place: Yaw (0), YawAndTilt (1) or Any (2). */
  vtkSetClampMacro(RotationFreedom, int, YAW, ANY);
  vtkGetMacro(RotationFreedom, int);
  ///@}
  ///@{
  /** Largest lean of the vertical under YawAndTilt [rad], 0..pi. */
  vtkSetClampMacro(MaxTilt, double, 0.0, 3.14159265358979323846);
  vtkGetMacro(MaxTilt, double);
  ///@}
  ///@{
  /** Residual over chord of the shared window (Eq. 1) above which two representatives do not
   * follow each other; more than 0. */
  vtkSetMacro(ConnectionThreshold, double);
  vtkGetMacro(ConnectionThreshold, double);
  ///@}
  ///@{
  /** Relative offset of velocity that a path found at once may cost; more is granted as the search
   * lasts; more than 0. */
  vtkSetMacro(JoinThreshold, double);
  vtkGetMacro(JoinThreshold, double);
  ///@}
  ///@{
  /** Paths looked for in each flight; the one nearest to the style of the database is taken;
   * 1..1000. */
  vtkSetClampMacro(NumberOfCandidates, int, 1, 1000);
  vtkGetMacro(NumberOfCandidates, int);
  ///@}
  ///@{
  /** Limit of branches of the two trees of one flight, 1..1000000. */
  vtkSetClampMacro(MaximumNumberOfBranches, int, 1, 1000000);
  vtkGetMacro(MaximumNumberOfBranches, int);
  ///@}
  ///@{
  /** Fraction by which a path may last longer or shorter before its time is scaled, 0..0.5. */
  vtkSetClampMacro(RetimingLimit, double, 0.0, 0.5);
  vtkGetMacro(RetimingLimit, double);
  ///@}
  ///@{
  /** How closely paths follow their guides, 0 (not at all) to 1. */
  vtkSetClampMacro(GuideWeight, double, 0.0, 1.0);
  vtkGetMacro(GuideWeight, double);
  ///@}
  ///@{
  /** Plans to choose from, of the seeds from Seed on, 1..1000. */
  vtkSetClampMacro(NumberOfTakes, int, 1, 1000);
  vtkGetMacro(NumberOfTakes, int);
  ///@}
  ///@{
  /** The take that is given, from 0; -1: the one with the least score. */
  vtkSetClampMacro(Take, int, -1, 999);
  vtkGetMacro(Take, int);
  ///@}
  ///@{
  /** Seed of everything random, 0 or more. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

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

  ///@{
  /** Whether the stage runs. One that rests takes none of its inputs and gives empty outputs. */
  vtkSetMacro(Active, bool);
  vtkGetMacro(Active, bool);
  vtkBooleanMacro(Active, bool);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkStylisticPlannerFilter();
  ~vtkStylisticPlannerFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;
  waft::KeptStage& Kept() override;

private:
  vtkStylisticPlannerFilter(const vtkStylisticPlannerFilter&) = delete;
  void operator=(const vtkStylisticPlannerFilter&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::PlanOptions;
  friend struct waft::RotationRange;
  friend struct waft::TakeOptions;
  int RotationFreedom = YAW_AND_TILT;
  double MaxTilt = 0.34906585039886591;
  double ConnectionThreshold = 0.06;
  double JoinThreshold = 0.05;
  int NumberOfCandidates = 32;
  int MaximumNumberOfBranches = 20000;
  double RetimingLimit = 0.15;
  double GuideWeight = 0.5;
  int NumberOfTakes = 1;
  int Take = 0;
  int Seed = 1;
  int NumberOfPlannedObjects = 0;

  bool Active = true;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
