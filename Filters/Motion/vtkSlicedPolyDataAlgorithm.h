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

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <string>

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
  /** Works as a window wants it: a Slice of 0.2 s, and on from there beside the updates. */
  void WorkInSlices();
  /** The next update goes on with the work that has not ended, and where it goes on beside shows
   * what it has come to; nothing where none is. */
  void GoOn();
  /** Work that goes on beside waits, from its next tick on, until an update after GoOn, which then
   * shows it without waiting and lets it go. */
  void Hold();
  /** Discards the work that has not ended, and the motion that there is: of a stage that nobody
   * sees any more, which a window may keep for a while. The next update begins anew. */
  void LetGo();
  /** 1 when nothing is left to do: what the last update gave is the whole result, or it failed. 0
   * when it is not: the stage's own work has not ended, or an input is not complete. */
  int GetComplete();
  enum WorkStates
  {
    NO_WORK,
    HELD,
    BESIDE, // it goes on by itself, after Hold to its next tick
    ARRIVED // it went on by itself to its end, which the next update after GoOn shows
  };
  ///@{
  /** Of the work that has not been shown whole: one of WorkStates; 0 to 1 of it; what it does, or
   * why it failed; seconds that it will take from here on by those that it took, below 0 while that
   * is not known. */
  int GetWorkState();
  double GetWorkDone();
  std::string GetWorkText();
  double GetSecondsLeft();
  ///@}

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
