// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/SurfaceRepair.h"

#include "Base/NumberText.h"
#include "Obstacles/PointWelding.h"
#include "Obstacles/WindingNumber.h"

#include <cmath>

namespace waft
{

namespace
{

struct Edge
{
  int Low = 0;
  int High = 0;
  int Triangle = 0;
  bool Forward = true; // the triangle runs from Low to High
};

Result CheckNumbers(const std::string& name, const TriangleMesh& mesh)
{
  if (mesh.Triangles.empty())
  {
    return Result::Error(name + ": no triangles, expected a closed triangle surface");
  }
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    if (!mesh.Points[i].allFinite())
    {
      return Result::Error(name + ": point " + std::to_string(i) + " is not finite");
    }
  }
  const int count = static_cast<int>(mesh.Points.size());
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    for (const int index : mesh.Triangles[t])
    {
      if (index < 0 || index >= count)
      {
        return Result::Error(name + ": triangle " + std::to_string(t) + " names point " +
                             std::to_string(index) + ", expected 0 to " +
                             std::to_string(count - 1));
      }
    }
  }
  return Result::Ok();
}

/// Gives points their representatives and drops triangles that collapse.
void Apply(const std::vector<int>& representative, TriangleMesh& mesh)
{
  std::vector<std::array<int, 3>> kept;
  kept.reserve(mesh.Triangles.size());
  for (auto triangle : mesh.Triangles)
  {
    for (int& index : triangle)
    {
      index = representative[index];
    }
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
    {
      kept.push_back(triangle);
    }
  }
  mesh.Triangles = std::move(kept);
}

std::vector<Edge> SortedEdges(const TriangleMesh& mesh)
{
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.Triangles.size());
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      const int a = mesh.Triangles[t][c];
      const int b = mesh.Triangles[t][(c + 1) % 3];
      edges.push_back({ std::min(a, b), std::max(a, b), static_cast<int>(t), a < b });
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& l, const Edge& r)
            {
              return l.Low != r.Low
                       ? l.Low < r.Low
                       : (l.High != r.High ? l.High < r.High : l.Triangle < r.Triangle);
            });
  return edges;
}

/// Every edge belongs to exactly two triangles.
Result CheckClosed(const std::string& name, const TriangleMesh& mesh,
                   const std::vector<Edge>& edges)
{
  for (std::size_t first = 0; first < edges.size();)
  {
    std::size_t last = first;
    while (last < edges.size() && edges[last].Low == edges[first].Low &&
           edges[last].High == edges[first].High)
    {
      ++last;
    }
    if (last - first != 2)
    {
      return Result::Error(name + ": the surface is not closed: the edge from " +
                           PointText(mesh.Points[edges[first].Low]) + " to " +
                           PointText(mesh.Points[edges[first].High]) + " belongs to " +
                           std::to_string(last - first) + " triangle(s), expected 2");
    }
    first = last;
  }
  return Result::Ok();
}

/// Turns triangles until neighbours agree; component[t] is the number of t's connected component.
Result OrientComponents(const std::string& name, const std::vector<Edge>& edges, TriangleMesh& mesh,
                        std::vector<int>& component, int& count)
{
  // Per triangle and corner: the neighbour across the edge, and whether both run the same way.
  struct Link
  {
    int Neighbour;
    bool Disagrees;
  };
  std::vector<std::vector<Link>> links(mesh.Triangles.size());
  for (std::size_t e = 0; e + 1 < edges.size(); e += 2)
  {
    const bool disagrees = edges[e].Forward == edges[e + 1].Forward;
    links[edges[e].Triangle].push_back({ edges[e + 1].Triangle, disagrees });
    links[edges[e + 1].Triangle].push_back({ edges[e].Triangle, disagrees });
  }
  component.assign(mesh.Triangles.size(), -1);
  std::vector<char> turned(mesh.Triangles.size(), 0);
  count = 0;
  std::vector<int> stack;
  for (std::size_t seed = 0; seed < mesh.Triangles.size(); ++seed)
  {
    if (component[seed] >= 0)
    {
      continue;
    }
    component[seed] = count;
    stack.push_back(static_cast<int>(seed));
    while (!stack.empty())
    {
      const int t = stack.back();
      stack.pop_back();
      for (const Link& link : links[t])
      {
        const char wanted = static_cast<char>(turned[t] ^ (link.Disagrees ? 1 : 0));
        if (component[link.Neighbour] < 0)
        {
          component[link.Neighbour] = count;
          turned[link.Neighbour] = wanted;
          stack.push_back(link.Neighbour);
        }
        else if (turned[link.Neighbour] != wanted)
        {
          return Result::Error(name + ": the surface has one side only near " +
                               PointText(mesh.Points[mesh.Triangles[t][0]]) +
                               ", expected the boundary of a solid");
        }
      }
    }
    ++count;
  }
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    if (turned[t])
    {
      std::swap(mesh.Triangles[t][1], mesh.Triangles[t][2]);
    }
  }
  return Result::Ok();
}

void FaceOutwards(TriangleMesh& mesh, const std::vector<int>& component, int count)
{
  std::vector<std::vector<int>> members(count);
  std::vector<Eigen::AlignedBox3d> bounds(count);
  std::vector<double> volume(count, 0.0);
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    const int k = component[t];
    members[k].push_back(static_cast<int>(t));
    const Vec3 origin = mesh.Points[mesh.Triangles[members[k].front()][0]];
    const Vec3& a = mesh.Points[mesh.Triangles[t][0]];
    const Vec3& b = mesh.Points[mesh.Triangles[t][1]];
    const Vec3& c = mesh.Points[mesh.Triangles[t][2]];
    volume[k] += (a - origin).dot((b - origin).cross(c - origin));
    bounds[k].extend(a).extend(b).extend(c);
  }
  for (int k = 0; k < count; ++k)
  {
    const Vec3 probe = mesh.Points[mesh.Triangles[members[k].front()][0]];
    int depth = 0;
    for (int other = 0; other < count; ++other)
    {
      depth += other != k && bounds[other].contains(bounds[k]) &&
               std::abs(WindingNumber(mesh, members[other], probe)) > 0.5;
    }
    const bool isCavity = depth % 2 == 1;
    if ((volume[k] > 0.0) == isCavity)
    {
      for (const int t : members[k])
      {
        std::swap(mesh.Triangles[t][1], mesh.Triangles[t][2]);
      }
    }
  }
}

} // namespace

Result RepairSurface(const std::string& name, TriangleMesh& mesh)
{
  if (Result result = CheckNumbers(name, mesh); !result)
  {
    return result;
  }
  Apply(EqualPoints(mesh.Points), mesh);
  std::vector<Edge> edges = SortedEdges(mesh);
  if (!CheckClosed(name, mesh, edges))
  {
    // Seams that close only up to rounding, sin(2 pi) for instance.
    Apply(NearPoints(mesh.Points, SeamTolerance(mesh.Points)), mesh);
    edges = SortedEdges(mesh);
    if (Result result = CheckClosed(name, mesh, edges); !result)
    {
      return result;
    }
  }
  if (mesh.Triangles.empty())
  {
    return Result::Error(name + ": all its triangles are points or segments, expected a solid");
  }
  std::vector<int> component;
  int count = 0;
  if (Result result = OrientComponents(name, edges, mesh, component, count); !result)
  {
    return result;
  }
  FaceOutwards(mesh, component, count);
  return Result::Ok();
}

} // namespace waft
