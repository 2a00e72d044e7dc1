// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/AirData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

namespace waft
{

namespace
{

template <class Value>
std::vector<Value> Joined(const std::vector<std::vector<Value>>& lists)
{
  std::vector<Value> all;
  for (const std::vector<Value>& own : lists)
  {
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

} // namespace

void AddControls(const AssimilationOutput& air, vtkPolyData* tracks)
{
  AddVectors(tracks->GetPointData(), names::Control, Joined(air.Controls));
  AddBytes(tracks->GetPointData(), names::Free, Joined(air.Free));
  if (!air.ResponseTimes.empty())
  {
    AddDoubles(tracks->GetCellData(), names::ResponseTime, air.ResponseTimes);
  }
}

void AirToImage(const HalfSeries& air, const HalfSeries& wind, double time, const SceneInfo& info,
                vtkImageData* data)
{
  FieldSeriesToImage(air.Around(time), time, info, data);
  if (!wind.IsEmpty())
  {
    vtkNew<vtkImageData> force;
    FieldSeriesToImage(wind.Around(time), time, info, force);
    data->GetPointData()->AddArray(force->GetPointData()->GetArray(names::Wind));
  }
}

void RoundsToTable(const std::vector<AssimilationRound>& rounds, const SceneInfo& info,
                   vtkTable* table)
{
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddColumn(columns, names::Stage, rounds, &AssimilationRound::Stage);
  AddColumn(columns, names::Candidate, rounds, &AssimilationRound::Candidate);
  AddColumn(columns, names::ControlRms, rounds, &AssimilationRound::Control);
  AddColumn(columns, names::ControlMedian, rounds, &AssimilationRound::MedianControl);
  AddColumn(columns, names::FlowRms, rounds, &AssimilationRound::Flow);
  AddColumn(columns, names::WindRms, rounds, &AssimilationRound::Wind);
  AddColumn(columns, names::Seconds, rounds, &AssimilationRound::Seconds);
  SceneInfoToFieldData(info, table);
}

} // namespace waft
