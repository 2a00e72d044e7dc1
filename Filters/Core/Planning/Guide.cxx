// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Guide.h"

#include <algorithm>

namespace waft
{

GuideWay::GuideWay(std::vector<Vec3> points) : Points(std::move(points))
{
  this->Lengths.assign(this->Points.size(), 0.0);
  for (std::size_t k = 1; k < this->Points.size(); ++k)
  {
    this->Lengths[k] = this->Lengths[k - 1] + (this->Points[k] - this->Points[k - 1]).norm();
  }
}

std::vector<Vec3> GuideWay::Take(const Vec3& from, const Vec3& to)
{
  double best = 1e300;
  double end = this->Taken;
  for (std::size_t k = 1; k < this->Points.size(); ++k)
  {
    const Vec3 side = this->Points[k] - this->Points[k - 1];
    const double length = this->Lengths[k] - this->Lengths[k - 1];
    if (!(length > 0.0) || this->Lengths[k] < this->Taken)
    {
      continue;
    }
    const double low = std::max(0.0, (this->Taken - this->Lengths[k - 1]) / length);
    const double u = std::clamp((to - this->Points[k - 1]).dot(side) / (length * length), low, 1.0);
    const double distance = (this->Points[k - 1] + u * side - to).squaredNorm();
    if (distance < best)
    {
      best = distance;
      end = this->Lengths[k - 1] + u * length;
    }
  }
  std::vector<Vec3> part{ from };
  for (std::size_t k = 0; k < this->Points.size(); ++k)
  {
    if (this->Lengths[k] > this->Taken && this->Lengths[k] < end)
    {
      part.push_back(this->Points[k]);
    }
  }
  part.push_back(to);
  this->Taken = end;
  return part;
}

} // namespace waft
