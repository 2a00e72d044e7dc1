// SPDX-License-Identifier: BSD-3-Clause
// Which rows of a list are whose: looked up, where to go through the list for each object would
// take the square of their number.
#pragma once

#include "Constraints/Constraint.h"

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace waft
{

class RowsOfObjects
{
public:
  explicit RowsOfObjects(const std::vector<Constraint>& rows)
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      this->Places[rows[i].ObjectId].push_back(i);
    }
  }

  /// Their places in the list, in its order.
  const std::vector<std::size_t>& Of(int objectId) const
  {
    static const std::vector<std::size_t> none;
    const auto found = this->Places.find(objectId);
    return found != this->Places.end() ? found->second : none;
  }

private:
  std::unordered_map<int, std::vector<std::size_t>> Places;
};

} // namespace waft
