// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAirAssimilationFilter
 * @brief   draws one air in which all objects drift to their marks with the least control
 *
 * Input port 0, Tracks (vtkPolyData): planned paths, one polyline an object, one point a frame.
 * Input port 1, Objects (vtkPolyData): one vertex an object.
 * Input port 2, Constraints (vtkPolyData): rows, each assigned to an object; those that a stage
 * before found impossible (`Status`) do not bind.
 * Input port 3, Obstacles (vtkPolyData, optional, may move): closed surfaces.
 * Input port 4, Wind (vtkImageData, optional, may vary in time): `Wind` or `Velocity`, which acts
 * on the air. Input port 5, Vortices (vtkPolyData, optional): the scene's own.
 *
 * Output port 0, Tracks (vtkPolyData): with `AirVelocity` and `Control` [m/s], what moves a body
 * beside the air; with Shapes and Glide `Slip` [m/s, world], their own velocity relative to the air
 * by their poses, `Orientation` and `AngularVelocity` [rad/s, world].
 * Output port 1, Air (vtkImageData, varies in time): `Velocity` [m/s]; `Wind` [m/s^2], the force of
 * the wind correction, which `Velocity` contains.
 * Output port 2, Vortices (vtkPolyData): all that stir the air.
 * Output port 3, Constraints (vtkPolyData): with `TouchDown`, the frame from which a rest is kept.
 * Output port 4, Report (vtkTable): one line per row and target of the constraints.
 * Output port 5, Rounds (vtkTable): `Stage`, `Candidate`, `ControlRms`, `ControlMedian`,
 * `FlowRms`, `WindRms` [m/s], `Seconds`.
 *
 * The result is the same, bit by bit, on any number of threads.
 */
#ifndef vtkAirAssimilationFilter_h
#define vtkAirAssimilationFilter_h

#include "WaftProperty.h"
#include "vtkChainStageAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>
#include <string>

namespace waft
{
struct AssimilationOptions;
struct TurningOptions;
} // namespace waft

class VTKWAFTFILTERS_EXPORT vtkAirAssimilationFilter : public vtkChainStageAlgorithm
{
public:
  static vtkAirAssimilationFilter* New();
  vtkTypeMacro(vtkAirAssimilationFilter, vtkChainStageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, Resolution);
  WaftProperty(int, LatticeResolution);
  WaftProperty(int, Candidates);
  WaftProperty(int, Starts);
  WaftProperty(int, Rounds);
  WaftProperty(int, WindRounds);
  WaftProperty(double, WindSpacing);
  WaftProperty(double, WindTimeSpacing);
  WaftProperty(double, WindStiffness);
  WaftProperty(double, Smoothness);
  WaftProperty(double, TouchDownSpread);
  WaftProperty(double, Glide);
  WaftProperty(int, Model);
  WaftProperty(double, Damping);
  WaftProperty(double, Lift);
  WaftProperty(double, PressureShift);
  WaftProperty(double, Follow);
  WaftProperty(double, Roll);
  WaftProperty(double, Spin);
  WaftProperty(double, VariationPerObject);
  WaftProperty(double, MaximumTurn);
  WaftProperty(int, RasterSize);
  WaftFlag(Inertia);
  WaftProperty(double, TimeLimit);
  WaftProperty(int, Seed);
  WaftFlag(WarmStart);
  WaftWrittenFile(CheckpointFile);
  WaftWrittenFile(StateFile);
  WaftFile(EditOf);

  /** Forgets the last run: the next one draws an air. */
  void Restart();

  ///@{
  /// Take an optional input away.
  void RemoveAllObstacles() { this->SetInputConnection(3, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(4, nullptr); }
  void RemoveAllVortices() { this->SetInputConnection(5, nullptr); }
  void RemoveAllShapes() { this->SetInputConnection(6, nullptr); }
  ///@}

protected:
  vtkAirAssimilationFilter();
  ~vtkAirAssimilationFilter() override;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  waft::KeptStage& Kept() override;
  std::vector<waft::PropertyRange> Ranges() const override;

private:
  vtkAirAssimilationFilter(const vtkAirAssimilationFilter&) = delete;
  void operator=(const vtkAirAssimilationFilter&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::AssimilationOptions;
  friend struct waft::TurningOptions;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
