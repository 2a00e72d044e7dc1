// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/SpacetimeData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <cmath>
#include <utility>

namespace waft
{
namespace
{

void AddFloats(vtkFieldData* data, const char* name, const std::vector<float>& values,
               int components)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), values[i]);
  }
  data->AddArray(array);
}

} // namespace

void ParticlesToPolyData(const ParticleSeries& particles, int frame, const SceneInfo& info,
                         vtkPolyData* data)
{
  data->Initialize();
  SceneInfoToFieldData(info, data);
  if (particles.Frames.empty())
  {
    return;
  }
  const auto last = static_cast<int>(particles.Frames.size()) - 1;
  const ParticleSeries::Frame& now =
    particles.Frames[static_cast<std::size_t>(std::clamp(frame, 0, last))];
  const std::size_t count = particles.ObjectIds.size();
  std::vector<Vec3> positions;
  std::vector<int> ids;
  std::vector<unsigned char> kinds;
  for (std::size_t i = 0; i < count; ++i)
  {
    const float* x = now.Positions.data() + 3 * i;
    positions.emplace_back(x[0], x[1], x[2]);
    ids.push_back(static_cast<int>(i));
    kinds.push_back(particles.ObjectIds[i] < 0 ? 0 : 1);
  }
  SetVertices(data, positions);
  vtkPointData* arrays = data->GetPointData();
  AddInts(arrays, names::ParticleId, ids);
  AddBytes(arrays, names::Kind, kinds);
  AddInts(arrays, names::ObjectId, particles.ObjectIds);
  AddFloats(arrays, names::Mass, particles.Masses, 1);
  AddFloats(arrays, names::Velocity, now.Velocities, 3);
  AddFloats(arrays, names::Density, now.Densities, 1);
  AddFloats(arrays, names::Pressure, now.Pressures, 1);
  AddFloats(arrays, names::Wind, now.Winds, 3);
  AddFloats(arrays, names::VortexForce, now.VortexForces, 3);
  AddFloats(arrays, names::Residual, now.Residuals, 3);
}

void OptimisedToPolyData(const SpacetimeOutput& solution, const SceneInfo& info, vtkPolyData* data)
{
  TracksToPolyData(solution.Tracks, info, data);
  AddDoubles(data->GetCellData(), names::PositionResidual, solution.PositionResiduals);
  AddDoubles(data->GetCellData(), names::VelocityResidual, solution.VelocityResiduals);
  for (const auto& [name, value] : { std::pair(names::ReplayError, solution.ObjectReplayError),
                                     std::pair(names::GasReplayError, solution.GasReplayError),
                                     std::pair(names::GasHiddenHand, solution.GasModelResidual),
                                     std::pair(names::RepairedFraction, solution.RepairedFraction),
                                     std::pair(names::LargestRepair, solution.LargestRepair) })
  {
    AddDoubles(data->GetFieldData(), name, { value });
  }
  // In a sampled air nothing of it can be had.
  if (!solution.Convergence.empty() && !std::isnan(solution.Convergence.back().ShareNone))
  {
    const ConvergenceRow& last = solution.Convergence.back();
    std::vector<double> squares;
    for (const double sum : { last.VorticesSquared, last.WindSquared, last.GasSquared,
                              last.DragSquared, last.LandingSquared, last.NoneSquared })
    {
      squares.push_back(sum / last.Motion);
    }
    AddDoubles(data->GetFieldData(), names::ForceSquares, squares);
    if (!std::isnan(solution.VorticesPart))
    {
      AddDoubles(data->GetFieldData(), names::VorticesPart, { solution.VorticesPart });
    }
    if (const FieldsPart& part = solution.Explained; !std::isnan(part.All[0]))
    {
      AddDoubles(
        data->GetFieldData(), names::FieldsExplained,
        { part.All[0], part.All[1], part.Objects[0], part.Objects[1], part.Gas[0], part.Gas[1] });
    }
  }
}

void ConvergenceToTable(const std::vector<ConvergenceRow>& rows, const SceneInfo& info,
                        vtkTable* table)
{
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  VisitConvergence([&](const ConvergenceColumn& column, auto member)
                   { AddColumn(columns, column.Name, rows, member); });
  SceneInfoToFieldData(info, table);
}

} // namespace waft
