// SPDX-License-Identifier: BSD-3-Clause
// What the assimilation gives besides tracks: the air, controls, the course of the solution.
#pragma once

#include "Air/Run/AirAssimilation.h"
#include "Base/Types.h"

class vtkImageData;
class vtkPolyData;
class vtkTable;

namespace waft
{

/// `Control` [m/s] and `Free` as point data of the output's tracks.
void AddControls(const AssimilationOutput& air, vtkPolyData* tracks);

/// One time of the air: `Velocity` [m/s] and, unless empty, `Wind` [m/s^2]; time is sampled.
void AirToImage(const HalfSeries& air, const HalfSeries& wind, double time, const SceneInfo& info,
                vtkImageData* data);

/// One row a round: `Stage`, `Candidate`, `ControlRms`, `ControlMedian`, `FlowRms`, `WindRms`
/// [m/s], `Seconds`.
void RoundsToTable(const std::vector<AssimilationRound>& rounds, const SceneInfo& info,
                   vtkTable* table);

} // namespace waft
