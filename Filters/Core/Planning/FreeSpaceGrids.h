// SPDX-License-Identifier: BSD-3-Clause
// The maps of free space of a scene: one for each size of object and each size of cells.
#pragma once

#include "Base/Motion.h"
#include "Base/SceneFrame.h"
#include "Planning/FreeSpaceGrid.h"
#include "Planning/PlannerNumbers.h"

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace waft
{

/// Each map is made when it is first asked for, by any of several threads.
class FreeSpaceGrids
{
public:
  /// margin: kept beyond the clearance radii [m]. There are no maps where obstacles move, of which
  /// a map tells nothing, or where there are none.
  FreeSpaceGrids(const ObstacleSet& obstacles, const Box& bounds,
                 const std::vector<MotionObject>& objects, double margin,
                 const std::atomic<bool>& stop);

  /// From coarse (0) to fine; null when there is none finer.
  const FreeSpaceGrid* Of(const MotionObject& object, int level);

private:
  struct LazyMap
  {
    std::once_flag Once;
    std::unique_ptr<FreeSpaceGrid> Map;
  };
  const ObstacleSet& Obstacles;
  Box Bounds;
  double Margin;
  const std::atomic<bool>& Stop;
  std::map<double, std::array<LazyMap, PlannerNumbers::MapCells.size()>> Maps; // by radius
};

} // namespace waft
