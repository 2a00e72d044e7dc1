// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPaintedShapeSource
 * @brief   what the sources of leaves and feathers share: a painted skin
 *
 * The skin is painted from the same outline as the mesh and written as a PNG file with alpha
 * to TextureFile; without that name nothing is written and the shape has its plain colour.
 */
#ifndef vtkPaintedShapeSource_h
#define vtkPaintedShapeSource_h

#include "WaftProperty.h"
#include "vtkThinShapeSource.h"

#include <string>

namespace waft
{
struct Outline;
struct PlanForm;
struct SheetOptions;
struct SkinOptions;
} // namespace waft

class VTKWAFTSOURCES_EXPORT vtkPaintedShapeSource : public vtkThinShapeSource
{
public:
  vtkAbstractTypeMacro(vtkPaintedShapeSource, vtkThinShapeSource);

  WaftProperty(double, Width);
  WaftProperty(double, Bend);
  WaftProperty(int, Rows);
  WaftProperty(int, Columns);
  WaftText(TextureFile);
  WaftProperty(int, TextureSize);
  WaftVector(double, BaseColor, 3);
  WaftVector(double, EdgeColor, 3);
  WaftVector(double, VeinColor, 3);
  WaftProperty(double, Blotches);
  WaftProperty(int, Seed);

protected:
  vtkPaintedShapeSource() = default;
  ~vtkPaintedShapeSource() override = default;

  waft::Result MakeShape(waft::Shape& shape) override;
  /// The plan and the shape's name.
  virtual waft::Result MakeOutline(waft::Outline& outline, std::string& name) = 0;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::PlanForm;
  friend struct waft::SheetOptions;
  friend struct waft::SkinOptions;

private:
  vtkPaintedShapeSource(const vtkPaintedShapeSource&) = delete;
  void operator=(const vtkPaintedShapeSource&) = delete;
};

#endif
