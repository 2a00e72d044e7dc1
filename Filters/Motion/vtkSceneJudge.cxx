// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSceneJudge.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Files/EmbeddedDatabase.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Chain/JudgeScene.h"

#include <vtkDataSetAttributes.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <limits>

vtkStandardNewMacro(vtkSceneJudge);

namespace
{

using waft::Finding;

void ToTable(const waft::SceneJudgement& judgement, vtkTable* table)
{
  const std::vector<Finding>& findings = judgement.Findings;
  table->Initialize();
  vtkFieldData* rows = table->GetRowData();
  waft::AddColumn(rows, waft::names::Possible, findings,
                  [](const Finding& one) -> unsigned char { return one.IsPossible ? 1 : 0; });
  waft::AddColumn(rows, waft::names::Kind, findings, &Finding::Kind);
  waft::AddColumn(rows, waft::names::Text, findings, &Finding::Text);
  waft::AddColumn(rows, waft::names::ObjectId, findings, &Finding::ObjectId);
  waft::AddColumn(rows, waft::names::Frame, findings, &Finding::Frame);
  waft::AddColumn(rows, waft::names::Row, findings, &Finding::Row);
  waft::AddColumn(rows, waft::names::Target, findings, &Finding::Target);
  waft::AddColumn(rows, waft::names::Place, findings,
                  [](const Finding& one)
                  {
                    constexpr double none = std::numeric_limits<double>::quiet_NaN();
                    return one.Place.value_or(waft::Vec3::Constant(none));
                  });
  vtkFieldData* fields = table->GetFieldData();
  waft::AddInts(fields, waft::names::NumberOfObjects,
                { static_cast<int>(judgement.NumberOfObjects) });
  waft::AddInts(fields, waft::names::NumberOfConstraints,
                { static_cast<int>(judgement.Report.size()) });
  waft::AddStrings(fields, waft::names::Lines, judgement.Lines());
}

waft::Result OfScene(const waft::Scene& scene, const waft::MotionDatabase& database,
                     vtkTable* findings)
{
  waft::SceneJudgement judgement;
  WAFT_RETURN_IF_FAILED(waft::JudgeScene(scene, database, waft::SmpFor(), judgement));
  ToTable(judgement, findings);
  return waft::Result::Ok();
}

} // namespace

std::string vtkSceneJudge::Judge(vtkPolyData* objects, vtkPolyData* constraints,
                                 vtkPolyData* obstacles, vtkTable* findings)
{
  waft::Scene scene;
  waft::MotionDatabase database;
  waft::Result result = waft::SceneInfoFromFieldData(objects, scene.Info);
  result = result ? waft::ObjectsFromPolyData(objects, scene.Objects) : result;
  if (result && constraints != nullptr)
  {
    result = waft::ConstraintsFromPolyData(constraints, scene.Info.Time, scene.Constraints);
  }
  if (result && obstacles != nullptr)
  {
    waft::ObstacleCollector collector;
    result = collector.Add(obstacles, 0.0, scene.Info.Time);
    scene.Obstacles = collector.Take();
  }
  result = result ? waft::ReadEmbeddedDatabase(database) : result;
  result = result ? OfScene(scene, database, findings) : result;
  return result.Message();
}
