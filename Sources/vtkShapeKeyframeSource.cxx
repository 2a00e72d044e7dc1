// SPDX-License-Identifier: BSD-3-Clause
#include "vtkShapeKeyframeSource.h"

#include "Bridge/ConstraintData.h"
#include "Bridge/FieldCollectors.h"
#include "Bridge/PrintValues.h"
#include "Bridge/SceneFiles.h"
#include "Bridge/StageExecution.h"
#include "Scene/LetterSpacing.h"
#include "Scene/SurfaceSampling.h"
#include "Scene/TargetSampling.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>

vtkStandardNewMacro(vtkShapeKeyframeSource);

/// Places and classes of the targets of one shape.
struct vtkShapeKeyframeSource::Drawing
{
  const vtkShapeKeyframeSource& Source;
  std::vector<waft::Vec3> Places;
  std::vector<int> Classes;

  waft::Result Draw(vtkPolyData* input);

private:
  waft::Result DrawMask(const waft::TargetMask& mask);
  waft::Result DrawText();
  waft::Result DrawImage();
  waft::Result DrawSurface(vtkPolyData* input);
  std::size_t Count() const { return static_cast<std::size_t>(this->Source.NumberOfTargets); }
  std::uint64_t Seed() const { return static_cast<std::uint64_t>(this->Source.Seed); }
};

waft::Result vtkShapeKeyframeSource::Drawing::DrawMask(const waft::TargetMask& mask)
{
  const waft::Vec3 u = waft::Vec3(this->Source.U);
  const waft::Vec3 v = waft::Vec3(this->Source.V);
  if (!(u.cross(v).norm() > 1e-3 * u.norm() * v.norm()))
  {
    return waft::Result::Error("U and V: expected directions that are not parallel");
  }
  if (!(this->Source.Width > 0.0))
  {
    return waft::Result::Error("Width: expected more than 0");
  }
  std::vector<waft::PlaneTarget> targets;
  WAFT_RETURN_IF_FAILED(waft::SampleMask(mask, this->Count(), {}, this->Seed(), 0, targets));
  for (const waft::PlaneTarget& target : targets)
  {
    this->Places.push_back(waft::Vec3(this->Source.Origin) +
                           this->Source.Width *
                             (target.X * u.normalized() + target.Y * v.normalized()));
    this->Classes.push_back(target.Class);
  }
  return waft::Result::Ok();
}

waft::Result vtkShapeKeyframeSource::Drawing::DrawText()
{
  if (this->Source.Text.empty())
  {
    return waft::Result::Error("Text: expected a text that is not empty");
  }
  waft::Picture picture;
  WAFT_RETURN_IF_FAILED(
    waft::VtkSceneAssets().DrawText(this->Source.Text, this->Source.Font, picture));
  const double distance = waft::TargetDistance(waft::MaskFromPicture(picture, {}), this->Count());
  return this->DrawMask(waft::MaskFromPicture(waft::SpreadLetters(picture, distance), {}));
}

waft::Result vtkShapeKeyframeSource::Drawing::DrawImage()
{
  if (this->Source.ImageFile.empty())
  {
    return waft::Result::Error("ImageFile: expected the name of a picture");
  }
  waft::Picture picture;
  if (const waft::Result loaded =
        waft::VtkSceneAssets().LoadPicture(this->Source.ImageFile, picture);
      !loaded)
  {
    return waft::Result::Error("ImageFile " + this->Source.ImageFile + ": " + loaded.Message());
  }
  return this->DrawMask(waft::MaskFromPicture(picture, this->Source.ClassColors));
}

waft::Result vtkShapeKeyframeSource::Drawing::DrawSurface(vtkPolyData* input)
{
  if (input == nullptr || input->GetNumberOfPoints() == 0)
  {
    return waft::Result::Error("Input: expected a surface, since Shape is Surface");
  }
  waft::TriangleMesh mesh;
  WAFT_RETURN_IF_FAILED(waft::MeshFromPolyData(input, "Input", mesh));
  WAFT_RETURN_IF_FAILED(waft::SampleSurface(mesh, this->Count(), this->Seed(), 0, this->Places));
  this->Classes.assign(this->Places.size(), -1);
  return waft::Result::Ok();
}

waft::Result vtkShapeKeyframeSource::Drawing::Draw(vtkPolyData* input)
{
  return this->Source.Shape == TEXT    ? this->DrawText()
         : this->Source.Shape == IMAGE ? this->DrawImage()
                                       : this->DrawSurface(input);
}

vtkShapeKeyframeSource::vtkShapeKeyframeSource() = default;

void vtkShapeKeyframeSource::SetNumberOfClassColors(int count)
{
  if (count > waft::limits::Count.High)
  {
    vtkErrorMacro("NumberOfClassColors: expected at most " << waft::limits::Count.High << ", found "
                                                           << count);
    return;
  }
  const auto size = static_cast<std::size_t>(std::max(0, count));
  if (size != this->ClassColors.size())
  {
    this->ClassColors.resize(size, { 0.0, 0.0, 0.0 });
    this->Modified();
  }
}

void vtkShapeKeyframeSource::SetClassColor(int index, double red, double green, double blue)
{
  if (index < 0)
  {
    return;
  }
  this->SetNumberOfClassColors(
    std::max(std::min(index, VTK_INT_MAX - 1) + 1, this->GetNumberOfClassColors()));
  if (index >= this->GetNumberOfClassColors())
  {
    return; // it was refused
  }
  this->ClassColors[static_cast<std::size_t>(index)] = { red, green, blue };
  this->Modified();
}

int vtkShapeKeyframeSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

vtkTypeBool vtkShapeKeyframeSource::ProcessRequest(vtkInformation* request,
                                                   vtkInformationVector** inputs,
                                                   vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "ClassColors", this->ClassColors, waft::limits::UpTo(1.0) },
      { "Radius", this->Radius, waft::limits::Distance },
      { "Origin", this->Origin, waft::limits::Coordinate },
      { "U", this->U, waft::limits::Direction },
      { "V", this->V, waft::limits::Direction },
      { "Width", this->Width, waft::limits::Length },
      { "Bounds", this->Bounds, waft::limits::Coordinate },
      { "NumberOfFrames", this->NumberOfFrames,
        waft::limits::Range{ 1, waft::limits::Frames.High } },
      { "FramesPerSecond", this->FramesPerSecond, waft::limits::FramesPerSecond } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkShapeKeyframeSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                               vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond }, outputs);
  return 1;
}

int vtkShapeKeyframeSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                        vtkInformationVector* outputs)
{
  waft::SceneInfo info;
  const double* b = this->Bounds;
  info.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  info.Time = waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond };
  info.Seed = static_cast<std::uint64_t>(this->Seed);
  const int last = this->NumberOfFrames - 1;
  if (this->Frame > last || !(this->FramesPerSecond > 0.0))
  {
    return waft::Fail(this, outputs,
                      "expected a Frame of at most " + std::to_string(last) +
                        ", the last of NumberOfFrames");
  }
  Drawing drawing{ *this, {}, {} };
  if (waft::Result drawn = drawing.Draw(vtkPolyData::GetData(inputs[0])); !drawn)
  {
    return waft::Fail(this, outputs, drawn.Message());
  }
  std::vector<waft::Constraint> rows;
  for (std::size_t k = 0; k < drawing.Places.size(); ++k)
  {
    waft::Constraint row;
    row.Kind = this->Rest ? waft::ConstraintKind::Rest : waft::ConstraintKind::Position;
    row.Frame = this->Frame;
    row.Until =
      this->Rest ? std::max(this->Frame, this->Until < 0 ? last : this->Until) : this->Frame;
    row.Value = drawing.Places[k];
    row.Radius = this->Radius;
    row.Row = -1;
    row.Target = static_cast<int>(k);
    row.Group = this->Group;
    row.ClassId = drawing.Classes[k];
    rows.push_back(row);
  }
  waft::ConstraintsToPolyData(rows, info, vtkPolyData::GetData(outputs));
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkShapeKeyframeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shape: " << this->Shape << "\n";
  os << indent << "Text: " << this->Text << "\n";
  os << indent << "Font: " << this->Font << "\n";
  os << indent << "ImageFile: " << this->ImageFile << "\n";
  for (const std::array<double, 3>& color : this->ClassColors)
  {
    waft::PrintValues(os, indent, "ClassColor", color.data(), 3);
  }
  os << indent << "NumberOfTargets: " << this->NumberOfTargets << "\n";
  os << indent << "Frame: " << this->Frame << "\n";
  os << indent << "Rest: " << this->Rest << "\n";
  os << indent << "Until: " << this->Until << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Group: " << this->Group << "\n";
  waft::PrintValues(os, indent, "Origin", this->Origin, 3);
  waft::PrintValues(os, indent, "U", this->U, 3);
  waft::PrintValues(os, indent, "V", this->V, 3);
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  waft::PrintValues(os, indent, "Bounds", this->Bounds, 6);
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
}
