// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/ConstraintTable.h"

namespace waft
{

std::vector<LinearCluster> MakeClusters(const SpacetimeModel& model, const ConstraintTable& table,
                                        const std::vector<bool>& hasFrame)
{
  const FixedAt fixedAt = [&](int frame, std::size_t object) -> const Vec3*
  {
    const std::size_t index = static_cast<std::size_t>(frame) * model.NumberOfObjects + object;
    return model.Flags[index] & FixedPosition ? &table.FixedPositions[index] : nullptr;
  };
  return MakeClusters(table.Rows, table.Balls, fixedAt, hasFrame);
}

} // namespace waft
