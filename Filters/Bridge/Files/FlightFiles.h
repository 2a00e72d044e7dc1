// SPDX-License-Identifier: BSD-3-Clause
// The files of a flight, as Documentation/UserGuide.md says what is in each.
#pragma once

#include "Base/Monitor.h"
#include "Base/Result.h"
#include "Chain/Motion.h"
#include "Scene/Scene.h"
#include "Scene/SceneNode.h"

#include <vtkType.h>

#include <string>
#include <vector>

class vtkTable;

namespace waft
{

/// What a flight is written with.
struct FlightFileOptions
{
  std::string Folder;       // which is there, and holds nothing of the same names
  bool HasAnimation = true; // animation.glb
  bool HasCsv = true;       // poses.csv
  bool HasMeshes = false;   // a file a frame
  bool HasParticles = false;
  bool HasAllAir = false;   // every frame of the air, not only as many as its picture needs
  bool IsHurried = false;   // somebody waits: without series of fields, particles and meshes
  bool HasFields = true;    // the motion by itself, and what moves it
  std::string PlannedFile;  // becomes planned.vtp; empty: the motion's plan does
  std::string AirStateFile; // becomes assimilated.state; empty: none does
};

/// Writes the files of a motion. report: what of report.json follows from the motion. warnings:
/// what was odd. Fails with the path where a file cannot be written; what there is by then stays.
Result WriteFlight(const Scene& scene, const Motion& motion, const FlightFileOptions& options,
                   Monitor& monitor, SceneJson& report, std::vector<std::string>& warnings);

/// Writes planned.vtp, constraints.vtp and vortices.vtp of a plan into a folder.
Result WritePlan(const SceneInfo& info, const PlanOutput& plan, const std::string& folder);
/// The joined report of a motion; see vtkMotionReport.
void JoinedReportToTable(const std::vector<JoinedRow>& report, const SceneInfo& info,
                         vtkTable* table);

/// A cell as it stands in files of text: doubles with 17 significant digits, of which what is no
/// number is empty.
std::string CellText(vtkTable* table, vtkIdType row, const char* column);
/// Rows with commas between, cells by CellText. A text that programs for tables would take for a
/// formula gets an apostrophe.
Result WriteCsv(const std::string& path, vtkTable* table, const std::vector<std::string>& columns);

} // namespace waft
