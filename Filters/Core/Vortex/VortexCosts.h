// SPDX-License-Identifier: BSD-3-Clause
// Residuals of the fit for Ceres. Parameter blocks: center, direction, shape, uniform background.
#pragma once

#include "Vortex/VortexModel.h"

#include <ceres/sized_cost_function.h>

namespace waft
{

/// scale (vortex(x, t) + background - acceleration); scale is 1 / noise [s^2/m].
class SampleCost : public ceres::SizedCostFunction<3, 3, 3, ShapeSize, 3>
{
public:
  SampleCost(const Vec3& x, double time, const Vec3& acceleration, double scale) :
    X(x), Time(time), Acceleration(acceleration), Scale(scale)
  {
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override
  {
    VortexJacobian jacobian;
    const Vec3 field = EvaluateVortex(parameters[0], parameters[1], parameters[2], this->X,
                                      this->Time, jacobians ? &jacobian : nullptr);
    Eigen::Map<Vec3>(residuals, 3) =
      this->Scale * (field + Eigen::Map<const Vec3>(parameters[3]) - this->Acceleration);
    if (jacobians)
    {
      using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
      using RowMajorShape = Eigen::Matrix<double, 3, ShapeSize, Eigen::RowMajor>;
      if (jacobians[0])
      {
        Eigen::Map<RowMajor3>(jacobians[0], 3, 3) = this->Scale * jacobian.Center;
      }
      if (jacobians[1])
      {
        Eigen::Map<RowMajor3>(jacobians[1], 3, 3) = this->Scale * jacobian.Direction;
      }
      if (jacobians[2])
      {
        Eigen::Map<RowMajorShape>(jacobians[2], 3, ShapeSize) = this->Scale * jacobian.Shape;
      }
      if (jacobians[3])
      {
        Eigen::Map<RowMajor3>(jacobians[3], 3, 3) = this->Scale * Mat3::Identity();
      }
    }
    return true;
  }

private:
  Vec3 X;
  double Time;
  Vec3 Acceleration;
  double Scale;
};

/// What is believed before any sample is seen: independent normal distributions.
struct VortexBelief
{
  VortexParameters Mean;
  double CenterPrecision = 0.0;    // 1/m
  double DirectionPrecision = 0.0; // 1/rad
  ShapeVector ShapePrecision = ShapeVector::Zero();
  double BackgroundPrecision = 0.0; // s^2/m
};

class BeliefCost : public ceres::SizedCostFunction<9 + ShapeSize, 3, 3, ShapeSize, 3>
{
public:
  explicit BeliefCost(const VortexBelief& belief) : Belief(belief) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override
  {
    constexpr int rows = 9 + ShapeSize;
    const VortexBelief& b = this->Belief;
    Eigen::Map<Eigen::Matrix<double, rows, 1>> r(residuals);
    r.segment<3>(0) = b.CenterPrecision * (Eigen::Map<const Vec3>(parameters[0]) - b.Mean.Center);
    r.segment<3>(3) =
      b.DirectionPrecision * (Eigen::Map<const Vec3>(parameters[1]) - b.Mean.Direction);
    r.segment<ShapeSize>(6) =
      b.ShapePrecision.cwiseProduct(Eigen::Map<const ShapeVector>(parameters[2]) - b.Mean.Shape);
    r.segment<3>(6 + ShapeSize) = b.BackgroundPrecision * Eigen::Map<const Vec3>(parameters[3]);
    const int first[4] = { 0, 3, 6, 6 + ShapeSize };
    const int size[4] = { 3, 3, ShapeSize, 3 };
    for (int block = 0; jacobians && block < 4; ++block)
    {
      if (!jacobians[block])
      {
        continue;
      }
      std::fill(jacobians[block], jacobians[block] + rows * size[block], 0.0);
      for (int k = 0; k < size[block]; ++k)
      {
        const double precision = block == 0   ? b.CenterPrecision
                                 : block == 1 ? b.DirectionPrecision
                                 : block == 2 ? b.ShapePrecision[k]
                                              : b.BackgroundPrecision;
        jacobians[block][(first[block] + k) * size[block] + k] = precision;
      }
    }
    return true;
  }

private:
  VortexBelief Belief;
};

} // namespace waft
