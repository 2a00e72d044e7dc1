// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkObjectSource
 * @brief   light objects of one kind at their starts, made by hand
 *
 * Output port 0, Objects (vtkPolyData): a vertex an object with the arrays `ObjectId`, `ShapeId`,
 * `ClassId` (int), `Mass` [kg], `SettlingSpeed` [m/s, terminal fall speed in still air],
 * `ClearanceRadius`, `RestHeight` [m] (double), `Velocity` [m/s], `AngularVelocity` [rad/s, world]
 * (double[3]), `Orientation` (double[4]; w, x, y, z), `OrientationGiven` (unsigned char; 0: objects
 * start turned as in flight), and `ObjectIdGiven` (unsigned char): 0 says that whoever takes
 * several sources' objects, appended, is to number them; ids of 1 are kept.
 * With an input at port 1, Shapes (vtkMultiBlockDataSet), the block ShapeId says Mass,
 * SettlingSpeed, ClearanceRadius, RestHeight and ClassId instead of the properties; port 0 takes
 * nothing. The field data `Bounds`, `NumberOfFrames`, `FramesPerSecond` and `AirDensity` describe
 * the scene.
 */
#ifndef vtkObjectSource_h
#define vtkObjectSource_h

#include "WaftProperty.h"
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

  WaftProperty(int, Layout);
  WaftProperty(int, NumberOfObjects);
  WaftVector(double, Position, 3);
  WaftVector(double, RowEnd, 3);
  WaftVector(double, RegionMin, 3);
  WaftVector(double, RegionSize, 3);
  WaftProperty(int, Seed);
  WaftVector(double, Velocity, 3);
  WaftVector(double, Orientation, 4);
  WaftVector(double, Angles, 3);
  WaftVector(double, AngularVelocity, 3);
  WaftProperty(int, ObjectId);
  WaftProperty(int, ShapeId);
  WaftProperty(int, Release);
  WaftProperty(int, LastRelease);
  WaftFlag(Appears);
  WaftFlag(OpenX);
  WaftFlag(OpenY);
  WaftFlag(OpenTop);
  WaftFlag(Loop);
  WaftProperty(int, On);
  WaftOpenProperty(int, ClassId);
  WaftOpenProperty(double, Mass);
  WaftOpenProperty(double, SettlingSpeed);
  WaftOpenProperty(double, ClearanceRadius);
  WaftOpenProperty(double, RestHeight);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);
  WaftOpenProperty(double, AirDensity);

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

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::ObjectOptions;
  friend struct waft::SceneFrame;
};

#endif
