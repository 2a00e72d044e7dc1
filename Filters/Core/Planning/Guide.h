// SPDX-License-Identifier: BSD-3-Clause
// A rough curve that an object's path follows loosely.
#pragma once

#include "Base/Types.h"

#include <vector>

namespace waft
{

struct Guide
{
  int ObjectId = 0;
  std::vector<Vec3> Points; // from the start on, at even speed between marks [m]

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObjectId...);
    visit(of.Points...);
  }
};

/// The curve of one object, taken up flight by flight.
class GuideWay
{
public:
  GuideWay() = default;
  explicit GuideWay(std::vector<Vec3> points);

  bool IsEmpty() const { return this->Points.size() < 2; }
  const Vec3& End() const { return this->Points.back(); }
  /// What lies between where the last part ended and the point nearest to `to` beyond it, with
  /// `from` and `to` themselves as ends. Parts follow one another.
  std::vector<Vec3> Take(const Vec3& from, const Vec3& to);

private:
  std::vector<Vec3> Points;
  std::vector<double> Lengths; // from the first point to each [m]
  double Taken = 0.0;          // length used up [m]
};

} // namespace waft
