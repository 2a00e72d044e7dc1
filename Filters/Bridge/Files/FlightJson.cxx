// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/FlightJson.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/SpacetimeData.h"
#include "Bridge/Files/FlightFiles.h"
#include "Scene/SceneNode.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace waft
{
namespace
{

// Degrees: median and 90th percentile of half a second of turning in the air.
constexpr double Agreeing[] = { 15.0, 45.0 };

/// Of field data of one entry, a number; null where it is not there, or none.
SceneJson NumberIn(vtkFieldData* fields, const char* name, vtkIdType index = 0)
{
  vtkDataArray* array = fields->GetArray(name);
  const bool isThere = array != nullptr && index < array->GetNumberOfValues();
  const double value = isThere ? array->GetVariantValue(index).ToDouble() : std::nan("");
  return std::isfinite(value) ? SceneJson(value) : SceneJson();
}

/// How far a motion is one of the optimiser's model, and what moves it.
void ReportOptimised(const SpacetimeOutput& optimised, const SceneInfo& info, vtkTable* convergence,
                     SceneJson& report)
{
  for (const char* field : { "energy", "dynamics", "forces", "fieldsExplained" })
  {
    report[field] = SceneJson::object();
  }
  if (optimised.Tracks.empty())
  {
    return;
  }
  const vtkIdType last = convergence->GetNumberOfRows() - 1;
  const auto inTable = [convergence](vtkIdType row, const std::string& name)
  { return convergence->GetValueByName(row, name.c_str()).ToDouble(); };
  if (last >= 0)
  {
    report["energy"] = { { "before", inTable(0, "E") }, { "after", inTable(last, "E") } };
  }
  SpacetimeOutput figures;
  figures.Convergence = optimised.Convergence;
  figures.VorticesPart = optimised.VorticesPart;
  figures.Explained = optimised.Explained;
  figures.ObjectReplayError = optimised.ObjectReplayError;
  figures.GasReplayError = optimised.GasReplayError;
  figures.GasModelResidual = optimised.GasModelResidual;
  figures.RepairedFraction = optimised.RepairedFraction;
  figures.LargestRepair = optimised.LargestRepair;
  vtkNew<vtkPolyData> tracks;
  OptimisedToPolyData(figures, info, tracks);
  vtkFieldData* fields = tracks->GetFieldData();
  for (const auto& [field, name] : { std::pair("replayError", names::ReplayError),
                                     std::pair("gasReplayError", names::GasReplayError),
                                     std::pair("gasHiddenHand", names::GasHiddenHand),
                                     std::pair("repairedFraction", names::RepairedFraction),
                                     std::pair("largestRepair", names::LargestRepair) })
  {
    const SceneJson number = NumberIn(fields, name);
    if (!number.is_null() && number >= 0.0)
    {
      report["dynamics"][field] = number;
    }
  }
  if (fields->GetArray(names::ForceSquares) != nullptr)
  {
    vtkIdType number = 0;
    for (const char* force : { "Vortices", "Wind", "Gas", "Drag", "Landing", "None" })
    {
      std::string field = force;
      field[0] = static_cast<char>(std::tolower(field[0]));
      report["forces"][field] = { { "share", inTable(last, std::string("Share") + force) },
                                  { "square", NumberIn(fields, names::ForceSquares, number++) } };
    }
    if (fields->GetArray(names::VorticesPart) != nullptr)
    {
      report["forces"]["vortices"]["part"] = NumberIn(fields, names::VorticesPart);
    }
  }
  if (fields->GetArray(names::FieldsExplained) != nullptr)
  {
    vtkIdType number = 0;
    for (const char* kind : { "all", "objects", "gas" })
    {
      report["fieldsExplained"][kind] = {
        { "solved", NumberIn(fields, names::FieldsExplained, number) },
        { "leftOut", NumberIn(fields, names::FieldsExplained, number + 1) }
      };
      number += 2;
    }
  }
}

/// How far half a second of turning in the air leads away from the poses: of all bodies, and of
/// whom by more than is wanted.
SceneJson AgreementOf(vtkPolyData* poses)
{
  vtkDataArray* lines = poses->GetCellData()->GetArray(names::Agreement);
  vtkDataArray* together = poses->GetFieldData()->GetArray(names::Agreement);
  if (lines == nullptr || together == nullptr)
  {
    return SceneJson::object();
  }
  SceneJson beyond = SceneJson::array();
  vtkDataArray* ids = poses->GetCellData()->GetArray(names::ObjectId);
  for (vtkIdType i = 0; i < lines->GetNumberOfTuples(); ++i)
  {
    if (lines->GetComponent(i, 0) > Agreeing[0] || lines->GetComponent(i, 1) > Agreeing[1])
    {
      beyond.push_back(static_cast<int>(ids->GetTuple1(i)));
    }
  }
  return { { "median", together->GetComponent(0, 0) },
           { "ninetieth", together->GetComponent(0, 1) },
           { "beyond", beyond } };
}

} // namespace

SceneJson MotionAsJson(const SceneInfo& info, const Motion& motion, vtkPolyData* poses,
                       vtkTable* convergence)
{
  SceneJson report = SceneJson::object();
  const Timeline& line = info.Time;
  report["time"] = { { "frames", line.NumberOfFrames },
                     { "framesPerSecond", line.FramesPerSecond } };
  if (info.Loops != 0)
  {
    report["time"]["loop"] = true;
  }
  ReportOptimised(motion.Optimised, info, convergence, report);
  report["fit"] = SceneJson::object();
  if (motion.Efforts.count(ChainStage::VortexFit) > 0)
  {
    const AirVortexFit& fit = motion.Fit;
    report["fit"] = { { "vortices", fit.Vortices.size() },
                      { "explained", fit.Explained },
                      { "explainedLeftOut", std::isnan(fit.ExplainedLeftOut)
                                              ? SceneJson()
                                              : SceneJson(fit.ExplainedLeftOut) } };
  }
  const std::vector<double>& laid = motion.Laid;
  report["settled"] = { { "objects", std::count_if(laid.begin(), laid.end(),
                                                   [](double shift) { return shift > 0.0; }) },
                        { "largestShift",
                          laid.empty() ? 0.0 : *std::max_element(laid.begin(), laid.end()) } };
  report["agreement"] = AgreementOf(poses);
  report["free"] = SceneJson::array(); // bodies that lie though no row asks for it
  for (const Constraint& row : motion.Air.Constraints)
  {
    if (row.Target < 0)
    {
      report["free"].push_back({ { "object", row.ObjectId }, { "touchDown", row.TouchDown } });
    }
  }
  return report;
}

SceneJson AsJson(const Effort& effort)
{
  return { { "seconds", effort.Seconds },
           { "processorSeconds", effort.Processor },
           { "threadSeconds", effort.Thread },
           { "peakMemoryMB", effort.PeakMB } };
}

SceneJson PlannedAsJson(const std::vector<ObjectRow>& rows)
{
  SceneJson told = SceneJson::array();
  for (const ObjectRow& row : rows)
  {
    told.push_back({ { "objectId", row.ObjectId },
                     { "rows", row.NumberOfRows },
                     { "met", row.NumberOfMet },
                     { "status", ToString(row.Status) },
                     { "cost", row.Cost },
                     { "branches", row.NumberOfBranches },
                     { "seconds", row.Seconds },
                     { "message", row.Message } });
  }
  return told;
}

SceneJson RowsAsJson(vtkTable* table)
{
  SceneJson rows = SceneJson::array();
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    SceneJson& line = rows.emplace_back(SceneJson::object());
    for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
    {
      const char* name = table->GetColumnName(i);
      line[name] = CellText(table, row, name);
    }
  }
  return rows;
}

} // namespace waft
