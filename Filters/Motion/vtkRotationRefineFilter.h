// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRotationRefineFilter
 * @brief   turns objects in the air while their centres follow given paths
 *
 * Input port 0, Tracks (vtkPolyData): one polyline an object, one point a frame; the point data
 * `AirVelocity` [m/s], when there, is the air's velocity along the path.
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
 * centre is moved from its track at most, so that the mesh lies on a surface.
 * Output port 2, Report (vtkTable): one line for each orientation row, with the columns of the
 * planner's Report; `Residual` [rad] is measured on the poses, beyond the row's radius.
 *
 * Shi et al. 2005, section 6 (model Paper: drag, Eq. 5, on each visible piece of surface); the
 * model Plate adds what lets thin bodies flutter and tumble: see
 * Documentation/RotationRefineFilter.md.
 */
#ifndef vtkRotationRefineFilter_h
#define vtkRotationRefineFilter_h

#include "vtkSlicedPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct RotationOptions;
}

class VTKWAFTFILTERS_EXPORT vtkRotationRefineFilter : public vtkSlicedPolyDataAlgorithm
{
public:
  static vtkRotationRefineFilter* New();
  vtkTypeMacro(vtkRotationRefineFilter, vtkSlicedPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** 0: Paper, 1: Plate. */
  vtkSetClampMacro(Model, int, 0, 1);
  vtkGetMacro(Model, int);
  ///@}
  ///@{
  /** Rate at which angular momentum dies away besides the air's drag [1/s], 0..1000. */
  vtkSetClampMacro(Damping, double, 0.0, 1000.0);
  vtkGetMacro(Damping, double);
  ///@}
  ///@{
  /** Extra slope of the normal force at small angles of attack, 0..4 (Plate). */
  vtkSetClampMacro(Lift, double, 0.0, 4.0);
  vtkGetMacro(Lift, double);
  ///@}
  ///@{
  /** Centre of pressure of an edge-on plate, in half chords ahead of the centre, 0..1 (Plate). */
  vtkSetClampMacro(PressureShift, double, 0.0, 1.0);
  vtkGetMacro(PressureShift, double);
  ///@}
  ///@{
  /** Rate at which the hidden sideslip is forgotten [1/s], 0..1000 (Plate). */
  vtkSetClampMacro(Follow, double, 0.0, 1000.0);
  vtkGetMacro(Follow, double);
  ///@}
  ///@{
  /** How readily a body rolls on when it turns over, 0..4; 1 as plates do (Plate). */
  vtkSetClampMacro(Roll, double, 0.0, 4.0);
  vtkGetMacro(Roll, double);
  ///@}
  ///@{
  /** Pitch of the propeller that a thin body is about its normal [rad], -1..1 (Plate). */
  vtkSetClampMacro(Spin, double, -1.0, 1.0);
  vtkGetMacro(Spin, double);
  ///@}
  ///@{
  /** How much objects of one shape differ, 0..0.5. */
  vtkSetClampMacro(VariationPerObject, double, 0.0, 0.5);
  vtkGetMacro(VariationPerObject, double);
  ///@}
  ///@{
  /** Time in which a body settles before it rests [s], 0..1000. */
  vtkSetClampMacro(LandingTime, double, 0.0, 1000.0);
  vtkGetMacro(LandingTime, double);
  ///@}
  ///@{
  /** Longest time over which an orientation row draws the pose towards it [s], 0..1000. */
  vtkSetClampMacro(TurningTime, double, 0.0, 1000.0);
  vtkGetMacro(TurningTime, double);
  ///@}
  ///@{
  /** The fastest turn that an orientation row may ask for [rad/s], 1..1000. */
  vtkSetClampMacro(TurningRate, double, 1.0, 1000.0);
  vtkGetMacro(TurningRate, double);
  ///@}
  ///@{
  /** The most that a body turns from a frame to the next [degrees], 5..180. */
  vtkSetClampMacro(MaximumTurn, double, 5.0, 180.0);
  vtkGetMacro(MaximumTurn, double);
  ///@}
  ///@{
  /** Pixels on a side of the pictures that tell what hides what, 8..1024. */
  vtkSetClampMacro(RasterSize, int, 8, 1024);
  vtkGetMacro(RasterSize, int);
  ///@}
  ///@{
  /** Seed of the variation, 0 or more. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /// Take an optional input away.
  void RemoveAllObstacles() { this->SetInputConnection(3, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(4, nullptr); }
  void RemoveAllConstraints() { this->SetInputConnection(5, nullptr); }
  void RemoveAllAir() { this->SetInputConnection(6, nullptr); }
  ///@}

  ///@{
  /** Whether the stage runs. One that rests takes none of its inputs and gives empty outputs. */
  vtkSetMacro(Active, bool);
  vtkGetMacro(Active, bool);
  vtkBooleanMacro(Active, bool);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkRotationRefineFilter();
  ~vtkRotationRefineFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;
  waft::KeptStage& Kept() override;

private:
  vtkRotationRefineFilter(const vtkRotationRefineFilter&) = delete;
  void operator=(const vtkRotationRefineFilter&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::RotationOptions;
  int Model = 1;
  double Damping = 0.3;
  double Lift = 2.9;
  double PressureShift = 0.0;
  double Follow = 0.5;
  double Roll = 1.0;
  double Spin = 0.0;
  double VariationPerObject = 0.15;
  double LandingTime = 0.7;
  double TurningTime = 2.0;
  double TurningRate = 60.0;
  double MaximumTurn = 60.0;
  int RasterSize = 128;
  int Seed = 1;

  bool Active = true;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
