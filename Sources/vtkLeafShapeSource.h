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

  ///@{
  /** 0 Ovate (toothed, as a beech's), 1 Maple, 2 Oak, 3 Willow, 4 Birch, 5 Aspen (nearly round). */
  vtkSetClampMacro(Kind, int, 0, 5);
  vtkGetMacro(Kind, int);
  ///@}
  ///@{
  /** Length of the stem, 1 by nature, 0 (none)..3. */
  vtkSetClampMacro(StemLength, double, 0.0, 3.0);
  vtkGetMacro(StemLength, double);
  ///@}
  ///@{
  /** Depth of lobes and teeth, 1 by nature, 0..1.5. */
  vtkSetClampMacro(Lobing, double, 0.0, 1.5);
  vtkGetMacro(Lobing, double);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkLeafShapeSource() = default;
  ~vtkLeafShapeSource() override = default;

  waft::Result MakeOutline(waft::Outline& outline, std::string& name) override;

private:
  vtkLeafShapeSource(const vtkLeafShapeSource&) = delete;
  void operator=(const vtkLeafShapeSource&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::LeafForm;
  int Kind = 0;
  double StemLength = 1.0;
  double Lobing = 1.0;
};

#endif
