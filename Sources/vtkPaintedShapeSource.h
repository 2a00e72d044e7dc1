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

  ///@{
  /** The plan's width, 1 by nature, 0.3..3. */
  vtkSetClampMacro(Width, double, 0.3, 3.0);
  vtkGetMacro(Width, double);
  ///@}
  ///@{
  /** Bend of the middle line, 1 by nature, -5..5. */
  vtkSetClampMacro(Bend, double, -5.0, 5.0);
  vtkGetMacro(Bend, double);
  ///@}
  ///@{
  /** Rows of the mesh along its length, 4..200. */
  vtkSetClampMacro(Rows, int, 4, 200);
  vtkGetMacro(Rows, int);
  ///@}
  ///@{
  /** Columns of the mesh across, 2..64; odd numbers count as the next even one. */
  vtkSetClampMacro(Columns, int, 2, 64);
  vtkGetMacro(Columns, int);
  ///@}
  ///@{
  /** The PNG file that the painted skin is written to; empty: none. */
  vtkSetMacro(TextureFile, std::string);
  vtkGetMacro(TextureFile, std::string);
  ///@}
  ///@{
  /** Pixels of the skin along the length, 16..4096. */
  vtkSetClampMacro(TextureSize, int, 16, 4096);
  vtkGetMacro(TextureSize, int);
  ///@}
  ///@{
  /** Colour near the middle, red, green, blue in 0..1. */
  vtkSetVector3Macro(BaseColor, double);
  vtkGetVector3Macro(BaseColor, double);
  ///@}
  ///@{
  /** Colour of edges, blotches and bands. */
  vtkSetVector3Macro(EdgeColor, double);
  vtkGetVector3Macro(EdgeColor, double);
  ///@}
  ///@{
  /** Colour of veins, stem or shaft. */
  vtkSetVector3Macro(VeinColor, double);
  vtkGetVector3Macro(VeinColor, double);
  ///@}
  ///@{
  /** How much of the edge's colour comes in blotches or bands, 0..1. */
  vtkSetClampMacro(Blotches, double, 0.0, 1.0);
  vtkGetMacro(Blotches, double);
  ///@}
  ///@{
  /** Seed of the skin's grain, 0 or more. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

protected:
  vtkPaintedShapeSource() = default;
  ~vtkPaintedShapeSource() override = default;

  waft::Result MakeShape(waft::Shape& shape) override;
  /// The plan and the shape's name.
  virtual waft::Result MakeOutline(waft::Outline& outline, std::string& name) = 0;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::PlanForm;
  friend struct waft::SheetOptions;
  friend struct waft::SkinOptions;
  double Width = 1.0;
  double Bend = 1.0;
  int Rows = 28;
  int Columns = 8;
  std::string TextureFile;
  int TextureSize = 512;
  double BaseColor[3] = { 0.36, 0.52, 0.14 };
  double EdgeColor[3] = { 0.66, 0.62, 0.16 };
  double VeinColor[3] = { 0.74, 0.78, 0.44 };
  double Blotches = 0.35;
  int Seed = 1;

private:
  vtkPaintedShapeSource(const vtkPaintedShapeSource&) = delete;
  void operator=(const vtkPaintedShapeSource&) = delete;
};

#endif
