// SPDX-License-Identifier: BSD-3-Clause
// The assignment problem: rows take columns, each column one row, at the least total cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace waft
{

/// A cost of two ranks: the least sum of penalties comes first, whatever the amounts.
struct RankedCost
{
  std::int64_t Penalty = 0;
  double Amount = 0.0;

  /// Of a pair that is not allowed.
  static RankedCost Never() { return { 0, std::numeric_limits<double>::infinity() }; }
  bool IsAllowed() const { return this->Amount < std::numeric_limits<double>::infinity(); }
  RankedCost operator+(const RankedCost& other) const
  {
    return { this->Penalty + other.Penalty, this->Amount + other.Amount };
  }
  RankedCost operator-(const RankedCost& other) const
  {
    return { this->Penalty - other.Penalty, this->Amount - other.Amount };
  }
  bool operator<(const RankedCost& other) const
  {
    return this->Penalty < other.Penalty ||
           (this->Penalty == other.Penalty && this->Amount < other.Amount);
  }
};

struct AssignmentProblem
{
  /// leftOut: cost of a row that takes no column, for each row. Costs begin as not allowed.
  AssignmentProblem(std::size_t columns, std::vector<RankedCost> leftOut) :
    Columns(columns), LeftOut(std::move(leftOut)),
    Costs(this->LeftOut.size() * columns, RankedCost::Never())
  {
  }

  std::size_t Rows() const { return this->LeftOut.size(); }
  RankedCost& At(std::size_t row, std::size_t column)
  {
    return this->Costs[row * this->Columns + column];
  }
  const RankedCost& At(std::size_t row, std::size_t column) const
  {
    return this->Costs[row * this->Columns + column];
  }

  std::size_t Columns = 0;
  std::vector<RankedCost> LeftOut;
  std::vector<RankedCost> Costs; // [Rows * Columns], from 0 up
};

/// Column of each row in the assignment of least total cost (shortest augmenting paths, Jonker and
/// Volgenant 1987), -1 where a row is left out. Of equal ones always the same.
std::vector<int> AssignLeastCost(const AssignmentProblem& problem);

} // namespace waft
