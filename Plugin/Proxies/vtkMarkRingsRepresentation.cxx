// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMarkRingsRepresentation.h"

#include "PartOfSurface.h"
#include "SoftDisc.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutlineSource.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkMarkRingsRepresentation);

namespace
{

constexpr double Least = 0.006;       // radius of a ring, over the diagonal of the volume
constexpr double FewMarks = 60.0;     // marks from which on rings are smaller
constexpr int Position = 0, Rest = 4; // Kinds of rows that are places
// Of rings that lie: their radius, over that of others, for they go round bodies; what is clear of
// it; and how high they hang, for bodies dip into what they lie on.
constexpr double LyingSize = 2.5, LyingHole = 0.72, Lift = 0.1;
constexpr double EdgeStrength = 0.4; // of the edges of a volume
constexpr int Corners = 48;
using Rgb = std::array<unsigned char, 3>;
constexpr Rgb Waiting{ 235, 150, 40 }, Met{ 40, 190, 120 }, Missed{ 215, 60, 45 };
// Offsets are in radii. The colour is as it is told, whatever the light.
constexpr const char* Ring = "//VTK::Color::Impl\n"
                             "  float away = length(offsetVCVSOutput.xy);\n"
                             "  if (away > 1.0 || away < 0.72) discard;\n"
                             "  ambientColor = vertexColorVSOutput.rgb;\n"
                             "  diffuseColor = vec3(0.0);\n";

double ValueOf(vtkDataArray* array, vtkIdType tuple, double otherwise)
{
  return array != nullptr && tuple < array->GetNumberOfTuples() ? array->GetComponent(tuple, 0)
                                                                : otherwise;
}

/// The volume of a scene; where the data have none, what the marks take up.
std::array<double, 6> VolumeOf(vtkPolyData* marks)
{
  std::array<double, 6> box{};
  vtkDataArray* volume = marks->GetFieldData()->GetArray("Bounds");
  if (volume != nullptr && volume->GetNumberOfValues() == 6)
  {
    for (vtkIdType i = 0; i < 6; ++i)
    {
      box[static_cast<std::size_t>(i)] = volume->GetVariantValue(i).ToDouble();
    }
  }
  else
  {
    marks->GetBounds(box.data());
  }
  return box;
}

/// Radius where rows have none [m].
double LeastRadius(vtkPolyData* marks)
{
  const std::array<double, 6> box = VolumeOf(marks);
  const auto crowd = static_cast<double>(marks->GetNumberOfPoints());
  return Least * std::min(1.0, std::sqrt(FewMarks / crowd)) *
         std::hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]);
}

/// Rings that lie on what bodies come to rest on.
struct LyingRings
{
  vtkNew<vtkPoints> Places;
  vtkNew<vtkCellArray> Quads;
  vtkNew<vtkUnsignedCharArray> Colors;

  LyingRings() { this->Colors->SetNumberOfComponents(3); }

  void Add(double x, double y, double z, double radius, const Rgb& color)
  {
    const vtkIdType first = this->Places->GetNumberOfPoints();
    for (int corner = 0; corner < Corners; ++corner)
    {
      const double angle = 2.0 * vtkMath::Pi() * corner / Corners;
      for (const double away : { LyingHole * radius, radius })
      {
        this->Places->InsertNextPoint(x + away * std::cos(angle), y + away * std::sin(angle), z);
        this->Colors->InsertNextTypedTuple(color.data());
      }
      const vtkIdType inner = first + 2 * corner, next = first + 2 * ((corner + 1) % Corners);
      const vtkIdType quad[4] = { inner, inner + 1, next + 1, next };
      this->Quads->InsertNextCell(4, quad);
    }
  }

  vtkSmartPointer<vtkPolyData> Take()
  {
    auto rings = vtkSmartPointer<vtkPolyData>::New();
    rings->SetPoints(this->Places);
    rings->SetPolys(this->Quads);
    rings->GetPointData()->SetScalars(this->Colors);
    return rings;
  }
};

void DrawRings(vtkActor* actor)
{
  vtkNew<vtkPointGaussianMapper> mapper;
  mapper->SetScaleArray("Radius");
  mapper->SetScaleFactor(1.0);
  mapper->EmissiveOff();
  mapper->SetSplatShaderCode(Ring);
  mapper->ScalarVisibilityOn();
  mapper->SetColorModeToDirectScalars();
  actor->SetMapper(mapper);
}

} // namespace

vtkMarkRingsRepresentation::vtkMarkRingsRepresentation() :
  Pool(waft::MakeSoftDisc(waft::FloorStrength))
{
}

vtkMarkRingsRepresentation::~vtkMarkRingsRepresentation() = default;

void vtkMarkRingsRepresentation::AddVolume(vtkPolyData* block, Parts& parts)
{
  const std::array<double, 6> box = VolumeOf(block);
  std::array<double, 6> under = box;
  under[5] = box[4];
  Part floor;
  std::copy_n(waft::FloorColor, 3, floor.Color);
  floor.IsLit = false;
  floor.IsPool = true;
  floor.Actor = this->ActorFor(parts, waft::TopOf(under.data()), this->Pool, waft::LeaveOutRim);
  const double* bounds = block->GetBounds();
  for (int side = 0; side < 6; ++side)
  {
    floor.Reach = std::max(floor.Reach, std::abs(box[side] - bounds[side]));
  }
  parts.push_back(std::move(floor));
  vtkNew<vtkOutlineSource> edges;
  edges->SetBounds(box.data());
  edges->Update();
  vtkPolyData* lines = edges->GetOutput();
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    const double* place = block->GetPoint(i);
    const vtkIdType upright[2] = { lines->GetPoints()->InsertNextPoint(place),
                                   lines->GetPoints()->InsertNextPoint(place[0], place[1],
                                                                       box[4]) };
    lines->GetLines()->InsertNextCell(2, upright);
  }
  Part part;
  part.Opacity = EdgeStrength;
  part.IsLit = false;
  part.IsVeil = true;
  part.Actor = this->ActorFor(parts, lines, nullptr);
  parts.push_back(std::move(part));
}

void vtkMarkRingsRepresentation::AddParts(vtkPolyData* block, double time, Parts& parts)
{
  if (this->ShowVolume)
  {
    this->AddVolume(block, parts);
  }
  vtkPointData* rows = block->GetPointData();
  vtkDataArray* kinds = rows->GetArray("Kind");
  const double rate = ValueOf(block->GetFieldData()->GetArray("FramesPerSecond"), 0, 30.0);
  const double now = std::round(time * rate);
  const double least = LeastRadius(block);
  const double missing = std::numeric_limits<double>::quiet_NaN();
  vtkDataArray* surfaces = block->GetFieldData()->GetArray("LandingHeight");
  LyingRings lying;
  vtkNew<vtkPoints> places;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("Radius");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    const double kind = ValueOf(kinds, i, Position);
    if (kind != Position && kind != Rest)
    {
      continue;
    }
    const bool isMet = ValueOf(rows->GetArray("Status"), i, 0.0) == 0.0;
    const Rgb& color =
      now < ValueOf(rows->GetArray("Frame"), i, HUGE_VAL) ? Waiting : (isMet ? Met : Missed);
    const double* place = block->GetPoint(i);
    const double surface = kind == Rest ? ValueOf(surfaces, i, missing) : missing;
    if (!std::isnan(surface))
    {
      lying.Add(place[0], place[1], surface + Lift * LyingSize * least, LyingSize * least, color);
      continue;
    }
    places->InsertNextPoint(place);
    const double radius = kind == Rest ? 0.0 : ValueOf(rows->GetArray("Radius"), i, 0.0);
    radii->InsertNextValue(static_cast<float>(std::max(radius, least)));
    colors->InsertNextTypedTuple(color.data());
  }
  if (lying.Places->GetNumberOfPoints() > 0)
  {
    Part part;
    part.IsLit = false;
    part.Actor = this->ActorFor(parts, lying.Take(), nullptr, waft::TakeColorsOfPoints);
    part.Reach = LyingSize * least;
    parts.push_back(std::move(part));
  }
  if (places->GetNumberOfPoints() == 0)
  {
    return;
  }
  const auto rings = vtkSmartPointer<vtkPolyData>::New();
  rings->SetPoints(places);
  rings->GetPointData()->SetScalars(colors);
  rings->GetPointData()->AddArray(radii);
  Part part;
  part.Actor = this->ActorFor(parts, rings, nullptr, DrawRings);
  part.Reach = radii->GetRange()[1];
  parts.push_back(std::move(part));
}

void vtkMarkRingsRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ShowVolume: " << this->ShowVolume << "\n";
}
