// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/StageFailure.h"

#include <vtkAlgorithm.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationKeyLookup.h>
#include <vtkInformationStringKey.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "Base/MessageText.h"
#include "Bridge/Data/Arrays.h"

using Sddp = vtkStreamingDemandDrivenPipeline;

namespace waft
{
namespace
{

constexpr const char* FailureMark = "Failure"; // field data of outputs

// Looked up by name: every module that this library is part of would have a key of its own.
template <typename Key>
Key* KeyOf(const char* name)
{
  vtkInformationKey* known = vtkInformationKeyLookup::Find(name, "waft");
  return known ? static_cast<Key*>(known) : Key::MakeKey(name, "waft");
}

// Of a stage: the sentence that it failed with, and what it said last.
vtkInformationStringKey* FailureKey()
{
  return KeyOf<vtkInformationStringKey>("FAILURE");
}

vtkInformationStringKey* SaidKey()
{
  return KeyOf<vtkInformationStringKey>("SAID");
}

// Of an output.
vtkInformationIntegerKey* NoInformationKey()
{
  return KeyOf<vtkInformationIntegerKey>("NO_INFORMATION");
}

std::string MarkOf(vtkDataObject* data)
{
  if (data == nullptr)
  {
    return {};
  }
  std::string sentence = FirstString(data->GetFieldData(), FailureMark);
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  if (!sentence.empty() || blocks == nullptr)
  {
    return sentence;
  }
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(blocks->NewIterator());
  for (leaf->InitTraversal(); sentence.empty() && !leaf->IsDoneWithTraversal();
       leaf->GoToNextItem())
  {
    sentence = FirstString(leaf->GetCurrentDataObject()->GetFieldData(), FailureMark);
  }
  return sentence;
}

void GiveUp(vtkAlgorithm* stage, vtkInformationVector* outputs, const std::string& sentence)
{
  Empty(outputs);
  for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
  {
    if (vtkDataObject* data = vtkDataObject::GetData(outputs->GetInformationObject(out)))
    {
      AddStrings(data->GetFieldData(), FailureMark, { sentence });
    }
  }
  stage->GetInformation()->Set(FailureKey(), sentence);
  stage->SetProgressText(sentence.c_str());
}

// The sentence, and the state of the stage and all before it.
std::string SaidNow(vtkAlgorithm* stage, const std::string& sentence)
{
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(stage->GetExecutive());
  return std::to_string(pipeline != nullptr ? pipeline->GetPipelineMTime() : stage->GetMTime()) +
         ": " + sentence;
}

} // namespace

int Empty(vtkInformationVector* outputs)
{
  for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
  {
    if (vtkDataObject* data = vtkDataObject::GetData(outputs->GetInformationObject(out)))
    {
      data->Initialize();
    }
  }
  return 1;
}

int Fail(vtkAlgorithm* stage, vtkInformationVector* outputs, const std::string& message)
{
  const std::string sentence = MessageText(message);
  GiveUp(stage, outputs, sentence);
  const std::string said = SaidNow(stage, sentence);
  const char* before = stage->GetInformation()->Get(SaidKey());
  if (before == nullptr || said != before)
  {
    stage->GetInformation()->Set(SaidKey(), said);
    vtkErrorWithObjectMacro(stage, << sentence);
  }
  return 1;
}

void RemoveTimes(vtkInformationVector* outputs)
{
  for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
  {
    outputs->GetInformationObject(out)->Remove(Sddp::TIME_STEPS());
    outputs->GetInformationObject(out)->Remove(Sddp::TIME_RANGE());
  }
}

int FailInformation(vtkInformationVector* outputs)
{
  const int nothing[6] = { 0, -1, 0, -1, 0, -1 };
  RemoveTimes(outputs);
  for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
  {
    vtkInformation* output = outputs->GetInformationObject(out);
    output->Set(NoInformationKey(), 1);
    vtkDataObject* data = vtkDataObject::GetData(output);
    if (data != nullptr && data->GetExtentType() == VTK_3D_EXTENT)
    {
      output->Set(Sddp::WHOLE_EXTENT(), nothing, 6);
    }
  }
  return 1;
}

bool HasNoInformation(vtkInformation* output)
{
  return output->Get(NoInformationKey()) != 0;
}

bool HasFailedInput(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector* outputs)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  if (ranks != nullptr && ranks->GetNumberOfProcesses() > 1)
  {
    return false;
  }
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < stage->GetNumberOfInputConnections(port); ++i)
    {
      const std::string sentence = MarkOf(stage->GetInputDataObject(port, i));
      if (!sentence.empty())
      {
        request->Remove(Sddp::CONTINUE_EXECUTING());
        GiveUp(stage, outputs, sentence);
        return true;
      }
    }
  }
  return false;
}

void ForgetFailure(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
    {
      outputs->GetInformationObject(out)->Remove(NoInformationKey());
    }
  }
  else if (HasFailed(stage))
  {
    stage->GetInformation()->Remove(FailureKey());
    stage->SetProgressText("done");
  }
}

bool HasFailed(vtkAlgorithm* stage)
{
  return stage->GetInformation()->Has(FailureKey()) != 0;
}

} // namespace waft
