// SPDX-License-Identifier: BSD-3-Clause
// A stage that computes once and serves every frame from what it keeps.
//
// The Internals of such a stage derive from KeptStage and say how to take the inputs and run Core;
// its RequestUpdateExtent and RequestData are those of KeptStage.
//
// With a Slice one update does a bounded part of the work. What there is so far is published then,
// with the field data `Complete` of 0; GoOn makes the next update do the next part. Work that goes
// on beside runs between updates, too, and is held while it is published. A stage whose input is
// not complete publishes what that comes to without work.
#pragma once

#include "Base/MachineMemory.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Bridge/Pipeline/FieldSweep.h"
#include "Bridge/Pipeline/SlicedRun.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Constraints/Constraint.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace waft
{

struct Motion;
struct Scene;

/// Whether an input shows what there is of it so far.
bool HasUnfinishedInput(vtkAlgorithm* stage, vtkInformationVector** inputs);
/// Marks outputs as what there is so far.
void MarkUnfinished(vtkInformationVector* outputs);

class KeptStage
{
public:
  /// scenePort: the input whose field data give the scene (SceneOfInputs), or NoPort of a source,
  /// which sets Scene by itself; the others: as in FieldSweep.
  KeptStage(vtkAlgorithm* stage, int scenePort, int obstaclesPort = FieldSweep::NoPort,
            int windPort = FieldSweep::NoPort, int airPort = FieldSweep::NoPort);
  virtual ~KeptStage() = default;
  KeptStage(const KeptStage&) = delete;
  KeptStage& operator=(const KeptStage&) = delete;

  /// The stage's requests. RequestData runs Core when parameters or inputs have changed, once all
  /// steps of obstacles, wind and air were pulled; then it fills the outputs for the time asked.
  /// Where the scene is with the first rank (IsWithFirstRank), and when it is stopped while it
  /// pulls, they stay empty.
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs);
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs);

  /// The next update gives what a motion of a scene has, as if the stage had come to it by itself.
  /// giver: whose both are.
  void Give(vtkAlgorithm* giver, const waft::Scene& scene, const Motion& motion);
  /// The next update goes on with work that has not ended; nothing where none is.
  void GoOn();
  /// From now on work that an update leaves goes on beside.
  void WorkBeside() { this->IsBeside = true; }
  /// Work that goes on beside waits, from its next tick on, until an update shows it and lets it
  /// go.
  void Hold() { this->Held.Hold(); }
  /// Discards all work, and lets go of what is kept.
  void LetGo();
  /// Whether what is shown is the whole result.
  bool IsComplete() const { return !this->IsUnfinished; }
  /// Of the work that has not ended, or of what it came to.
  SlicedRun::State Now() const { return this->Held.Now(); }
  SlicedRun::Progress SoFar() const;
  /// That the work takes from here on by those that it took [s]; below 0 while that is not known.
  double SecondsLeft() const;
  /// In the destructor of who derives: what is held works on its members.
  void Discard();

protected:
  /// Takes the inputs (Scene and Fields are there), runs Core, fills the Kept outputs and Warnings.
  /// Stopped: what is kept is shown, and the next update runs again. Inputs are there until the
  /// first tick of the monitor. What is read while the stage shows, and all of VTK, it writes after
  /// Rejoin alone.
  virtual Result Run(vtkInformationVector** inputs, Monitor& monitor) = 0;
  void Rejoin() { this->Held.Rejoin(); }
  /// Fills the Kept outputs with what a motion has of the stage, in the place of Run.
  virtual Result Adopt(vtkInformationVector** inputs, const waft::Scene& scene,
                       const Motion& motion);
  /// Seconds of work in an update; 0: all.
  virtual double Slice() const { return 0.0; }
  /// Fills the Kept outputs with what the run that is held has come to.
  virtual void Publish() {}
  /// After a failure: fills those of the Kept outputs that it does not touch.
  virtual void KeepBeforeFailure() {}
  /// Publish, out of inputs that are not complete; stays empty where it fails.
  virtual Result PublishFrom(vtkInformationVector** inputs);
  /// Lets go of what it keeps beside the Kept outputs.
  virtual void Clear() {}
  /// FillVarying, of what there is so far.
  virtual void FillPublished(double time, vtkInformationVector* outputs) const;
  /// After each pass over what is pulled over time, the first of a run being told: takes from
  /// Fields what is not to be kept until Run.
  virtual Result TakePass(vtkInformationVector** inputs, bool isFirst);
  /// Whether what the stage gives is of a time; a database is of none.
  virtual bool HasTime() const { return true; }
  /// False of a stage that was told to rest: it takes no input, and its outputs are empty.
  virtual bool IsActive() const { return true; }
  /// Of several ranks that run together: what holds for all of them, out of what this one found in
  /// its inputs.
  virtual Result Agree(const Result& own) { return own; }
  /// Fills the outputs that are not kept, for a time within the scene's [s].
  virtual void FillVarying(double time, vtkInformationVector* outputs) const;

  /// The data of an output port that are the same at every frame: made when first named during Run,
  /// given as shallow copies, since later stages may ask for every frame. Data is the port's type.
  template <typename Data>
  Data* Kept(int port)
  {
    const auto at = static_cast<std::size_t>(port);
    this->Keep.resize(std::max(this->Keep.size(), at + 1));
    if (!this->Keep[at])
    {
      this->Keep[at].TakeReference(Data::New());
    }
    return static_cast<Data*>(this->Keep[at].Get());
  }
  /// The rows of an optional input Constraints, none when it is absent or empty.
  Result TakeConstraints(vtkInformationVector* input, std::vector<Constraint>& constraints) const;
  /// The frame nearest to a time [s].
  int FrameAt(double time) const;

private:
  GivesMemoryBack Last;

protected:
  SceneInfo Scene;
  FieldSweep Fields;
  std::vector<std::string> Warnings;

private:
  Result TakeScene(vtkInformationVector** inputs);
  /// Of several ranks: the first has the scene.
  bool IsElsewhere(vtkInformationVector** inputs) const;
  /// Runs Core as far as one update goes, and keeps what came out.
  Result Begin(vtkInformationVector** inputs);
  Result Advance(vtkInformationVector** inputs, double seconds);
  Result PublishHeld(vtkInformationVector** inputs);
  Result End(vtkInformationVector** inputs, const Result& result);
  Result TakeGiven(vtkInformationVector** inputs);
  void Show(vtkInformation* request, vtkInformationVector* outputs);
  int FailWith(const Result& result, vtkInformationVector* outputs);
  void GiveKept(vtkInformationVector* outputs) const;
  double SliceNow() const;
  virtual bool RunsOnAllRanks() const { return false; }
  /// Between two steps of what is pulled over time: false when the stage is asked to stop.
  bool GoesOn();

  vtkAlgorithm* Stage;
  int ScenePort;
  std::string Defaults; // that the scene has, since no input says another
  StageCache Cache;
  SlicedRun Held;
  bool IsBeside = false;
  bool IsDue = false;        // work that has not ended is to go on
  bool IsUnfinished = false; // what is kept is not the whole result
  SlicedRun::Progress Reached;
  std::chrono::steady_clock::time_point LastLook = std::chrono::steady_clock::now();
  std::vector<vtkSmartPointer<vtkDataObject>> Keep; // by output port, null where it varies
  vtkSmartPointer<vtkAlgorithm> Giver;              // of what is given
  const waft::Scene* GivenScene = nullptr;
  const Motion* GivenMotion = nullptr;
};

} // namespace waft
