// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGridSmokeSource
 * @brief   air and smoke moved by vortices and winds on a grid
 *
 * Input port 0 takes nothing: ParaView's Python connects the active source to the first port of
 * what it makes, and a source must not depend on what happens to be active. Input port 1, Obstacles
 * (vtkPolyData, optional, may move): closed surfaces. Input port 2, Wind (vtkImageData, optional,
 * may vary in time): a user's own wind; with `Wind` an acceleration [m/s^2], with only `Velocity`
 * [m/s] a drag towards it at the rate WindDrag. Input port 3, Vortices (vtkPolyData, optional):
 * vortices besides the random ones.
 *
 * Output port 0, Smoke (vtkImageData, time-varying): its points are the voxels' centres; point data
 * `Velocity` [m/s], `Vorticity` [1/s], `VortexForce`, `WindForce` [m/s^2] (float[3]), `Density`,
 * `Pressure` [Pa] (float), `Obstacle` (unsigned char, 1 in solids).
 * Output port 1, Vortices (vtkPolyData): the vortices of this run.
 * Output port 2, Obstacles (vtkPolyData): the obstacles of this run, the random ones included.
 *
 * Incompressible air on a staggered grid (Shi et al. 2005, section 3.1; Fedkiw, Stam, Jensen 2001)
 * in a scene of random vortices (Shi et al. 2005, Eq. 13), decaying winds and simple obstacles that
 * is described wholly by the parameters. Frames are computed when they are first asked for and kept
 * up to CacheLimit; those beyond it are computed again from checkpoints, to the same bits. Random
 * forces and sizes scale with the ranges below; lengths are in widths of the volume.
 */
#ifndef vtkGridSmokeSource_h
#define vtkGridSmokeSource_h

#include "WaftProperty.h"
#include "vtkAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <memory>

namespace waft
{
struct AirRun;
struct EnsembleOptions;
class KeptStage;
struct SliceOptions;
struct SmokeOptions;
}

class VTKWAFTSOURCES_EXPORT vtkGridSmokeSource : public vtkAlgorithm
{
public:
  static vtkGridSmokeSource* New();
  vtkTypeMacro(vtkGridSmokeSource, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum AdvectionSchemes
  {
    LINEAR = 0,
    MONOTONE_CUBIC = 1,
    MACCORMACK = 2
  };
  enum BoundaryKinds
  {
    CLOSED = 0,
    OPEN = 1,
    PERIODIC = 2
  };

  WaftProperty(int, Seed);
  WaftVector(int, Resolution, 3);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);
  WaftOpenProperty(double, AirDensity);
  WaftOpenProperty(double, WarmUpSeconds);

  WaftProperty(int, Advection);
  WaftProperty(int, BoundaryX);
  WaftProperty(int, BoundaryY);
  WaftProperty(int, BoundaryZ);
  WaftFlag(ClosedFloor);
  WaftVector(double, Breeze, 3);
  WaftOpenProperty(double, Confinement);
  WaftOpenProperty(double, BuoyancyDensity);
  WaftOpenProperty(double, BuoyancyTemperature);
  WaftOpenProperty(double, EmitterTemperature);
  WaftOpenProperty(double, Dissipation);
  WaftOpenProperty(double, WindDrag);
  WaftOpenProperty(double, CourantNumber);
  WaftOpenProperty(double, Tolerance);

  WaftProperty(int, NumberOfVortices);
  WaftProperty(int, NumberOfWinds);
  WaftProperty(int, NumberOfObstacles);
  WaftProperty(int, NumberOfEmitters);
  WaftVector(double, VortexDiameter, 2);
  WaftVector(double, VortexLength, 2);
  WaftVector(double, VortexAcceleration, 2);
  WaftVector(double, VortexDuration, 2);
  WaftVector(double, WindRadius, 2);
  WaftVector(double, WindAcceleration, 2);
  WaftVector(double, WindDuration, 2);
  WaftVector(double, ObstacleSize, 2);

  WaftSlices;

  ///@{
  /** Memory for frames and checkpoints that are kept [MB]. */
  vtkSetClampMacro(CacheLimit, int, 1, VTK_INT_MAX);
  vtkGetMacro(CacheLimit, int);
  ///@}
  /** Memory that frames and checkpoints take at present [MB]. */
  double GetCacheSize() const;

  ///@{
  /// Take an optional input away.
  void RemoveAllObstacles() { this->SetInputConnection(1, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(2, nullptr); }
  void RemoveAllVortices() { this->SetInputConnection(3, nullptr); }
  ///@}

protected:
  vtkGridSmokeSource();
  ~vtkGridSmokeSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;
  int RequestInformation(vtkInformationVector* outputs);
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs);

private:
  int Process(vtkInformation* request, vtkInformationVector** inputs,
              vtkInformationVector* outputs);
  vtkGridSmokeSource(const vtkGridSmokeSource&) = delete;
  void operator=(const vtkGridSmokeSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::AirRun;
  friend struct waft::SmokeOptions;
  friend struct waft::EnsembleOptions;
  friend struct waft::SliceOptions;
  waft::KeptStage& Kept();
  int CacheLimit = 512;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
