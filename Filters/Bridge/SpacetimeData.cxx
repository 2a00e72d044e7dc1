// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SpacetimeData.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"
#include "Bridge/SceneData.h"

#include <vtkCellArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

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
  vtkNew<vtkCellArray> vertices;
  for (std::size_t i = 0; i < count; ++i)
  {
    const float* x = now.Positions.data() + 3 * i;
    positions.emplace_back(x[0], x[1], x[2]);
    ids.push_back(static_cast<int>(i));
    kinds.push_back(particles.ObjectIds[i] < 0 ? 0 : 1);
    const vtkIdType vertex = static_cast<vtkIdType>(i);
    vertices->InsertNextCell(1, &vertex);
  }
  vtkNew<vtkPoints> points;
  SetPoints(points, positions);
  data->SetPoints(points);
  data->SetVerts(vertices);
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
}

void ConvergenceToTable(const std::vector<ConvergenceRow>& rows, const SceneInfo& info,
                        vtkTable* table)
{
  std::vector<int> passes, iterations;
  std::vector<std::string> stages;
  std::vector<double> e, ex, ev, ec, violations, leashes, seconds;
  for (const ConvergenceRow& row : rows)
  {
    passes.push_back(row.Pass);
    stages.push_back(row.Stage);
    iterations.push_back(row.Iteration);
    e.push_back(row.E);
    ex.push_back(row.Ex);
    ev.push_back(row.Ev);
    ec.push_back(row.Ec);
    violations.push_back(row.MaxViolation);
    leashes.push_back(row.Leash);
    seconds.push_back(row.Seconds);
  }
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddInts(columns, names::Pass, passes);
  AddStrings(columns, names::Stage, stages);
  AddInts(columns, names::Iteration, iterations);
  AddDoubles(columns, names::E, e);
  AddDoubles(columns, names::Ex, ex);
  AddDoubles(columns, names::Ev, ev);
  AddDoubles(columns, names::Ec, ec);
  AddDoubles(columns, names::MaxViolation, violations);
  AddDoubles(columns, names::Leash, leashes);
  AddDoubles(columns, names::Seconds, seconds);
  SceneInfoToFieldData(info, table);
}

} // namespace waft
