// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/CurlPotential.h"

namespace waft
{

CurlPotential::CurlPotential(const SplineWind& shape, int knots) : Shape(shape), Knots(knots)
{
  this->Shape.Knots.clear();
}

Eigen::Index CurlPotential::NumberOfUnknowns() const
{
  return static_cast<Eigen::Index>(this->UnknownsPerKnot()) * this->Knots;
}

Eigen::Index CurlPotential::NumberOfCoefficients() const
{
  return static_cast<Eigen::Index>(3 * this->Shape.NumberOfNodes()) * this->Knots;
}

void CurlPotential::Curl(const Eigen::VectorXd& unknown, Eigen::VectorXd& c) const
{
  const auto& n = this->Shape.Dimensions;
  c.resize(this->NumberOfCoefficients());
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    const double* a = unknown.data() + knot * this->UnknownsPerKnot();
    const double* mean = a + 3 * this->OuterNodes();
    const auto slope = [&](int component, int axis, int i, int j, int k)
    {
      const int d[3] = { axis == 0, axis == 1, axis == 2 };
      return (a[3 * this->Outer(i + d[0], j + d[1], k + d[2]) + component] -
              a[3 * this->Outer(i - d[0], j - d[1], k - d[2]) + component]) *
             0.5 / this->Shape.Spacing[axis];
    };
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          double* out =
            c.data() + 3 * (knot * this->Shape.NumberOfNodes() + this->Shape.Node(i, j, k));
          out[0] = mean[0] + slope(2, 1, i, j, k) - slope(1, 2, i, j, k);
          out[1] = mean[1] + slope(0, 2, i, j, k) - slope(2, 0, i, j, k);
          out[2] = mean[2] + slope(1, 0, i, j, k) - slope(0, 1, i, j, k);
        }
      }
    }
  }
}

void CurlPotential::Adjoint(const Eigen::VectorXd& c, Eigen::VectorXd& unknown) const
{
  const auto& n = this->Shape.Dimensions;
  unknown.setZero(this->NumberOfUnknowns());
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    double* a = unknown.data() + knot * this->UnknownsPerKnot();
    double* mean = a + 3 * this->OuterNodes();
    const auto spread = [&](int component, int axis, int i, int j, int k, double value)
    {
      const int d[3] = { axis == 0, axis == 1, axis == 2 };
      const double part = value * 0.5 / this->Shape.Spacing[axis];
      a[3 * this->Outer(i + d[0], j + d[1], k + d[2]) + component] += part;
      a[3 * this->Outer(i - d[0], j - d[1], k - d[2]) + component] -= part;
    };
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          const double* in =
            c.data() + 3 * (knot * this->Shape.NumberOfNodes() + this->Shape.Node(i, j, k));
          for (int axis = 0; axis < 3; ++axis)
          {
            mean[axis] += in[axis];
          }
          spread(2, 1, i, j, k, in[0]);
          spread(1, 2, i, j, k, -in[0]);
          spread(0, 2, i, j, k, in[1]);
          spread(2, 0, i, j, k, -in[1]);
          spread(1, 0, i, j, k, in[2]);
          spread(0, 1, i, j, k, -in[2]);
        }
      }
    }
  }
}

Eigen::VectorXd CurlPotential::Scale() const
{
  const std::size_t per = this->UnknownsPerKnot();
  Eigen::VectorXd scale =
    Eigen::VectorXd::Constant(this->NumberOfUnknowns(), this->Shape.Spacing.squaredNorm() / 3.0);
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    scale.segment(knot * per + 3 * this->OuterNodes(), 3)
      .setConstant(1.0 / static_cast<double>(this->Shape.NumberOfNodes()));
  }
  return scale;
}

} // namespace waft
