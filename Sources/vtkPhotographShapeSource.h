// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPhotographShapeSource
 * @brief   one thin body from a photograph: outlined, triangulated, textured by it, curved
 *
 * The outline is that of the largest thing which the picture's alpha shows; a picture without
 * transparency is cut from the commonest colour of its border. Shi et al. 2005, section 7.
 *
 * Output port 0, Shapes (vtkMultiBlockDataSet): see vtkThinShapeSource; the block is named by the
 * file. The shape's `Texture` is the photograph.
 */
#ifndef vtkPhotographShapeSource_h
#define vtkPhotographShapeSource_h

#include "vtkThinShapeSource.h"

namespace waft
{
struct PhotographFile;
struct PhotographOptions;
}

class VTKWAFTSOURCES_EXPORT vtkPhotographShapeSource : public vtkThinShapeSource
{
public:
  static vtkPhotographShapeSource* New();
  vtkTypeMacro(vtkPhotographShapeSource, vtkThinShapeSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The photograph, a picture file. */
  vtkSetMacro(Photograph, std::string);
  vtkGetMacro(Photograph, std::string);
  ///@}
  ///@{
  /** Alpha above which a pixel belongs to the body, 0.01..0.99. */
  vtkSetClampMacro(Threshold, double, 0.01, 0.99);
  vtkGetMacro(Threshold, double);
  ///@}
  ///@{
  /** How far the outline may be off, in lengths, 0.0005..0.1. */
  vtkSetClampMacro(Detail, double, 0.0005, 0.1);
  vtkGetMacro(Detail, double);
  ///@}
  ///@{
  /** About as many triangles, 20..20000; a fine outline takes more. */
  vtkSetClampMacro(NumberOfTriangles, int, 20, 20000);
  vtkGetMacro(NumberOfTriangles, int);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkPhotographShapeSource() = default;
  ~vtkPhotographShapeSource() override = default;

  waft::Result MakeShape(waft::Shape& shape) override;

private:
  vtkPhotographShapeSource(const vtkPhotographShapeSource&) = delete;
  void operator=(const vtkPhotographShapeSource&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::PhotographFile;
  friend struct waft::PhotographOptions;
  std::string Photograph;
  double Threshold = 0.5;
  double Detail = 0.006;
  int NumberOfTriangles = 500;
};

#endif
