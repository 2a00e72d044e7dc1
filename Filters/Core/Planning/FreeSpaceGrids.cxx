// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/FreeSpaceGrids.h"

namespace waft
{

FreeSpaceGrids::FreeSpaceGrids(const ObstacleSet& obstacles, const Box& bounds,
                               const std::vector<MotionObject>& objects, double margin,
                               const std::atomic<bool>& stop) :
  Obstacles(obstacles),
  Bounds(bounds), Margin(margin), Stop(stop)
{
  if (!obstacles.IsEmpty() && !obstacles.HasMoving())
  {
    for (const MotionObject& object : objects)
    {
      this->Maps[object.ClearanceRadius]; // made here, since threads only look up
    }
  }
}

const FreeSpaceGrid* FreeSpaceGrids::Of(const MotionObject& object, int level)
{
  const auto entry = this->Maps.find(object.ClearanceRadius);
  if (entry == this->Maps.end() || level >= static_cast<int>(PlannerNumbers::MapCells.size()))
  {
    return nullptr;
  }
  const auto which = static_cast<std::size_t>(level);
  LazyMap& lazy = entry->second[which];
  std::call_once(lazy.Once,
                 [&]()
                 {
                   lazy.Map = std::make_unique<FreeSpaceGrid>(
                     this->Obstacles, this->Bounds, object.ClearanceRadius + this->Margin,
                     PlannerNumbers::MapCells[which], this->Stop);
                 });
  return lazy.Map.get();
}

} // namespace waft
