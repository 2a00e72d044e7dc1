// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Assignment.h"

#include <limits>

namespace waft
{

std::vector<std::size_t> LeastCostAssignment(const std::vector<std::vector<double>>& costs)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t rows = costs.size();
  const std::size_t columns = rows == 0 ? 0 : costs.front().size();
  // Row and column 0 are the root of the paths; prices keep every reduced cost at or above zero.
  std::vector<double> rowPrice(rows + 1, 0.0);
  std::vector<double> columnPrice(columns + 1, 0.0);
  std::vector<std::size_t> rowOf(columns + 1, 0);
  std::vector<std::size_t> previous(columns + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row)
  {
    rowOf[0] = row;
    std::size_t column = 0;
    std::vector<double> least(columns + 1, infinity);
    std::vector<char> done(columns + 1, 0);
    do
    {
      done[column] = 1;
      const std::size_t from = rowOf[column];
      double step = infinity;
      std::size_t next = 0;
      for (std::size_t c = 1; c <= columns; ++c)
      {
        if (done[c])
        {
          continue;
        }
        const double reduced = costs[from - 1][c - 1] - rowPrice[from] - columnPrice[c];
        if (reduced < least[c])
        {
          least[c] = reduced;
          previous[c] = column;
        }
        if (least[c] < step)
        {
          step = least[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= columns; ++c)
      {
        if (done[c])
        {
          rowPrice[rowOf[c]] += step;
          columnPrice[c] -= step;
        }
        else
        {
          least[c] -= step;
        }
      }
      column = next;
    } while (rowOf[column] != 0);
    while (column != 0)
    {
      rowOf[column] = rowOf[previous[column]];
      column = previous[column];
    }
  }
  std::vector<std::size_t> columnOf(rows, 0);
  for (std::size_t c = 1; c <= columns; ++c)
  {
    if (rowOf[c] != 0)
    {
      columnOf[rowOf[c] - 1] = c - 1;
    }
  }
  return columnOf;
}

} // namespace waft
