// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/IntoBalls.h"

#include "Base/SmoothStep.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double MostAcceleration = 5.0; // m/s^2
constexpr double StepBends = 5.78;       // the largest second derivative of SmoothStep

// That frame and, less and less, those to either side of it up to the next that keeps its place.
void MoveAround(std::size_t frame, const Vec3& move, double step, const std::vector<char>& keeps,
                std::vector<Vec3>& path)
{
  const double time = std::sqrt(StepBends * move.norm() / MostAcceleration);
  const long wanted = std::max(1L, std::lround(std::ceil(time / step)));
  const auto first = static_cast<long>(frame);
  for (const long side : { -1L, 1L })
  {
    const auto at = [&](long i) { return static_cast<std::size_t>(first + side * i); };
    const auto isPath = [&](long i) { return first + side * i >= 0 && at(i) < path.size(); };
    long reach = 1;
    while (reach < wanted && isPath(reach) && !keeps[at(reach)])
    {
      ++reach;
    }
    reach = isPath(reach) ? reach : wanted; // no mark beyond the end
    for (long i = 1; i < reach && isPath(i); ++i)
    {
      path[at(i)] += SmoothStep(1.0 - static_cast<double>(i) / static_cast<double>(reach)) * move;
    }
  }
  path[frame] += move;
}

} // namespace

Vec3 NearestOf(const PositionBall& ball, const Vec3& x)
{
  const double away = (x - ball.Center).norm();
  return away > ball.Radius ? Vec3(ball.Center + ball.Radius / away * (x - ball.Center)) : x;
}

bool MoveIntoBalls(const std::vector<PositionBall>& balls,
                   const std::function<bool(std::size_t frame)>& stays, double step,
                   const std::function<void(std::vector<Vec3>& path)>& keepInside,
                   std::vector<Vec3>& path)
{
  if (balls.empty())
  {
    return false;
  }
  std::vector<char> keeps(path.size());
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    keeps[f] = stays(f) ? 1 : 0;
  }
  std::vector<const PositionBall*> own;
  for (const PositionBall& ball : balls)
  {
    if (!keeps[static_cast<std::size_t>(ball.Frame)])
    {
      own.push_back(&ball);
    }
  }
  for (const PositionBall* ball : own)
  {
    keeps[static_cast<std::size_t>(ball->Frame)] = 1;
  }
  bool isMoved = false;
  for (const PositionBall* ball : own)
  {
    const auto f = static_cast<std::size_t>(ball->Frame);
    const Vec3 move = NearestOf(*ball, path[f]) - path[f];
    if (!move.isZero(0.0))
    {
      MoveAround(f, move, step, keeps, path);
      isMoved = true;
    }
  }
  if (isMoved)
  {
    keepInside(path);
  }
  for (const PositionBall* ball : own)
  {
    Vec3& x = path[static_cast<std::size_t>(ball->Frame)];
    x = NearestOf(*ball, x);
  }
  return isMoved;
}

} // namespace waft
