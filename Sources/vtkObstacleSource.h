// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkObstacleSource
 * @brief   an obstacle and a ground, made by hand
 *
 * Output port 0, Obstacles (vtkPolyData): closed surfaces of triangles, of a box, a sphere or a
 * cylinder, and of a ground where there is one. They have no `ObstacleId`: stages tell obstacles
 * apart by what of them hangs together, also when several of these are appended. The field data
 * `Bounds`, `NumberOfFrames`, `FramesPerSecond` describe the scene.
 */
#ifndef vtkObstacleSource_h
#define vtkObstacleSource_h

#include "WaftProperty.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

namespace waft
{
struct SceneFrame;
struct ObstacleSourceOptions;
}

class VTKWAFTSOURCES_EXPORT vtkObstacleSource : public vtkPolyDataAlgorithm
{
public:
  static vtkObstacleSource* New();
  vtkTypeMacro(vtkObstacleSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Kinds
  {
    NONE = 0,
    BOX = 1,
    SPHERE = 2,
    CYLINDER = 3
  };

  WaftProperty(int, Kind);
  WaftVector(double, Corner, 3);
  WaftVector(double, Size, 3);
  WaftVector(double, Center, 3);
  WaftVector(double, Base, 3);
  WaftVector(double, Top, 3);
  WaftOpenProperty(double, Radius);
  WaftFlag(Ground);
  WaftOpenProperty(double, GroundHeight);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkObstacleSource();
  ~vtkObstacleSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkObstacleSource(const vtkObstacleSource&) = delete;
  void operator=(const vtkObstacleSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::ObstacleSourceOptions;
  friend struct waft::SceneFrame;
};

#endif
