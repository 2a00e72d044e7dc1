// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRotationRefineFilter
 * @brief   turns objects in the air while their centres follow given paths
 *
 * Input port 0, Tracks (vtkPolyData): one polyline an object, one point a frame; the point data
 * `AirVelocity` [m/s], when there, is the air's velocity along the path. With `Slip` [m/s] the
 * tracks' own `Orientation` and `AngularVelocity` are the poses, which the path was found with.
 * Input port 1, Objects (vtkPolyData): `ObjectId`, `ShapeId`, `Mass`, initial `Orientation` and
 * `AngularVelocity`.
 * Input port 2, Shapes (vtkMultiBlockDataSet): the meshes, centred on their mass.
 * Input port 3, Obstacles (vtkPolyData, optional): closed surfaces, may move.
 * Input port 4, Wind (vtkImageData, optional): a field with `Velocity` [m/s] is the air where
 * tracks carry none, and its gradient turns bodies; one with `Wind` (an acceleration) is passed
 * over. Input port 5, Constraints (vtkPolyData, optional): rows of kind orientation are met, rows
 * of kind rest lay the body on its surface. Input port 6, Air (vtkImageData, optional, may vary in
 * time): `Velocity` [m/s], as the assimilation gives it, is the air in place of `AirVelocity` and
 * Wind; its gradient turns bodies, and `Damping` draws them to half its vorticity.
 *
 * Output port 0, Meshes (vtkPolyData, time-varying): all meshes posed at the current time, with
 * texture coordinates, normals and the point and cell data `ObjectId`, `ShapeId`.
 * Output port 1, Poses (vtkPolyData): Tracks with `Orientation` (w, x, y, z), `AngularVelocity`
 * [rad/s, world] and `Torque` [N m, world] at every frame, and by line `Shift` [m]: how far its
 * centre is moved from its track at most, so that the mesh lies on a surface; of poses that came
 * with `Slip` also `Agreement` (2, degrees), by line and of all as field data: median and 90th
 * percentile of how far half a second of turning in the air leads away from them. What it turns and
 * glides by, which differs between bodies of a shape, is there by line, too: `DragCoefficient`,
 * `Lift`, `RotationalLift`, `PressureShift`, `Spin` [rad], `SlippingMass` [kg], `BroadsideSpeed`
 * [m/s], `Damping`, `Follow` [1/s], `Pace`.
 * Output port 2, Report (vtkTable): one line for each orientation row, with the columns of the
 * planner's Report; `Residual` [rad] is measured on the poses, beyond the row's radius.
 *
 * Shi et al. 2005, section 6 (model Paper: drag, Eq. 5, on each visible piece of surface); the
 * model Plate adds what lets thin bodies flutter and tumble: see
 * Documentation/RotationRefineFilter.md.
 */
#ifndef vtkRotationRefineFilter_h
#define vtkRotationRefineFilter_h

#include "WaftProperty.h"
#include "vtkChainStageAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct RotationOptions;
struct TurningOptions;
}

class VTKWAFTFILTERS_EXPORT vtkRotationRefineFilter : public vtkChainStageAlgorithm
{
public:
  static vtkRotationRefineFilter* New();
  vtkTypeMacro(vtkRotationRefineFilter, vtkChainStageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, Model);
  WaftProperty(double, Damping);
  WaftProperty(double, Lift);
  WaftProperty(double, PressureShift);
  WaftProperty(double, Follow);
  WaftProperty(double, Roll);
  WaftProperty(double, Spin);
  WaftProperty(double, VariationPerObject);
  WaftProperty(double, LandingTime);
  WaftProperty(double, TurningTime);
  WaftProperty(double, TurningRate);
  WaftProperty(double, MaximumTurn);
  WaftProperty(int, RasterSize);
  WaftFlag(KeepApart);
  WaftProperty(int, Seed);

  ///@{
  /// Take an optional input away.
  void RemoveAllObstacles() { this->SetInputConnection(3, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(4, nullptr); }
  void RemoveAllConstraints() { this->SetInputConnection(5, nullptr); }
  void RemoveAllAir() { this->SetInputConnection(6, nullptr); }
  ///@}

protected:
  vtkRotationRefineFilter();
  ~vtkRotationRefineFilter() override;

  waft::KeptStage& Kept() override;
  std::vector<waft::PropertyRange> Ranges() const override;

private:
  vtkRotationRefineFilter(const vtkRotationRefineFilter&) = delete;
  void operator=(const vtkRotationRefineFilter&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::RotationOptions;
  friend struct waft::TurningOptions;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
