// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPaintedShapeSource.h"

#include "Base/AtomicFile.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Shapes/PngImage.h"
#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"

namespace
{

waft::Result WriteSkin(const waft::Outline& outline, const waft::SkinOptions& skin)
{
  const int height = waft::TextureHeight(outline, skin.TextureSize);
  std::vector<std::uint8_t> pixels;
  WAFT_RETURN_IF_FAILED(waft::PaintTexture(outline, skin, height, pixels));
  return waft::WriteWholeFile(skin.TextureFile, waft::EncodePng(pixels, skin.TextureSize, height));
}

} // namespace

double vtkPaintedShapeSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::PlanForm, waft::SheetOptions, waft::SkinOptions>(property, value);
}

waft::Result vtkPaintedShapeSource::MakeShape(waft::Shape& shape)
{
  waft::Outline outline;
  WAFT_RETURN_IF_FAILED(this->MakeOutline(outline, shape.Name));
  auto sheet = waft::OptionsOf<waft::SheetOptions>(*this);
  sheet.Columns += sheet.Columns % 2;
  WAFT_RETURN_IF_FAILED(waft::MakeSheet(outline, sheet, shape));
  const auto skin = waft::OptionsOf<waft::SkinOptions>(*this);
  shape.Color = skin.BaseColor;
  shape.Texture = skin.TextureFile;
  return skin.TextureFile.empty() ? waft::Result::Ok() : WriteSkin(outline, skin);
}
