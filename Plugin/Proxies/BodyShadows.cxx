// SPDX-License-Identifier: BSD-3-Clause
#include "BodyShadows.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace waft
{

namespace
{

constexpr double Spread = 2.4;  // half a shadow's length, over the standard deviation of its body
constexpr double Narrow = 0.35; // width at least, over the length
constexpr double Near = 8.0;    // standard deviations of height in which a shadow pales
constexpr double Dark = 0.75;   // opacity under what lies
constexpr double Pale = 0.30;   // and under what is high up
constexpr double Wide = 0.8;    // by which a shadow is wider then
constexpr double Lift = 2e-4;   // above the ground, over the extent of all

/// Of points: their number, sums and sums of products.
struct Footprint
{
  double Count = 0.0, X = 0.0, Y = 0.0, Z = 0.0, XX = 0.0, XY = 0.0, YY = 0.0;

  void Add(const double* point)
  {
    this->Count += 1.0;
    this->X += point[0];
    this->Y += point[1];
    this->Z += point[2];
    this->XX += point[0] * point[0];
    this->XY += point[0] * point[1];
    this->YY += point[1] * point[1];
  }
};

std::map<int, Footprint> FootprintsOf(vtkPolyData* bodies)
{
  vtkDataArray* ids = bodies->GetPointData()->GetArray("ObjectId");
  std::map<int, Footprint> prints;
  Footprint* print = nullptr;
  int of = 0;
  for (vtkIdType i = 0; i < bodies->GetNumberOfPoints(); ++i)
  {
    const int id = ids != nullptr ? static_cast<int>(ids->GetComponent(i, 0)) : 0;
    if (print == nullptr || id != of) // points of a body follow one another
    {
      print = &prints[id];
      of = id;
    }
    print->Add(bodies->GetPoint(i));
  }
  return prints;
}

struct Sheet
{
  vtkNew<vtkPoints> Corners;
  vtkNew<vtkCellArray> Quads;
  vtkNew<vtkFloatArray> Places;
  vtkNew<vtkUnsignedCharArray> Colors;

  void Add(const Footprint& body, double ground, double lift)
  {
    const double x = body.X / body.Count, y = body.Y / body.Count, z = body.Z / body.Count;
    const double xx = body.XX / body.Count - x * x, yy = body.YY / body.Count - y * y;
    const double xy = body.XY / body.Count - x * y;
    const double middle = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
    const double length = std::sqrt(std::max(0.0, middle + apart));
    const double width = std::max(std::sqrt(std::max(0.0, middle - apart)), Narrow * length);
    if (length == 0.0 || z < ground)
    {
      return;
    }
    const double nearness = std::exp(-(z - ground) / (Near * length));
    const double wider = Spread * (1.0 + Wide * (1.0 - nearness));
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const double along[2] = { wider * length * std::cos(angle), wider * length * std::sin(angle) };
    const double across[2] = { -wider * width * std::sin(angle), wider * width * std::cos(angle) };
    const auto opacity =
      static_cast<unsigned char>(std::lround(255.0 * (Pale + (Dark - Pale) * nearness)));
    this->Quads->InsertNextCell(4);
    for (const std::array<int, 2>& side :
         { std::array{ -1, -1 }, std::array{ 1, -1 }, std::array{ 1, 1 }, std::array{ -1, 1 } })
    {
      this->Quads->InsertCellPoint(this->Corners->InsertNextPoint(
        x + side[0] * along[0] + side[1] * across[0], y + side[0] * along[1] + side[1] * across[1],
        ground + lift));
      this->Places->InsertNextTuple2(0.5 * (1 + side[0]), 0.5 * (1 + side[1]));
      this->Colors->InsertNextTuple4(20, 24, 30, opacity);
    }
  }
};

} // namespace

vtkSmartPointer<vtkPolyData> ShadowsOf(vtkPolyData* bodies)
{
  vtkDataArray* ground = bodies->GetFieldData()->GetArray("Ground");
  if (ground == nullptr || ground->GetNumberOfValues() != 1)
  {
    return nullptr;
  }
  Sheet sheet;
  sheet.Places->SetNumberOfComponents(2);
  sheet.Colors->SetNumberOfComponents(4);
  for (const auto& [id, print] : FootprintsOf(bodies))
  {
    sheet.Add(print, ground->GetComponent(0, 0), Lift * bodies->GetLength());
  }
  auto shadows = vtkSmartPointer<vtkPolyData>::New();
  shadows->SetPoints(sheet.Corners);
  shadows->SetPolys(sheet.Quads);
  shadows->GetPointData()->SetTCoords(sheet.Places);
  shadows->GetPointData()->SetScalars(sheet.Colors);
  return shadows;
}

} // namespace waft
