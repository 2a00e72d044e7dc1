// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkThinShapeSource
 * @brief   what the sources of one curved thin body share
 *
 * Output port 0, Shapes (vtkMultiBlockDataSet): one block, a surface centred on its centre of mass
 * [m], x along the length, y across, z along the normal, edges up, with texture coordinates and the
 * field data `DragCoefficient`, `AreaDensity` [kg/m^2], `Thickness` [m], `SettlingSpeed` [m/s],
 * `Damping` [1/s], `ClassId`, `Color`, `Texture` (path of an image), or, painted in memory, `Skin`
 * (bytes of a PNG file) and `SkinSize` (how many). The field data `Bounds`, `NumberOfFrames` and
 * `FramesPerSecond` describe the scene.
 */
#ifndef vtkThinShapeSource_h
#define vtkThinShapeSource_h

#include "WaftProperty.h"
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <memory>

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

  WaftOpenProperty(double, Length);
  WaftProperty(double, Curl);
  WaftProperty(double, Camber);
  WaftProperty(double, Twist);
  WaftOpenProperty(double, AreaDensity);
  WaftOpenProperty(double, Thickness);
  WaftOpenProperty(double, DragCoefficient);
  WaftOpenProperty(double, SettlingSpeed);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);

protected:
  vtkThinShapeSource();
  ~vtkThinShapeSource() override;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  /// Gives a shape its name, mesh, texture coordinates, texture and colour.
  virtual waft::Result MakeShape(waft::Shape& shape) = 0;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::Bending;
  friend struct waft::SceneFrame;
  friend struct waft::ThinBody;

private:
  vtkThinShapeSource(const vtkThinShapeSource&) = delete;
  void operator=(const vtkThinShapeSource&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
