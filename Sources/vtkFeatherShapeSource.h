// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFeatherShapeSource
 * @brief   one feather: vanes, shaft, curl, camber and a painted skin by parameters
 *
 * Output port 0, Shapes (vtkMultiBlockDataSet): see vtkThinShapeSource; the block is named by the
 * kind (feather, contour, down).
 */
#ifndef vtkFeatherShapeSource_h
#define vtkFeatherShapeSource_h

#include "WaftProperty.h"
#include "vtkPaintedShapeSource.h"

namespace waft
{
struct FeatherForm;
}

class VTKWAFTSOURCES_EXPORT vtkFeatherShapeSource : public vtkPaintedShapeSource
{
public:
  static vtkFeatherShapeSource* New();
  vtkTypeMacro(vtkFeatherShapeSource, vtkPaintedShapeSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, Kind);
  WaftProperty(double, ShaftLength);
  WaftProperty(double, Asymmetry);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkFeatherShapeSource();
  ~vtkFeatherShapeSource() override = default;

  waft::Result MakeOutline(waft::Outline& outline, std::string& name) override;

private:
  vtkFeatherShapeSource(const vtkFeatherShapeSource&) = delete;
  void operator=(const vtkFeatherShapeSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::FeatherForm;
};

#endif
