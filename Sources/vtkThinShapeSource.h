// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkThinShapeSource
 * @brief   what the sources of one curved thin body share
 *
 * Output port 0, Shapes (vtkMultiBlockDataSet): one block, a surface centred on its centre of mass
 * [m], x along the length, y across, z along the normal, edges up, with texture coordinates and the
 * field data `DragCoefficient`, `AreaDensity` [kg/m^2], `Thickness` [m], `SettlingSpeed` [m/s],
 * `Damping` [1/s], `ClassId`, `Color`, `Texture` (path of an image). The field data `Bounds`,
 * `NumberOfFrames` and `FramesPerSecond` describe the scene.
 */
#ifndef vtkThinShapeSource_h
#define vtkThinShapeSource_h

#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <string>

namespace waft
{
struct Bending;
class Result;
struct SceneFrame;
struct Shape;
struct ThinBody;
} // namespace waft

class VTKWAFTSOURCES_EXPORT vtkThinShapeSource : public vtkMultiBlockDataSetAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkThinShapeSource, vtkMultiBlockDataSetAlgorithm);

  ///@{
  /** Largest extent [m], more than 0. */
  vtkSetMacro(Length, double);
  vtkGetMacro(Length, double);
  ///@}
  ///@{
  /** Rise of the edges over half the local width, 0..2. */
  vtkSetClampMacro(Curl, double, 0.0, 2.0);
  vtkGetMacro(Curl, double);
  ///@}
  ///@{
  /** Rise of both ends over the length, 0..0.5. */
  vtkSetClampMacro(Camber, double, 0.0, 0.5);
  vtkGetMacro(Camber, double);
  ///@}
  ///@{
  /** Turn of the tip against the base [rad], -1..1. */
  vtkSetClampMacro(Twist, double, -1.0, 1.0);
  vtkGetMacro(Twist, double);
  ///@}
  ///@{
  /** Mass of a square metre [kg/m^2], more than 0. */
  vtkSetMacro(AreaDensity, double);
  vtkGetMacro(AreaDensity, double);
  ///@}
  ///@{
  /** Thickness [m], more than 0. */
  vtkSetMacro(Thickness, double);
  vtkGetMacro(Thickness, double);
  ///@}
  ///@{
  /** Drag coefficient, broadside. */
  vtkSetMacro(DragCoefficient, double);
  vtkGetMacro(DragCoefficient, double);
  ///@}
  ///@{
  /** Terminal fall speed in still air [m/s]. */
  vtkSetMacro(SettlingSpeed, double);
  vtkGetMacro(SettlingSpeed, double);
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

protected:
  vtkThinShapeSource();
  ~vtkThinShapeSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  /// Gives a shape its name, mesh, texture coordinates, texture and colour.
  virtual waft::Result MakeShape(waft::Shape& shape) = 0;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::Bending;
  friend struct waft::SceneFrame;
  friend struct waft::ThinBody;
  double Length = 0.1;
  double Curl = 0.3;
  double Camber = 0.05;
  double Twist = 0.0;
  double AreaDensity = 0.1;
  double Thickness = 0.0004;
  double DragCoefficient = 1.2;
  double SettlingSpeed = 0.8;
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;

private:
  vtkThinShapeSource(const vtkThinShapeSource&) = delete;
  void operator=(const vtkThinShapeSource&) = delete;
};

#endif
