// SPDX-License-Identifier: BSD-3-Clause
// The obstacles, the wind and the air of a stage, gathered over time.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Pipeline/StageExecution.h"

#include <vector>

namespace waft
{

/// Pulls the optional input ports Obstacles (surfaces), Wind and Air (vtkImageData) of a stage
/// over all their steps: RequestSteps in RequestUpdateExtent, Take and Continue in RequestData, at
/// last the results.
class FieldSweep
{
public:
  static constexpr int NoPort = -1;

  explicit FieldSweep(int obstaclesPort = NoPort, int windPort = NoPort, int airPort = NoPort);
  /// From now on the stage has the obstacles that it took, and there is no sweep while nothing
  /// changes upstream of their port. Of a stage without wind and air only.
  void KeepObstacles() { this->Keeps = this->WindPort == NoPort && this->AirPort == NoPort; }
  /// Like TimeSweep::RequestSteps; of images all is asked for, whatever their lattices.
  void RequestSteps(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector** inputs,
                    vtkInformationVector* outputs, bool isCurrent);
  bool IsFirst() const { return this->Sweep.IsFirst(); }
  /// What the ports show in this pass. Inputs that are absent or empty are passed over. Fails as
  /// the collectors do.
  Result Take(vtkInformationVector** inputs, const Timeline& line);
  bool Continue(vtkInformation* request);
  /// Like TimeSweep::Leave.
  bool Leave(vtkInformation* request);
  void Reset(vtkInformation* request) { this->Sweep.Reset(request); }

  /// Whether the obstacles that were taken last still hold.
  bool HoldsObstacles() const { return this->IsKept; }
  /// The stage lost them: the next run sweeps.
  void ForgetObstacles() { this->KeptSignature.clear(); }
  /// After the last pass, once each; of the air also after each pass, what came since.
  std::vector<ObstacleMesh> TakeObstacles();
  FieldSeries TakeWind() { return this->Wind.Take(); }
  FieldSeries TakeAir() { return this->Air.Take(); }

private:
  int ObstaclesPort;
  int WindPort;
  int AirPort;
  TimeSweep Sweep;
  ObstacleCollector Obstacles;
  FieldCollector Wind;
  FieldCollector Air{ FieldRole::Air };
  bool Keeps = false;
  bool IsKept = false;    // this run takes the obstacles of an earlier sweep
  bool MustSweep = false; // it cannot, after all
  std::vector<vtkMTimeType> Signature, KeptSignature; // of the obstacles' port
  double Rate = 0.0, KeptRate = 0.0;                  // frames per second
};

} // namespace waft
