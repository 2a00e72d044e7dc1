// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Warp.h"

#include <Eigen/Dense>

#include <array>

namespace waft
{

namespace
{

/// Symmetric matrix of bandwidth 2, factored in place as L D L^T.
class Pentadiagonal
{
public:
  explicit Pentadiagonal(std::size_t size) : Bands(size, { 0.0, 0.0, 0.0 }) {}

  void Add(std::size_t i, std::size_t j, double value)
  {
    this->Bands[std::max(i, j)][std::max(i, j) - std::min(i, j)] += value;
  }
  void Factor()
  {
    const std::size_t n = this->Bands.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      auto& row = this->Bands[i];
      double l2 = 0.0;
      if (i >= 2)
      {
        l2 = row[2] / this->Bands[i - 2][0];
        row[0] -= l2 * row[2];
      }
      if (i >= 1)
      {
        const double coupling = i >= 2 ? l2 * this->Bands[i - 1][1] * this->Bands[i - 2][0] : 0.0;
        const double l1 = (row[1] - coupling) / this->Bands[i - 1][0];
        row[0] -= l1 * (row[1] - coupling);
        row[1] = l1;
      }
      row[2] = l2;
    }
  }
  template <typename T>
  void Solve(std::vector<T>& b) const
  {
    const std::size_t n = this->Bands.size();
    for (std::size_t i = 1; i < n; ++i)
    {
      b[i] -= this->Bands[i][1] * b[i - 1];
      if (i >= 2)
      {
        b[i] -= this->Bands[i][2] * b[i - 2];
      }
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      b[i] /= this->Bands[i][0];
    }
    for (std::size_t i = n; i-- > 0;)
    {
      if (i + 1 < n)
      {
        b[i] -= this->Bands[i + 1][1] * b[i + 1];
      }
      if (i + 2 < n)
      {
        b[i] -= this->Bands[i + 2][2] * b[i + 2];
      }
    }
  }

private:
  std::vector<std::array<double, 3>> Bands; // [i]: (i,i), (i,i-1), (i,i-2)
};

constexpr std::array<double, 3> Stencil{ 1.0, -2.0, 1.0 };

/// The samples that are sought.
struct Unknowns
{
  std::vector<int> IndexOf; // by sample; -1: fixed
  std::vector<std::size_t> Frames;
};

Unknowns UnknownsOf(const WarpProblem& problem)
{
  Unknowns unknowns;
  unknowns.IndexOf.assign(problem.IsFixed.size(), -1);
  for (std::size_t k = 0; k < problem.IsFixed.size(); ++k)
  {
    if (problem.IsFixed[k] == 0)
    {
      unknowns.IndexOf[k] = static_cast<int>(unknowns.Frames.size());
      unknowns.Frames.push_back(k);
    }
  }
  return unknowns;
}

void AddStiffness(const WarpProblem& problem, const std::vector<int>& unknown,
                  Pentadiagonal& matrix, std::vector<Vec3>& right)
{
  for (std::size_t k = 1; k + 1 < unknown.size(); ++k)
  {
    const double weight = problem.StiffnessWeights.empty() ? 1.0 : problem.StiffnessWeights[k];
    Vec3 target = problem.SecondDifferences[k];
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (unknown[k - 1 + i] < 0)
      {
        target -= Stencil[i] * problem.Fixed[k - 1 + i];
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      const int row = unknown[k - 1 + i];
      if (row < 0)
      {
        continue;
      }
      right[row] += weight * Stencil[i] * target;
      for (std::size_t j = 0; j <= i; ++j)
      {
        const int column = unknown[k - 1 + j];
        if (column >= 0)
        {
          matrix.Add(row, column, weight * Stencil[i] * Stencil[j]);
        }
      }
    }
  }
}

void AddSoft(const WarpProblem& problem, const std::vector<int>& unknown, Pentadiagonal& matrix,
             std::vector<Vec3>& right)
{
  for (const SoftMark& mark : problem.Soft)
  {
    const int row = unknown[mark.Frame];
    if (row >= 0)
    {
      matrix.Add(row, row, mark.Weight);
      right[row] += mark.Weight * mark.Value;
    }
  }
}

/// A least-squares solution that does not depend on the rows' units.
Eigen::MatrixXd SolveBalanced(const Eigen::MatrixXd& schur, const Eigen::MatrixXd& gap)
{
  const Eigen::Index rows = schur.rows();
  Eigen::VectorXd scale(rows);
  for (Eigen::Index r = 0; r < rows; ++r)
  {
    scale(r) = schur(r, r) > 0.0 ? 1.0 / std::sqrt(schur(r, r)) : 0.0;
  }
  const Eigen::MatrixXd balanced = scale.asDiagonal() * schur * scale.asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(balanced);
  return scale.asDiagonal() * solver.solve(Eigen::MatrixXd(scale.asDiagonal() * gap));
}

/// Linear rows by the Schur complement: x = x0 + H^-1 A^T (A H^-1 A^T)^-1 (b - A x0). matrix: H,
/// factored; x: x0 on entry.
void ImposeRows(const WarpProblem& problem, const std::vector<int>& unknown,
                const Pentadiagonal& matrix, std::vector<Vec3>& x)
{
  const auto rows = static_cast<Eigen::Index>(problem.Rows.size());
  if (rows == 0)
  {
    return;
  }
  std::vector<std::vector<double>> columns(problem.Rows.size());
  Eigen::MatrixXd schur(rows, rows);
  Eigen::MatrixXd gap(rows, 3);
  for (Eigen::Index r = 0; r < rows; ++r)
  {
    const LinearRow& row = problem.Rows[r];
    std::vector<double>& column = columns[r];
    column.assign(x.size(), 0.0);
    Vec3 value = row.Value;
    for (std::size_t i = 0; i < row.Frames.size(); ++i)
    {
      const int index = unknown[row.Frames[i]];
      if (index >= 0)
      {
        column[index] += row.Weights[i];
        value -= row.Weights[i] * x[index];
      }
      else
      {
        value -= row.Weights[i] * problem.Fixed[row.Frames[i]];
      }
    }
    matrix.Solve(column);
    gap.row(r) = value.transpose();
  }
  for (Eigen::Index r = 0; r < rows; ++r)
  {
    for (Eigen::Index c = 0; c < rows; ++c)
    {
      double sum = 0.0;
      for (std::size_t i = 0; i < problem.Rows[r].Frames.size(); ++i)
      {
        const int index = unknown[problem.Rows[r].Frames[i]];
        sum += index >= 0 ? problem.Rows[r].Weights[i] * columns[c][index] : 0.0;
      }
      schur(r, c) = sum;
    }
  }
  const Eigen::MatrixXd multipliers = SolveBalanced(schur, gap);
  for (Eigen::Index r = 0; r < rows; ++r)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      x[i] += columns[r][i] * multipliers.row(r).transpose();
    }
  }
}

} // namespace

std::vector<Vec3> SecondDifferences(const std::vector<Vec3>& positions)
{
  std::vector<Vec3> result(positions.size(), Vec3::Zero());
  for (std::size_t k = 1; k + 1 < positions.size(); ++k)
  {
    result[k] = positions[k - 1] - 2.0 * positions[k] + positions[k + 1];
  }
  return result;
}

std::vector<Vec3> SolveWarp(const WarpProblem& problem)
{
  const Unknowns unknowns = UnknownsOf(problem);
  const std::vector<std::size_t>& frames = unknowns.Frames;
  std::vector<Vec3> x = problem.Fixed;
  if (frames.empty())
  {
    return x;
  }
  Pentadiagonal matrix(frames.size());
  std::vector<Vec3> right(frames.size(), Vec3::Zero());
  if (problem.IsFixed.size() - frames.size() < 2)
  {
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      matrix.Add(i, i, 1e-13); // two marks at least hold a path where it is
    }
  }
  AddStiffness(problem, unknowns.IndexOf, matrix, right);
  AddSoft(problem, unknowns.IndexOf, matrix, right);
  matrix.Factor();
  matrix.Solve(right);
  ImposeRows(problem, unknowns.IndexOf, matrix, right);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    x[frames[i]] = right[i];
  }
  return x;
}

} // namespace waft
