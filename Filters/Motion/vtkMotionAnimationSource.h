// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionAnimationSource
 * @brief   reads a scene file and runs all stages: bodies that fly, from one source
 *
 * It runs waft::RunChain, whose table says which stages a Quality has and who takes what from
 * whom. What is there already is not made again: another rotation needs no other air, and an edit
 * of the scene file plans only what it changed.
 *
 * Output ports, by the stages that give them; of stages that do not run they are empty:
 *  - 0 Meshes, 1 Poses: all bodies as they are turned (vtkRotationRefineFilter); the first varies
 *    in time.
 *  - 2 Obstacles, 3 Objects: of the scene (vtkMotionSceneReader); the first may vary in time.
 *  - 4 Marks, 5 PlannedTracks, 6 Trees, 7 PlannedReport: the constraints with their objects, paths
 *    and the search for them (vtkStylisticPlannerFilter).
 *  - 8 AssimilatedTracks, 9 Air, 10 Vortices, 11 AssimilatedReport, 12 Rounds: one air and the
 *    drift in it (vtkAirAssimilationFilter); Air varies in time.
 *  - 13 OptimisedTracks, 14 Gas, 15 Wind, 16 Convergence, 17 OptimisedReport: of the optimiser
 *    (vtkSPHSpacetimeFilter); Gas and Wind vary in time.
 *  - 18 TurnedReport: orientation rows as they were turned.
 *
 * The motion is that of these stages joined by hand, bit by bit, on any number of threads. Of
 * several MPI processes the first alone runs it, and the outputs of the others are empty.
 */
#ifndef vtkMotionAnimationSource_h
#define vtkMotionAnimationSource_h

#include "WaftProperty.h"
#include "vtkSlicedPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>
#include <string>

class vtkMultiProcessController;
class vtkTable;

namespace waft
{
struct FlightOptions;
struct TakeOptions;
} // namespace waft

class VTKWAFTFILTERS_EXPORT vtkMotionAnimationSource : public vtkSlicedPolyDataAlgorithm
{
public:
  static vtkMotionAnimationSource* New();
  vtkTypeMacro(vtkMotionAnimationSource, vtkSlicedPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Qualities
  {
    PREVIEW,
    AIR,
    ASSIMILATED = AIR, // what it was called before
    FULL,
    PAPER
  };
  enum Stops
  {
    AFTER_SCENE,
    AFTER_PLAN,
    AFTER_ASSIMILATION,
    AFTER_OPTIMISATION,
    AFTER_ROTATION,
    AFTER_ALL
  };

  ///@{
  /** The scene file. Setting it reads the file anew, also under the same name. */
  void SetFileName(const std::string& name);
  vtkGetMacro(FileName, std::string);
  ///@}
  /** The next update reads the file anew. */
  void Reload();
  ///@{
  /**
   * Changes of the scene that the file does not have: a JSON Patch, as waft::EditSceneText takes
   * it. Whom they touch flies anew in the air that there is, the others keep their bits.
   */
  void SetEdits(const std::string& edits);
  vtkGetMacro(Edits, std::string);
  ///@}
  /** What of the scene can be moved by the hand: waft::DescribeHandles; empty before a scene was
   * read. */
  std::string GetHandles() const;
  /**
   * Writes the edits to the scene file, all else in which stays as it was written; Edits is empty
   * then. A file that is not the one that was read any more is left as it is: an error says so.
   */
  void SaveScene();
  /** Writes the scene with the edits to another file; the source stays with its own. False where it
   * could not, and an error says why. */
  bool SaveSceneAs(const std::string& name);
  /** 1 when the scene was edited and flew on in the air that there was, which leaves more bodies
   * short of their marks than when it was drawn: LetGo has the next update draw another. */
  int GetWantsNewAir() const;
  WaftOpenProperty(int, Quality);
  WaftProperty(int, Seed);
  WaftOpenProperty(int, StopAfter);
  WaftProperty(double, TimeLimit);
  WaftProperty(double, MemoryLimit);
  WaftText(EditOf);
  WaftProperty(int, NumberOfTakes);
  WaftProperty(int, Take);

  ///@{
  /** A motion database, .vtm; empty: the one that comes with Waft. Setting it reads the file anew.
   */
  void SetDatabase(const std::string& name);
  vtkGetMacro(Database, std::string);
  ///@}

  /** The seed that the scene file gives; 1 before one was read. */
  int GetSceneSeed() const;
  /** Sets an option of a stage, by their names in the table of the chain; false where there is
   * none. */
  bool SetStageOption(const std::string& stage, const std::string& name, double value);

  /** The word of the stage that works; an empty text while none does. */
  std::string GetStageAtWork() const;
  /**
   * The next update writes a folder of results, as waft::FlyInto does. request: JSON with the
   * fields of waft::FlightRequest but Scene, Database and Options, which are this source's.
   * UserEvent tells that from now on a stop leaves something. When it is over the source is as it
   * was without.
   */
  void SetFlight(const std::string& request);
  /** Writes a folder of the motion that there is, as waft::SaveFlight does; gives what went wrong,
   * or an empty text. */
  std::string SaveFlight(const std::string& request, int isShown);
  /** Keeps the air of the flight in the user's cache, so that another source, as of a state of
   * ParaView that is loaded again, comes to the same motion without another simulation. */
  void KeepFlight();
  /** Those besides the first are in vtkSharedWork::Serve meanwhile; null: this process alone. */
  void SetController(vtkMultiProcessController* controller);
  /**
   * What came of the last update, as JSON: `stages` ({word: seconds, processorSeconds,
   * threadSeconds, peakMemoryMB}), `fault` (whose a failure was: input, memory, disk, stopped, or
   * an empty text), `seed`, `key`, `editOf` (the state whose air it flew on in), `isStopped`,
   * `stoppedIn` (the word of the stage that was), `leftOut`, `movedBy` (the last stage that moved
   * objects), `hasAir`, `warnings`.
   */
  std::string GetFlight() const;
  /** The next update of a stage by itself gives what this source has of it, without work; nothing
   * of other algorithms. Its inputs are taken for those of the scene. */
  void HandOver(vtkAlgorithm* stage);
  /** What came of each row, as vtkMotionReport has it. */
  void GetReport(vtkTable* report) const;
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkMotionAnimationSource();
  ~vtkMotionAnimationSource() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;
  waft::KeptStage& Kept() override;

private:
  vtkMotionAnimationSource(const vtkMotionAnimationSource&) = delete;
  void operator=(const vtkMotionAnimationSource&) = delete;

  std::string RangeError() const;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::FlightOptions;
  friend struct waft::TakeOptions;
  std::string FileName;
  std::string Database;
  std::string Edits;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
