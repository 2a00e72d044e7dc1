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
 *
 * With Slice an update pulls for about so many seconds; between two of them nothing goes on, since
 * the flow comes by the pipeline. Until all is traced there are no tracks.
 */
#ifndef vtkTrajectoryTraceFilter_h
#define vtkTrajectoryTraceFilter_h

#include "WaftProperty.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct AnnotationOptions;
struct SliceOptions;
struct TraceOptions;
}

class VTKWAFTFILTERS_EXPORT vtkTrajectoryTraceFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkTrajectoryTraceFilter* New();
  vtkTypeMacro(vtkTrajectoryTraceFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, SeedStride);
  WaftOpenProperty(double, SettlingSpeed);
  WaftProperty(double, VortexShare);
  WaftProperty(double, ForceFloor);
  WaftProperty(double, ShortestRun);

  WaftSlices;

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

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::AnnotationOptions;
  friend struct waft::SliceOptions;
  friend struct waft::TraceOptions;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
