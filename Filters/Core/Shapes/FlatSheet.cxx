// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/FlatSheet.h"

#include "Base/ShapeMeasures.h"

#include <cmath>

namespace waft
{

namespace
{

// Rows are closer together where the outline closes.
double RowPosition(int row, int rows)
{
  return 0.5 - 0.5 * std::cos(M_PI * row / rows);
}

void AddStrip(const Outline& outline, int rows, int columns, FlatSheet& sheet)
{
  const auto add = [&](double along, double across)
  {
    double x = 0.0;
    double y = 0.0;
    outline.PointAt({ along, across }, x, y);
    sheet.Points.push_back({ x, y });
    const double width = across > 0.0 ? outline.Left(along) : outline.Right(along);
    sheet.Rise.push_back(0.5 * across * across * width * outline.Width);
    return static_cast<int>(sheet.Points.size()) - 1;
  };
  const int base = add(0.0, 0.0);
  int previous = -1;
  for (int row = 1; row < rows; ++row)
  {
    const int first = static_cast<int>(sheet.Points.size());
    for (int c = 0; c <= columns; ++c)
    {
      add(RowPosition(row, rows), -1.0 + 2.0 * c / columns);
    }
    for (int c = 0; c < columns; ++c)
    {
      if (previous < 0)
      {
        sheet.Triangles.push_back({ base, first + c, first + c + 1 });
      }
      else
      {
        sheet.Triangles.push_back({ previous + c, first + c, first + c + 1 });
        sheet.Triangles.push_back({ previous + c, first + c + 1, previous + c + 1 });
      }
    }
    previous = first;
  }
  const int tip = add(1.0, 0.0);
  for (int c = 0; c < columns; ++c)
  {
    sheet.Triangles.push_back({ previous + c, tip, previous + c + 1 });
  }
}

void AddStar(const Outline& outline, int rows, int columns, FlatSheet& sheet)
{
  const int sectors = 2 * rows;
  const int rings = std::max(2, columns / 2);
  sheet.Points.push_back({ outline.CenterX, 0.0 });
  sheet.Rise.push_back(0.0);
  for (int ring = 1; ring <= rings; ++ring)
  {
    for (int i = 0; i < sectors; ++i)
    {
      const double angle = 2.0 * M_PI * i / sectors;
      const double across = static_cast<double>(ring) / rings;
      double x = 0.0;
      double y = 0.0;
      outline.PointAt({ angle, across }, x, y);
      sheet.Points.push_back({ x, y });
      sheet.Rise.push_back(0.5 * across * across * outline.Radius(angle));
    }
  }
  const auto at = [&](int ring, int i) { return 1 + (ring - 1) * sectors + i % sectors; };
  for (int i = 0; i < sectors; ++i)
  {
    sheet.Triangles.push_back({ 0, at(1, i), at(1, i + 1) });
    for (int ring = 1; ring < rings; ++ring)
    {
      sheet.Triangles.push_back({ at(ring, i), at(ring + 1, i), at(ring + 1, i + 1) });
      sheet.Triangles.push_back({ at(ring, i), at(ring + 1, i + 1), at(ring, i + 1) });
    }
  }
}

// The stem or bare shaft, narrower towards its end, bent a little, ending in the blade.
void AddStem(const Outline& outline, FlatSheet& sheet)
{
  constexpr int pieces = 6;
  const int first = static_cast<int>(sheet.Points.size());
  for (int i = 0; i <= pieces; ++i)
  {
    const double s = static_cast<double>(i) / pieces;
    const double half = 0.5 * outline.StemWidth * (1.0 - 0.4 * s);
    double x = 0.0;
    double y = 0.0;
    outline.StemAt(s, x, y);
    sheet.Points.push_back({ x, y - half });
    sheet.Points.push_back({ x, y + half });
    sheet.Rise.insert(sheet.Rise.end(), { 0.0, 0.0 });
  }
  for (int i = 0; i < pieces; ++i)
  {
    const int a = first + 2 * i;
    sheet.Triangles.push_back({ a, a + 2, a + 3 });
    sheet.Triangles.push_back({ a, a + 3, a + 1 });
  }
}

} // namespace

FlatSheet FlattenOutline(const Outline& outline, int rows, int columns)
{
  FlatSheet sheet;
  if (outline.Type == Outline::Kind::Star)
  {
    AddStar(outline, rows, columns, sheet);
  }
  else
  {
    AddStrip(outline, rows, columns, sheet);
  }
  if (outline.StemWidth > 0.0)
  {
    AddStem(outline, sheet);
  }
  return sheet;
}

void BendSheet(const FlatSheet& sheet, const Bending& bending, Shape& shape)
{
  TriangleMesh mesh;
  mesh.Triangles = sheet.Triangles;
  for (std::size_t i = 0; i < sheet.Points.size(); ++i)
  {
    const double x = sheet.Points[i][0];
    const double y = sheet.Points[i][1];
    const double rise = bending.Curl * sheet.Rise[i] + bending.Camber * 4.0 * (x - 0.5) * (x - 0.5);
    // The twist turns a cross-section about the length; it starts in the middle so that both ends
    // share it.
    const double turn = bending.Twist * (x - 0.5);
    mesh.Points.emplace_back(x, y * std::cos(turn) - rise * std::sin(turn),
                             y * std::sin(turn) + rise * std::cos(turn));
  }
  ScaleToExtent(bending.Length, mesh);
  CenterOnMass(mesh);
  shape.Mesh = std::move(mesh);
}

} // namespace waft
