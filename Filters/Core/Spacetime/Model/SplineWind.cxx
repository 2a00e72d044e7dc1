// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/SplineWind.h"

#include <algorithm>

namespace waft
{

SplineStencil SplineWind::Stencil(const Vec3& x) const
{
  SplineStencil stencil;
  for (int a = 0; a < 3; ++a)
  {
    const int count = this->Dimensions[a];
    const double c = std::clamp((x[a] - this->Origin[a]) / this->Spacing[a], 0.5, count - 1.5);
    const int centre = std::min(static_cast<int>(c + 0.5), count - 2);
    const double t = c - centre;
    stencil.First[a] = centre - 1;
    stencil.Weights[a][0] = static_cast<float>(0.5 * (0.5 - t) * (0.5 - t));
    stencil.Weights[a][1] = static_cast<float>(0.75 - t * t);
    stencil.Weights[a][2] = static_cast<float>(0.5 * (0.5 + t) * (0.5 + t));
  }
  return stencil;
}

void SplineWind::At(double frame, std::vector<float>& coefficients) const
{
  const double last = static_cast<double>(this->Knots.size() - 1);
  const double s = std::clamp(frame / this->FramesPerKnot, 0.0, last);
  const auto k = static_cast<std::size_t>(s);
  const std::size_t next = std::min(k + 1, this->Knots.size() - 1);
  const auto t = static_cast<float>(s - static_cast<double>(k));
  coefficients.resize(this->Knots[k].size());
  for (std::size_t i = 0; i < coefficients.size(); ++i)
  {
    coefficients[i] = (1.0f - t) * this->Knots[k][i] + t * this->Knots[next][i];
  }
}

SphSplineField SplineWind::Field(const std::vector<float>& coefficients) const
{
  SphSplineField field;
  for (int a = 0; a < 3; ++a)
  {
    field.Dimensions[a] = this->Dimensions[a];
    field.Origin[a] = static_cast<float>(this->Origin[a]);
    field.InverseSpacing[a] = static_cast<float>(1.0 / this->Spacing[a]);
  }
  field.Coefficients = coefficients.data();
  return field;
}

Vec3 SampleField(const SplineWind& field, const Vec3& x, double frame)
{
  const double last = static_cast<double>(field.Knots.size() - 1);
  const double s = std::clamp(frame / field.FramesPerKnot, 0.0, last);
  const auto knot = static_cast<std::size_t>(s);
  const std::size_t next = std::min(knot + 1, field.Knots.size() - 1);
  const double t = s - static_cast<double>(knot);
  const SplineStencil stencil = field.Stencil(x);
  const auto& w = stencil.Weights;
  Vec3 value = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        const std::size_t node =
          4 * field.Node(stencil.First[0] + i, stencil.First[1] + j, stencil.First[2] + k);
        const double weight = static_cast<double>(w[0][i]) * w[1][j] * w[2][k];
        for (int a = 0; a < 3; ++a)
        {
          value[a] +=
            weight * ((1.0 - t) * field.Knots[knot][node + a] + t * field.Knots[next][node + a]);
        }
      }
    }
  }
  return value;
}

} // namespace waft
