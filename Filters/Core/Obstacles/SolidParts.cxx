// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/SolidParts.h"

#include "Obstacles/PointWelding.h"
#include "Obstacles/WindingNumber.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace waft
{

namespace
{

// Sets of triangles; the least of a set names it.
class TriangleSets
{
public:
  explicit TriangleSets(std::size_t count) : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }
  int Find(int t)
  {
    while (this->Parent[t] != t)
    {
      t = this->Parent[t] = this->Parent[this->Parent[t]];
    }
    return t;
  }
  void Join(int a, int b)
  {
    const int first = this->Find(a);
    const int second = this->Find(b);
    this->Parent[std::max(first, second)] = std::min(first, second);
  }

private:
  std::vector<int> Parent;
};

void JoinAcrossEdges(const TriangleMesh& mesh, TriangleSets& sets)
{
  const std::vector<int> point = NearPoints(mesh.Points, SeamTolerance(mesh.Points));
  std::vector<std::array<int, 3>> edges; // its ends, the lower first, and a triangle
  edges.reserve(3 * mesh.Triangles.size());
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      const int from = point[mesh.Triangles[t][c]];
      const int to = point[mesh.Triangles[t][(c + 1) % 3]];
      if (from != to)
      {
        edges.push_back({ std::min(from, to), std::max(from, to), static_cast<int>(t) });
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 0; e + 1 < edges.size();)
  {
    const bool isShared = edges[e][0] == edges[e + 1][0] && edges[e][1] == edges[e + 1][1];
    if (isShared)
    {
      sets.Join(edges[e][2], edges[e + 1][2]);
    }
    e += isShared ? 2 : 1;
  }
}

// Of the winding number, which is a half on a face: what lies there is not inside.
constexpr double Inside = 0.75;

struct Part
{
  std::vector<int> Triangles;
  Eigen::AlignedBox3d Bounds;
};

std::vector<Part> PartsOf(const TriangleMesh& mesh)
{
  TriangleSets sets(mesh.Triangles.size());
  JoinAcrossEdges(mesh, sets);
  std::vector<int> partOf(mesh.Triangles.size(), -1);
  std::vector<Part> parts;
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    int& own = partOf[sets.Find(static_cast<int>(t))];
    if (own < 0)
    {
      own = static_cast<int>(parts.size());
      parts.emplace_back();
    }
    parts[own].Triangles.push_back(static_cast<int>(t));
    for (const int corner : mesh.Triangles[t])
    {
      parts[own].Bounds.extend(mesh.Points[corner]);
    }
  }
  return parts;
}

// The part that one bounds a cavity of: itself, or the last of those around it.
int OwnerOf(const TriangleMesh& mesh, const std::vector<Part>& parts, int part)
{
  const Vec3& probe = mesh.Points[mesh.Triangles[parts[part].Triangles.front()][0]];
  int depth = 0;
  int innermost = part;
  for (int other = 0; other < static_cast<int>(parts.size()); ++other)
  {
    if (other != part && parts[other].Bounds.contains(parts[part].Bounds) &&
        std::abs(WindingNumber(mesh, parts[other].Triangles, probe)) > Inside)
    {
      ++depth;
      innermost =
        depth == 1 || parts[innermost].Bounds.contains(parts[other].Bounds) ? other : innermost;
    }
  }
  return depth % 2 == 1 ? innermost : part;
}

} // namespace

std::vector<int> SolidOfTriangles(const TriangleMesh& mesh, int& count)
{
  const std::vector<Part> parts = PartsOf(mesh);
  std::vector<int> solid(parts.size(), -1);
  std::vector<int> owner;
  for (int part = 0; part < static_cast<int>(parts.size()); ++part)
  {
    owner.push_back(OwnerOf(mesh, parts, part));
  }
  count = 0;
  std::vector<int> solidOf(mesh.Triangles.size());
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    int& number = solid[owner[part]];
    number = number < 0 ? count++ : number;
    for (const int t : parts[part].Triangles)
    {
      solidOf[t] = number;
    }
  }
  return solidOf;
}

} // namespace waft
