// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces for the tests of obstacles.
#pragma once

#include "Base/Primitives.h"

#include <cmath>

namespace waft::testing
{

/// A torus about the z axis; every triangle has points of its own, as readers of STL give them,
/// and the seam closes only up to rounding.
inline TriangleMesh TorusMesh(const Vec3& centre, double ring, double tube, int n, int m)
{
  const auto point = [&](int i, int j)
  {
    const double u = 2.0 * EIGEN_PI * i / n;
    const double v = 2.0 * EIGEN_PI * j / m;
    return Vec3(centre + Vec3((ring + tube * std::cos(v)) * std::cos(u),
                              (ring + tube * std::cos(v)) * std::sin(u), tube * std::sin(v)));
  };
  TriangleMesh mesh;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c)
  {
    const int first = static_cast<int>(mesh.Points.size());
    mesh.Points.insert(mesh.Points.end(), { a, b, c });
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      add(point(i, j), point(i + 1, j), point(i + 1, j + 1));
      add(point(i, j), point(i + 1, j + 1), point(i, j + 1));
    }
  }
  return mesh;
}

/// Stairs of unit cubes, n by n columns, column (i, j) as high as i + j + 1: the boundary faces of
/// the cubes.
inline TriangleMesh StairsMesh(int n)
{
  const auto isSolid = [n](int i, int j, int k)
  { return i >= 0 && j >= 0 && k >= 0 && i < n && j < n && k <= i + j; };
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int k = 0; k <= i + j; ++k)
      {
        for (int face = 0; face < 6; ++face)
        {
          const int axis = face / 2;
          int next[3] = { i, j, k };
          next[axis] += face % 2 ? 1 : -1;
          if (isSolid(next[0], next[1], next[2]))
          {
            continue;
          }
          Vec3 corner(i, j, k);
          corner[axis] += face % 2;
          const Vec3 u = Vec3::Unit((axis + 1) % 3);
          const Vec3 v = Vec3::Unit((axis + 2) % 3);
          const int first = static_cast<int>(mesh.Points.size());
          mesh.Points.insert(mesh.Points.end(), { corner, corner + u, corner + u + v, corner + v });
          mesh.Triangles.push_back({ first, first + 1, first + 2 });
          mesh.Triangles.push_back({ first, first + 2, first + 3 });
        }
      }
    }
  }
  return mesh;
}

inline void Append(TriangleMesh& mesh, const TriangleMesh& other)
{
  const int first = static_cast<int>(mesh.Points.size());
  mesh.Points.insert(mesh.Points.end(), other.Points.begin(), other.Points.end());
  for (const auto& t : other.Triangles)
  {
    mesh.Triangles.push_back({ t[0] + first, t[1] + first, t[2] + first });
  }
}

inline void Turn(TriangleMesh& mesh)
{
  for (auto& t : mesh.Triangles)
  {
    std::swap(t[1], t[2]);
  }
}

} // namespace waft::testing
