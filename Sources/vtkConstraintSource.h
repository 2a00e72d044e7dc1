// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkConstraintSource
 * @brief   constraints on one object, made by hand
 *
 * Output port 0, Constraints (vtkPolyData): one vertex a row. Without UseWaypoints it is one row of
 * Kind at Frame: a position, velocity, acceleration or rest of Value, or an orientation. With
 * UseWaypoints it is a position or rest at each of them, at frames evenly spaced from Frame to
 * LastFrame. A position may ask its body to face a direction (Facing). `Row` is -1: a row's number
 * is its vertex's, also when several of these are appended. The field data `Bounds`,
 * `NumberOfFrames`, `FramesPerSecond` describe the scene.
 */
#ifndef vtkConstraintSource_h
#define vtkConstraintSource_h

#include "WaftProperty.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <array>
#include <vector>

namespace waft
{
struct ConstraintOptions;
struct FacingOptions;
struct SceneFrame;
}

class VTKWAFTSOURCES_EXPORT vtkConstraintSource : public vtkPolyDataAlgorithm
{
public:
  static vtkConstraintSource* New();
  vtkTypeMacro(vtkConstraintSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Kinds
  {
    POSITION = 0,
    VELOCITY = 1,
    ACCELERATION = 2,
    ORIENTATION = 3,
    REST = 4
  };

  WaftProperty(int, ObjectId);
  WaftProperty(int, Kind);
  WaftProperty(int, Frame);
  WaftProperty(int, FrameFrom);
  WaftProperty(int, Hold);
  WaftFlag(Drift);
  WaftProperty(int, On);
  WaftProperty(int, LastFrame);
  WaftProperty(int, Until);
  WaftVector(double, Value, 3);
  WaftVector(double, Orientation, 4);
  WaftProperty(double, Radius);
  WaftFlag(UseWaypoints);

  ///@{
  /** Places [m] instead of Value, in the order of time. */
  void SetNumberOfWaypoints(int count);
  int GetNumberOfWaypoints() const { return static_cast<int>(this->Waypoints.size()); }
  void SetWaypoint(int index, double x, double y, double z);
  /** Zeros for a waypoint that is not there. */
  void GetWaypoint(int index, double point[3]) const;
  ///@}

  WaftVector(double, Facing, 3);
  WaftProperty(double, FacingTolerance);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkConstraintSource();
  ~vtkConstraintSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkConstraintSource(const vtkConstraintSource&) = delete;
  void operator=(const vtkConstraintSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::ConstraintOptions;
  friend struct waft::FacingOptions;
  friend struct waft::SceneFrame;
  std::vector<std::array<double, 3>> Waypoints;
};

#endif
