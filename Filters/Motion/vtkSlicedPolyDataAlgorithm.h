// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSlicedPolyDataAlgorithm
 * @brief   a stage whose work may be done in slices, one an update
 *
 * With Slice an update returns after about so many seconds of work. While Complete is 0, outputs
 * show the motion so far and have the field data `Complete` (int, 0); GoOn makes the next update go
 * on. A change of properties or inputs discards what is held, which stops the stage as abort does.
 * Of several MPI processes each works all at once.
 */
#ifndef vtkSlicedPolyDataAlgorithm_h
#define vtkSlicedPolyDataAlgorithm_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

namespace waft
{
class KeptStage;
struct SliceOptions;
} // namespace waft

class VTKWAFTFILTERS_EXPORT vtkSlicedPolyDataAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkSlicedPolyDataAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Seconds of work after which an update shows the motion so far, to go on from there when it is
   * asked to; 0: all at once. The motion comes to the same bits. 0 to 1e+09. Does not modify the
   * stage: it holds from the next piece of work on. */
  void SetSlice(double seconds);
  vtkGetMacro(Slice, double);
  ///@}
  /** Sets a Slice as short as a window wants it, 0.2 s. */
  void WorkInSlices();
  /** The next update goes on with the work that is held; nothing where none is. */
  void GoOn();
  /** 1 when nothing is left to do: what the last update gave is the whole result, or it failed. 0
   * when it is not: the stage's own work is held, or an input is not complete. */
  int GetComplete();
  /** Of the work that is held: 0 to 1. */
  double GetWorkDone();

protected:
  vtkSlicedPolyDataAlgorithm();
  ~vtkSlicedPolyDataAlgorithm() override;

  virtual waft::KeptStage& Kept() = 0;

  friend struct waft::SliceOptions;
  double Slice = 0.0;

private:
  vtkSlicedPolyDataAlgorithm(const vtkSlicedPolyDataAlgorithm&) = delete;
  void operator=(const vtkSlicedPolyDataAlgorithm&) = delete;
};

#endif
