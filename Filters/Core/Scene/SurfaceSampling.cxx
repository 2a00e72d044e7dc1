// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SurfaceSampling.h"

#include "Base/Random.h"
#include "Scene/BlueNoise.h"

#include <algorithm>
#include <cmath>

namespace waft
{

Result SampleSurface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed,
                     std::uint64_t stream, std::vector<Vec3>& points)
{
  points.clear();
  std::vector<double> sums;
  double area = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    const Vec3& a = mesh.Points[t[0]];
    area += 0.5 * (mesh.Points[t[1]] - a).cross(mesh.Points[t[2]] - a).norm();
    sums.push_back(area);
  }
  if (!(area > 0.0))
  {
    return Result::Error("expected a surface with an area, found none");
  }
  constexpr std::size_t candidatesPerPoint = 20;
  Random random(seed, stream);
  std::vector<Vec3> candidates;
  for (std::size_t n = 0; n < candidatesPerPoint * count; ++n)
  {
    const double at = area * random.Uniform();
    const auto triangle = static_cast<std::size_t>(
      std::min<std::ptrdiff_t>(std::upper_bound(sums.begin(), sums.end(), at) - sums.begin(),
                               static_cast<std::ptrdiff_t>(sums.size()) - 1));
    const auto& t = mesh.Triangles[triangle];
    const double r = std::sqrt(random.Uniform());
    const double s = random.Uniform();
    candidates.push_back((1.0 - r) * mesh.Points[t[0]] + r * (1.0 - s) * mesh.Points[t[1]] +
                         r * s * mesh.Points[t[2]]);
  }
  for (const std::size_t i : EliminateSamples(candidates, count, PackingDistance(area, 2, count)))
  {
    points.push_back(candidates[i]);
  }
  return Result::Ok();
}

} // namespace waft
