// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPaintedShapeSource.h"

#include "Base/AtomicFile.h"
#include "Bridge/PrintValues.h"
#include "Bridge/StageExecution.h"
#include "Shapes/PngImage.h"
#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"

#include <algorithm>
#include <cmath>

namespace
{
std::array<double, 3> Color(const double* color)
{
  return { color[0], color[1], color[2] };
}
} // namespace

vtkTypeBool vtkPaintedShapeSource::ProcessRequest(vtkInformation* request,
                                                  vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "Width", this->Width, waft::limits::Finite },
      { "Bend", this->Bend, waft::limits::Finite },
      { "BaseColor", this->BaseColor, waft::limits::UpTo(1.0) },
      { "EdgeColor", this->EdgeColor, waft::limits::UpTo(1.0) },
      { "VeinColor", this->VeinColor, waft::limits::UpTo(1.0) },
      { "Blotches", this->Blotches, waft::limits::Finite } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

waft::Result vtkPaintedShapeSource::MakeShape(waft::Shape& shape)
{
  waft::Outline outline;
  WAFT_RETURN_IF_FAILED(this->MakeOutline(outline, shape.Name));
  waft::SheetOptions options;
  this->TakeBending(options);
  options.Rows = this->Rows;
  options.Columns = this->Columns + this->Columns % 2;
  WAFT_RETURN_IF_FAILED(waft::MakeSheet(outline, options, shape));
  shape.Color = Color(this->BaseColor);
  if (!this->TextureFile.empty())
  {
    WAFT_RETURN_IF_FAILED(this->Paint(outline));
    shape.Texture = this->TextureFile;
  }
  return waft::Result::Ok();
}

waft::Result vtkPaintedShapeSource::Paint(const waft::Outline& outline) const
{
  const waft::PlanBox box = waft::TextureBox(outline);
  waft::TextureOptions options;
  const double ratio = (box.Y1 - box.Y0) / (box.X1 - box.X0);
  options.Width = this->TextureSize;
  options.Height = std::clamp(static_cast<int>(std::lround(ratio * this->TextureSize)), 16, 4096);
  options.Base = Color(this->BaseColor);
  options.Edge = Color(this->EdgeColor);
  options.Vein = Color(this->VeinColor);
  options.Blotches = this->Blotches;
  options.Seed = static_cast<std::uint64_t>(this->Seed);
  std::vector<std::uint8_t> pixels;
  WAFT_RETURN_IF_FAILED(waft::PaintTexture(outline, options, pixels));
  return waft::WriteWholeFile(this->TextureFile,
                              waft::EncodePng(pixels, options.Width, options.Height));
}

void vtkPaintedShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Bend: " << this->Bend << "\n";
  os << indent << "Rows: " << this->Rows << "\n";
  os << indent << "Columns: " << this->Columns << "\n";
  os << indent << "TextureFile: " << this->TextureFile << "\n";
  os << indent << "TextureSize: " << this->TextureSize << "\n";
  waft::PrintValues(os, indent, "BaseColor", this->BaseColor, 3);
  waft::PrintValues(os, indent, "EdgeColor", this->EdgeColor, 3);
  waft::PrintValues(os, indent, "VeinColor", this->VeinColor, 3);
  os << indent << "Blotches: " << this->Blotches << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
