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

/// A column as a row sees it that looks for one.
struct ColumnOffer
{
  static constexpr std::size_t None = static_cast<std::size_t>(-1);

  std::size_t Column = None;
  RankedCost Cost; // less the column's price
  bool IsTaken = true;

  bool Exists() const { return this->Column != None; }
  /// Cheaper, or of the same cost and free.
  bool IsBefore(const ColumnOffer& other) const
  {
    return !other.Exists() || this->Cost < other.Cost ||
           (!(other.Cost < this->Cost) && !this->IsTaken && other.IsTaken);
  }
};

/// What a row may take at which cost, searched under the prices of now. A problem is a class of
/// this kind; it need not hold the cost of each pair.
class ColumnSearch
{
public:
  /// The price is subtracted from the costs of the column. A closed column is not offered.
  struct State
  {
    RankedCost Price; // zero or less
    bool IsTaken = false;
    bool IsClosed = false;
  };

  virtual ~ColumnSearch() = default;
  virtual std::size_t Columns() const = 0;
  /// Cost of each row that takes no column.
  virtual const std::vector<RankedCost>& LeftOut() const = 0;
  virtual RankedCost Cost(std::size_t row, std::size_t column) const = 0;
  virtual void Set(std::size_t column, const State& state) = 0;
  /// The best and second best for a row, of equal ones always the same.
  virtual std::pair<ColumnOffer, ColumnOffer> Best(std::size_t row) const = 0;
  /// How far amounts of allowed pairs may lie apart. With more than zero, rows first bid for
  /// columns (which pays where many prices are to be found), and where that ends is made exact.
  virtual double Range() const { return 0.0; }
  /// A guess at a price, but for a constant, with which such bidding begins.
  virtual RankedCost FirstPrice(std::size_t /*column*/) const { return RankedCost(); }
};

struct Assignment
{
  std::vector<int> ColumnOf; // of each row, -1: left out
  RankedCost Cost;
  /// The dual sum: what any assignment costs at least. It equals Cost, but for rounding.
  RankedCost Bound;
};

/// The assignment of least total cost: an auction (Bertsekas 1988) for prices to begin with, then
/// shortest augmenting paths (Jonker and Volgenant 1987) over all pairs, each pair looked at only
/// when its turn may have come. The columns of the search are left with their last states.
Assignment AssignLeastCost(ColumnSearch& search);

/// Few rows and columns, the cost of each pair stated.
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

/// Column of each row in the assignment of least total cost, -1 where a row is left out.
std::vector<int> AssignLeastCost(const AssignmentProblem& problem);

} // namespace waft
