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

#include "WaftProperty.h"
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

  WaftText(Photograph);
  WaftProperty(double, Threshold);
  WaftProperty(double, Detail);
  WaftProperty(int, NumberOfTriangles);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkPhotographShapeSource();
  ~vtkPhotographShapeSource() override = default;

  waft::Result MakeShape(waft::Shape& shape) override;

private:
  vtkPhotographShapeSource(const vtkPhotographShapeSource&) = delete;
  void operator=(const vtkPhotographShapeSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::PhotographFile;
  friend struct waft::PhotographOptions;
};

#endif
