// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionDatabaseSource
 * @brief   a motion database from nothing: simulated, traced, cut, clustered
 *
 * Output port 0 (vtkMultiBlockDataSet): blocks `Segments`, `Basis`, `Nodes`, `Connections`,
 * `Vortices`, `Provenance`; the leaves are vtkPolyData and vtkTable. It can be written with
 * vtkXMLMultiBlockDataWriter and read back without a bit changed.
 *
 * Output port 1 (vtkTable): coverage, a row for each simulation but the first: `Simulations` (that
 * were there before it), `NewSegments` (that it brought), `NewShare` (of these, farther from all
 * before than CoverageTolerance, 0..1).
 *
 * Simulations of air with random vortices, decaying winds and obstacles (Shi et al. 2005, section
 * 3.1) run side by side, one thread each, and are traced while they run, with two frames of each in
 * memory. The same Seed gives the same output bit by bit on any number of threads. Stopped half
 * way, it gives the database of the simulations that are whole, or nothing; with a folder KeptIn
 * the next execution goes on from there.
 */
#ifndef vtkMotionDatabaseSource_h
#define vtkMotionDatabaseSource_h

#include "WaftProperty.h"
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkSmartPointer.h"
#include "vtkWaftSourcesModule.h"

#include <memory>
#include <string>

namespace waft
{
struct AirRun;
struct ClusterOptions;
struct ClusterTreeOptions;
struct ConnectionOptions;
struct DatabaseOptions;
struct EnsembleOptions;
class KeptStage;
struct RotationRange;
struct SliceOptions;
struct TraceOptions;
}

class vtkMultiProcessController;

class VTKWAFTSOURCES_EXPORT vtkMotionDatabaseSource : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkMotionDatabaseSource* New();
  vtkTypeMacro(vtkMotionDatabaseSource, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RotationFreedomType
  {
    YAW = 0,
    YAW_AND_TILT = 1,
    ANY = 2
  };

  WaftProperty(int, NumberOfSimulations);
  WaftProperty(double, StopBelow);
  WaftProperty(double, CoverageTolerance);
  WaftText(KeptIn);

  WaftSlices;

  ///@{
  /** The run is stopped after this many seconds, as by an abort; 0: none. */
  vtkSetClampMacro(TimeLimit, double, 0.0, 1e+09);
  vtkGetMacro(TimeLimit, double);
  ///@}

  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(int, Resolution);
  WaftProperty(int, SeedStride);
  WaftOpenProperty(int, NumberOfVortices);
  WaftOpenProperty(int, NumberOfWinds);
  WaftOpenProperty(int, NumberOfObstacles);
  WaftProperty(int, MaximumSegments);
  WaftProperty(int, NumberOfTopNodes);
  WaftProperty(int, Seed);
  WaftVector(double, Bounds, 6);
  WaftOpenProperty(double, FramesPerSecond);
  WaftOpenProperty(double, WarmUpSeconds);
  WaftOpenProperty(double, SettlingSpeed);
  WaftOpenProperty(double, RelativeError);
  WaftOpenProperty(double, NotConnectible);
  WaftVector(double, VortexDiameter, 2);
  WaftVector(double, VortexLength, 2);
  WaftVector(double, VortexAcceleration, 2);
  WaftVector(double, VortexDuration, 2);
  WaftVector(double, WindRadius, 2);
  WaftVector(double, WindAcceleration, 2);
  WaftVector(double, WindDuration, 2);
  WaftVector(double, ObstacleSize, 2);
  WaftProperty(int, RotationFreedom);

  ///@{
  /**
   * Processes that simulate, of which this is the first; the others are in vtkSharedWork::Serve.
   * None by default: this one alone.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkMotionDatabaseSource();
  ~vtkMotionDatabaseSource() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkMotionDatabaseSource(const vtkMotionDatabaseSource&) = delete;
  void operator=(const vtkMotionDatabaseSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::AirRun;
  friend struct waft::ClusterOptions;
  friend struct waft::ClusterTreeOptions;
  friend struct waft::ConnectionOptions;
  friend struct waft::DatabaseOptions;
  friend struct waft::EnsembleOptions;
  friend struct waft::RotationRange;
  friend struct waft::SliceOptions;
  friend struct waft::TraceOptions;
  double TimeLimit = 0.0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

  waft::KeptStage& Kept();

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
