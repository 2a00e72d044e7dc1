// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/ConnectionTable.h"

#include <algorithm>
#include <cmath>

namespace waft
{

Result BuildConnectionTable(const ConnectionOptions& options, const ParallelFor& parallelFor,
                            Monitor& monitor, MotionDatabase& database)
{
  if (Result result = options.Validate(); !result)
  {
    return result;
  }
  const std::size_t count = database.TopNodes.size();
  std::vector<std::vector<Vec3>> heads(count);
  std::vector<std::vector<Vec3>> tails(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    const std::vector<Vec3> samples =
      database.Reconstruct(database.Nodes[database.TopNodes[t]].Medoid);
    heads[t].assign(samples.begin(), samples.begin() + database.Window);
    tails[t].assign(samples.end() - database.Window, samples.end());
  }
  std::vector<Connection> table(count * count);
  constexpr std::size_t batch = 16;
  for (std::size_t first = 0; first < count; first += batch)
  {
    if (!monitor.Tick(double(first) / double(count), "Connecting representatives"))
    {
      return Result::Stopped();
    }
    parallelFor(std::min(batch, count - first),
                [&](std::size_t begin, std::size_t end)
                {
                  for (std::size_t before = first + begin; before < first + end; ++before)
                  {
                    for (std::size_t after = 0; after < count; ++after)
                    {
                      Connection& connection = table[before * count + after];
                      connection = AlignWindows(tails[before], heads[after],
                                                options.RotationFreedom, options.MaxTilt);
                      connection.IsConnectible = connection.Cost <= options.NotConnectible;
                    }
                  }
                });
  }
  database.Connections = std::move(table);
  return Result::Ok();
}

} // namespace waft
