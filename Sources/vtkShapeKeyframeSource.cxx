// SPDX-License-Identifier: BSD-3-Clause
#include "vtkShapeKeyframeSource.h"

#include "Bridge/Data/Blocks.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/KeyframeOptions.h"
#include "Scene/LetterSpacing.h"
#include "Scene/SurfaceSampling.h"
#include "Scene/TargetSampling.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

vtkStandardNewMacro(vtkShapeKeyframeSource);

namespace
{

constexpr int NumberToLookAt = 48; // of targets, before there are objects

/// Places and classes of the targets of one shape.
struct Drawing
{
  const waft::KeyframeOptions& Options;
  std::size_t Count;
  std::vector<waft::Vec3> Positions;
  std::vector<int> Classes;
  std::string Remark; // what is odd about the picture

  waft::Result Draw(vtkDataObject* input);

private:
  waft::Result DrawMask(const waft::TargetMask& mask);
  waft::Result DrawText();
  waft::Result DrawImage();
  waft::Result DrawSurface(vtkDataObject* data);
};

waft::Result Drawing::DrawMask(const waft::TargetMask& mask)
{
  const waft::Vec3& u = this->Options.U;
  const waft::Vec3& v = this->Options.V;
  if (!(u.cross(v).norm() > 1e-3 * u.norm() * v.norm()))
  {
    return waft::Result::Error("U and V: expected directions that are not parallel");
  }
  std::vector<waft::PlaneTarget> targets;
  WAFT_RETURN_IF_FAILED(waft::SampleMask(mask, this->Count, {}, this->Options.Seed, 0, targets));
  for (const waft::PlaneTarget& target : targets)
  {
    this->Positions.push_back(this->Options.Origin +
                              this->Options.Width *
                                (target.X * u.normalized() + target.Y * v.normalized()));
    this->Classes.push_back(target.Class);
  }
  return waft::Result::Ok();
}

waft::Result Drawing::DrawText()
{
  if (this->Options.Text.empty())
  {
    return waft::Result::Error("Text: expected a text that is not empty");
  }
  waft::Picture picture;
  if (const waft::Result drawn =
        waft::VtkSceneAssets().DrawText(this->Options.Text, this->Options.Font, picture);
      !drawn)
  {
    return waft::Result::Error("Text: " + drawn.Message());
  }
  const double distance = waft::TargetDistance(waft::MaskFromPicture(picture, {}), this->Count);
  return this->DrawMask(waft::MaskFromPicture(waft::SpreadLetters(picture, distance), {}));
}

waft::Result Drawing::DrawImage()
{
  if (this->Options.ImageFile.empty())
  {
    return waft::Result::Error("ImageFile: expected the name of a picture");
  }
  waft::Picture picture;
  if (const waft::Result loaded =
        waft::VtkSceneAssets().LoadPicture(this->Options.ImageFile, picture);
      !loaded)
  {
    return waft::Result::Error("ImageFile " + this->Options.ImageFile + ": " + loaded.Message());
  }
  const std::string remark = waft::RemarkOnTransparency(picture);
  if (!remark.empty() && this->Options.ClassColors.empty())
  {
    this->Remark = "ImageFile " + this->Options.ImageFile + ": " + remark;
  }
  return this->DrawMask(waft::MaskFromPicture(picture, this->Options.ClassColors));
}

waft::Result Drawing::DrawSurface(vtkDataObject* data)
{
  vtkSmartPointer<vtkPolyData> input;
  if (data != nullptr)
  {
    WAFT_RETURN_IF_FAILED(waft::OneSurface(data, "Input", input));
  }
  if (input == nullptr || input->GetNumberOfPoints() == 0)
  {
    return waft::Result::Error("Input: expected a surface, since Shape is Surface");
  }
  waft::TriangleMesh mesh;
  WAFT_RETURN_IF_FAILED(waft::MeshFromPolyData(input, "Input", mesh));
  WAFT_RETURN_IF_FAILED(
    waft::SampleSurface(mesh, this->Count, this->Options.Seed, 0, this->Positions));
  this->Classes.assign(this->Positions.size(), -1);
  return waft::Result::Ok();
}

waft::Result Drawing::Draw(vtkDataObject* input)
{
  switch (this->Options.Shape)
  {
    case waft::DrawnShape::Text:
      return this->DrawText();
    case waft::DrawnShape::Image:
      return this->DrawImage();
    case waft::DrawnShape::Surface:
      break;
  }
  return this->DrawSurface(input);
}

constexpr int AlongTheArrow = waft::NumberOfPlaceOrders + 1;

/// Of each target, where they come or go one after another; else nothing.
std::vector<double> PartsOf(const Drawing& drawing)
{
  const waft::KeyframeOptions& options = drawing.Options;
  if (options.Order == 0)
  {
    return {};
  }
  if (options.Order == AlongTheArrow)
  {
    std::vector<double> keys;
    for (const waft::Vec3& x : drawing.Positions)
    {
      keys.push_back(x.dot(options.OrderTo - options.OrderFrom));
    }
    return waft::PartsByKey(keys);
  }
  const bool isDrawn = options.Shape != waft::DrawnShape::Surface;
  const waft::Vec3 u = isDrawn ? options.U : waft::Vec3::UnitX();
  const waft::Vec3 v = isDrawn ? options.V : waft::Vec3::UnitZ();
  std::vector<waft::OrderedPlace> places;
  for (const waft::Vec3& x : drawing.Positions)
  {
    places.push_back({ x.dot(u), x.dot(v), x });
  }
  return waft::PartsByPlace(static_cast<waft::PlaceOrder>(options.Order - 1), places, options.Seed,
                            0);
}

std::vector<waft::Constraint> RowsOf(const Drawing& drawing)
{
  const waft::KeyframeOptions& options = drawing.Options;
  const std::vector<double> order = PartsOf(drawing);
  const std::vector<double> parts = options.FrameFrom >= 0 ? order : std::vector<double>();
  const std::vector<double> leaving =
    order.empty() ? waft::PartsByChance(drawing.Positions.size(), options.Seed, waft::LeaveStream)
                  : order;
  const waft::FrameWindow goes{ options.LeaveFrame,
                                std::max(options.LeaveFrame, options.LastLeave) };
  const waft::FrameWindow window{ options.FrameFrom, options.Frame };
  const int last = options.NumberOfFrames - 1;
  std::vector<waft::Constraint> rows;
  for (std::size_t k = 0; k < drawing.Positions.size(); ++k)
  {
    waft::Constraint row;
    row.Kind = options.Rest ? waft::ConstraintKind::Rest : waft::ConstraintKind::Position;
    row.Frame = options.Frame;
    row.Until = options.Rest ? std::max(options.Frame, options.Until < 0 ? last : options.Until)
                             : options.Frame;
    row.FrameFrom = options.FrameFrom;
    row.IsOpenWindow = options.FrameFrom >= 0 && parts.empty();
    row.Hold = options.Rest ? 0 : options.Hold;
    row.Drifts = options.Drift && row.Hold > 0 ? 1 : 0;
    row.On = options.On;
    if (options.Leave > 0)
    {
      row.Goes.From = waft::FrameAt(goes, waft::TimeSpread::Even, leaving[k]);
      row.Goes.Away = options.Leave > 1 ? waft::SidesOut[options.Leave - 2].Direction()
                                        : waft::Vec3(waft::Vec3::Zero());
      row.Until = options.Rest ? std::min(row.Until, row.Goes.From) : row.Until;
    }
    if (!parts.empty())
    {
      waft::SetArrival(waft::FrameAt(window, waft::TimeSpread::Even, parts[k]),
                       drawing.Positions[k], row);
    }
    row.Value = drawing.Positions[k];
    row.Radius = options.Radius;
    row.Row = -1;
    row.Target = static_cast<int>(k);
    row.Group = options.Group;
    row.ClassId = drawing.Classes[k];
    options.AskOf(row);
    rows.push_back(row);
  }
  waft::SetHolds(last, rows);
  return rows;
}

using waft::StageInput;

const waft::StageInputs InputsOfKeyframes = {
  { "Input", StageInput::Type::Anything, StageInput::Number::Optional },
  { "Objects", StageInput::Type::Merged, StageInput::Number::Optional },
};

/// As many as were asked for, or as there are objects.
std::size_t CountOf(const waft::KeyframeOptions& options, vtkPolyData* objects)
{
  const vtkIdType found = objects != nullptr ? objects->GetNumberOfPoints() : 0;
  return static_cast<std::size_t>(options.NumberOfTargets > 0 ? options.NumberOfTargets
                                  : found > 0                 ? found
                                                              : NumberToLookAt);
}

} // namespace

struct vtkShapeKeyframeSource::Internals
{
  waft::StageCache Cache; // each frame that is played asks for the rows
  vtkNew<vtkPolyData> Kept;
};

vtkShapeKeyframeSource::vtkShapeKeyframeSource() : Impl(std::make_unique<Internals>())
{
  waft::TakeDefaults<waft::KeyframeOptions>(*this);
  this->SetNumberOfInputPorts(OBJECTS_PORT + 1);
}

vtkShapeKeyframeSource::~vtkShapeKeyframeSource() = default;

double vtkShapeKeyframeSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::KeyframeOptions>(property, value);
}

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

int vtkShapeKeyframeSource::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(InputsOfKeyframes, port, info);
}

vtkTypeBool vtkShapeKeyframeSource::ProcessRequest(vtkInformation* request,
                                                   vtkInformationVector** inputs,
                                                   vtkInformationVector* outputs)
{
  return waft::GuardedRequest(this, request, inputs, outputs, InputsOfKeyframes,
                              waft::RangesOf<waft::KeyframeOptions>(*this),
                              [&](vtkInformationVector** taken) {
                                return this->Superclass::ProcessRequest(request, taken, outputs);
                              });
}

int vtkShapeKeyframeSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                               vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  return 1;
}

int vtkShapeKeyframeSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                        vtkInformationVector* outputs)
{
  const auto options = waft::OptionsOf<waft::KeyframeOptions>(*this);
  const waft::SceneInfo info = options.Info();
  const int last = options.NumberOfFrames - 1;
  if (options.Frame > last)
  {
    return waft::Fail(this, outputs,
                      "expected a Frame of at most " + std::to_string(last) +
                        ", the last of NumberOfFrames");
  }
  Internals& impl = *this->Impl;
  vtkInformation* surface = inputs[INPUT_PORT]->GetInformationObject(0);
  const bool varies = this->Shape == SURFACE && surface != nullptr &&
                      surface->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  if (varies || !impl.Cache.IsCurrent(this, inputs))
  {
    impl.Cache.Forget();
    const std::size_t count = CountOf(options, vtkPolyData::GetData(inputs[OBJECTS_PORT]));
    Drawing drawing{ options, count, {}, {}, {} };
    if (waft::Result drawn = drawing.Draw(vtkDataObject::GetData(inputs[INPUT_PORT])); !drawn)
    {
      return waft::Fail(this, outputs, drawn.Message());
    }
    if (!drawing.Remark.empty())
    {
      vtkWarningMacro(<< drawing.Remark);
    }
    if (options.FrameFrom >= options.Frame)
    {
      return waft::Fail(this, outputs, "FrameFrom: expected a frame before Frame, or -1");
    }
    if (options.Hold > 0 && !options.Rest && options.Radius > 0.0)
    {
      return waft::Fail(this, outputs, "Hold: expected 0 where Radius is above 0");
    }
    waft::ConstraintsToPolyData(RowsOf(drawing), info, impl.Kept);
    impl.Cache.MarkCurrent(this, inputs);
  }
  vtkPolyData::GetData(outputs)->ShallowCopy(impl.Kept);
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkShapeKeyframeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::KeyframeOptions>(os, indent, *this);
}
