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

#include "vtkMultiBlockDataSetAlgorithm.h"
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
struct RotationRange;
struct TraceOptions;
}

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

  ///@{
  /** Simulations, each with vortices, winds and obstacles of its own; at most, with StopBelow. */
  vtkSetClampMacro(NumberOfSimulations, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfSimulations, int);
  ///@}
  ///@{
  /** The first simulation of whose segments a smaller fraction than this is new is the last; 0: all
   * are run. */
  vtkSetClampMacro(StopBelow, double, 0.0, 1.0);
  vtkGetMacro(StopBelow, double);
  ///@}
  ///@{
  /** A segment is new when its rms distance to all before is above this fraction of the rms chord
   * of the segments of its length. */
  vtkSetClampMacro(CoverageTolerance, double, 1e-6, 1.0);
  vtkGetMacro(CoverageTolerance, double);
  ///@}
  ///@{
  /** A folder where simulations that are whole are kept, and taken from when they are of the same
   * parameters; empty: none. */
  vtkSetMacro(KeptIn, std::string);
  vtkGetMacro(KeptIn, std::string);
  ///@}
  ///@{
  /** The run is stopped after this many seconds, as by an abort; 0: none. */
  vtkSetClampMacro(TimeLimit, double, 0.0, 1e+09);
  vtkGetMacro(TimeLimit, double);
  ///@}
  ///@{
  /** Frames of each simulation. */
  vtkSetClampMacro(NumberOfFrames, int, 2, VTK_INT_MAX);
  vtkGetMacro(NumberOfFrames, int);
  ///@}
  ///@{
  /** Voxels along the longest side of the volume. */
  vtkSetClampMacro(Resolution, int, 4, VTK_INT_MAX);
  vtkGetMacro(Resolution, int);
  ///@}
  ///@{
  /** Tracers start at every SeedStride-th voxel along each axis. */
  vtkSetClampMacro(SeedStride, int, 1, VTK_INT_MAX);
  vtkGetMacro(SeedStride, int);
  ///@}
  ///@{
  /** Vortices of one simulation. */
  vtkSetClampMacro(NumberOfVortices, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfVortices, int);
  ///@}
  ///@{
  /** Decaying winds of one simulation. */
  vtkSetClampMacro(NumberOfWinds, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfWinds, int);
  ///@}
  ///@{
  /** Boxes, cylinders and spheres of one simulation, at most. */
  vtkSetClampMacro(NumberOfObstacles, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfObstacles, int);
  ///@}
  ///@{
  /** More segments than this are thinned at random; 0: all are kept. */
  vtkSetClampMacro(MaximumSegments, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumSegments, int);
  ///@}
  ///@{
  /** Initial clusters of all lengths together: the representatives that paths are planned with. */
  vtkSetClampMacro(NumberOfTopNodes, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfTopNodes, int);
  ///@}
  ///@{
  /** Seed of everything random. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}
  ///@{
  /** The volume (xmin, xmax, ymin, ymax, zmin, zmax) [m]; its sides are whole numbers of voxels. */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}
  ///@{
  /** Frames per second. */
  vtkSetMacro(FramesPerSecond, double);
  vtkGetMacro(FramesPerSecond, double);
  ///@}
  ///@{
  /** The air is driven for this long before tracers are set free, in seconds. */
  vtkSetMacro(WarmUpSeconds, double);
  vtkGetMacro(WarmUpSeconds, double);
  ///@}
  ///@{
  /** Tracers sink through the air at this speed, in metres per second; 0: they follow it. */
  vtkSetMacro(SettlingSpeed, double);
  vtkGetMacro(SettlingSpeed, double);
  ///@}
  ///@{
  /** Error of the compression: rms left out over rms of the segments. */
  vtkSetMacro(RelativeError, double);
  vtkGetMacro(RelativeError, double);
  ///@}
  ///@{
  /** Pairs of representatives whose residual, over the chord of the window, is above this do not
   * follow each other. */
  vtkSetMacro(NotConnectible, double);
  vtkGetMacro(NotConnectible, double);
  ///@}
  ///@{
  /** Diameters of vortices, in widths of the volume: twice the radius where the acceleration falls
   * to half. Lowest and highest. */
  vtkSetVector2Macro(VortexDiameter, double);
  vtkGetVector2Macro(VortexDiameter, double);
  ///@}
  ///@{
  /** Distances between the poles of vortices, in widths of the volume. Lowest and highest. */
  vtkSetVector2Macro(VortexLength, double);
  vtkGetVector2Macro(VortexLength, double);
  ///@}
  ///@{
  /** Largest accelerations of vortices, in metres per second squared. Lowest and highest. */
  vtkSetVector2Macro(VortexAcceleration, double);
  vtkGetVector2Macro(VortexAcceleration, double);
  ///@}
  ///@{
  /** Standard deviations of the vortices in time, in seconds. Lowest and highest. */
  vtkSetVector2Macro(VortexDuration, double);
  vtkGetVector2Macro(VortexDuration, double);
  ///@}
  ///@{
  /** Radii of winds, in widths of the volume. Lowest and highest. */
  vtkSetVector2Macro(WindRadius, double);
  vtkGetVector2Macro(WindRadius, double);
  ///@}
  ///@{
  /** Accelerations of winds at their centres, in metres per second squared. Lowest and highest. */
  vtkSetVector2Macro(WindAcceleration, double);
  vtkGetVector2Macro(WindAcceleration, double);
  ///@}
  ///@{
  /** Standard deviations of the winds in time, in seconds. Lowest and highest. */
  vtkSetVector2Macro(WindDuration, double);
  vtkGetVector2Macro(WindDuration, double);
  ///@}
  ///@{
  /** Sizes of obstacles, in widths of the volume. Lowest and highest. */
  vtkSetVector2Macro(ObstacleSize, double);
  vtkGetVector2Macro(ObstacleSize, double);
  ///@}
  ///@{
  /** Which rotations the connection table may use: 0 Yaw, 1 YawAndTilt, 2 Any. */
  vtkSetClampMacro(RotationFreedom, int, YAW, ANY);
  vtkGetMacro(RotationFreedom, int);
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

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::AirRun;
  friend struct waft::ClusterOptions;
  friend struct waft::ClusterTreeOptions;
  friend struct waft::ConnectionOptions;
  friend struct waft::DatabaseOptions;
  friend struct waft::EnsembleOptions;
  friend struct waft::RotationRange;
  friend struct waft::TraceOptions;
  int NumberOfSimulations = 8;
  double StopBelow = 0.0;
  double CoverageTolerance = 0.05;
  std::string KeptIn;
  double TimeLimit = 0.0;
  int NumberOfFrames = 300;
  int Resolution = 64;
  int SeedStride = 8;
  int NumberOfVortices = 10;
  int NumberOfWinds = 6;
  int NumberOfObstacles = 2;
  int MaximumSegments = 6000;
  int NumberOfTopNodes = 100;
  int Seed = 1;
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  double FramesPerSecond = 30.0;
  double WarmUpSeconds = 3.0;
  double SettlingSpeed = 0.0;
  double RelativeError = 0.002;
  double NotConnectible = 0.15;
  double VortexDiameter[2] = { 0.22, 0.44 };
  double VortexLength[2] = { 0.3, 0.8 };
  double VortexAcceleration[2] = { 0.27, 1.05 };
  double VortexDuration[2] = { 2.0, 4.0 };
  double WindRadius[2] = { 0.2, 0.5 };
  double WindAcceleration[2] = { 0.16, 0.65 };
  double WindDuration[2] = { 0.7, 2.0 };
  double ObstacleSize[2] = { 0.08, 0.25 };
  int RotationFreedom = YAW_AND_TILT;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
