// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/StageExecution.h"

#include "Base/SharedWork.h"
#include "Bridge/Pipeline/Upstream.h"

#include <vtkAlgorithm.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkVersionMacros.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <new>
#include <stdexcept>
#include <unistd.h>

using Sddp = vtkStreamingDemandDrivenPipeline;

namespace waft
{
namespace
{

const pid_t LoadedBy = getpid(); // a fork of it has none of the threads that VTK 9.3 keeps
// Each library of the plugin has this file's variables; a process has one environment.
constexpr const char* ProcessesVariable = "WAFT_PROCESSES_HERE";

std::vector<vtkMTimeType> CurrentSignature(vtkAlgorithm* stage, vtkInformationVector** inputs)
{
  std::vector<vtkMTimeType> signature{ stage->GetMTime() };
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    const std::vector<vtkMTimeType> own = InputSignature(inputs[port]);
    signature.push_back(static_cast<vtkMTimeType>(own.size()));
    signature.insert(signature.end(), own.begin(), own.end());
  }
  return signature;
}

bool HasInputWithoutInformation(vtkAlgorithm* stage)
{
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < stage->GetNumberOfInputConnections(port); ++i)
    {
      vtkInformation* produced = ProducedInformation(stage->GetInputInformation(port, i));
      if (produced != nullptr && HasNoInformation(produced))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

StageMonitor::~StageMonitor()
{
  if (!this->IsHeld)
  {
    this->Stage->SetProgressText(this->IsStopped ? "stopped" : "done");
  }
}

bool StageMonitor::Tick(double fraction, const std::string& text)
{
  this->Stage->SetProgressText(text.c_str());
  this->Stage->UpdateProgress(std::clamp(fraction, 0.0, 1.0));
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
  this->IsStopped = this->IsStopped || this->Stage->CheckAbort() || this->Stage->GetAbortExecute();
  // CheckAbort marks the outputs, and the executive would empty what the stage gives: its best so
  // far. The wish to stop is taken back at once, since taking it back later would modify the stage
  // and make it run again.
  this->Stage->SetAbortOutput(false);
#else
  this->IsStopped = this->IsStopped || this->Stage->GetAbortExecute();
#endif
  this->Stage->SetAbortExecute(0);
  return !this->IsStopped;
}

void SetProcessesHere(int count)
{
  setenv(ProcessesVariable, std::to_string(std::max(1, count)).c_str(), 1);
}

int ProcessesHere()
{
  const char* given = std::getenv(ProcessesVariable);
  return given == nullptr ? 1 : std::max(1, std::atoi(given));
}

void ChooseThreads()
{
  if (std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 &&
      !std::getenv("VTK_SMP_BACKEND_IN_USE") && getpid() == LoadedBy)
  {
    vtkSMPTools::SetBackend("STDThread");
  }
}

ParallelFor SmpFor()
{
  ChooseThreads();
  ParallelFor loop =
    [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
  {
    vtkSMPTools::For(0, static_cast<vtkIdType>(count),
                     [&](vtkIdType begin, vtkIdType end)
                     { body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
  };
  const bool isThreaded = std::strcmp(vtkSMPTools::GetBackend(), "STDThread") == 0;
  const int processes = ProcessesHere();
  if (isThreaded || processes > 1)
  {
    // VTK's begin with each loop.
    const int own = isThreaded ? vtkSMPTools::GetEstimatedNumberOfThreads() : 1;
    loop = ThreadedFor([own, processes] { return OthersWork() ? own : own * processes; });
  }
  return [loop](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
  {
    // An exception that left a thread would end the process.
    std::mutex mutex;
    std::exception_ptr first;
    loop(count,
         [&](std::size_t begin, std::size_t end)
         {
           try
           {
             body(begin, end);
           }
           catch (...)
           {
             const std::lock_guard<std::mutex> lock(mutex);
             first = first ? first : std::current_exception();
           }
         });
    if (first)
    {
      std::rethrow_exception(first);
    }
  };
}

std::vector<vtkMTimeType> InputSignature(vtkInformationVector* input)
{
  std::vector<vtkMTimeType> signature;
  for (int i = 0; i < input->GetNumberOfInformationObjects(); ++i)
  {
    auto* pipeline =
      vtkDemandDrivenPipeline::SafeDownCast(ProducerOf(input->GetInformationObject(i)));
    signature.push_back(pipeline ? pipeline->GetPipelineMTime() : 0);
  }
  return signature;
}

bool StageCache::IsCurrent(vtkAlgorithm* stage, vtkInformationVector** inputs) const
{
  return !this->Signature.empty() && this->Signature == CurrentSignature(stage, inputs);
}

void StageCache::Reawaken(vtkAlgorithm* stage)
{
  const bool isOwn = !this->Signature.empty() && this->Signature.front() == stage->GetMTime();
  stage->Modified();
  if (isOwn)
  {
    this->Signature.front() = stage->GetMTime();
  }
}

void StageCache::MarkCurrent(vtkAlgorithm* stage, vtkInformationVector** inputs)
{
  this->Signature = CurrentSignature(stage, inputs);
}

int GuardedRequest(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector* outputs,
                   const std::vector<PropertyRange>& properties,
                   const std::function<int()>& process)
{
  const bool isInformation = request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION());
  const bool isData = request->Has(vtkDemandDrivenPipeline::REQUEST_DATA());
  std::string lack;
  try
  {
    if (isData && HasFailedInput(stage, request, outputs))
    {
      return 1;
    }
    if (isInformation || isData)
    {
      const Result checked = CheckProperties(properties);
      if (isInformation && (!checked || HasInputWithoutInformation(stage)))
      {
        return FailInformation(outputs);
      }
      if (!checked)
      {
        return Fail(stage, outputs, checked.Message());
      }
      ForgetFailure(stage, request, outputs);
    }
    return process();
  }
  catch (const std::bad_alloc&)
  {
    lack = "expected an input that fits into memory, found too little memory for it";
  }
  catch (const std::length_error&) // of a container, beyond any memory
  {
    lack = "expected an input that fits into memory, found one beyond any";
  }
  catch (const std::exception& error)
  {
    lack = error.what();
  }
  request->Remove(Sddp::CONTINUE_EXECUTING());
  return Fail(stage, outputs, lack);
}

bool IsPieceOfOthers(vtkInformation* request, vtkInformationVector* outputs)
{
  return outputs->GetInformationObject(AskingPort(request))->Get(Sddp::UPDATE_PIECE_NUMBER()) > 0;
}

} // namespace waft
