// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/VortexData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>

namespace waft
{

void VorticesToPolyData(const std::vector<Vortex>& vortices, const SceneInfo& info,
                        vtkPolyData* data)
{
  std::vector<Vec3> poles;
  vtkNew<vtkCellArray> lines;
  for (const Vortex& vortex : vortices)
  {
    const vtkIdType first = static_cast<vtkIdType>(poles.size());
    const vtkIdType line[2] = { first, first + 1 };
    lines->InsertNextCell(2, line);
    poles.push_back(vortex.P1);
    poles.push_back(vortex.P2);
  }
  data->Initialize();
  vtkNew<vtkPoints> points;
  SetPoints(points, poles);
  data->SetPoints(points);
  data->SetLines(lines);
  vtkCellData* arrays = data->GetCellData();
  AddColumn(arrays, names::VortexId, vortices, &Vortex::VortexId);
  AddColumn(arrays, names::Strength, vortices, &Vortex::Strength);
  AddColumn(arrays, names::CenterTime, vortices, &Vortex::CenterTime);
  AddColumn(arrays, names::Duration, vortices, &Vortex::Duration);
  AddColumn(arrays, names::CoreRadius, vortices, &Vortex::CoreRadius);
  AddColumn(arrays, names::Confidence, vortices, &Vortex::Confidence);
  AddColumn(arrays, names::ObjectCount, vortices, &Vortex::ObjectCount);
  SceneInfoToFieldData(info, data);
}

void AirVortexFitToPolyData(const AirVortexFit& fit, const SceneInfo& info, vtkPolyData* data)
{
  VorticesToPolyData(fit.Vortices, info, data);
  AddDoubles(data->GetFieldData(), names::Explained, { fit.Explained });
  if (!std::isnan(fit.ExplainedLeftOut))
  {
    AddDoubles(data->GetFieldData(), names::ExplainedLeftOut, { fit.ExplainedLeftOut });
  }
}

Result VorticesFromPolyData(vtkPolyData* data, std::vector<Vortex>& vortices)
{
  WAFT_RETURN_IF_FAILED(CheckCells(data, "Vortices"));
  const vtkIdType count = data->GetNumberOfCells();
  const ArraySource source{ data->GetCellData(), "Vortices", count };
  vortices.clear();
  if (count == 0)
  {
    return Result::Ok();
  }
  std::vector<Vec3> points;
  std::vector<Vortex> read(static_cast<std::size_t>(count));
  const auto readOptional = [&](const char* name, auto member)
  { return ReadOptionalColumn(source, name, read, member); };
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), "Vortices", points));
  WAFT_RETURN_IF_FAILED(readOptional(names::VortexId, &Vortex::VortexId));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Strength, read, &Vortex::Strength));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::CenterTime, read, &Vortex::CenterTime));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Duration, read, &Vortex::Duration));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::CoreRadius, read, &Vortex::CoreRadius));
  WAFT_RETURN_IF_FAILED(readOptional(names::Confidence, &Vortex::Confidence));
  WAFT_RETURN_IF_FAILED(readOptional(names::ObjectCount, &Vortex::ObjectCount));
  vtkNew<vtkIdList> ends;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const std::string cell = "Vortices: cell " + std::to_string(i);
    data->GetCellPoints(i, ends);
    if (ends->GetNumberOfIds() != 2)
    {
      return Result::Error(cell + ": expected a line of 2 points, pole to pole, found " +
                           std::to_string(ends->GetNumberOfIds()));
    }
    Vortex& vortex = read[static_cast<std::size_t>(i)];
    vortex.VortexId = vortex.VortexId < 0 ? static_cast<int>(i) : vortex.VortexId;
    vortex.P1 = points[static_cast<std::size_t>(ends->GetId(0))];
    vortex.P2 = points[static_cast<std::size_t>(ends->GetId(1))];
    if (!(vortex.Duration > 0.0) || vortex.CoreRadius < 0.0 || vortex.P1 == vortex.P2)
    {
      return Result::Error(
        cell + ": expected two different poles, a positive Duration and a CoreRadius of 0 or more");
    }
  }
  vortices = std::move(read);
  return Result::Ok();
}

} // namespace waft
