// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkObjectSource
 * @brief   one light object at its start, made by hand
 *
 * Output port 0, Objects (vtkPolyData): one vertex at Position with the arrays `ObjectId`,
 * `ShapeId`, `ClassId` (int), `Mass` [kg], `SettlingSpeed` [m/s, terminal fall speed in still air],
 * `ClearanceRadius`, `RestHeight` [m] (double), `Velocity` [m/s], `AngularVelocity` [rad/s, world]
 * (double[3]) and `Orientation` (double[4]; w, x, y, z). Several objects: append several of these.
 * The field data `Bounds`, `NumberOfFrames`, `FramesPerSecond` and `AirDensity` describe the scene.
 */
#ifndef vtkObjectSource_h
#define vtkObjectSource_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

namespace waft
{
struct ObjectOptions;
struct SceneFrame;
}

class VTKWAFTSOURCES_EXPORT vtkObjectSource : public vtkPolyDataAlgorithm
{
public:
  static vtkObjectSource* New();
  vtkTypeMacro(vtkObjectSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Place at frame 0 [m]. */
  vtkSetVector3Macro(Position, double);
  vtkGetVector3Macro(Position, double);
  ///@}
  ///@{
  /** Velocity at frame 0 [m/s]. */
  vtkSetVector3Macro(Velocity, double);
  vtkGetVector3Macro(Velocity, double);
  ///@}
  ///@{
  /** Orientation at frame 0, a quaternion (w, x, y, z), body to world. */
  vtkSetVector4Macro(Orientation, double);
  vtkGetVector4Macro(Orientation, double);
  ///@}
  ///@{
  /** Angular velocity at frame 0 [rad/s, world]. */
  vtkSetVector3Macro(AngularVelocity, double);
  vtkGetVector3Macro(AngularVelocity, double);
  ///@}
  ///@{
  /** Number that tracks and constraints name the object by, 0 or more. */
  vtkSetClampMacro(ObjectId, int, 0, VTK_INT_MAX);
  vtkGetMacro(ObjectId, int);
  ///@}
  ///@{
  /** Block of Shapes that is its body, 0 or more. */
  vtkSetClampMacro(ShapeId, int, 0, VTK_INT_MAX);
  vtkGetMacro(ShapeId, int);
  ///@}
  ///@{
  /** Class for targets that take one class only; -1: none. */
  vtkSetMacro(ClassId, int);
  vtkGetMacro(ClassId, int);
  ///@}
  ///@{
  /** Mass [kg], more than 0. It serves the rotation. */
  vtkSetMacro(Mass, double);
  vtkGetMacro(Mass, double);
  ///@}
  ///@{
  /** Terminal fall speed in still air [m/s]. */
  vtkSetMacro(SettlingSpeed, double);
  vtkGetMacro(SettlingSpeed, double);
  ///@}
  ///@{
  /** Distance that the centre keeps from obstacles and walls [m]. */
  vtkSetMacro(ClearanceRadius, double);
  vtkGetMacro(ClearanceRadius, double);
  ///@}
  ///@{
  /** Height of the centre above a plane that the body lies on [m]. */
  vtkSetMacro(RestHeight, double);
  vtkGetMacro(RestHeight, double);
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
  ///@{
  /** Density of the air [kg/m^3]. */
  vtkSetMacro(AirDensity, double);
  vtkGetMacro(AirDensity, double);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkObjectSource();
  ~vtkObjectSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkObjectSource(const vtkObjectSource&) = delete;
  void operator=(const vtkObjectSource&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::ObjectOptions;
  friend struct waft::SceneFrame;
  double Position[3] = { 0.0, 0.0, 3.0 };
  double Velocity[3] = { 0.0, 0.0, 0.0 };
  double Orientation[4] = { 1.0, 0.0, 0.0, 0.0 };
  double AngularVelocity[3] = { 0.0, 0.0, 0.0 };
  int ObjectId = 0;
  int ShapeId = 0;
  int ClassId = -1;
  double Mass = 0.001;
  double SettlingSpeed = 0.8;
  double ClearanceRadius = 0.05;
  double RestHeight = 0.0;
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
  double AirDensity = 1.2;
};

#endif
