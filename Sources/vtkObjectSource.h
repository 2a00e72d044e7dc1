// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkObjectSource
 * @brief   light objects of one kind at their starts, made by hand
 *
 * Output port 0, Objects (vtkPolyData): a vertex an object with the arrays `ObjectId`, `ShapeId`,
 * `ClassId` (int), `Mass` [kg], `SettlingSpeed` [m/s, terminal fall speed in still air],
 * `ClearanceRadius`, `RestHeight` [m] (double), `Velocity` [m/s], `AngularVelocity` [rad/s, world]
 * (double[3]), `Orientation` (double[4]; w, x, y, z), and `ObjectIdGiven` (unsigned char): 0 says
 * that whoever takes several sources' objects, appended, is to number them; ids of 1 are kept.
 * With an input at port 1, Shapes (vtkMultiBlockDataSet), the block ShapeId says Mass,
 * SettlingSpeed, ClearanceRadius, RestHeight and ClassId instead of the properties; port 0 takes
 * nothing. The field data `Bounds`, `NumberOfFrames`, `FramesPerSecond` and `AirDensity` describe
 * the scene.
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

  static constexpr int SHAPES_PORT = 1;
  enum Layouts
  {
    ONE = 0,
    ROW = 1,
    SPREAD = 2
  };
  ///@{
  /** One object at Position (0), a row from Position to RowEnd (1), a spread in the region (2). */
  vtkSetClampMacro(Layout, int, ONE, SPREAD);
  vtkGetMacro(Layout, int);
  ///@}
  ///@{
  /** Objects of a row or a spread, 1 to 100000. */
  vtkSetClampMacro(NumberOfObjects, int, 1, 100000);
  vtkGetMacro(NumberOfObjects, int);
  ///@}
  ///@{
  /** Place at frame 0 [m]. */
  vtkSetVector3Macro(Position, double);
  vtkGetVector3Macro(Position, double);
  ///@}
  ///@{
  /** Place of a row's last object [m]. */
  vtkSetVector3Macro(RowEnd, double);
  vtkGetVector3Macro(RowEnd, double);
  ///@}
  ///@{
  /** Lowest corner of a spread's region [m]. */
  vtkSetVector3Macro(RegionMin, double);
  vtkGetVector3Macro(RegionMin, double);
  ///@}
  ///@{
  /** Extents of a spread's region [m]; it may be flat. */
  vtkSetVector3Macro(RegionSize, double);
  vtkGetVector3Macro(RegionSize, double);
  ///@}
  ///@{
  /** Seed of a spread, 0 or more; also the scene's. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
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
  /** Turns about the world's x, y and z axes in this order, after Orientation [degrees]. */
  vtkSetVector3Macro(Angles, double);
  vtkGetVector3Macro(Angles, double);
  ///@}
  ///@{
  /** Angular velocity at frame 0 [rad/s, world]. */
  vtkSetVector3Macro(AngularVelocity, double);
  vtkGetVector3Macro(AngularVelocity, double);
  ///@}
  ///@{
  /** Number that tracks and constraints name the object by, of several the first; -1: the least
   * numbers that no other object takes. */
  vtkSetClampMacro(ObjectId, int, -1, VTK_INT_MAX);
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

  /// Takes the optional input away.
  void RemoveAllShapes() { this->SetInputConnection(SHAPES_PORT, nullptr); }

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkObjectSource();
  ~vtkObjectSource() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
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
  int Layout = ONE;
  int NumberOfObjects = 5;
  double Position[3] = { 0.0, 0.0, 3.0 };
  double RowEnd[3] = { 1.0, 0.0, 3.0 };
  double RegionMin[3] = { -1.0, -1.0, 2.5 };
  double RegionSize[3] = { 2.0, 2.0, 1.0 };
  int Seed = 1;
  double Velocity[3] = { 0.0, 0.0, 0.0 };
  double Orientation[4] = { 1.0, 0.0, 0.0, 0.0 };
  double Angles[3] = { 0.0, 0.0, 0.0 };
  double AngularVelocity[3] = { 0.0, 0.0, 0.0 };
  int ObjectId = -1;
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
