// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/TouchedBalls.h"

#include <Eigen/Cholesky>

#include <map>

namespace waft
{

TouchedBalls::TouchedBalls(const SpacetimeModel& model, const FrameShare& share) :
  Model(model), Share(share)
{
}

void TouchedBalls::Add(std::size_t frame, std::size_t object)
{
  this->Frames.push_back(frame);
  this->Objects.push_back(object);
  this->Normals.insert(this->Normals.end(), 3, 0.0f);
}

void TouchedBalls::Touch(std::vector<float> normals)
{
  this->Normals = std::move(normals);
  this->Share.GatherPoints(this->Frames, this->Normals);
}

void TouchedBalls::Project(const TimelinePreconditioner& preconditioner,
                           StateVector& direction) const
{
  const std::size_t stride = this->Model.Stride();
  std::vector<float> moves(3 * this->Size(), 0.0f);
  std::map<std::size_t, std::vector<std::size_t>> touched; // by object
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
    if (this->Normal(k) != Vec3::Zero())
    {
      touched[this->Objects[k]].push_back(k);
    }
    const std::size_t j = this->Frames[k];
    for (int c = 0; c < 3 && this->Share.Own().Contains(j); ++c)
    {
      moves[3 * k + c] = direction[this->Share.Slot(j) * this->Model.FrameSize() + c * stride +
                                   this->Model.NumberOfGas + this->Objects[k]];
    }
  }
  if (touched.empty())
  {
    return;
  }
  this->Share.GatherPoints(this->Frames, moves);
  for (const auto& [object, balls] : touched)
  {
    this->ProjectObject(preconditioner, balls, moves, direction);
  }
}

void TouchedBalls::ProjectObject(const TimelinePreconditioner& preconditioner,
                                 const std::vector<std::size_t>& touched,
                                 const std::vector<float>& moves, StateVector& direction) const
{
  const auto n = static_cast<Eigen::Index>(touched.size());
  const std::size_t object = this->Objects[touched.front()];
  std::vector<std::vector<float>> columns;
  Eigen::MatrixXd matrix(n, n);
  Eigen::VectorXd beyond(n);
  for (Eigen::Index a = 0; a < n; ++a)
  {
    const std::size_t k = touched[a];
    columns.push_back(preconditioner.ColumnOf(object, this->Frames[k]));
    beyond[a] = this->Normal(k).dot(Vec3(moves[3 * k], moves[3 * k + 1], moves[3 * k + 2]));
    for (Eigen::Index b = 0; b < n; ++b)
    {
      matrix(a, b) =
        this->Normal(k).dot(this->Normal(touched[b])) * columns[a][2 * this->Frames[touched[b]]];
    }
  }
  matrix.diagonal() *= 1.0 + 1e-6; // two balls about one place
  const Eigen::VectorXd forces = matrix.ldlt().solve(beyond);
  for (Eigen::Index a = 0; a < n; ++a)
  {
    const Vec3 force = forces[a] * this->Normal(touched[a]);
    for (std::size_t j = this->Share.Own().Begin; j < this->Share.Own().End; ++j)
    {
      float* p = direction.data() + this->Share.Slot(j) * this->Model.FrameSize() +
                 this->Model.NumberOfGas + object;
      for (int c = 0; c < 3; ++c)
      {
        p[c * this->Model.Stride()] -= static_cast<float>(force[c] * columns[a][2 * j]);
        p[(3 + c) * this->Model.Stride()] -= static_cast<float>(force[c] * columns[a][2 * j + 1]);
      }
    }
  }
}

} // namespace waft
