// SPDX-License-Identifier: BSD-3-Clause
// From a scene file to a folder of results.
//
//   FlightRequest request;
//   request.Scene = "feather.waft.json";
//   request.Output = "out";
//   request.Options = ChainOptions::At(Quality::Preview);
//   FlightMonitor monitor;
//   Flight flight;
//   Result result = FlyScene(request, nullptr, monitor, flight);
#pragma once

#include "Base/Communicator.h"
#include "Base/Effort.h"
#include "Base/Monitor.h"
#include "Base/Result.h"
#include "Chain/ChainOptions.h"
#include "Chain/Motion.h"
#include "Chain/RunChain.h"
#include "Scene/Scene.h"
#include "Scene/SceneWind.h"
#include "Trajectory/MotionDatabase.h"

#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

/// What a scene file is flown with.
struct FlightRequest
{
  std::string Scene;    // the file
  std::string Output;   // the folder of results; empty: none are written
  std::string Database; // a .vtm; empty: the one that comes with Waft
  ChainOptions Options; // the time limit begins with the call
  /// The folder of a finished run, in whose air it flies, by its seed unless Options have another.
  std::string EditOf;
  bool Resumes = false;      // goes on from what an earlier run of the same key left in Output
  bool HasCsv = true;        // poses.csv
  bool HasMeshes = false;    // meshes.pvd, a file a frame
  bool HasParticles = false; // particles.pvd
  bool KeepsAir = false;     // every frame of the air
  bool KeepsState = false;   // of the air, beside the results
  /// Stages that end by themselves are not stopped: they are quick, and the best so far is to be
  /// whole.
  bool EndsWhole = true;
  bool TakesKept = false; // flies on in the air that StateStore has of this very flight
  std::string Defaults;   // JSON: what of it came from the user's settings
};

/// What programs that know no C++ ask for: an object with the fields by their names, those that
/// lack have their defaults. Scene, Database and Options are not read.
FlightRequest FlightRequestFromJson(const std::string& text);

/// Progress of a flight, and stops.
class FlightMonitor : public Monitor
{
public:
  bool Tick(double, const std::string&) override { return true; }
  /// A stage works from now on.
  virtual void Begin(ChainStage) {}
  /// From now on there is something to write when it is stopped; before, Ticks that return false
  /// end it with ErrorKind::Stopped and nothing is written.
  virtual void Keep() {}
  /// All stages are over, and files are written.
  virtual void Write() {}
};

/// What is known of a flight besides its motion.
struct FlightRecord
{
  std::int64_t Seed = 0;
  std::string Key;         // of the run: two of one key are the same motion
  std::string EditedState; // the file of the state of the air that it flew on in; empty: none
  Effort Reading;          // the scene
  bool IsKept = false;     // its air was kept of the same flight at another time
  bool IsStopped = false;
  bool IsHurried = false; // somebody stopped it, and waits
  std::vector<std::string> Warnings;

  /// The series that are left out of what is written, since somebody waits.
  std::vector<std::string> LeftOut(const FlightRequest& request, const Motion& made) const;
};

struct Flight
{
  Scene TheScene;
  SceneWind Wind;
  MotionDatabase Database;
  Motion Made;
  FlightRecord Record;

  /// All rows are met.
  bool IsMet() const;
};

/// Runs all stages of a scene file and writes its folder, whole or not at all: see the user guide
/// for what is in it. Fails, and leaves earlier results alone, by its Kind: Input on a scene, a
/// database or an option that cannot be, and where files that no run wrote are in the way; Memory;
/// Disk; Stopped before there was a plan. Stopped later it writes the best so far, which Resumes
/// goes on from. ranks: those besides the first are in Serve meanwhile; null: this process alone.
Result FlyScene(const FlightRequest& request, Communicator* ranks, FlightMonitor& monitor,
                Flight& flight);

/// Fails where a path is none of a regular file.
Result CheckSceneFile(const std::string& path);

/// The same of a scene that was read: inputs, record.Reading and, of what the reader said,
/// record.Warnings are given.
Result FlyInto(const FlightRequest& request, const ChainInputs& inputs, FlightMonitor& monitor,
               Motion& made, ChainMemory* memory, FlightRecord& record);

/// Writes the folder of a flight that is over. isShown: only what a page or a picture is made of.
Result SaveFlight(const FlightRequest& request, const Scene& scene, const Motion& made,
                  FlightRecord& record, bool isShown);

} // namespace waft
