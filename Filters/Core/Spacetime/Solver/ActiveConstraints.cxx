// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/ActiveConstraints.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <map>

namespace waft
{
namespace
{

std::vector<Vec3> Vectors(const std::vector<float>& values)
{
  std::vector<Vec3> vectors;
  for (std::size_t k = 0; k + 2 < values.size(); k += 3)
  {
    vectors.emplace_back(values[k], values[k + 1], values[k + 2]);
  }
  return vectors;
}

bool IsZero(const Vec3& v)
{
  return v == Vec3::Zero();
}

} // namespace

ActiveConstraints::ActiveConstraints(const SpacetimeModel& model, const FramePartition& partition) :
  Model(model), Partition(partition)
{
}

void ActiveConstraints::Add(std::size_t frame, std::size_t object)
{
  this->Frames.push_back(frame);
  this->Objects.push_back(object);
  this->Normals.insert(this->Normals.end(), 3, 0.0f);
}

void ActiveConstraints::Touch(std::vector<float> normals)
{
  this->Normals = std::move(normals);
  this->Partition.GatherPoints(this->Frames, this->Normals);
}

void ActiveConstraints::Project(const TimelinePreconditioner& preconditioner,
                                StateVector& direction) const
{
  const std::size_t stride = this->Model.Stride();
  const std::vector<Vec3> normals = Vectors(this->Normals);
  if (std::all_of(normals.begin(), normals.end(), IsZero))
  {
    return;
  }
  std::vector<float> moves(3 * this->Size(), 0.0f);
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
    const std::size_t j = this->Frames[k];
    for (int c = 0; c < 3 && this->Partition.Own().Contains(j); ++c)
    {
      moves[3 * k + c] = direction[this->Partition.Slot(j) * this->Model.FrameSize() + c * stride +
                                   this->Model.NumberOfGas + this->Objects[k]];
    }
  }
  this->Partition.GatherPoints(this->Frames, moves);
  const std::vector<Vec3> steps = Vectors(moves);
  std::vector<double> beyond(this->Size());
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
    beyond[k] = normals[k].dot(steps[k]);
  }
  this->TakeAway(preconditioner, normals, beyond, direction);
}

void ActiveConstraints::Enter(const TimelinePreconditioner& preconditioner,
                              std::vector<float> overshoots, StateVector& state) const
{
  this->Partition.GatherPoints(this->Frames, overshoots);
  std::vector<Vec3> normals = Vectors(overshoots);
  std::vector<double> beyond(this->Size(), 0.0);
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
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
      for (std::size_t j = this->Partition.Own().Begin; j < this->Partition.Own().End; ++j)
      {
        float* p = vector.data() + this->Partition.Slot(j) * this->Model.FrameSize() +
                   this->Model.NumberOfGas + object;
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
