// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/NearestColumns.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace waft
{

namespace
{

constexpr std::size_t LeafSize = 8;

/// Mean and standard deviation along each axis, the latter exactly zero where all are the same.
std::pair<Vec3, Vec3> Distribution(const std::vector<Vec3>& points)
{
  Vec3 mean = Vec3::Zero();
  Vec3 width = Vec3::Zero();
  for (const Vec3& point : points)
  {
    mean += (point - points[0]) / double(points.size());
  }
  mean += points.empty() ? Vec3::Zero() : points[0];
  for (const Vec3& point : points)
  {
    width += (point - mean).cwiseAbs2() / double(points.size());
  }
  return { mean, width.cwiseSqrt() };
}

} // namespace

bool NearestColumns::Worth::operator<(const Worth& other) const
{
  const auto key = [](const Worth& worth)
  { return std::tuple(worth.IsOpen, worth.Discount.Penalty, worth.Discount.Amount, worth.IsFree); };
  return key(*this) < key(other);
}

void NearestColumns::Tree::Stretch(const std::vector<Vec3>& targets)
{
  std::vector<Vec3> columns;
  for (const Candidate& candidate : this->Candidates)
  {
    columns.push_back(candidate.Position);
  }
  const auto [targetMean, targetWidth] = Distribution(targets);
  const auto [columnMean, columnWidth] = Distribution(columns);
  this->TargetMean = targetMean;
  this->ColumnMean = columnMean;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (targetWidth[axis] > 0.0 && columnWidth[axis] > 0.0)
    {
      this->TargetScale[axis] = std::sqrt(columnWidth[axis] / targetWidth[axis]);
      this->ColumnScale[axis] = 1.0 / this->TargetScale[axis];
    }
  }
}

double NearestColumns::Tree::RowConstant(const Vec3& target) const
{
  const Vec3 own = target - this->TargetMean;
  return (own + this->TargetMean - this->ColumnMean).squaredNorm() -
         this->StretchTarget(target).squaredNorm();
}

double NearestColumns::Tree::ColumnConstant(const Vec3& position) const
{
  const Vec3 own = position - this->ColumnMean;
  return own.squaredNorm() - 2.0 * own.dot(this->TargetMean - this->ColumnMean) -
         own.cwiseProduct(this->ColumnScale).squaredNorm();
}

double NearestColumns::Tree::Spread(const std::vector<Vec3>& targets) const
{
  if (this->Candidates.empty() || targets.empty())
  {
    return 0.0;
  }
  Vec3 low = this->Nodes[0].Low;
  Vec3 high = this->Nodes[0].High;
  for (const Vec3& target : targets)
  {
    low = low.cwiseMin(this->StretchTarget(target));
    high = high.cwiseMax(this->StretchTarget(target));
  }
  return (high - low).squaredNorm();
}

void NearestColumns::Tree::Build(std::size_t columns)
{
  this->CandidateOf.assign(columns, ColumnOffer::None);
  this->LeafOf.assign(columns, ColumnOffer::None);
  std::size_t leaves = 1;
  while (leaves * LeafSize < this->Candidates.size())
  {
    leaves *= 2;
  }
  this->Nodes.resize(2 * leaves - 1);
  this->Worths.resize(this->Candidates.size());
  this->Split(0, 0, this->Candidates.size());
  for (std::size_t p = 0; p < this->Candidates.size(); ++p)
  {
    const Candidate& candidate = this->Candidates[p];
    this->CandidateOf[candidate.Column] = p;
    this->Points.push_back(this->StretchColumn(candidate));
    this->Constants.push_back({ candidate.Penalty, this->ColumnConstant(candidate.Position) });
    this->Worths[p] = { RankedCost() - this->Constants[p], true, true };
  }
  for (std::size_t node = this->Nodes.size(); node-- > 0;)
  {
    this->Gather(node);
  }
}

void NearestColumns::Tree::Split(std::size_t node, std::size_t begin, std::size_t end)
{
  Node& own = this->Nodes[node];
  own.Begin = begin;
  own.End = end;
  if (begin < end)
  {
    own.Low = own.High = this->StretchColumn(this->Candidates[begin]);
  }
  for (std::size_t p = begin; p < end; ++p)
  {
    own.Low = own.Low.cwiseMin(this->StretchColumn(this->Candidates[p]));
    own.High = own.High.cwiseMax(this->StretchColumn(this->Candidates[p]));
  }
  if (this->IsLeaf(node))
  {
    for (std::size_t p = begin; p < end; ++p)
    {
      this->LeafOf[this->Candidates[p].Column] = node;
    }
    return;
  }
  int axis = 0;
  (own.High - own.Low).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  // By column among equals: the order is the same on every machine.
  std::sort(this->Candidates.begin() + std::ptrdiff_t(begin),
            this->Candidates.begin() + std::ptrdiff_t(end),
            [axis](const Candidate& a, const Candidate& b) {
              return std::pair(a.Position[axis], a.Column) < std::pair(b.Position[axis], b.Column);
            });
  this->Split(2 * node + 1, begin, middle);
  this->Split(2 * node + 2, middle, end);
}

void NearestColumns::Tree::Gather(std::size_t node)
{
  Node& own = this->Nodes[node];
  if (!this->IsLeaf(node))
  {
    own.Most = std::max(this->Nodes[2 * node + 1].Most, this->Nodes[2 * node + 2].Most);
    return;
  }
  own.Most = Worth();
  for (std::size_t p = own.Begin; p < own.End; ++p)
  {
    own.Most = std::max(own.Most, this->Worths[p]);
  }
}

void NearestColumns::Tree::Set(std::size_t column, const State& state)
{
  const std::size_t p = this->CandidateOf[column];
  if (p == ColumnOffer::None)
  {
    return;
  }
  this->Worths[p] = { state.Price - this->Constants[p], !state.IsTaken, !state.IsClosed };
  for (std::size_t node = this->LeafOf[column];; node = (node - 1) / 2)
  {
    const Worth before = this->Nodes[node].Most;
    this->Gather(node);
    if (node == 0 || this->Nodes[node].Most == before)
    {
      return;
    }
  }
}

ColumnOffer NearestColumns::Tree::Bound(std::size_t node, const Vec3& position) const
{
  const Node& own = this->Nodes[node];
  ColumnOffer bound;
  if (own.Most.IsOpen)
  {
    const Vec3 outside = (own.Low - position).cwiseMax(position - own.High).cwiseMax(0.0);
    bound.Column = own.Begin;
    bound.Cost = RankedCost{ 0, outside.squaredNorm() } - own.Most.Discount;
    bound.IsTaken = !own.Most.IsFree;
  }
  return bound;
}

void NearestColumns::Tree::Search(std::size_t node, const Vec3& position,
                                  std::pair<ColumnOffer, ColumnOffer>& best) const
{
  if (this->IsLeaf(node))
  {
    const Node& own = this->Nodes[node];
    for (std::size_t p = own.Begin; p < own.End; ++p)
    {
      const Worth& worth = this->Worths[p];
      if (!worth.IsOpen)
      {
        continue;
      }
      const double distance = (position - this->Points[p]).squaredNorm();
      const ColumnOffer offer{ this->Candidates[p].Column,
                               RankedCost{ 0, distance } - worth.Discount, !worth.IsFree };
      if (offer.IsBefore(best.first))
      {
        best = { offer, best.first };
      }
      else if (offer.IsBefore(best.second))
      {
        best.second = offer;
      }
    }
    return;
  }
  std::size_t near = 2 * node + 1;
  std::size_t far = near + 1;
  ColumnOffer nearBound = this->Bound(near, position);
  ColumnOffer farBound = this->Bound(far, position);
  if (farBound.Exists() && farBound.IsBefore(nearBound))
  {
    std::swap(near, far);
    std::swap(nearBound, farBound);
  }
  if (nearBound.Exists() && nearBound.IsBefore(best.second))
  {
    this->Search(near, position, best);
  }
  if (farBound.Exists() && farBound.IsBefore(best.second))
  {
    this->Search(far, position, best);
  }
}

NearestColumns::NearestColumns(std::size_t columns, const RankedCost& leftOut,
                               std::vector<std::vector<Candidate>> kinds, std::vector<Row> rows) :
  ColumnCount(columns),
  RowsLeftOut(rows.size(), leftOut), Rows(std::move(rows)), Trees(kinds.size())
{
  for (std::size_t k = 0; k < kinds.size(); ++k)
  {
    std::vector<Vec3> targets;
    for (const Row& row : this->Rows)
    {
      if (row.Kind == k)
      {
        targets.push_back(row.Position);
      }
    }
    Tree& tree = this->Trees[k];
    tree.Candidates = std::move(kinds[k]);
    tree.Stretch(targets);
    tree.Build(columns);
    this->Spread = std::max(this->Spread, tree.Spread(targets));
  }
}

RankedCost NearestColumns::Cost(std::size_t row, std::size_t column) const
{
  const Tree& tree = this->Trees[this->Rows[row].Kind];
  const std::size_t p = tree.CandidateOf[column];
  return p == ColumnOffer::None
           ? RankedCost::Never()
           : RankedCost{ tree.Candidates[p].Penalty,
                         (this->Rows[row].Position - tree.Candidates[p].Position).squaredNorm() };
}

void NearestColumns::Set(std::size_t column, const State& state)
{
  for (Tree& tree : this->Trees)
  {
    tree.Set(column, state);
  }
}

std::pair<ColumnOffer, ColumnOffer> NearestColumns::Best(std::size_t row) const
{
  const Row& own = this->Rows[row];
  const Tree& tree = this->Trees[own.Kind];
  std::pair<ColumnOffer, ColumnOffer> best;
  tree.Search(0, tree.StretchTarget(own.Position), best);
  const RankedCost constant{ 0, tree.RowConstant(own.Position) };
  best.first.Cost = best.first.Cost + constant;
  best.second.Cost = best.second.Cost + constant;
  return best;
}

/// What makes up for the column's constant, as the first rows see it.
RankedCost NearestColumns::FirstPrice(std::size_t column) const
{
  const Tree& tree = this->Trees[0];
  const std::size_t p = tree.CandidateOf[column];
  return p == ColumnOffer::None ? RankedCost() : RankedCost{ 0, tree.Constants[p].Amount };
}

} // namespace waft
