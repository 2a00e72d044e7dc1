// SPDX-License-Identifier: BSD-3-Clause
// The assignment of least cost by shortest augmenting paths over a table of all pairs: rows^2 times
// columns. What is faster is held against it.
#pragma once

#include "Constraints/LeastCost.h"

namespace waft::test
{

/// Rows are taken in one after the other, each along the cheapest path of columns that change
/// hands. Prices keep the cost of every pair, less both prices, from zero up, and zero where a row
/// has its column. Being left out is a column of the row's own, of which the price stays zero.
class PlainAssignment
{
public:
  explicit PlainAssignment(const AssignmentProblem& problem) :
    Problem(problem), RowPrices(problem.Rows()), ColumnPrices(problem.Columns),
    RowOf(problem.Columns, None), ColumnOf(problem.Rows(), None)
  {
  }

  std::vector<int> Run()
  {
    for (std::size_t row = 0; row < this->Problem.Rows(); ++row)
    {
      this->TakeIn(row);
    }
    std::vector<int> result;
    for (const std::size_t column : this->ColumnOf)
    {
      result.push_back(column == None ? -1 : static_cast<int>(column));
    }
    return result;
  }

private:
  static constexpr std::size_t None = static_cast<std::size_t>(-1);

  void TakeIn(std::size_t start)
  {
    const std::size_t columns = this->Problem.Columns;
    std::vector<RankedCost> shortest(columns, RankedCost::Never());
    std::vector<std::size_t> from(columns, None); // the column before on the path
    std::vector<char> isDone(columns, 0);
    RankedCost distance;
    RankedCost leaving = RankedCost::Never(); // of the path on which a row is left out
    std::size_t left = None;
    std::size_t sink = None; // a free column
    for (std::size_t row = start, last = None; sink == None;)
    {
      const RankedCost out = distance + this->Problem.LeftOut[row] - this->RowPrices[row];
      if (left == None || out < leaving)
      {
        leaving = out;
        left = row;
      }
      std::size_t nearest = None;
      for (std::size_t c = 0; c < columns; ++c)
      {
        if (isDone[c] != 0)
        {
          continue;
        }
        const RankedCost& cost = this->Problem.At(row, c);
        if (cost.IsAllowed())
        {
          const RankedCost reduced = distance + cost - this->RowPrices[row] - this->ColumnPrices[c];
          if (!shortest[c].IsAllowed() || reduced < shortest[c])
          {
            shortest[c] = reduced;
            from[c] = last;
          }
        }
        if (shortest[c].IsAllowed() && (nearest == None || shortest[c] < shortest[nearest]))
        {
          nearest = c;
        }
      }
      if (nearest == None || leaving < shortest[nearest])
      {
        break;
      }
      distance = shortest[nearest];
      isDone[nearest] = 1;
      last = nearest;
      row = this->RowOf[nearest];
      sink = row == None ? nearest : None;
    }
    const RankedCost total = sink == None ? leaving : distance;
    this->RowPrices[start] = this->RowPrices[start] + total;
    for (std::size_t c = 0; c < columns; ++c)
    {
      if (isDone[c] != 0 && c != sink)
      {
        const RankedCost change = total - shortest[c];
        this->RowPrices[this->RowOf[c]] = this->RowPrices[this->RowOf[c]] + change;
        this->ColumnPrices[c] = this->ColumnPrices[c] - change;
      }
    }
    std::size_t column = sink;
    if (sink == None)
    {
      column = this->ColumnOf[left];
      this->ColumnOf[left] = None;
    }
    while (column != None)
    {
      const std::size_t before = from[column];
      const std::size_t row = before == None ? start : this->RowOf[before];
      this->RowOf[column] = row;
      this->ColumnOf[row] = column;
      column = before;
    }
  }

  const AssignmentProblem& Problem;
  std::vector<RankedCost> RowPrices, ColumnPrices;
  std::vector<std::size_t> RowOf, ColumnOf;
};

} // namespace waft::test
