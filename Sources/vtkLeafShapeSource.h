// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLeafShapeSource
 * @brief   one leaf: outline, stem, curl, camber and a painted skin by parameters
 *
 * Output port 0, Shapes (vtkMultiBlockDataSet): see vtkThinShapeSource; the block is named by the
 * kind (leaf, maple, oak, willow, birch, aspen).
 */
#ifndef vtkLeafShapeSource_h
#define vtkLeafShapeSource_h

#include "WaftProperty.h"
#include "vtkPaintedShapeSource.h"

namespace waft
{
struct LeafForm;
}

class VTKWAFTSOURCES_EXPORT vtkLeafShapeSource : public vtkPaintedShapeSource
{
public:
  static vtkLeafShapeSource* New();
  vtkTypeMacro(vtkLeafShapeSource, vtkPaintedShapeSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, Kind);
  WaftProperty(double, StemLength);
  WaftProperty(double, Lobing);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkLeafShapeSource();
  ~vtkLeafShapeSource() override = default;

  waft::Result MakeOutline(waft::Outline& outline, std::string& name) override;

private:
  vtkLeafShapeSource(const vtkLeafShapeSource&) = delete;
  void operator=(const vtkLeafShapeSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::LeafForm;
};

#endif
