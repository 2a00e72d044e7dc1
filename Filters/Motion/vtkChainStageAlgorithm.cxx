// SPDX-License-Identifier: BSD-3-Clause
#include "vtkChainStageAlgorithm.h"

#include "Base/SliceOptions.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"

#include <vtkMultiProcessController.h>

vtkChainStageAlgorithm::vtkChainStageAlgorithm(waft::ChainStage stage) : Stage(stage)
{
  this->SetNumberOfInputPorts(static_cast<int>(waft::InputsOf(stage).size()));
  this->SetNumberOfOutputPorts(static_cast<int>(waft::TraitsOf(stage).Outputs.size()));
}

vtkChainStageAlgorithm::~vtkChainStageAlgorithm() = default;

void vtkChainStageAlgorithm::SetController(vtkMultiProcessController* controller)
{
  this->Controller = controller;
}

vtkMultiProcessController* vtkChainStageAlgorithm::GetController()
{
  return this->Controller;
}

int vtkChainStageAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(waft::InputsOf(this->Stage), port, info);
}

int vtkChainStageAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  return waft::FillOutput(this->Stage, port, info);
}

vtkTypeBool vtkChainStageAlgorithm::ProcessRequest(vtkInformation* request,
                                                   vtkInformationVector** inputs,
                                                   vtkInformationVector* outputs)
{
  std::vector<waft::PropertyRange> ranges = this->Ranges();
  const std::vector<waft::PropertyRange> slices = waft::RangesOf<waft::SliceOptions>(*this);
  ranges.insert(ranges.end(), slices.begin(), slices.end());
  return waft::GuardedRequest(this, request, inputs, outputs, waft::InputsOf(this->Stage), ranges,
                              [&](vtkInformationVector** taken) {
                                return this->Superclass::ProcessRequest(request, taken, outputs);
                              });
}

int vtkChainStageAlgorithm::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkChainStageAlgorithm::RequestUpdateExtent(vtkInformation* request,
                                                vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  return this->Kept().RequestUpdateExtent(request, inputs, outputs);
}

int vtkChainStageAlgorithm::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                        vtkInformationVector* outputs)
{
  return this->Kept().RequestData(request, inputs, outputs);
}

void vtkChainStageAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Active: " << this->Active << "\n";
  os << indent << "Controller: " << this->Controller.Get() << "\n";
}
