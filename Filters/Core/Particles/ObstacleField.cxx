// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/ObstacleField.h"

#include "Obstacles/DistanceFrames.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

struct Weights
{
  int First;
  double Value[3], Slope[3], Curve[3];
};

Weights SplineWeights(double x, int count)
{
  const double c = std::clamp(x, 0.5, count - 1.5);
  const bool clamped = c != x;
  const int centre = std::min(static_cast<int>(c + 0.5), count - 2);
  const double t = c - centre;
  Weights w;
  w.First = centre - 1;
  w.Value[0] = 0.5 * (0.5 - t) * (0.5 - t);
  w.Value[1] = 0.75 - t * t;
  w.Value[2] = 0.5 * (0.5 + t) * (0.5 + t);
  const double slope[3] = { t - 0.5, -2.0 * t, t + 0.5 };
  const double curve[3] = { 1.0, -2.0, 1.0 };
  for (int k = 0; k < 3; ++k)
  {
    w.Slope[k] = clamped ? 0.0 : slope[k];
    w.Curve[k] = clamped ? 0.0 : curve[k];
  }
  return w;
}

} // namespace

Result ObstacleField::Build(const std::vector<ObstacleMesh>& obstacles, const Box& bounds,
                            double spacing, double unit, double band, int numberOfFrames)
{
  this->Lattices.clear();
  if (obstacles.empty())
  {
    return Result::Ok();
  }
  const bool moving = std::any_of(obstacles.begin(), obstacles.end(),
                                  [](const ObstacleMesh& o) { return o.IsMoving(); });
  DistanceLattice lattice;
  lattice.Spacing = spacing;
  lattice.Band = band;
  lattice.Origin = bounds.Min - Vec3::Constant(spacing);
  for (int a = 0; a < 3; ++a)
  {
    lattice.Dimensions[a] = static_cast<int>(std::ceil(bounds.Size()[a] / spacing)) + 3;
    this->Origin[a] = -spacing / unit;
  }
  this->Dimensions = lattice.Dimensions;
  this->InverseSpacing = unit / spacing;
  DistanceFrames frames;
  WAFT_RETURN_IF_FAILED(frames.Build(obstacles, lattice));
  for (int frame = 0; frame < (moving ? numberOfFrames : 1); ++frame)
  {
    std::vector<float> values;
    if (Result result = frames.At(frame, values); !result)
    {
      this->Lattices.clear();
      return result;
    }
    for (float& value : values)
    {
      value = static_cast<float>(value / unit);
    }
    this->Lattices.push_back(std::move(values));
  }
  return Result::Ok();
}

double ObstacleField::Evaluate(const Vec3& p, int frame, Vec3& gradient, Mat3& hessian) const
{
  const std::vector<float>& values =
    this->Lattices[std::min<std::size_t>(frame, this->Lattices.size() - 1)];
  Weights w[3];
  for (int a = 0; a < 3; ++a)
  {
    w[a] = SplineWeights((p[a] - this->Origin[a]) * this->InverseSpacing, this->Dimensions[a]);
  }
  double value = 0.0, g[3] = {}, h[6] = {};
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      const std::size_t row =
        (static_cast<std::size_t>(w[2].First + k) * this->Dimensions[1] + w[1].First + j) *
          this->Dimensions[0] +
        w[0].First;
      double line = 0.0, slope = 0.0, curve = 0.0;
      for (int i = 0; i < 3; ++i)
      {
        const double v = values[row + i];
        line += w[0].Value[i] * v;
        slope += w[0].Slope[i] * v;
        curve += w[0].Curve[i] * v;
      }
      const double y0 = w[1].Value[j], y1 = w[1].Slope[j], y2 = w[1].Curve[j];
      const double z0 = w[2].Value[k], z1 = w[2].Slope[k], z2 = w[2].Curve[k];
      value += y0 * z0 * line;
      g[0] += y0 * z0 * slope;
      g[1] += y1 * z0 * line;
      g[2] += y0 * z1 * line;
      h[0] += y0 * z0 * curve;
      h[1] += y1 * z0 * slope;
      h[2] += y0 * z1 * slope;
      h[3] += y2 * z0 * line;
      h[4] += y1 * z1 * line;
      h[5] += y0 * z2 * line;
    }
  }
  const double scale = this->InverseSpacing;
  gradient = scale * Vec3(g[0], g[1], g[2]);
  hessian << h[0], h[1], h[2], h[1], h[3], h[4], h[2], h[4], h[5];
  hessian *= scale * scale;
  return value;
}

double ObstacleField::Distance(const Vec3& p, int frame) const
{
  Vec3 gradient;
  Mat3 hessian;
  return this->Evaluate(p, frame, gradient, hessian);
}

} // namespace waft
