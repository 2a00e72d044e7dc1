// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkConstraintSource
 * @brief   wishes about one object, made by hand
 *
 * Output port 0, Constraints (vtkPolyData): one vertex a row. Without UseWaypoints it is one row of
 * Kind at Frame: a position, velocity, acceleration or rest of Value, or an orientation. With
 * UseWaypoints it is a position or rest at each of them, at frames evenly spaced from Frame to
 * LastFrame. `Row` is -1: a row's number is its vertex's, also when several of these are appended.
 * The field data `Bounds`, `NumberOfFrames`, `FramesPerSecond` describe the scene.
 */
#ifndef vtkConstraintSource_h
#define vtkConstraintSource_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <array>
#include <vector>

namespace waft
{
struct ConstraintOptions;
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
  ///@{
  /** The object spoken of; -1: any, the planner chooses. */
  vtkSetClampMacro(ObjectId, int, -1, VTK_INT_MAX);
  vtkGetMacro(ObjectId, int);
  ///@}
  ///@{
  /** Position (0), velocity (1), acceleration (2), orientation (3) or rest (4). */
  vtkSetClampMacro(Kind, int, POSITION, REST);
  vtkGetMacro(Kind, int);
  ///@}
  ///@{
  /** Frame of the row, or of the first waypoint; 0 or more. */
  vtkSetClampMacro(Frame, int, 0, VTK_INT_MAX);
  vtkGetMacro(Frame, int);
  ///@}
  ///@{
  /** Frame of the last waypoint; -1: the scene's last. */
  vtkSetClampMacro(LastFrame, int, -1, VTK_INT_MAX);
  vtkGetMacro(LastFrame, int);
  ///@}
  ///@{
  /** A rest lasts to this frame; -1: the scene's last. */
  vtkSetClampMacro(Until, int, -1, VTK_INT_MAX);
  vtkGetMacro(Until, int);
  ///@}
  ///@{
  /** Place [m], velocity [m/s] or acceleration [m/s^2]; of a rest the point above the surface. */
  vtkSetVector3Macro(Value, double);
  vtkGetVector3Macro(Value, double);
  ///@}
  ///@{
  /** Orientation, a quaternion (w, x, y, z), body to world. */
  vtkSetVector4Macro(Orientation, double);
  vtkGetVector4Macro(Orientation, double);
  ///@}
  ///@{
  /** By how much the row may be missed, in the unit of its value (orientation: rad); 0: exact. */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}
  ///@{
  /** Whether the waypoints count, instead of Value. */
  vtkSetMacro(UseWaypoints, bool);
  vtkGetMacro(UseWaypoints, bool);
  vtkBooleanMacro(UseWaypoints, bool);
  ///@}
  ///@{
  /** Places [m] instead of Value, in the order of time. */
  void SetNumberOfWaypoints(int count);
  int GetNumberOfWaypoints() const { return static_cast<int>(this->Waypoints.size()); }
  void SetWaypoint(int index, double x, double y, double z);
  /** Zeros for a waypoint that is not there. */
  void GetWaypoint(int index, double point[3]) const;
  ///@}
  ///@{
  /** The volume (xmin, xmax, ymin, ymax, zmin, zmax) [m]. */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}
  ///@{
  /** Frames of the scene, 1 or more. */
  vtkSetClampMacro(NumberOfFrames, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfFrames, int);
  ///@}
  ///@{
  /** Frames per second, more than 0. */
  vtkSetMacro(FramesPerSecond, double);
  vtkGetMacro(FramesPerSecond, double);
  ///@}

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

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::ConstraintOptions;
  friend struct waft::SceneFrame;
  int ObjectId = 0;
  int Kind = POSITION;
  int Frame = 150;
  int LastFrame = -1;
  int Until = -1;
  double Value[3] = { 0.0, 0.0, 2.0 };
  double Orientation[4] = { 1.0, 0.0, 0.0, 0.0 };
  double Radius = 0.0;
  bool UseWaypoints = false;
  std::vector<std::array<double, 3>> Waypoints{ { -0.5, 0.0, 2.0 }, { 0.5, 0.0, 2.0 } };
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
};

#endif
