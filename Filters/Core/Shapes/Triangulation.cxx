// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/Triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <map>

namespace waft
{

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_2<Kernel>;
using Faces = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, Faces>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

constexpr double LeastShape = 0.125; // squared sine of the least angle: 20.7 degrees

} // namespace

Result TriangulatePolygon(const Polygon& polygon, double size,
                          std::vector<std::array<double, 2>>& points,
                          std::vector<std::array<int, 3>>& triangles)
{
  if (polygon.size() < 3 || !(size > 0.0))
  {
    return Result::Error("expected an outline of at least three corners");
  }
  try
  {
    Triangulation mesh;
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
      const auto& a = polygon[k];
      const auto& b = polygon[(k + 1) % polygon.size()];
      mesh.insert_constraint(Kernel::Point_2(a[0], a[1]), Kernel::Point_2(b[0], b[1]));
    }
    CGAL::Delaunay_mesher_2<Triangulation, Criteria>(mesh, Criteria(LeastShape, size))
      .refine_mesh();
    std::map<Triangulation::Vertex_handle, int> numbers;
    std::vector<std::array<double, 2>> vertices;
    std::vector<std::array<int, 3>> faces;
    for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
    {
      if (!face->is_in_domain())
      {
        continue;
      }
      std::array<int, 3> corners{};
      for (int c = 0; c < 3; ++c)
      {
        const auto vertex = face->vertex(c);
        const auto [number, isNew] = numbers.emplace(vertex, static_cast<int>(vertices.size()));
        if (isNew)
        {
          vertices.push_back({ vertex->point().x(), vertex->point().y() });
        }
        corners[static_cast<std::size_t>(c)] = number->second;
      }
      faces.push_back(corners);
    }
    if (faces.empty())
    {
      return Result::Error("expected an outline with an area, found none");
    }
    points = std::move(vertices);
    triangles = std::move(faces);
    return Result::Ok();
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("the outline cannot be filled with triangles: ") +
                         error.what());
  }
}

} // namespace waft
