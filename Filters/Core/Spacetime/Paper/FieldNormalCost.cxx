// SPDX-License-Identifier: BSD-3-Clause
// What the normal equations say of fields that are given: their cost, how it changes with them, and
// which of the vortices explain next to nothing.
#include "Spacetime/Paper/FieldNormal.h"

#include <cmath>

namespace waft
{

Eigen::VectorXd FieldNormal::CoefficientsOf(const AirFields& fields) const
{
  Eigen::VectorXd c = Eigen::VectorXd::Zero(this->Right.size());
  const std::size_t nodes = this->Lattice.NumberOfNodes();
  for (std::size_t k = 0; k < fields.Wind.Knots.size() && c.size() > 0; ++k)
  {
    for (std::size_t i = 0; i < 3 * nodes; ++i)
    {
      c[static_cast<Eigen::Index>(3 * nodes * k + i)] = fields.Wind.Knots[k][i / 3 * 4 + i % 3];
    }
  }
  return c;
}

Eigen::VectorXd FieldNormal::StrengthsOf(const AirFields& fields) const
{
  Eigen::VectorXd strengths(this->RightOfVortices.size());
  for (Eigen::Index n = 0; n < strengths.size(); ++n)
  {
    strengths[n] = fields.Vortices[static_cast<std::size_t>(n)].Strength;
  }
  return strengths;
}

void FieldNormal::Gradient(const Eigen::VectorXd& wind, const Eigen::VectorXd& strengths,
                           Eigen::VectorXd& byWind, Eigen::VectorXd& byStrength) const
{
  byWind = this->Beside * strengths - this->Right;
  byStrength =
    this->OfVortices * strengths + this->Beside.transpose() * wind - this->RightOfVortices;
  const Eigen::Index block = this->Knots > 0 ? this->Curl.rows() : 0;
  for (int k = 0; k < this->Knots; ++k)
  {
    const auto n = static_cast<std::size_t>(k);
    byWind.segment(k * block, block) +=
      this->Diagonal[n].OfVectors() * wind.segment(k * block, block);
    if (k + 1 < this->Knots)
    {
      const Sparse upper = this->Upper[n].OfVectors();
      byWind.segment(k * block, block) += upper * wind.segment((k + 1) * block, block);
      byWind.segment((k + 1) * block, block) += upper * wind.segment(k * block, block);
    }
  }
}

std::vector<int> FieldNormal::Idle(const AirFields& fields, double fraction) const
{
  const double least = -2.0 * fraction * this->Cost(fields);
  std::vector<int> ids;
  for (Eigen::Index n = 0; n < this->RightOfVortices.size(); ++n)
  {
    const Vortex& vortex = fields.Vortices[static_cast<std::size_t>(n)];
    if (vortex.Strength * vortex.Strength * this->OfVortices(n, n) < least)
    {
      ids.push_back(vortex.VortexId);
    }
  }
  return ids;
}

double FieldNormal::Cost(const AirFields& fields) const
{
  const Eigen::VectorXd wind = this->CoefficientsOf(fields);
  const Eigen::VectorXd strengths = this->StrengthsOf(fields);
  Eigen::VectorXd byWind, byStrength;
  this->Gradient(wind, strengths, byWind, byStrength);
  return 0.5 * (wind.dot(byWind - this->Right) + strengths.dot(byStrength - this->RightOfVortices));
}

double FieldNormal::ScaledGradient(const AirFields& fields, double energy) const
{
  Eigen::VectorXd byWind, byStrength;
  this->Gradient(this->CoefficientsOf(fields), this->StrengthsOf(fields), byWind, byStrength);
  double sum = 0.0;
  for (Eigen::Index n = 0; n < byStrength.size(); ++n)
  {
    sum += byStrength[n] * byStrength[n] / this->OfVortices(n, n);
  }
  const Sparse adjoint = this->Knots > 0 ? Sparse(this->Curl.transpose()) : Sparse();
  for (int k = 0; k < this->Knots; ++k)
  {
    const Eigen::VectorXd by = adjoint * byWind.segment(k * this->Curl.rows(), this->Curl.rows());
    const Eigen::SparseMatrix<double> product =
      this->Diagonal[static_cast<std::size_t>(k)].OfVectors() * this->Curl;
    for (Eigen::Index u = 0; u < by.size(); ++u)
    {
      const double second = adjoint.row(u).dot(product.col(u));
      sum += second > 0.0 ? by[u] * by[u] / second : 0.0;
    }
  }
  return std::sqrt(sum / (2.0 * energy));
}

} // namespace waft
