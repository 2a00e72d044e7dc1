// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Primitives.h"

#include <cmath>

namespace waft
{

TriangleMesh MakeBox(const Box& box)
{
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
  {
    mesh.Points.emplace_back(corner & 1 ? box.Max.x() : box.Min.x(),
                             corner & 2 ? box.Max.y() : box.Min.y(),
                             corner & 4 ? box.Max.z() : box.Min.z());
  }
  mesh.Triangles = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                     { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return mesh;
}

TriangleMesh MakeSphere(const Vec3& center, double radius, int meridians, int parallels)
{
  TriangleMesh mesh;
  mesh.Points.emplace_back(center + radius * Vec3::UnitZ());
  for (int j = 1; j < parallels; ++j)
  {
    const double polar = M_PI * j / parallels;
    for (int i = 0; i < meridians; ++i)
    {
      const double turn = 2.0 * M_PI * i / meridians;
      mesh.Points.emplace_back(center + radius * Vec3(std::sin(polar) * std::cos(turn),
                                                      std::sin(polar) * std::sin(turn),
                                                      std::cos(polar)));
    }
  }
  mesh.Points.emplace_back(center - radius * Vec3::UnitZ());
  const int south = static_cast<int>(mesh.Points.size()) - 1;
  const auto ring = [&](int j, int i) { return 1 + (j - 1) * meridians + i % meridians; };
  for (int i = 0; i < meridians; ++i)
  {
    mesh.Triangles.push_back({ 0, ring(1, i), ring(1, i + 1) });
    for (int j = 1; j + 1 < parallels; ++j)
    {
      mesh.Triangles.push_back({ ring(j, i), ring(j + 1, i), ring(j + 1, i + 1) });
      mesh.Triangles.push_back({ ring(j, i), ring(j + 1, i + 1), ring(j, i + 1) });
    }
    mesh.Triangles.push_back({ south, ring(parallels - 1, i + 1), ring(parallels - 1, i) });
  }
  return mesh;
}

TriangleMesh MakeCylinder(const Vec3& base, const Vec3& top, double radius, int sides)
{
  const Vec3 axis = (top - base).normalized();
  const Vec3 across = axis.unitOrthogonal();
  const Vec3 third = axis.cross(across);
  TriangleMesh mesh;
  mesh.Points = { base, top };
  for (int i = 0; i < sides; ++i)
  {
    const double turn = 2.0 * M_PI * i / sides;
    const Vec3 rim = radius * (std::cos(turn) * across + std::sin(turn) * third);
    mesh.Points.emplace_back(base + rim);
    mesh.Points.emplace_back(top + rim);
  }
  for (int i = 0; i < sides; ++i)
  {
    const int a = 2 + 2 * i;
    const int b = 2 + 2 * ((i + 1) % sides);
    mesh.Triangles.push_back({ 0, b, a });
    mesh.Triangles.push_back({ 1, a + 1, b + 1 });
    mesh.Triangles.push_back({ a, b, b + 1 });
    mesh.Triangles.push_back({ a, b + 1, a + 1 });
  }
  return mesh;
}

} // namespace waft
