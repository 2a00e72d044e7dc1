// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkKeptPolyDataAlgorithm
 * @brief   a stage that computes once, and may be given what it would come to
 */
#ifndef vtkKeptPolyDataAlgorithm_h
#define vtkKeptPolyDataAlgorithm_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

namespace waft
{
class KeptStage;
}

class VTKWAFTFILTERS_EXPORT vtkKeptPolyDataAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkKeptPolyDataAlgorithm, vtkPolyDataAlgorithm);

protected:
  vtkKeptPolyDataAlgorithm() = default;
  ~vtkKeptPolyDataAlgorithm() override;

  virtual waft::KeptStage& Kept() = 0;

private:
  friend class vtkMotionAnimationSource; // which hands its motion over
  vtkKeptPolyDataAlgorithm(const vtkKeptPolyDataAlgorithm&) = delete;
  void operator=(const vtkKeptPolyDataAlgorithm&) = delete;
};

#endif
