// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/HardConstraints.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double Inside = 1.0 - 1e-6;   // of a radius: float rounding stays within the ball
constexpr double OnSphere = 1.0 - 1e-3; // of a radius: farther out a ball counts as touched

Vec3 Get(const float* p, std::size_t stride)
{
  return Vec3(p[0], p[stride], p[2 * stride]);
}

void Set(float* p, std::size_t stride, const Vec3& value)
{
  for (int c = 0; c < 3; ++c)
  {
    p[c * stride] = static_cast<float>(value[c]);
  }
}

} // namespace

HardConstraints::HardConstraints(const SpacetimeModel& model, const TimeLevel& level,
                                 const ConstraintTable& table, const ParallelFor& parallel,
                                 const std::vector<char>& movable) :
  Model(model),
  Level(level), Table(table), Parallel(parallel), Touched(model)
{
  this->LevelOfFrame.assign(model.NumberOfFrames, -1);
  std::vector<bool> hasFrame(model.NumberOfFrames, false);
  for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
  {
    this->LevelOfFrame[level.Frames[j]] = static_cast<int>(j);
    hasFrame[level.Frames[j]] = true;
  }
  this->HoldObjects(movable);
  this->TakeClusters(hasFrame);

  const std::size_t no = model.NumberOfObjects;
  std::vector<bool> taken(this->Held.begin(), this->Held.end());
  for (const LinearCluster& cluster : this->Clusters)
  {
    for (const int frame : cluster.Frames())
    {
      taken[this->LevelOfFrame[frame] * no + cluster.Object()] = true;
    }
  }
  for (const PositionBall& ball : table.Balls)
  {
    const int j = this->LevelOfFrame[ball.Frame];
    if (j >= 0 && !(model.Flag(ball.Frame, ball.Object) & FixedPosition))
    {
      if (!taken[j * no + ball.Object])
      {
        this->Touched.Add(static_cast<std::size_t>(j), ball.Object);
        this->Balls.push_back(
          { static_cast<std::size_t>(j), ball.Object, ball.Center, ball.Radius });
      }
    }
  }
  for (const LevelBall& ball : this->Balls)
  {
    taken[ball.Frame * no + ball.Object] = true;
  }
  for (std::size_t j = 0; j < level.NumberOfFrames() && !table.Planned.empty(); ++j)
  {
    for (std::size_t o = 0; o < no; ++o)
    {
      if (!taken[j * no + o] && !(model.Flag(level.Frames[j], o) & FixedPosition))
      {
        this->LeashBalls.push_back(
          { j, o, table.Planned[static_cast<std::size_t>(level.Frames[j]) * no + o], 0.0 });
      }
    }
  }
}

void HardConstraints::HoldObjects(const std::vector<char>& movable)
{
  const std::size_t no = this->Model.NumberOfObjects;
  const std::size_t frames = this->Level.NumberOfFrames();
  this->Held.assign(frames * no, 0);
  this->IsPart = !movable.empty() || !this->Level.IsFree(0) || !this->Level.IsFree(frames - 1);
  for (std::size_t k = 0; k < this->Held.size(); ++k)
  {
    const bool moves = movable.empty() || movable[this->Model.NumberOfGas + k % no];
    this->Held[k] = !moves || !this->Level.IsFree(k / no);
  }
  for (std::size_t i = 0; i < this->Model.NumberOfGas && !movable.empty(); ++i)
  {
    if (!movable[i])
    {
      this->HeldGas.push_back(i);
    }
  }
}

void HardConstraints::TakeClusters(const std::vector<bool>& hasFrame)
{
  if (!this->IsPart)
  {
    this->Clusters = MakeClusters(this->Model, this->Table, hasFrame);
    return;
  }
  const std::size_t no = this->Model.NumberOfObjects;
  for (LinearCluster& cluster :
       MakeClusters(this->Model, this->Table, std::vector<bool>(hasFrame.size(), true)))
  {
    const auto isHeld = [&](int frame)
    {
      const int j = this->LevelOfFrame[frame];
      return j < 0 || this->Held[j * no + cluster.Object()];
    };
    if (std::none_of(cluster.Frames().begin(), cluster.Frames().end(), isHeld))
    {
      this->Clusters.push_back(std::move(cluster));
      continue;
    }
    for (const int frame : cluster.Frames())
    {
      if (this->LevelOfFrame[frame] >= 0)
      {
        this->Held[this->LevelOfFrame[frame] * no + cluster.Object()] = 1;
      }
    }
  }
}

std::size_t HardConstraints::Offset(std::size_t j, std::size_t object) const
{
  return j * this->Model.FrameSize() + this->Model.NumberOfGas + object;
}

void HardConstraints::ForBalls(const std::function<void(const LevelBall&)>& visit) const
{
  for (const LevelBall& ball : this->Balls)
  {
    visit(ball);
  }
  for (const LevelBall& ball : this->LeashBalls)
  {
    if (this->Leash > 0.0)
    {
      visit({ ball.Frame, ball.Object, ball.Center, this->Leash });
    }
  }
}

void HardConstraints::Project(StateVector& state) const
{
  const std::size_t stride = this->Model.Stride();
  const std::size_t no = this->Model.NumberOfObjects;
  this->Parallel(
    this->Level.NumberOfFrames(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t j = begin; j < end; ++j)
      {
        if (!this->Level.IsFree(j))
        {
          continue;
        }
        float* frame = state.data() + j * this->Model.FrameSize();
        for (int c = 0; c < 3; ++c)
        {
          float* x = frame + c * stride;
          const auto size = static_cast<float>(this->Model.Size[c]);
          for (std::size_t i = 0; i < this->Model.NumberOfGas; ++i)
          {
            x[i] = std::min(std::max(x[i], 0.0f), size);
          }
        }
        for (std::size_t o = 0; o < no; ++o)
        {
          if (this->Held[j * no + o])
          {
            continue;
          }
          const int flags = this->Model.Flag(this->Level.Frames[j], o);
          float* p = state.data() + this->Offset(j, o);
          if (flags & FixedPosition)
          {
            Set(
              p, stride,
              this->Table.FixedPositions[static_cast<std::size_t>(this->Level.Frames[j]) * no + o]);
          }
          if (flags & FixedVelocity)
          {
            Set(p + 3 * stride, stride, Vec3::Zero());
          }
        }
      }
    });
  this->ForBalls(
    [&](const LevelBall& ball)
    {
      float* p = state.data() + this->Offset(ball.Frame, ball.Object);
      const Vec3 d = Get(p, stride) - ball.Center;
      const double r = d.norm();
      if (r > ball.Radius * Inside)
      {
        Set(p, stride, ball.Center + (ball.Radius * Inside / r) * d);
      }
    });
  std::vector<Eigen::MatrixX3d> points = this->ClusterPoints(state);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    this->Clusters[k].Project(points[k]);
  }
  this->SetClusterPoints(points, state);
}

void HardConstraints::Project(const TimelinePreconditioner& preconditioner,
                              StateVector& state) const
{
  if (this->Leash <= 0.0) // which would stop the frames about a ball from coming along
  {
    this->EnterBalls(preconditioner, state);
  }
  this->Project(state);
}

void HardConstraints::EnterBalls(const TimelinePreconditioner& preconditioner,
                                 StateVector& state) const
{
  ActiveConstraints::Vectors overshoots;
  for (const LevelBall& ball : this->Balls)
  {
    const std::size_t offset = this->Offset(ball.Frame, ball.Object);
    const Vec3 d = Get(state.data() + offset, this->Model.Stride()) - ball.Center;
    const double inside = ball.Radius * Inside;
    const double beyond = d.norm() > inside ? 1.0 - inside / d.norm() : 0.0;
    overshoots.emplace_back((beyond * d).cast<float>());
  }
  this->Touched.Enter(preconditioner, overshoots, state);
}

void HardConstraints::FindWalls(std::size_t j, const StateVector& state,
                                const StateVector& gradient)
{
  std::vector<std::size_t>& active = this->ActiveWalls[j];
  active.clear();
  for (int c = 0; c < 3; ++c)
  {
    const std::size_t row = j * this->Model.FrameSize() + c * this->Model.Stride();
    const auto size = static_cast<float>(this->Model.Size[c]);
    for (std::size_t i = row; i < row + this->Model.NumberOfGas; ++i)
    {
      if ((state[i] <= 0.0f && gradient[i] > 0.0f) || (state[i] >= size && gradient[i] < 0.0f))
      {
        active.push_back(i);
      }
    }
  }
}

void HardConstraints::FindActive(const StateVector& state, const StateVector& gradient)
{
  this->ActiveWalls.resize(this->Level.NumberOfFrames());
  this->Parallel(this->Level.NumberOfFrames(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t j = begin; j < end; ++j)
                   {
                     this->FindWalls(j, state, gradient);
                   }
                 });
  this->ActiveBalls.clear();
  this->ForBalls(
    [&](const LevelBall& ball)
    {
      const Vec3 n = this->TouchNormal(ball, state, gradient);
      if (n != Vec3::Zero())
      {
        this->ActiveBalls.push_back(
          { this->Offset(ball.Frame, ball.Object),
            { static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z()) } });
      }
    });
  ActiveConstraints::Vectors normals;
  for (const LevelBall& ball : this->Balls)
  {
    normals.emplace_back(this->TouchNormal(ball, state, gradient).cast<float>());
  }
  this->Touched.Touch(std::move(normals));
}

Vec3 HardConstraints::TouchNormal(const LevelBall& ball, const StateVector& state,
                                  const StateVector& gradient) const
{
  const std::size_t stride = this->Model.Stride();
  const std::size_t offset = this->Offset(ball.Frame, ball.Object);
  const Vec3 d = Get(state.data() + offset, stride) - ball.Center;
  const double r = d.norm();
  const bool leaves =
    r >= ball.Radius * OnSphere && r > 0.0 && Get(gradient.data() + offset, stride).dot(d) < 0.0;
  return leaves ? Vec3(d / r) : Vec3::Zero();
}

void HardConstraints::ClearHeld(StateVector& direction) const
{
  const std::size_t size = this->Model.FrameSize();
  const std::size_t no = this->Model.NumberOfObjects;
  for (std::size_t j = 0; j < this->Level.NumberOfFrames(); ++j)
  {
    float* frame = direction.data() + j * size;
    if (!this->Level.IsFree(j))
    {
      std::fill(frame, frame + size, 0.0f);
      continue;
    }
    for (std::size_t row = 0; row < size; row += this->Model.Stride())
    {
      for (const std::size_t i : this->HeldGas)
      {
        frame[row + i] = 0.0f;
      }
      for (std::size_t o = 0; o < no; ++o)
      {
        if (this->Held[j * no + o])
        {
          frame[row + this->Model.NumberOfGas + o] = 0.0f;
        }
      }
    }
  }
}

void HardConstraints::ProjectTangent(StateVector& direction) const
{
  const std::size_t stride = this->Model.Stride();
  const std::size_t no = this->Model.NumberOfObjects;
  if (this->IsPart)
  {
    this->ClearHeld(direction);
  }
  for (std::size_t j = 0; j < this->Level.NumberOfFrames(); ++j)
  {
    for (std::size_t o = 0; o < no; ++o)
    {
      const int flags = this->Model.Flag(this->Level.Frames[j], o);
      float* p = direction.data() + this->Offset(j, o);
      if (flags & FixedPosition)
      {
        Set(p, stride, Vec3::Zero());
      }
      if (flags & FixedVelocity)
      {
        Set(p + 3 * stride, stride, Vec3::Zero());
      }
    }
  }
  for (const std::vector<std::size_t>& walls : this->ActiveWalls)
  {
    for (const std::size_t i : walls)
    {
      direction[i] = 0.0f;
    }
  }
  for (const Active& active : this->ActiveBalls)
  {
    float* p = direction.data() + active.Offset;
    const Vec3 n(active.Normal[0], active.Normal[1], active.Normal[2]);
    const Vec3 d = Get(p, stride);
    Set(p, stride, d - d.dot(n) * n);
  }
  std::vector<Eigen::MatrixX3d> points = this->ClusterPoints(direction);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    this->Clusters[k].ProjectTangent(points[k]);
  }
  this->SetClusterPoints(points, direction);
}

void HardConstraints::ProjectTangent(const TimelinePreconditioner& preconditioner,
                                     StateVector& direction) const
{
  if (this->Leash <= 0.0) // which would stop the frames about a ball from going along
  {
    this->Touched.Project(preconditioner, direction);
  }
  this->ProjectTangent(direction);
}

double HardConstraints::MaxViolation(const StateVector& state) const
{
  const std::size_t stride = this->Model.Stride();
  double largest = 0.0;
  for (const LevelBall& ball : this->Balls)
  {
    const Vec3 d = Get(state.data() + this->Offset(ball.Frame, ball.Object), stride) - ball.Center;
    largest = std::max(largest, d.norm() - ball.Radius);
  }
  const std::vector<Eigen::MatrixX3d> points = this->ClusterPoints(state);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    largest = std::max(largest, this->Clusters[k].Violation(points[k]));
  }
  return largest;
}

std::vector<Eigen::MatrixX3d> HardConstraints::ClusterPoints(const StateVector& vector) const
{
  std::vector<Eigen::MatrixX3d> points;
  for (const LinearCluster& cluster : this->Clusters)
  {
    points.emplace_back(cluster.Frames().size(), 3);
    for (Eigen::Index k = 0; k < points.back().rows(); ++k)
    {
      const auto j = static_cast<std::size_t>(this->LevelOfFrame[cluster.Frames()[k]]);
      points.back().row(k) =
        Get(vector.data() + this->Offset(j, cluster.Object()), this->Model.Stride()).transpose();
    }
  }
  return points;
}

void HardConstraints::SetClusterPoints(const std::vector<Eigen::MatrixX3d>& points,
                                       StateVector& vector) const
{
  for (std::size_t m = 0; m < points.size(); ++m)
  {
    const LinearCluster& cluster = this->Clusters[m];
    for (Eigen::Index k = 0; k < points[m].rows(); ++k)
    {
      const auto j = static_cast<std::size_t>(this->LevelOfFrame[cluster.Frames()[k]]);
      Set(vector.data() + this->Offset(j, cluster.Object()), this->Model.Stride(),
          points[m].row(k).transpose());
    }
  }
}

} // namespace waft
