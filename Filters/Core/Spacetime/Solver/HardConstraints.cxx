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

/// By frame its level frame, -1: it is not on the level.
std::vector<int> LevelOfFrames(const SpacetimeModel& model, const TimeLevel& level)
{
  std::vector<int> levelOfFrame(model.NumberOfFrames, -1);
  for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
  {
    levelOfFrame[level.Frames[j]] = static_cast<int>(j);
  }
  return levelOfFrame;
}

} // namespace

HardConstraints::HardConstraints(const SpacetimeModel& model, const TimeLevel& level,
                                 const ConstraintTable& table, const ParallelFor& parallel) :
  Model(model),
  Level(level), Table(table), Parallel(parallel), Held(HoldUnknowns(model, level)),
  Clusters(model, table, LevelOfFrames(model, level), this->Held), Touched(model)
{
  this->TakeBalls(LevelOfFrames(model, level));
}

void HardConstraints::TakeBalls(const std::vector<int>& levelOfFrame)
{
  const std::size_t no = this->Model.NumberOfObjects;
  std::vector<bool> taken(this->Held.Objects.begin(), this->Held.Objects.end());
  this->Clusters.Visit([&](std::size_t j, std::size_t object) { taken[j * no + object] = true; });
  for (const PositionBall& ball : this->Table.Balls)
  {
    const int j = levelOfFrame[ball.Frame];
    if (j >= 0 && !(this->Model.Flag(ball.Frame, ball.Object) & FixedPosition) &&
        !taken[j * no + ball.Object])
    {
      this->Touched.Add(static_cast<std::size_t>(j), ball.Object);
      this->Balls.push_back({ static_cast<std::size_t>(j), ball.Object, ball.Center, ball.Radius });
    }
  }
  for (const LevelBall& ball : this->Balls)
  {
    taken[ball.Frame * no + ball.Object] = true;
  }
  for (std::size_t j = 0; j < this->Level.NumberOfFrames() && !this->Table.Planned.empty(); ++j)
  {
    const int frame = this->Level.Frames[j];
    for (std::size_t o = 0; o < no; ++o)
    {
      if (!taken[j * no + o] && !(this->Model.Flag(frame, o) & FixedPosition))
      {
        this->LeashBalls.push_back(
          { j, o, this->Table.Planned[static_cast<std::size_t>(frame) * no + o], 0.0 });
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

void HardConstraints::ProjectFrame(std::size_t j, StateVector& state) const
{
  const std::size_t stride = this->Model.Stride();
  const std::size_t no = this->Model.NumberOfObjects;
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
    if (this->Held.Objects[j * no + o])
    {
      continue;
    }
    const int flags = this->Model.Flag(this->Level.Frames[j], o);
    float* p = state.data() + this->Offset(j, o);
    if (flags & FixedPosition)
    {
      SetVector(
        p, stride,
        this->Table.FixedPositions[static_cast<std::size_t>(this->Level.Frames[j]) * no + o]);
    }
    if (flags & FixedVelocity)
    {
      SetVector(p + 3 * stride, stride, Vec3::Zero());
    }
  }
}

void HardConstraints::Project(StateVector& state) const
{
  const std::size_t stride = this->Model.Stride();
  this->Parallel(this->Level.NumberOfFrames(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t j = begin; j < end; ++j)
                   {
                     if (this->Level.IsFree(j))
                     {
                       this->ProjectFrame(j, state);
                     }
                   }
                 });
  this->ForBalls(
    [&](const LevelBall& ball)
    {
      float* p = state.data() + this->Offset(ball.Frame, ball.Object);
      const Vec3 d = VectorAt(p, stride) - ball.Center;
      const double r = d.norm();
      if (r > ball.Radius * Inside)
      {
        SetVector(p, stride, ball.Center + (ball.Radius * Inside / r) * d);
      }
    });
  this->Clusters.Project(state);
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
    const Vec3 d = VectorAt(state.data() + offset, this->Model.Stride()) - ball.Center;
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
  const Vec3 d = VectorAt(state.data() + offset, stride) - ball.Center;
  const double r = d.norm();
  const bool leaves = r >= ball.Radius * OnSphere && r > 0.0 &&
                      VectorAt(gradient.data() + offset, stride).dot(d) < 0.0;
  return leaves ? Vec3(d / r) : Vec3::Zero();
}

void HardConstraints::ProjectTangent(StateVector& direction) const
{
  const std::size_t stride = this->Model.Stride();
  const std::size_t no = this->Model.NumberOfObjects;
  ClearHeld(this->Model, this->Level, this->Held, direction);
  for (std::size_t j = 0; j < this->Level.NumberOfFrames(); ++j)
  {
    for (std::size_t o = 0; o < no; ++o)
    {
      const int flags = this->Model.Flag(this->Level.Frames[j], o);
      float* p = direction.data() + this->Offset(j, o);
      if (flags & FixedPosition)
      {
        SetVector(p, stride, Vec3::Zero());
      }
      if (flags & FixedVelocity)
      {
        SetVector(p + 3 * stride, stride, Vec3::Zero());
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
    const Vec3 d = VectorAt(p, stride);
    SetVector(p, stride, d - d.dot(n) * n);
  }
  this->Clusters.ProjectTangent(direction);
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
    const Vec3 d =
      VectorAt(state.data() + this->Offset(ball.Frame, ball.Object), stride) - ball.Center;
    largest = std::max(largest, d.norm() - ball.Radius);
  }
  return std::max(largest, this->Clusters.Violation(state));
}

} // namespace waft
