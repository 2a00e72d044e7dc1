// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTrajectoryTraceFilter
 * @brief   follows massless tracers through a flow that varies in time
 *
 * Input port 0, Input (vtkImageData, time-varying): point data `Velocity` [m/s] (float or
 * double[3]), optional `VortexForce` and `WindForce` [m/s^2], optional `Obstacle` (1: solid;
 * tracers end there). A flow of one time step is taken as steady over the scene's frames. Input
 * port 1, Vortices (vtkPolyData, optional): the vortices that drive the flow, for the annotation.
 * Without `VortexForce` their closed forms serve for it. Input port 2, Obstacles (vtkPolyData,
 * optional, may move): tracers end where they meet one.
 *
 * Output port 0, Tracks (vtkPolyData): one polyline per tracer, one point a frame, annotated with
 * `ForceType`, `VortexId`, `VortexAcceleration` and `WindAcceleration`; field data `SettlingSpeed`.
 *
 * Tracers start at a uniform subset of the image's points and are carried by Runge-Kutta steps of
 * fourth order, in one pass over the time steps with two of them in memory (Shi et al. 2005,
 * section 3.1). A tracer ends at the last frame, at the boundary of the volume (field data
 * `Bounds`, else the image's) or at an obstacle. Frames per second come from the field data, else
 * from the time steps. Stopped half way, it gives the tracks up to there.
 */
#ifndef vtkTrajectoryTraceFilter_h
#define vtkTrajectoryTraceFilter_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct AnnotationOptions;
struct TraceOptions;
}

class VTKWAFTFILTERS_EXPORT vtkTrajectoryTraceFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkTrajectoryTraceFilter* New();
  vtkTypeMacro(vtkTrajectoryTraceFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Tracers start at every SeedStride-th point along each axis; at least 1. */
  vtkSetClampMacro(SeedStride, int, 1, VTK_INT_MAX);
  vtkGetMacro(SeedStride, int);
  ///@}
  ///@{
  /** Tracers sink through the air at this speed [m/s]; 0: they follow it. */
  vtkSetMacro(SettlingSpeed, double);
  vtkGetMacro(SettlingSpeed, double);
  ///@}
  ///@{
  /** A point is driven by a vortex when |f_vortex| > VortexShare (|f_vortex| + |f_wind|), 0..1. */
  vtkSetClampMacro(VortexShare, double, 0.0, 1.0);
  vtkGetMacro(VortexShare, double);
  ///@}
  ///@{
  /** A force below this drives nothing [m/s^2]. */
  vtkSetClampMacro(ForceFloor, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ForceFloor, double);
  ///@}
  ///@{
  /** Stretches of one cause that are shorter take the cause before them [s]. */
  vtkSetClampMacro(ShortestRun, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ShortestRun, double);
  ///@}

  ///@{
  /// Take an optional input away.
  void RemoveAllVortices() { this->SetInputConnection(1, nullptr); }
  void RemoveAllObstacles() { this->SetInputConnection(2, nullptr); }
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkTrajectoryTraceFilter();
  ~vtkTrajectoryTraceFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkTrajectoryTraceFilter(const vtkTrajectoryTraceFilter&) = delete;
  void operator=(const vtkTrajectoryTraceFilter&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::AnnotationOptions;
  friend struct waft::TraceOptions;
  int SeedStride = 8;
  double SettlingSpeed = 0.0;
  double VortexShare = 0.5;
  double ForceFloor = 0.05;
  double ShortestRun = 0.3;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
