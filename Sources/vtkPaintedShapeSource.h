// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPaintedShapeSource
 * @brief   what the sources of leaves and feathers share: a painted skin
 *
 * The skin is painted from the same outline as the mesh, with alpha, and goes with the shape (field
 * data `Skin`, the bytes of a PNG file). With SaveSkinAs it is written to that file, which the
 * shape then names as its `Texture`; a file that was not saved so, or was changed since, is left
 * alone.
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
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(double, Width);
  WaftProperty(double, Bend);
  WaftProperty(int, Rows);
  WaftProperty(int, Columns);
  WaftText(SaveSkinAs);
  /** What SaveSkinAs was called before; it does the same where that is empty. */
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
