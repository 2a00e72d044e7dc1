// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanWay.h"

#include "Planning/PlannerNumbers.h"

#include <algorithm>

namespace waft
{

bool FindWay(const ClearanceField& field, const SpanPlanOptions& options,
             const std::vector<Vec3>& guide, SpanTask& task)
{
  task.Way = guide;
  if (!options.Rooms || field.Obstacles == nullptr || field.Obstacles->IsEmpty())
  {
    return true;
  }
  const auto isClear = [&](const std::vector<Vec3>& way)
  {
    for (std::size_t k = 1; k < way.size(); ++k)
    {
      if (!field.Obstacles->IsClear(way[k - 1], 0.0, way[k], 0.0, 0.0))
      {
        return false;
      }
    }
    return true;
  };
  if (task.Way.size() > 1 && isClear(task.Way))
  {
    return true;
  }
  task.Way.clear();
  const Vec3 lift = Vec3(0.0, 0.0, field.Rule.Radius + options.Margin);
  const Vec3 a = task.Start.Position + (task.Start.IsRest ? lift : Vec3(Vec3::Zero()));
  const Vec3 b = task.Goal.Position + (task.Goal.IsRest ? lift : Vec3(Vec3::Zero()));
  const double radius = std::min({ field.Rule.Radius, field.Required(a), field.Required(b) });
  if (field.Obstacles->IsClear(a, 0.0, b, 0.0, PlannerNumbers::ClearSight * std::max(0.0, radius)))
  {
    return true;
  }
  for (int level = 0; task.Way.empty(); ++level)
  {
    const FreeSpaceGrid* rooms = options.Rooms(level);
    if (rooms == nullptr)
    {
      return level == 0;
    }
    task.Way = rooms->FindWay(a, b);
  }
  return true;
}

} // namespace waft
