// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPaintedShapeSource.h"

#include "Base/AtomicFile.h"
#include "Bridge/Files/WrittenMark.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Shapes/PngImage.h"
#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace
{

/// Whether nothing is lost when a file is replaced: an earlier version marked none of its skins.
bool IsReplaceable(const std::string& path, const std::string& skin)
{
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error)) || waft::IsMarkedAsWritten(path))
  {
    return true;
  }
  std::ifstream stream(path, std::ios::binary);
  return fs::file_size(path, error) == skin.size() &&
         std::string(std::istreambuf_iterator<char>(stream), {}) == skin;
}

waft::Result SaveSkin(const std::string& path, const std::string& skin)
{
  if (!IsReplaceable(path, skin))
  {
    return waft::Result::Error("Save Skin As: " + path +
                               ": nothing was written: expected a new name or a skin saved here "
                               "before, found another file, which is left alone");
  }
  return waft::WriteWholeFile(path, waft::MarkedPng(skin));
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
  const int height = waft::TextureHeight(outline, skin.TextureSize);
  std::vector<std::uint8_t> pixels;
  WAFT_RETURN_IF_FAILED(waft::PaintTexture(outline, skin, height, pixels));
  shape.Skin = waft::EncodePng(pixels, skin.TextureSize, height);
  const std::string& path = skin.SaveSkinAs.empty() ? this->TextureFile : skin.SaveSkinAs;
  if (!path.empty())
  {
    WAFT_RETURN_IF_FAILED(SaveSkin(path, shape.Skin));
    shape.Texture = path;
    shape.Skin.clear();
  }
  return waft::Result::Ok();
}

void vtkPaintedShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TextureFile: " << this->TextureFile << "\n";
}
