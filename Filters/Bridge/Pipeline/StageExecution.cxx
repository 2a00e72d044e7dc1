// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/StageExecution.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortKey.h>
#include <vtkInformationExecutivePortVectorKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationKeyLookup.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkVersionMacros.h>

#include "Bridge/Data/SceneData.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <unistd.h>

using Sddp = vtkStreamingDemandDrivenPipeline;

namespace waft
{
namespace
{

const pid_t LoadedBy = getpid(); // a fork of it has none of the threads that VTK 9.3 keeps

vtkExecutive* ProducerOf(vtkInformation* input)
{
  vtkExecutive* producer = nullptr;
  int port = 0;
  vtkExecutive::PRODUCER()->Get(input, producer, port);
  return producer;
}

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

// Looked up by name: every module that this library is part of would have a key of its own.
vtkInformationIntegerKey* StandsStillKey()
{
  vtkInformationKey* known = vtkInformationKeyLookup::Find("STANDS_STILL", "waft");
  return known ? static_cast<vtkInformationIntegerKey*>(known)
               : vtkInformationIntegerKey::MakeKey("STANDS_STILL", "waft");
}

// What the stage itself says of the output that comes in.
vtkInformation* ToldOf(vtkInformation* input)
{
  vtkExecutive* producer = ProducerOf(input);
  if (producer != nullptr && producer->GetAlgorithm()->IsA("vtkPVPostFilter"))
  {
    // ParaView puts it behind each output of a proxy; it hands data through, but no key of ours.
    return producer->GetInputInformation(0)->GetInformationObject(0);
  }
  return input;
}

bool StandsStill(vtkInformation* input)
{
  vtkInformation* told = ToldOf(input);
  return told != nullptr && told->Get(StandsStillKey()) != 0;
}

bool HasInputWithoutInformation(vtkAlgorithm* stage)
{
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < stage->GetNumberOfInputConnections(port); ++i)
    {
      vtkInformation* told = ToldOf(stage->GetInputInformation(port, i));
      if (told != nullptr && HasNoInformation(told))
      {
        return true;
      }
    }
  }
  return false;
}

bool HasDataTime(vtkInformation* input)
{
  vtkDataObject* data = vtkDataObject::GetData(input);
  return data && data->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP());
}

// A producer and all that is upstream of it.
void AddUpstream(vtkExecutive* producer, std::set<vtkExecutive*>& upstream)
{
  if (producer == nullptr || !upstream.insert(producer).second)
  {
    return;
  }
  for (int port = 0; port < producer->GetNumberOfInputPorts(); ++port)
  {
    vtkInformationVector* inputs = producer->GetInputInformation(port);
    for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
    {
      AddUpstream(ProducerOf(inputs->GetInformationObject(i)), upstream);
    }
  }
}

std::set<vtkExecutive*> UpstreamOf(vtkAlgorithm* stage, vtkInformationVector** inputs)
{
  std::set<vtkExecutive*> upstream;
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      AddUpstream(ProducerOf(inputs[port]->GetInformationObject(i)), upstream);
    }
  }
  return upstream;
}

// Whether a consumer of any output of a producer is one of those that count.
template <typename Test>
bool AnyConsumer(vtkExecutive* producer, const Test& counts)
{
  vtkInformationVector* outputs = producer->GetOutputInformation();
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    vtkExecutive** consumers = vtkExecutive::CONSUMERS()->GetExecutives(output);
    const int count = vtkExecutive::CONSUMERS()->Length(output);
    if (std::any_of(consumers, consumers + count, counts))
    {
      return true;
    }
  }
  return false;
}

// Whether nobody else takes an output of the source of this input.
bool IsOnlyConsumer(vtkAlgorithm* stage, vtkInformation* input)
{
  vtkExecutive* producer = ProducerOf(input);
  return producer != nullptr && !AnyConsumer(producer, [stage](vtkExecutive* other)
                                             { return other != stage->GetExecutive(); });
}

// Whether what is upstream of a stage serves others as well, which are not upstream of it.
bool HasCommonUpstream(vtkAlgorithm* stage, vtkInformationVector** inputs)
{
  const std::set<vtkExecutive*> upstream = UpstreamOf(stage, inputs);
  const auto isOther = [&](vtkExecutive* consumer)
  { return consumer != stage->GetExecutive() && upstream.count(consumer) == 0; };
  return std::any_of(upstream.begin(), upstream.end(),
                     [&](vtkExecutive* producer) { return AnyConsumer(producer, isOther); });
}

// The output port that a pass serves.
int AskingPort(vtkInformation* request)
{
  return request->Has(vtkExecutive::FROM_OUTPUT_PORT())
           ? std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT()))
           : 0;
}

// The time line that the data of an input carry, if any; a database or shapes have one of their
// own.
bool TimelineOf(vtkInformation* input, Timeline& line)
{
  vtkDataObject* data = vtkDataObject::GetData(input);
  if (!data || data->IsA("vtkMultiBlockDataSet") ||
      !data->GetFieldData()->HasArray("NumberOfFrames"))
  {
    return false;
  }
  SceneInfo info;
  if (!SceneInfoFromFieldData(data, info))
  {
    return false;
  }
  line = info.Time;
  return true;
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

ParallelFor SmpFor()
{
  if (std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 &&
      !std::getenv("VTK_SMP_BACKEND_IN_USE") && getpid() == LoadedBy)
  {
    vtkSMPTools::SetBackend("STDThread");
  }
  ParallelFor loop =
    [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
  {
    vtkSMPTools::For(0, static_cast<vtkIdType>(count),
                     [&](vtkIdType begin, vtkIdType end)
                     { body(static_cast<std::size_t>(begin), static_cast<std::size_t>(end)); });
  };
  if (std::strcmp(vtkSMPTools::GetBackend(), "STDThread") == 0)
  {
    loop = ThreadedFor(vtkSMPTools::GetEstimatedNumberOfThreads()); // VTK's begin with each loop
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

void TimeSweep::RequestSteps(vtkAlgorithm* stage, vtkInformation* request,
                             vtkInformationVector** inputs, vtkInformationVector* outputs,
                             bool isCurrent)
{
  if (HasFailed(stage)) // in the middle of an earlier sweep, perhaps
  {
    this->Step = 0;
  }
  if (this->Step == 0)
  {
    this->NumberOfSteps = 1;
    for (const int port : this->Ports)
    {
      for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
      {
        vtkInformation* input = inputs[port]->GetInformationObject(i);
        const int steps = StandsStill(input) ? 1 : input->Length(Sddp::TIME_STEPS());
        this->NumberOfSteps = std::max(this->NumberOfSteps, static_cast<std::size_t>(steps));
      }
    }
  }
  const bool isPulling = !isCurrent && this->NumberOfSteps > 1 && this->HasNewStep();
  vtkInformation* output = outputs->GetInformationObject(AskingPort(request));
  const bool mayMislead = isPulling && HasCommonUpstream(stage, inputs);
  this->MustReturn = false;
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      const int steps = input->Length(Sddp::TIME_STEPS());
      if (steps == 0)
      {
        continue;
      }
      const double* times = input->Get(Sddp::TIME_STEPS());
      const double asked = steps > 1 && output->Has(Sddp::UPDATE_TIME_STEP())
                             ? output->Get(Sddp::UPDATE_TIME_STEP())
                             : times[0];
      const bool rests = isCurrent && HasDataTime(input) && IsOnlyConsumer(stage, input);
      const double due = isPulling ? times[std::min(static_cast<int>(this->Step), steps - 1)]
                         : rests   ? DataTime(input)
                                   : asked;
      this->MustReturn = this->MustReturn || (mayMislead && due != asked);
      input->Set(Sddp::UPDATE_TIME_STEP(), due);
    }
  }
}

double TimeSweep::DataTime(vtkInformation* input)
{
  return HasDataTime(input)
           ? vtkDataObject::GetData(input)->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP())
           : 0.0;
}

double TimeSweep::Fraction() const
{
  return static_cast<double>(this->Step) / static_cast<double>(this->NumberOfSteps);
}

bool TimeSweep::Continue(vtkInformation* request)
{
  if (this->Step + 1 < this->NumberOfSteps || (this->HasNewStep() && this->MustReturn))
  {
    ++this->Step;
    request->Set(Sddp::CONTINUE_EXECUTING(), 1);
    return true;
  }
  this->Reset(request);
  return false;
}

bool TimeSweep::Leave(vtkInformation* request)
{
  this->Step = std::max(this->Step, this->NumberOfSteps - 1);
  return this->Continue(request);
}

void TimeSweep::Reset(vtkInformation* request)
{
  this->Step = 0;
  request->Remove(Sddp::CONTINUE_EXECUTING());
}

void PassTimeSteps(vtkAlgorithm* stage, vtkInformationVector** inputs,
                   vtkInformationVector* outputs)
{
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      Timeline line;
      if (!input->Has(Sddp::TIME_STEPS()))
      {
        if (TimelineOf(input, line))
        {
          SetTimeSteps(line, outputs);
          return;
        }
        continue;
      }
      for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
      {
        outputs->GetInformationObject(out)->CopyEntry(input, Sddp::TIME_STEPS());
        outputs->GetInformationObject(out)->CopyEntry(input, Sddp::TIME_RANGE());
      }
      return;
    }
  }
  RemoveTimes(outputs);
}

void SetTimeSteps(const Timeline& line, vtkInformationVector* outputs)
{
  std::vector<double> times;
  for (int frame = 0; frame < line.NumberOfFrames; ++frame)
  {
    times.push_back(line.Time(frame));
  }
  const double range[2] = { times.front(), times.back() };
  for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
  {
    vtkInformation* output = outputs->GetInformationObject(out);
    output->Set(Sddp::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(Sddp::TIME_RANGE(), range, 2);
  }
}

void SetStandsStill(vtkInformation* output, bool standsStill)
{
  output->Set(StandsStillKey(), standsStill);
}

double RequestedTime(vtkInformationVector* outputs, int port, const Timeline& line)
{
  vtkInformation* output = outputs->GetInformationObject(port);
  const double asked =
    output->Has(Sddp::UPDATE_TIME_STEP()) ? output->Get(Sddp::UPDATE_TIME_STEP()) : 0.0;
  const double time = std::clamp(asked, 0.0, line.Time(line.NumberOfFrames - 1));
  if (vtkDataObject* data = vtkDataObject::GetData(output))
  {
    data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  return time;
}

double RequestedTimeOfAll(vtkInformation* request, vtkInformationVector* outputs,
                          const Timeline& line)
{
  const double time = RequestedTime(outputs, AskingPort(request), line);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (vtkDataObject* data = vtkDataObject::GetData(outputs->GetInformationObject(port)))
    {
      data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    }
  }
  return time;
}

int RequestedFrame(vtkInformationVector* outputs, int port, const Timeline& line)
{
  return static_cast<int>(std::lround(RequestedTime(outputs, port, line) * line.FramesPerSecond));
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
