// SPDX-License-Identifier: BSD-3-Clause
// What a user sets of a whole run.
#pragma once

#include "Air/Run/AirAssimilation.h"
#include "Chain/ChainTable.h"
#include "Planning/Takes.h"
#include "Rotation/RotationRefine.h"
#include "Spacetime/Model/SpacetimeOptions.h"
#include "Vortex/VortexFit.h"

#include <cstdint>
#include <optional>
#include <string>

namespace waft
{

/// Seeds of stages are not read: they are all Seed.
struct ChainOptions
{
  Quality Detail = Quality::Full;
  std::int64_t Seed = -1; // -1: the scene's own
  ChainStage StopAfter = ChainStage::VortexFit;
  /// Seconds after which the best motion so far is turned and given; 0: no limit. With a limit two
  /// runs may differ.
  double TimeLimit = 0.0;
  /// The motion has the plan already: what an earlier run left of it.
  bool HasPlan = false;
  PlanOptions Plan;
  TakeOptions Takes;
  AssimilationOptions Air;
  std::optional<RotationOptions> Turning; // of bodies while the air is looked for; none: Rotation
  SpacetimeOptions Optimiser;
  RotationOptions Rotation;
  VortexFitOptions Fit; // its Bounds are the scene's

  Result Validate() const;
  /// Those of a quality: the defaults, and of a preview a coarse air.
  static ChainOptions At(Quality quality);
  /// Sets an option of a stage by their names in the table. False where there is none.
  bool Set(ChainStage stage, const std::string& name, double value);
};

/// What one source of a whole run has for properties, besides those of the takes and of slices.
struct FlightOptions
{
  std::string FileName;
  std::string Database;
  std::string EditOf;
  int Quality = 0;
  int Seed = -1;
  int StopAfter = 5;
  double TimeLimit = 0.0;
  double MemoryLimit = 0.0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField("FileName", "The scene file. Setting it reads the file anew."), of.FileName...);
    visit(
      OptionField{ "Quality",
                   { 0, 3 },
                   "",
                   "Preview: drift in coarse air, the fastest. Air: drift in fine air. Full: the "
                   "optimiser besides. As in the 2005 paper: the optimiser alone, in air "
                   "at rest." },
      of.Quality...);
    visit(
      OptionField{
        "Seed", { -1, 2147483647 }, "", "Another seed is another motion through the same marks." }
        .Or("the scene's own"),
      of.Seed...);
    visit(
      OptionField{
        "StopAfter", { 0, 5 }, "", "The last stage that runs; the ports of later ones are empty." },
      of.StopAfter...);
    visit(TextField("Database", "A motion database, .vtm; empty: the one that comes with Waft."),
          of.Database...);
    visit(TextField("EditOf",
                    "The State File of a run of the same scene that differs in some objects' rows: "
                    "the same air, and only what changed drifts again; empty: none."),
          of.EditOf...);
    visit(OptionField{ "TimeLimit",
                       { 0, 1e+09 },
                       "s",
                       "Seconds after which the best motion so far is given. With a limit two runs "
                       "may differ." }
            .Or("no limit"),
          of.TimeLimit...);
    visit(OptionField{ "MemoryLimit",
                       { 0, 1e+09 },
                       "MB",
                       "Megabytes that the optimiser may take besides its input; with less than it "
                       "needs it takes several times as long." }
            .Or("no limit"),
          of.MemoryLimit...);
  }
};

} // namespace waft
