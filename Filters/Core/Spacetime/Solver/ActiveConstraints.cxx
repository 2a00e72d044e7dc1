// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/ActiveConstraints.h"

#include <Eigen/Cholesky>

#include <map>

namespace waft
{
namespace
{

bool IsZero(const Vec3& v)
{
  return v == Vec3::Zero();
}

} // namespace

void ActiveConstraints::Add(std::size_t frame, std::size_t object)
{
  this->Frames.push_back(frame);
  this->Objects.push_back(object);
  this->Normals.emplace_back(Eigen::Vector3f::Zero());
}

void ActiveConstraints::Project(const TimelinePreconditioner& preconditioner,
                                StateVector& direction) const
{
  const std::size_t stride = this->Model.Stride();
  std::vector<Vec3> normals;
  std::vector<double> beyond;
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
    const float* p = direction.data() + this->Frames[k] * this->Model.FrameSize() +
                     this->Model.NumberOfGas + this->Objects[k];
    normals.emplace_back(this->Normals[k].cast<double>());
    beyond.push_back(normals[k].dot(VectorAt(p, stride)));
  }
  this->TakeAway(preconditioner, normals, beyond, direction);
}

void ActiveConstraints::Enter(const TimelinePreconditioner& preconditioner,
                              const Vectors& overshoots, StateVector& state) const
{
  std::vector<Vec3> normals;
  std::vector<double> beyond(this->Size(), 0.0);
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
    normals.emplace_back(overshoots[k].cast<double>());
    if (!IsZero(normals[k]))
    {
      beyond[k] = normals[k].norm();
      normals[k] /= beyond[k];
    }
  }
  this->TakeAway(preconditioner, normals, beyond, state);
}

void ActiveConstraints::TakeAway(const TimelinePreconditioner& preconditioner,
                                 const std::vector<Vec3>& normals,
                                 const std::vector<double>& beyond, StateVector& vector) const
{
  std::map<std::size_t, std::vector<std::size_t>> touched; // by object
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
    if (!IsZero(normals[k]))
    {
      touched[this->Objects[k]].push_back(k);
    }
  }
  for (const auto& [object, balls] : touched)
  {
    const auto n = static_cast<Eigen::Index>(balls.size());
    std::vector<std::vector<float>> columns;
    Eigen::MatrixXd matrix(n, n);
    Eigen::VectorXd excess(n);
    for (Eigen::Index a = 0; a < n; ++a)
    {
      columns.push_back(preconditioner.ColumnOf(object, this->Frames[balls[a]]));
      excess[a] = beyond[balls[a]];
      for (Eigen::Index b = 0; b < n; ++b)
      {
        matrix(a, b) =
          normals[balls[a]].dot(normals[balls[b]]) * columns[a][2 * this->Frames[balls[b]]];
      }
    }
    matrix.diagonal() *= 1.0 + 1e-6; // two balls about one place
    const Eigen::VectorXd forces = matrix.ldlt().solve(excess);
    for (Eigen::Index a = 0; a < n; ++a)
    {
      const Vec3 force = forces[a] * normals[balls[a]];
      for (std::size_t j = 0; 2 * j < columns[a].size(); ++j)
      {
        float* p = vector.data() + j * this->Model.FrameSize() + this->Model.NumberOfGas + object;
        for (int c = 0; c < 3; ++c)
        {
          p[c * this->Model.Stride()] -= static_cast<float>(force[c] * columns[a][2 * j]);
          p[(3 + c) * this->Model.Stride()] -= static_cast<float>(force[c] * columns[a][2 * j + 1]);
        }
      }
    }
  }
}

} // namespace waft
