// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Compression.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace waft
{

Eigen::MatrixXd SecondMoments(const Eigen::MatrixXd& columns)
{
  constexpr Eigen::Index block = 128;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(columns.rows(), columns.rows());
  for (Eigen::Index first = 0; first < columns.cols(); first += block)
  {
    const auto part = columns.middleCols(first, std::min(block, columns.cols() - first));
    sum.noalias() += part * part.transpose();
  }
  return sum;
}

Eigen::MatrixXd CompressSegments(const Eigen::MatrixXd& samples, double relativeError,
                                 SegmentGroup& group)
{
  const Eigen::Index size = samples.rows();
  group.NumberOfSamples = static_cast<int>(size / 3);
  group.Mean = samples.rowwise().mean();
  const Eigen::MatrixXd centered = samples.colwise() - group.Mean;

  // The left singular vectors are the eigenvectors of the small square matrix; squaring costs half
  // of the digits, which the stated error does not need: it is measured afterwards.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(SecondMoments(centered));
  const double all = samples.squaredNorm();
  const double allowed = relativeError * relativeError * all;
  double rest = axes.eigenvalues().cwiseMax(0.0).sum();
  Eigen::Index rank = 0;
  while (rank < size && rest > allowed && axes.eigenvalues()[size - 1 - rank] > 1e-14 * all)
  {
    rest -= axes.eigenvalues()[size - 1 - rank];
    ++rank;
  }
  group.Basis.resize(size, rank);
  for (Eigen::Index r = 0; r < rank; ++r)
  {
    Eigen::VectorXd direction = axes.eigenvectors().col(size - 1 - r);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    group.Basis.col(r) = direction[largest] < 0.0 ? Eigen::VectorXd(-direction) : direction;
  }
  const Eigen::MatrixXd coefficients = group.Basis.transpose() * centered;
  const double lost = (centered - group.Basis * coefficients).squaredNorm();
  group.RelativeError = all > 0.0 ? std::sqrt(lost / all) : 0.0;
  return coefficients;
}

} // namespace waft
