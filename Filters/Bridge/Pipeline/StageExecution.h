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
#include "Base/Types.h"
#include "Bridge/Pipeline/PropertyCheck.h"
#include "Bridge/Pipeline/StageFailure.h"

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

/// vtkSMPTools; the first exception of a body reaches the caller. Debian's VTK runs one thread
/// unless told otherwise: when nobody chose a backend (by VTK_SMP_BACKEND_IN_USE or
/// vtkSMPTools::SetBackend), STDThread is taken, but in a fork of the process that loaded this.
ParallelFor SmpFor();

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

/// Pulls inputs over all their time steps, one pass of RequestData a step, and after the last one
/// back to the time that was asked of the stage.
///
/// All input ports, swept or not, are asked for the same step, and a stage whose result is current
/// asks for the time that is asked of itself. So after every pass all that is upstream stands at
/// one time. This matters because ports often come from one source, directly or by way of other
/// stages: a source fills all its outputs whenever one of them is asked for another time, and the
/// consumer would see the time that was asked for last.
///
/// Two passes are spared, as sources may be slow: the one back, when nobody else takes anything of
/// all that is upstream; and, once the result is current, any of a source that serves this stage
/// alone: it does not execute, and so nothing upstream of it is disturbed.
class TimeSweep
{
public:
  /// In the constructor of the stage: the input ports whose steps are seen one by one. Of the
  /// others any step will do.
  explicit TimeSweep(std::vector<int> ports) : Ports(std::move(ports)) {}
  /// In RequestUpdateExtent.
  void RequestSteps(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector** inputs,
                    vtkInformationVector* outputs, bool isCurrent);
  /// The time of the data that an input shows in this pass [s] (0 without time).
  static double DataTime(vtkInformation* input);
  bool IsFirst() const { return this->Step == 0; }
  /// False in the pass back to the time that was asked: its step was seen already.
  bool HasNewStep() const { return this->Step < this->NumberOfSteps; }
  /// Fraction of the steps that were pulled.
  double Fraction() const;
  /// In RequestData, when this step's data was taken: true when another pass was asked for.
  bool Continue(vtkInformation* request);
  /// The steps that are left are not wanted: true when the pass back was asked for.
  bool Leave(vtkInformation* request);
  /// After a failure in the middle of a sweep.
  void Reset(vtkInformation* request);

private:
  std::vector<int> Ports;
  std::size_t Step = 0;
  std::size_t NumberOfSteps = 1;
  bool MustReturn = false; // the last step is not the one that was asked of the stage
};

/// The number of input ports of a stage is read from it; gives all outputs the time steps of the
/// first input that has any, or whose data carry a scene's field data, else none.
void PassTimeSteps(vtkAlgorithm* stage, vtkInformationVector** inputs,
                   vtkInformationVector* outputs);
/// Gives all outputs the frames of a time line.
void SetTimeSteps(const Timeline& line, vtkInformationVector* outputs);
/// In RequestInformation: whether the data of an output are the same at all its time steps. A
/// TimeSweep does not pull such an input over time.
void SetStandsStill(vtkInformation* output, bool standsStill);

/// The time asked of an output port [s], clamped to the time line, and stamped on its data.
double RequestedTime(vtkInformationVector* outputs, int port, const Timeline& line);
/// The time asked of the output port that this pass of RequestData serves, clamped to the time
/// line, and stamped on the data of all ports. A stage of several ports that vary in time takes
/// this one: the pipeline notes after a pass that every port was made for the asking port's time,
/// and does not ask the others for that time again.
double RequestedTimeOfAll(vtkInformation* request, vtkInformationVector* outputs,
                          const Timeline& line);
/// The same as RequestedTime, as the nearest frame.
int RequestedFrame(vtkInformationVector* outputs, int port, const Timeline& line);

/// What every stage's ProcessRequest is: `process`, once the properties are in their ranges and no
/// input is of a stage that failed, with exceptions as errors (Fail).
int GuardedRequest(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector* outputs,
                   const std::vector<PropertyRange>& properties,
                   const std::function<int()>& process);

/// Whether a request is for the piece of another rank than the first. ParaView asks sources with a
/// composite output for it, whether they say that they can give pieces or not.
bool IsPieceOfOthers(vtkInformation* request, vtkInformationVector* outputs);

} // namespace waft
