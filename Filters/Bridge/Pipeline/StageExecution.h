// SPDX-License-Identifier: BSD-3-Clause
// How every stage runs in the pipeline: progress and abort, threads, a result that is kept and
// served frame by frame, inputs that are pulled over all their time steps.
//
// A stage holds a StageCache and, when an input varies in time, a TimeSweep, and does this:
//
//   RequestInformation   PassTimeSteps(inputs, outputs);
//   RequestUpdateExtent  sweep.RequestSteps(this, request, inputs, outputs,
//                                           cache.IsCurrent(this, inputs));
//   RequestData          if (!cache.IsCurrent(this, inputs))
//                        {
//                          if (sweep.HasNewStep()) take the data of this step;
//                          if (sweep.Continue(request)) return 1;
//                          validate; compute; keep the result;
//                          cache.MarkCurrent(this, inputs);
//                        }
//                        fill the outputs for RequestedTime(outputs, port);
//
// On a failure: return Fail(this, outputs, message), which reports and empties the outputs
// (StageFailure.h).
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Bridge/Pipeline/PropertyCheck.h"
#include "Bridge/Pipeline/StageFailure.h"
#include "Bridge/Pipeline/StageTimes.h"
#include "Bridge/Pipeline/TimeSweep.h"

#include <vtkType.h>

#include <functional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace waft
{

/// Passes progress to an algorithm and asks it for abort. In the end the text is "done", or
/// "stopped", unless the work is held.
class StageMonitor : public Monitor
{
public:
  explicit StageMonitor(vtkAlgorithm* stage) : Stage(stage) {}
  ~StageMonitor() override;
  StageMonitor(const StageMonitor&) = delete;
  StageMonitor& operator=(const StageMonitor&) = delete;
  bool Tick(double fraction, const std::string& text) override;
  void Hold() { this->IsHeld = true; }

private:
  bool IsHeld = false;
  vtkAlgorithm* Stage;
  bool IsStopped = false;
};

/// Debian's VTK runs one thread unless told otherwise: when nobody chose a backend (by
/// VTK_SMP_BACKEND_IN_USE or vtkSMPTools::SetBackend), STDThread is taken, but in a fork of the
/// process that loaded this. Call it on the thread on which stages are made, before one works on
/// another: a loop of VTK that is under way while the backend changes ends the process.
void ChooseThreads();
/// vtkSMPTools, as ChooseThreads has it; the first exception of a body reaches the caller. Where
/// processes of this machine work for this one it takes their threads while they sleep.
ParallelFor SmpFor();
/// How many processes of this machine are one run, whose first one this is: 1 unless it is told.
/// Each has as many threads as this one. What one library of the plugin sets holds for all.
void SetProcessesHere(int count);
int ProcessesHere();

/// Knows whether a kept result still belongs to the parameters of its stage and to what comes in:
/// the stage's own MTime and each input's pipeline MTime, never the MTime of the data, which
/// changes at every frame.
class StageCache
{
public:
  bool IsCurrent(vtkAlgorithm* stage, vtkInformationVector** inputs) const;
  void MarkCurrent(vtkAlgorithm* stage, vtkInformationVector** inputs);
  void Forget() { this->Signature.clear(); }
  /// The stage executes again when it is updated next, though what is kept stays current.
  void Reawaken(vtkAlgorithm* stage);

private:
  std::vector<vtkMTimeType> Signature;
};

/// What may have changed upstream of one input port: the pipeline MTime of each connection.
std::vector<vtkMTimeType> InputSignature(vtkInformationVector* input);

/// What every stage's ProcessRequest is: `process`, once the properties are in their ranges and no
/// input is of a stage that failed, with exceptions as errors (Fail).
int GuardedRequest(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector* outputs,
                   const std::vector<PropertyRange>& properties,
                   const std::function<int()>& process);

/// Whether a request is for the piece of another rank than the first. ParaView asks sources with a
/// composite output for it, whether they say that they can give pieces or not.
bool IsPieceOfOthers(vtkInformation* request, vtkInformationVector* outputs);

} // namespace waft
