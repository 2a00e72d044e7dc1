// SPDX-License-Identifier: BSD-3-Clause
// Costs of an assignment that are squared distances, searched in k-d trees.
#pragma once

#include "Base/Types.h"
#include "Constraints/LeastCost.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace waft
{

/// Rows and columns at points. Rows of one kind see the columns alike: which of them they may take,
/// where those are, and the penalty of each. Memory and time of a price grow with the number of
/// kinds; the pairs are not stored.
///
/// A constant that all costs of a row or of a column share does not change who is nearest, once
/// prices make up for it. So the trees hold the points moved and stretched along each axis until
/// targets and columns lie in one cloud: with T and O from the means and any k, (T - O + s)^2 is
/// (k T - O / k)^2, and what depends on T or O alone. Prices are then small and nearly the same at
/// points that are near, which is what searches are fast by.
class NearestColumns : public ColumnSearch
{
public:
  struct Candidate
  {
    std::size_t Column = 0;
    Vec3 Position = Vec3::Zero();
    std::int64_t Penalty = 0;
  };
  struct Row
  {
    std::size_t Kind = 0;
    Vec3 Position = Vec3::Zero();
  };

  /// kinds: the columns that rows of each kind may take, each at most once.
  /// leftOut: cost of a row that takes none.
  NearestColumns(std::size_t columns, const RankedCost& leftOut,
                 std::vector<std::vector<Candidate>> kinds, std::vector<Row> rows);

  std::size_t Columns() const override { return this->ColumnCount; }
  const std::vector<RankedCost>& LeftOut() const override { return this->RowsLeftOut; }
  RankedCost Cost(std::size_t row, std::size_t column) const override;
  void Set(std::size_t column, const State& state) override;
  std::pair<ColumnOffer, ColumnOffer> Best(std::size_t row) const override;
  RankedCost FirstPrice(std::size_t column) const override;
  /// Squared diagonal of the box of all points as they are stretched.
  double Range() const override { return this->Spread; }

private:
  /// What a column takes off a distance, or the most that one below a node does.
  struct Worth
  {
    RankedCost Discount;
    bool IsFree = false;
    bool IsOpen = false;

    bool operator<(const Worth& other) const;
    bool operator==(const Worth& other) const { return !(*this < other) && !(other < *this); }
  };

  /// Nodes 2k + 1 and 2k + 2 are below node k; those of the last level are leaves.
  struct Tree
  {
    struct Node
    {
      Vec3 Low = Vec3::Zero();
      Vec3 High = Vec3::Zero();
      std::size_t Begin = 0, End = 0; // of Candidates
      Worth Most;
    };

    void Stretch(const std::vector<Vec3>& targets);
    double Spread(const std::vector<Vec3>& targets) const;
    Vec3 StretchTarget(const Vec3& target) const
    {
      return (target - this->TargetMean).cwiseProduct(this->TargetScale);
    }
    Vec3 StretchColumn(const Candidate& candidate) const
    {
      return (candidate.Position - this->ColumnMean).cwiseProduct(this->ColumnScale);
    }
    double RowConstant(const Vec3& target) const;
    double ColumnConstant(const Vec3& position) const;
    void Build(std::size_t columns);
    void Split(std::size_t node, std::size_t begin, std::size_t end);
    void Gather(std::size_t node); // Most from what is below
    void Set(std::size_t column, const State& state);
    void Search(std::size_t node, const Vec3& position,
                std::pair<ColumnOffer, ColumnOffer>& best) const;
    bool IsLeaf(std::size_t node) const { return 2 * node + 1 >= this->Nodes.size(); }
    /// No offer below the node can be before this one.
    ColumnOffer Bound(std::size_t node, const Vec3& position) const;

    std::vector<Candidate> Candidates; // ordered by leaves
    std::vector<Vec3> Points;          // of the candidates, stretched
    std::vector<RankedCost> Constants; // of the costs, by candidate
    Vec3 TargetMean = Vec3::Zero(), ColumnMean = Vec3::Zero();
    Vec3 TargetScale = Vec3::Zero(), ColumnScale = Vec3::Zero(); // k and 1 / k, 0: the axis is flat
    std::vector<Worth> Worths;
    std::vector<Node> Nodes;
    std::vector<std::size_t> CandidateOf, LeafOf; // by column
  };

  std::size_t ColumnCount = 0;
  std::vector<RankedCost> RowsLeftOut;
  std::vector<Row> Rows;
  std::vector<Tree> Trees; // by kind
  double Spread = 0.0;
};

} // namespace waft
