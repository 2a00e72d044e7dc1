// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/FieldPenalty.h"

#include "Spacetime/Fields/WindEstimate.h"

#include <Eigen/Core>

namespace waft
{

double MeanNodeWeight(const SpacetimeModel& model, const SplineWind& lattice, int knots)
{
  const double all = model.Weights.VelocityWeight * static_cast<double>(model.NumberOfParticles()) *
                     (model.NumberOfFrames - 1);
  return all / (static_cast<double>(lattice.NumberOfNodes()) * knots);
}

NodeMatrix PenaltyInSpace(const SplineWind& lattice, const FieldPenalty& penalty)
{
  const auto& n = lattice.Dimensions;
  NodeMatrix matrix(lattice);
  constexpr double bend[3] = { 1.0, -2.0, 1.0 };
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        matrix.At(lattice.Node(i, j, k), 0, 0, 0) += penalty.Ridge;
        const int here[3] = { i, j, k };
        for (int axis = 0; axis < 3; ++axis)
        {
          if (here[axis] < 1 || here[axis] > n[axis] - 2)
          {
            continue;
          }
          const int d[3] = { axis == 0, axis == 1, axis == 2 };
          for (int a = -1; a <= 1; ++a)
          {
            const std::size_t node = lattice.Node(i + a * d[0], j + a * d[1], k + a * d[2]);
            for (int b = -1; b <= 1; ++b)
            {
              matrix.At(node, (b - a) * d[0], (b - a) * d[1], (b - a) * d[2]) +=
                penalty.Curvature * bend[a + 1] * bend[b + 1];
            }
          }
        }
      }
    }
  }
  return matrix;
}

double VortexNorm(const SpacetimeModel& model, const SplineWind& lattice, const Vortex& vortex)
{
  Vortex unit = vortex;
  unit.Strength = 1.0;
  double inSpace = 0.0;
  for (int k = 0; k < lattice.Dimensions[2]; ++k)
  {
    for (int j = 0; j < lattice.Dimensions[1]; ++j)
    {
      for (int i = 0; i < lattice.Dimensions[0]; ++i)
      {
        const Vec3 node = lattice.Origin + lattice.Spacing.cwiseProduct(Vec3(i, j, k));
        inSpace += unit.SpatialAcceleration(node).squaredNorm();
      }
    }
  }
  double inTime = 0.0;
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    const double factor = unit.TimeFactor(frame);
    inTime += factor * factor;
  }
  return inSpace * inTime / lattice.FramesPerKnot;
}

double FieldCost(const SpacetimeModel& model, const AirFields& fields)
{
  if (!model.Air.IsEmpty()) // in which no other field acts
  {
    return 0.0;
  }
  const FieldPenalty penalty(model);
  const SplineWind lattice = MakeWindLattice(model, WindOptions().FramesPerKnot);
  const int knots = KnotsOf(model, lattice.FramesPerKnot);
  double sum = 0.0;
  for (const Vortex& vortex : fields.Vortices)
  {
    sum += penalty.Ridge * vortex.Strength * vortex.Strength * VortexNorm(model, lattice, vortex);
  }
  const Eigen::SparseMatrix<double, Eigen::RowMajor> inSpace =
    PenaltyInSpace(lattice, penalty).OfVectors();
  Eigen::VectorXd before;
  for (const std::vector<float>& knot : fields.Wind.Knots)
  {
    Eigen::VectorXd c(inSpace.rows());
    for (Eigen::Index node = 0; node < c.size() / 3; ++node)
    {
      for (int a = 0; a < 3; ++a)
      {
        c[3 * node + a] = knot[static_cast<std::size_t>(4 * node + a)];
      }
    }
    sum += c.dot(inSpace * c);
    sum += before.size() > 0 ? penalty.TimeSmoothing * (c - before).squaredNorm() : 0.0;
    before = std::move(c);
  }
  return 0.5 * MeanNodeWeight(model, lattice, knots) * sum;
}

} // namespace waft
