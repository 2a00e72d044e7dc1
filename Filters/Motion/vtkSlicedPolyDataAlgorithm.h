// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSlicedPolyDataAlgorithm
 * @brief   a stage whose work may be done in slices, one an update
 *
 * With Slice an update returns after about so many seconds of work. While Complete is 0, outputs
 * show the motion so far and have the field data `Complete` (int, 0); GoOn makes the next update go
 * on. After WorkInSlices the work goes on beside as well, on a thread of its own, from one update
 * to the next: that which GoOn asked for shows what there is by then. A change of properties or
 * inputs discards, at the next update, what there is so far, which stops the stage as abort does.
 * Of several MPI processes each works all at once.
 */
#ifndef vtkSlicedPolyDataAlgorithm_h
#define vtkSlicedPolyDataAlgorithm_h

#include "WaftProperty.h"
#include "vtkKeptPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <string>

namespace waft
{
struct SliceOptions;
}

class VTKWAFTFILTERS_EXPORT vtkSlicedPolyDataAlgorithm : public vtkKeptPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkSlicedPolyDataAlgorithm, vtkKeptPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftSlices;

protected:
  vtkSlicedPolyDataAlgorithm();
  ~vtkSlicedPolyDataAlgorithm() override;

private:
  friend struct waft::SliceOptions;
  vtkSlicedPolyDataAlgorithm(const vtkSlicedPolyDataAlgorithm&) = delete;
  void operator=(const vtkSlicedPolyDataAlgorithm&) = delete;
};

#endif
