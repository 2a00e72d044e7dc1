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

#include "vtkAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <memory>

namespace waft
{
struct AirRun;
struct EnsembleOptions;
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

  ///@{
  /** Seed of the random scene, 0 or more. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}
  ///@{
  /** Voxels along each axis, 4 to 1024. */
  vtkSetVector3Macro(Resolution, int);
  vtkGetVector3Macro(Resolution, int);
  ///@}
  ///@{
  /** The volume (xmin, xmax, ymin, ymax, zmin, zmax) [m]. */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}
  ///@{
  /** Frames of the run, 1 or more. */
  vtkSetClampMacro(NumberOfFrames, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfFrames, int);
  ///@}
  ///@{
  /** Frames per second, more than 0. */
  vtkSetMacro(FramesPerSecond, double);
  vtkGetMacro(FramesPerSecond, double);
  ///@}
  ///@{
  /** Density of the air [kg/m^3]; scales the pressure. */
  vtkSetMacro(AirDensity, double);
  vtkGetMacro(AirDensity, double);
  ///@}
  ///@{
  /** The air starts at rest this long before frame 0 [s]. */
  vtkSetMacro(WarmUpSeconds, double);
  vtkGetMacro(WarmUpSeconds, double);
  ///@}

  ///@{
  /** How the air carries itself and the smoke: LINEAR, MONOTONE_CUBIC, MACCORMACK. */
  vtkSetClampMacro(Advection, int, LINEAR, MACCORMACK);
  vtkGetMacro(Advection, int);
  ///@}
  ///@{
  /** What the two ends of an axis are: CLOSED, OPEN, PERIODIC. */
  vtkSetClampMacro(BoundaryX, int, CLOSED, PERIODIC);
  vtkGetMacro(BoundaryX, int);
  vtkSetClampMacro(BoundaryY, int, CLOSED, PERIODIC);
  vtkGetMacro(BoundaryY, int);
  vtkSetClampMacro(BoundaryZ, int, CLOSED, PERIODIC);
  vtkGetMacro(BoundaryZ, int);
  ///@}
  ///@{
  /** With BoundaryZ open: the floor is a wall all the same. */
  vtkSetMacro(ClosedFloor, bool);
  vtkGetMacro(ClosedFloor, bool);
  vtkBooleanMacro(ClosedFloor, bool);
  ///@}
  ///@{
  /** Strength of vorticity confinement [1/s]; 0: none. */
  vtkSetMacro(Confinement, double);
  vtkGetMacro(Confinement, double);
  ///@}
  ///@{
  /** Downward acceleration of smoke of density 1 [m/s^2]; negative: it rises. */
  vtkSetMacro(BuoyancyDensity, double);
  vtkGetMacro(BuoyancyDensity, double);
  ///@}
  ///@{
  /** Upward acceleration per kelvin above the ambient [m/s^2 K]. */
  vtkSetMacro(BuoyancyTemperature, double);
  vtkGetMacro(BuoyancyTemperature, double);
  ///@}
  ///@{
  /** Warmth of the smoke that is given off, above the ambient [K]. */
  vtkSetMacro(EmitterTemperature, double);
  vtkGetMacro(EmitterTemperature, double);
  ///@}
  ///@{
  /** Smoke fades at this rate [1/s]. */
  vtkSetMacro(Dissipation, double);
  vtkGetMacro(Dissipation, double);
  ///@}
  ///@{
  /** Rate at which an input wind that is a velocity draws the air towards it [1/s]. */
  vtkSetMacro(WindDrag, double);
  vtkGetMacro(WindDrag, double);
  ///@}
  ///@{
  /** A substep moves no air farther than this many voxels. */
  vtkSetMacro(CourantNumber, double);
  vtkGetMacro(CourantNumber, double);
  ///@}
  ///@{
  /** Largest divergence times time step that the projection leaves. */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /** Numbers of random things, 0 to 1000. */
  vtkSetClampMacro(NumberOfVortices, int, 0, 1000);
  vtkGetMacro(NumberOfVortices, int);
  vtkSetClampMacro(NumberOfWinds, int, 0, 1000);
  vtkGetMacro(NumberOfWinds, int);
  vtkSetClampMacro(NumberOfObstacles, int, 0, 1000);
  vtkGetMacro(NumberOfObstacles, int);
  /** Balls that give off smoke. */
  vtkSetClampMacro(NumberOfEmitters, int, 0, 1000);
  vtkGetMacro(NumberOfEmitters, int);
  ///@}
  ///@{
  /** Ranges of the random vortices: diameter and length [widths], largest acceleration at
   * mid-segment [m/s^2], standard deviation in time [s]. */
  vtkSetVector2Macro(VortexDiameter, double);
  vtkGetVector2Macro(VortexDiameter, double);
  vtkSetVector2Macro(VortexLength, double);
  vtkGetVector2Macro(VortexLength, double);
  vtkSetVector2Macro(VortexAcceleration, double);
  vtkGetVector2Macro(VortexAcceleration, double);
  vtkSetVector2Macro(VortexDuration, double);
  vtkGetVector2Macro(VortexDuration, double);
  ///@}
  ///@{
  /** Ranges of the random winds: radius [widths], acceleration [m/s^2], standard deviation in time
   * [s]. */
  vtkSetVector2Macro(WindRadius, double);
  vtkGetVector2Macro(WindRadius, double);
  vtkSetVector2Macro(WindAcceleration, double);
  vtkGetVector2Macro(WindAcceleration, double);
  vtkSetVector2Macro(WindDuration, double);
  vtkGetVector2Macro(WindDuration, double);
  ///@}
  ///@{
  /** Range of the random obstacles' extent [widths]. */
  vtkSetVector2Macro(ObstacleSize, double);
  vtkGetVector2Macro(ObstacleSize, double);
  ///@}
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

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::AirRun;
  friend struct waft::SmokeOptions;
  friend struct waft::EnsembleOptions;
  int Seed = 1;
  int Resolution[3] = { 64, 64, 64 };
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
  double AirDensity = 1.2;
  double WarmUpSeconds = 3.0;
  int Advection = MONOTONE_CUBIC;
  int BoundaryX = OPEN;
  int BoundaryY = OPEN;
  int BoundaryZ = OPEN;
  bool ClosedFloor = true;
  double Confinement = 0.5;
  double BuoyancyDensity = 0.0;
  double BuoyancyTemperature = 0.033;
  double EmitterTemperature = 0.0;
  double Dissipation = 0.0;
  double WindDrag = 1.0;
  double CourantNumber = 2.0;
  double Tolerance = 1e-4;
  int NumberOfVortices = 10;
  int NumberOfWinds = 6;
  int NumberOfObstacles = 2;
  int NumberOfEmitters = 3;
  double VortexDiameter[2] = { 0.22, 0.44 };
  double VortexLength[2] = { 0.3, 0.8 };
  double VortexAcceleration[2] = { 0.23, 0.92 };
  double VortexDuration[2] = { 2.0, 4.0 };
  double WindRadius[2] = { 0.2, 0.5 };
  double WindAcceleration[2] = { 0.18, 0.72 };
  double WindDuration[2] = { 0.7, 2.0 };
  double ObstacleSize[2] = { 0.08, 0.25 };
  int CacheLimit = 2048;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
