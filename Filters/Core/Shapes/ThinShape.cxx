// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/ThinShape.h"

#include "Base/Primitives.h"
#include "Base/ShapeMeasures.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace waft
{

namespace
{

/// The sheet of a built-in shape; one that has none here has a leaf's, which is the default.
struct BuiltinSheet
{
  const char* Name;
  int Rows;
  int Columns;
  double Curl;
  double Camber;
  double Twist; // rad
};

constexpr BuiltinSheet Sheets[] = {
  { "maple", 42, 8, 0.35, 0.06, 0.0 }, // 84 sectors: its teeth
  { "oak", 44, 8, 0.35, 0.07, 0.0 },   // its lobes
  { "willow", 28, 6, 0.5, 0.10, 0.3 }, { "feather", 36, 8, 0.5, 0.10, 0.15 },
  { "down", 28, 8, 0.8, 0.1, 0.0 },    { "petal", 20, 8, 0.7, 0.12, 0.0 },
  { "disc", 28, 8, 0.0, 0.0, 0.0 },
};

SheetOptions SheetOf(const std::string& name)
{
  SheetOptions options;
  for (const BuiltinSheet& sheet : Sheets)
  {
    if (name == sheet.Name)
    {
      options.Rows = sheet.Rows;
      options.Columns = sheet.Columns;
      options.Curl = sheet.Curl;
      options.Camber = sheet.Camber;
      options.Twist = sheet.Twist;
    }
  }
  return options;
}

} // namespace

Result SheetOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(ValidateFields<SheetOptions>(*this));
  return this->Columns % 2 == 0 ? Result::Ok()
                                : Result::Error("Columns: expected an even number, found " +
                                                std::to_string(this->Columns));
}

SheetOptions FeatherSheet()
{
  SheetOptions options = SheetOf("feather");
  options.Length = 0.2;
  return options;
}

ThinBody FeatherBody()
{
  ThinBody body;
  body.AreaDensity = 0.04;
  body.Thickness = 0.0005;
  body.SettlingSpeed = 0.4;
  return body;
}

const std::vector<BuiltinShape>& BuiltinShapes()
{
  static const std::vector<BuiltinShape> shapes = {
    { "leaf", 0.10, 0.8, 0.10, 0.0004, 1.2, 0.0, { 0.45, 0.56, 0.18 } },
    { "maple", 0.14, 0.9, 0.11, 0.0004, 1.2, 0.0, { 0.75, 0.22, 0.10 } },
    { "oak", 0.13, 0.8, 0.12, 0.0005, 1.2, 0.0, { 0.62, 0.38, 0.15 } },
    { "willow", 0.12, 0.7, 0.09, 0.0003, 1.2, 0.0, { 0.78, 0.70, 0.25 } },
    { "aspen", 0.06, 0.8, 0.09, 0.0003, 1.2, 0.0, { 0.92, 0.74, 0.20 } },
    { "feather", 0.20, 0.4, 0.04, 0.0005, 1.2, 0.0, { 0.90, 0.88, 0.84 } },
    { "down", 0.05, 0.15, 0.02, 0.0010, 1.2, 0.5, { 0.96, 0.95, 0.93 } },
    { "petal", 0.04, 0.6, 0.06, 0.0003, 1.2, 0.25, { 0.95, 0.72, 0.78 } },
    { "bubble", 0.06, 0.05, 0.002, 0.000002, 0.47, 0.9, { 0.80, 0.90, 0.98 } },
    { "disc", 0.10, 0.9, 0.12, 0.0002, 1.2, 0.0, { 0.95, 0.95, 0.92 } },
  };
  return shapes;
}

PlanBox TextureBox(const Outline& outline)
{
  constexpr double margin = 0.02;
  const FlatSheet sheet = FlattenOutline(outline, SheetOptions().Rows, SheetOptions().Columns);
  PlanBox box{ 1e300, 1e300, -1e300, -1e300 };
  for (const auto& p : sheet.Points)
  {
    box.X0 = std::min(box.X0, p[0]);
    box.Y0 = std::min(box.Y0, p[1]);
    box.X1 = std::max(box.X1, p[0]);
    box.Y1 = std::max(box.Y1, p[1]);
  }
  const double growX = margin * (box.X1 - box.X0);
  const double growY = margin * (box.Y1 - box.Y0);
  return { box.X0 - growX, box.Y0 - growY, box.X1 + growX, box.Y1 + growY };
}

Result MakeSheet(const Outline& outline, const SheetOptions& options, Shape& shape)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  const FlatSheet sheet = FlattenOutline(outline, options.Rows, options.Columns);
  const PlanBox box = TextureBox(outline);
  shape.TextureCoordinates.clear();
  for (const auto& p : sheet.Points)
  {
    shape.TextureCoordinates.push_back(
      { (p[0] - box.X0) / (box.X1 - box.X0), (p[1] - box.Y0) / (box.Y1 - box.Y0) });
  }
  BendSheet(sheet, options, shape);
  return Result::Ok();
}

Result MakeBuiltinShape(const std::string& name, double size, Shape& shape)
{
  std::string known;
  for (const BuiltinShape& builtin : BuiltinShapes())
  {
    known += (known.empty() ? "" : ", ") + builtin.Name;
    if (builtin.Name != name)
    {
      continue;
    }
    Shape made;
    made.Name = name;
    made.AreaDensity = builtin.AreaDensity;
    made.SettlingSpeed = builtin.SettlingSpeed;
    made.Thickness = builtin.Thickness;
    made.Damping = builtin.Damping;
    made.DragCoefficient = builtin.DragCoefficient;
    made.Color = builtin.Color;
    const double length = size > 0.0 ? size : builtin.Size;
    if (name == "bubble")
    {
      made.Mesh = MakeSphere(Vec3::Zero(), 0.5, 24, 14);
      for (const Vec3& p : made.Mesh.Points)
      {
        made.TextureCoordinates.push_back({ 0.5 + p.x(), 0.5 + p.y() });
      }
      ScaleToExtent(length, made.Mesh);
    }
    else
    {
      Outline outline;
      Result result = OutlineOf(name, outline);
      SheetOptions options = SheetOf(name);
      options.Length = length;
      if (result)
      {
        result = MakeSheet(outline, options, made);
      }
      if (!result)
      {
        return result;
      }
    }
    shape = std::move(made);
    return Result::Ok();
  }
  return Result::Error("expected a built-in shape (" + known + "), found \"" + name + "\"");
}

Result AlignShape(double size, TriangleMesh& mesh)
{
  for (const Vec3& p : mesh.Points)
  {
    if (!p.allFinite())
    {
      return Result::Error("expected finite points, found one that is not");
    }
  }
  const double area = SurfaceArea(mesh);
  if (!(area > 0.0))
  {
    return Result::Error("expected a surface with an area, found none");
  }
  CenterOnMass(mesh);
  // Second moments of the shell: exact over each triangle.
  Mat3 moments = Mat3::Zero();
  for (const auto& t : mesh.Triangles)
  {
    const Vec3& a = mesh.Points[t[0]];
    const Vec3& b = mesh.Points[t[1]];
    const Vec3& c = mesh.Points[t[2]];
    const Vec3 sum = a + b + c;
    const double weight = 0.5 * (b - a).cross(c - a).norm() / 12.0;
    moments +=
      weight * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(moments); // ascending
  Mat3 rotation;
  rotation.row(0) = axes.eigenvectors().col(2).transpose();
  rotation.row(2) = axes.eigenvectors().col(0).transpose();
  double skewX = 0.0;
  double skewZ = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    const Vec3& a = mesh.Points[t[0]];
    const double weight = (mesh.Points[t[1]] - a).cross(mesh.Points[t[2]] - a).norm();
    const Vec3 center = (a + mesh.Points[t[1]] + mesh.Points[t[2]]) / 3.0;
    skewX += weight * std::pow(rotation.row(0).dot(center), 3);
    skewZ += weight * std::pow(rotation.row(2).dot(center), 3);
  }
  if (skewX < 0.0)
  {
    rotation.row(0) *= -1.0;
  }
  if (skewZ < 0.0)
  {
    rotation.row(2) *= -1.0;
  }
  rotation.row(1) = Vec3(rotation.row(2)).cross(Vec3(rotation.row(0))).transpose();
  for (Vec3& p : mesh.Points)
  {
    p = rotation * p;
  }
  if (size > 0.0)
  {
    ScaleToExtent(size, mesh);
  }
  return Result::Ok();
}

} // namespace waft
