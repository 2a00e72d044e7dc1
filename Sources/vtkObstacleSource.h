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
  ///@{
  /** What stands in the way: nothing (0), a box (1), a sphere (2) or a cylinder (3). */
  vtkSetClampMacro(Kind, int, NONE, CYLINDER);
  vtkGetMacro(Kind, int);
  ///@}
  ///@{
  /** Lowest corner of a box [m]. */
  vtkSetVector3Macro(Corner, double);
  vtkGetVector3Macro(Corner, double);
  ///@}
  ///@{
  /** Extents of a box [m], more than 0. */
  vtkSetVector3Macro(Size, double);
  vtkGetVector3Macro(Size, double);
  ///@}
  ///@{
  /** Middle of a sphere [m]. */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}
  ///@{
  /** Middle of one end of a cylinder [m]. */
  vtkSetVector3Macro(Base, double);
  vtkGetVector3Macro(Base, double);
  ///@}
  ///@{
  /** Middle of the other end of a cylinder [m]. */
  vtkSetVector3Macro(Top, double);
  vtkGetVector3Macro(Top, double);
  ///@}
  ///@{
  /** Of a sphere or a cylinder [m], more than 0. */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}
  ///@{
  /** Whether there is a ground to land on, all over the volume and beyond. */
  vtkSetMacro(Ground, bool);
  vtkGetMacro(Ground, bool);
  vtkBooleanMacro(Ground, bool);
  ///@}
  ///@{
  /** Height of the ground [m]. */
  vtkSetMacro(GroundHeight, double);
  vtkGetMacro(GroundHeight, double);
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
  vtkObstacleSource();
  ~vtkObstacleSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkObstacleSource(const vtkObstacleSource&) = delete;
  void operator=(const vtkObstacleSource&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::ObstacleSourceOptions;
  friend struct waft::SceneFrame;
  int Kind = BOX;
  double Corner[3] = { -0.5, -0.5, 0.0 };
  double Size[3] = { 1.0, 1.0, 1.0 };
  double Center[3] = { 0.0, 0.0, 1.0 };
  double Base[3] = { 0.0, 0.0, 0.0 };
  double Top[3] = { 0.0, 0.0, 2.0 };
  double Radius = 0.3;
  bool Ground = false;
  double GroundHeight = 0.0;
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
};

#endif
