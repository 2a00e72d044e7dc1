// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkChainStageAlgorithm
 * @brief   a stage of the chain that takes objects to their marks
 *
 * Its ports are those that the chain's table has.
 */
#ifndef vtkChainStageAlgorithm_h
#define vtkChainStageAlgorithm_h

#include "vtkSlicedPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"
#include "vtkWaftFiltersModule.h"

#include <vector>

namespace waft
{
enum class ChainStage;
struct PropertyRange;
} // namespace waft

class vtkMultiProcessController;

class VTKWAFTFILTERS_EXPORT vtkChainStageAlgorithm : public vtkSlicedPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkChainStageAlgorithm, vtkSlicedPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Whether the stage runs. One that rests takes none of its inputs and gives empty outputs. */
  vtkSetMacro(Active, bool);
  vtkGetMacro(Active, bool);
  vtkBooleanMacro(Active, bool);
  ///@}

  ///@{
  /**
   * Processes of which this one is the first and has the work of; the others are in
   * vtkSharedWork::Serve. No byte of what comes out hangs on it. None by default: this one alone.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  explicit vtkChainStageAlgorithm(waft::ChainStage stage);
  ~vtkChainStageAlgorithm() override;

  /** Those of its properties. */
  virtual std::vector<waft::PropertyRange> Ranges() const = 0;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

  bool Active = true;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  vtkChainStageAlgorithm(const vtkChainStageAlgorithm&) = delete;
  void operator=(const vtkChainStageAlgorithm&) = delete;

  const waft::ChainStage Stage;
};

#endif
