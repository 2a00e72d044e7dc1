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

  ///@{
  /** 0 Flight (a wing's), 1 Contour (a body's, downy at its base), 2 Down. */
  vtkSetClampMacro(Kind, int, 0, 2);
  vtkGetMacro(Kind, int);
  ///@}
  ///@{
  /** Length of the bare shaft, 1 by nature, 0 (none)..3. */
  vtkSetClampMacro(ShaftLength, double, 0.0, 3.0);
  vtkGetMacro(ShaftLength, double);
  ///@}
  ///@{
  /** How unlike the two vanes are, 1 by nature, -2..2. */
  vtkSetClampMacro(Asymmetry, double, -2.0, 2.0);
  vtkGetMacro(Asymmetry, double);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkFeatherShapeSource();
  ~vtkFeatherShapeSource() override = default;

  waft::Result MakeOutline(waft::Outline& outline, std::string& name) override;

private:
  vtkFeatherShapeSource(const vtkFeatherShapeSource&) = delete;
  void operator=(const vtkFeatherShapeSource&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::FeatherForm;
  int Kind = 0;
  double ShaftLength = 1.0;
  double Asymmetry = 1.0;
};

#endif
