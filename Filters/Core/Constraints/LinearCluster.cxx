// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LinearCluster.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <map>
#include <set>

namespace waft
{
namespace
{

constexpr int ProjectionSweeps = 200; // alternating between exact rows and balls

} // namespace

LinearCluster::LinearCluster(std::size_t object, const std::vector<const DifferenceRow*>& rows,
                             const std::vector<PositionBall>& balls, const FixedAt& fixedAt) :
  Owner(object)
{
  std::set<int> frames;
  for (const DifferenceRow* row : rows)
  {
    for (const DifferenceRow::Term& term : row->Terms)
    {
      if (fixedAt(term.Frame, object) == nullptr)
      {
        frames.insert(term.Frame);
      }
    }
  }
  this->FreeFrames.assign(frames.begin(), frames.end());
  std::map<int, int> index;
  for (std::size_t k = 0; k < this->FreeFrames.size(); ++k)
  {
    index[this->FreeFrames[k]] = static_cast<int>(k);
  }
  const auto n = static_cast<Eigen::Index>(this->FreeFrames.size());
  std::vector<BallRow> exact;
  for (const DifferenceRow* row : rows)
  {
    BallRow ball{ Eigen::RowVectorXd::Zero(n), row->Value.transpose(), row->Radius };
    for (const DifferenceRow::Term& term : row->Terms)
    {
      const auto found = index.find(term.Frame);
      if (found != index.end())
      {
        ball.Coefficients[found->second] += term.Coefficient;
      }
      else
      {
        ball.Value -= term.Coefficient * fixedAt(term.Frame, object)->transpose();
      }
    }
    (row->Radius > 0.0 ? this->BallRows : exact).push_back(ball);
  }
  this->Exact.resize(static_cast<Eigen::Index>(exact.size()), n);
  this->ExactValues.resize(static_cast<Eigen::Index>(exact.size()), 3);
  for (std::size_t r = 0; r < exact.size(); ++r)
  {
    this->Exact.row(r) = exact[r].Coefficients;
    this->ExactValues.row(r) = exact[r].Value;
  }
  if (!exact.empty() && n > 0)
  {
    this->Inverse = this->Exact.completeOrthogonalDecomposition().pseudoInverse();
  }
  for (const PositionBall& ball : balls)
  {
    const auto found = index.find(ball.Frame);
    if (ball.Object == object && found != index.end())
    {
      this->BallPoints.push_back({ found->second, ball.Center.transpose(), ball.Radius });
    }
  }
}

void LinearCluster::ProjectExact(Eigen::MatrixX3d& x) const
{
  if (this->Inverse.size() > 0)
  {
    x -= this->Inverse * (this->Exact * x - this->ExactValues);
  }
}

void LinearCluster::Project(Eigen::MatrixX3d& x) const
{
  this->ProjectExact(x);
  for (int sweep = 0; sweep < ProjectionSweeps; ++sweep)
  {
    bool moved = false;
    for (const BallRow& row : this->BallRows)
    {
      const Eigen::RowVector3d miss = row.Coefficients * x - row.Value;
      const double size = row.Coefficients.squaredNorm();
      const double limit = row.Radius * (1.0 - 1e-7);
      if (miss.norm() > row.Radius && size > 0.0)
      {
        x += row.Coefficients.transpose() * ((limit / miss.norm() - 1.0) / size * miss);
        moved = true;
      }
    }
    for (const BallPoint& ball : this->BallPoints)
    {
      const Eigen::RowVector3d d = x.row(ball.Index) - ball.Center;
      if (d.norm() > ball.Radius)
      {
        x.row(ball.Index) = ball.Center + (ball.Radius * (1.0 - 1e-7) / d.norm()) * d;
        moved = true;
      }
    }
    if (!moved)
    {
      return;
    }
    this->ProjectExact(x);
  }
}

void LinearCluster::ProjectTangent(Eigen::MatrixX3d& change) const
{
  if (this->Inverse.size() > 0)
  {
    change -= this->Inverse * (this->Exact * change);
  }
}

double LinearCluster::Violation(const Eigen::MatrixX3d& x) const
{
  double largest = 0.0;
  if (this->Exact.size() > 0)
  {
    largest = (this->Exact * x - this->ExactValues).rowwise().norm().maxCoeff();
  }
  for (const BallRow& row : this->BallRows)
  {
    largest = std::max(largest, (row.Coefficients * x - row.Value).norm() - row.Radius);
  }
  for (const BallPoint& ball : this->BallPoints)
  {
    largest = std::max(largest, (x.row(ball.Index) - ball.Center).norm() - ball.Radius);
  }
  return largest;
}

std::vector<LinearCluster> MakeClusters(const std::vector<DifferenceRow>& rows,
                                        const std::vector<PositionBall>& balls,
                                        const FixedAt& fixedAt, const std::vector<bool>& hasFrame)
{
  // Rows of one object by their first frame; a row joins the cluster before it when they have a
  // free frame.
  std::map<std::size_t, std::vector<const DifferenceRow*>> byObject;
  for (const DifferenceRow& row : rows)
  {
    const bool complete =
      std::all_of(row.Terms.begin(), row.Terms.end(),
                  [&](const DifferenceRow::Term& term) { return bool(hasFrame[term.Frame]); });
    if (complete)
    {
      byObject[row.Object].push_back(&row);
    }
  }
  const auto lastFrame = [](const DifferenceRow* row)
  {
    int last = 0;
    for (const DifferenceRow::Term& term : row->Terms)
    {
      last = std::max(last, term.Frame);
    }
    return last;
  };
  const auto firstFrame = [](const DifferenceRow* row)
  {
    int first = row->Terms.front().Frame;
    for (const DifferenceRow::Term& term : row->Terms)
    {
      first = std::min(first, term.Frame);
    }
    return first;
  };
  std::vector<LinearCluster> clusters;
  for (auto& [object, own] : byObject)
  {
    std::stable_sort(own.begin(), own.end(),
                     [&](const DifferenceRow* a, const DifferenceRow* b)
                     { return firstFrame(a) < firstFrame(b); });
    std::vector<const DifferenceRow*> group;
    int last = -1;
    for (const DifferenceRow* row : own)
    {
      if (!group.empty() && firstFrame(row) > last)
      {
        clusters.emplace_back(object, group, balls, fixedAt);
        group.clear();
      }
      last = group.empty() ? lastFrame(row) : std::max(last, lastFrame(row));
      group.push_back(row);
    }
    if (!group.empty())
    {
      clusters.emplace_back(object, group, balls, fixedAt);
    }
  }
  return clusters;
}

} // namespace waft
