// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Seams.h"

#include "Base/SmoothStep.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// True when the bend at a sample follows from fixed samples alone.
bool IsGiven(const WarpProblem& warp, int k)
{
  return warp.IsFixed[k - 1] != 0 && warp.IsFixed[k] != 0 && warp.IsFixed[k + 1] != 0;
}

Vec3 ValueOf(const LinearRow& row, const std::vector<Vec3>& positions)
{
  Vec3 value = Vec3::Zero();
  for (std::size_t i = 0; i < row.Frames.size(); ++i)
  {
    value += row.Weights[i] * positions[row.Frames[i]];
  }
  return value;
}

/// A row by itself would be met by a jump of the acceleration (of velocity) or by a peak of it (of
/// acceleration). So bends that meet it are given beforehand: the missing acceleration as a bump,
/// the missing velocity as a jump that is handed over as at a seam.
void PrepareRow(const LinearRow& row, int reach, const std::vector<Vec3>& positions,
                WarpProblem& warp)
{
  const int centre = (row.Frames.front() + row.Frames.back()) / 2;
  double second = 0.0;
  double first = 0.0;
  for (std::size_t i = 0; i < row.Frames.size(); ++i)
  {
    const double time = row.Frames[i] - centre;
    first += row.Weights[i] * time;
    second += 0.5 * row.Weights[i] * time * time;
  }
  if (std::abs(first) > 1e-9 || !(std::abs(second) > 1e-9))
  {
    return;
  }
  const Vec3 missing = (row.Value - ValueOf(row, positions)) / second;
  const auto last = static_cast<int>(warp.SecondDifferences.size()) - 2;
  for (int k = std::max(1, centre - reach); k <= std::min(last, centre + reach); ++k)
  {
    const double u = 1.0 - std::abs(k - centre) / (reach + 1.0);
    warp.SecondDifferences[k] += CubicStep(u) * missing;
  }
}

} // namespace

void HealSeams(const std::vector<int>& seams, int reach, WarpProblem& warp)
{
  const auto count = static_cast<int>(warp.IsFixed.size());
  std::vector<Vec3>& bends = warp.SecondDifferences;
  const auto bendAt = [&](int k) -> Vec3
  {
    return IsGiven(warp, k) ? Vec3(warp.Fixed[k - 1] - 2.0 * warp.Fixed[k] + warp.Fixed[k + 1])
                            : bends[k];
  };
  for (std::size_t i = 0; i < seams.size(); ++i)
  {
    const int seam = seams[i];
    if (seam < 2 || seam + 2 >= count)
    {
      continue;
    }
    int own = std::min({ reach, seam - 1, count - 2 - seam });
    own = i > 0 && seams[i - 1] < seam ? std::min(own, (seam - seams[i - 1]) / 2) : own;
    own =
      i + 1 < seams.size() && seams[i + 1] > seam ? std::min(own, (seams[i + 1] - seam) / 2) : own;
    const Vec3 before = bendAt(seam - 1);
    const Vec3 jump = bendAt(seam + 1) - before;
    const double left = IsGiven(warp, seam + 1) ? 1.0 : IsGiven(warp, seam - 1) ? 0.0 : 0.5;
    bends[seam] = before + left * jump;
    for (int k = 1; k < own; ++k)
    {
      const double u = 1.0 - static_cast<double>(k) / own;
      const double weight = CubicStep(u);
      bends[seam - k] += left * weight * jump;
      bends[seam + k] -= (1.0 - left) * weight * jump;
    }
  }
}

std::vector<Vec3> UniteFlights(const std::vector<int>& seams, int reach,
                               const std::vector<MotionRow>& rows, WarpProblem& warp)
{
  HealSeams(seams, reach, warp);
  std::vector<Vec3> united = SolveWarp(warp);
  // Rows with a tolerance are imposed where the motion does not meet them by itself.
  std::vector<int> jumps;
  for (int seam : seams)
  {
    if (seam > 1 && seam + 2 < static_cast<int>(warp.IsFixed.size()) &&
        (IsGiven(warp, seam - 1) || IsGiven(warp, seam + 1)))
    {
      jumps.push_back(seam);
    }
  }
  for (const MotionRow& row : rows)
  {
    LinearRow imposed = row.Row;
    if (row.Radius > 0.0)
    {
      const Vec3 offset = ValueOf(row.Row, united) - row.Row.Value;
      if (!(offset.norm() > PlannerNumbers::RowLeft * row.Radius))
      {
        continue;
      }
      imposed.Value += offset.normalized() * (PlannerNumbers::RowGiven * row.Radius);
    }
    PrepareRow(imposed, reach, united, warp);
    warp.Rows.push_back(imposed);
    jumps.push_back((imposed.Frames.front() + imposed.Frames.back()) / 2);
  }
  std::sort(jumps.begin(), jumps.end());
  jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
  if (!warp.Rows.empty())
  {
    united = SolveWarp(warp);
  }
  // What rows and given stretches bent the path by jumps there in turn.
  for (int round = 0; round < PlannerNumbers::HealingRounds && !jumps.empty(); ++round)
  {
    warp.SecondDifferences = SecondDifferences(united);
    HealSeams(jumps, reach, warp);
    united = SolveWarp(warp);
  }
  return united;
}

} // namespace waft
