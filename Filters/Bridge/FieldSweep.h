// SPDX-License-Identifier: BSD-3-Clause
// The obstacles and the wind of a stage, gathered over time.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Bridge/FieldCollectors.h"
#include "Bridge/StageExecution.h"

#include <vector>

namespace waft
{

/// Pulls the optional input ports Obstacles (vtkPolyData) and Wind (vtkImageData) of a stage over
/// all their steps: RequestSteps in RequestUpdateExtent, Take and Continue in RequestData, at last
/// the two results.
class FieldSweep
{
public:
  static constexpr int NoPort = -1;

  explicit FieldSweep(int obstaclesPort = NoPort, int windPort = NoPort);
  /// Like TimeSweep::RequestSteps; of the wind all is asked for, whatever its lattice.
  void RequestSteps(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector** inputs,
                    vtkInformationVector* outputs, bool isCurrent);
  bool IsFirst() const { return this->Sweep.IsFirst(); }
  /// What the ports show in this pass. Inputs that are absent or empty are passed over. Fails as
  /// the collectors do.
  Result Take(vtkInformationVector** inputs, const Timeline& line);
  bool Continue(vtkInformation* request) { return this->Sweep.Continue(request); }
  void Reset(vtkInformation* request) { this->Sweep.Reset(request); }

  /// After the last pass, once each.
  std::vector<ObstacleMesh> TakeObstacles() { return this->Obstacles.Take(); }
  FieldSeries TakeWind() { return this->Wind.Take(); }

private:
  int ObstaclesPort;
  int WindPort;
  TimeSweep Sweep;
  ObstacleCollector Obstacles;
  FieldCollector Wind;
};

} // namespace waft
