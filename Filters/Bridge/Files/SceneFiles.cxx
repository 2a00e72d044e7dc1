// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/SceneFiles.h"

#include "Bridge/Files/FontFiles.h"
#include "Bridge/Files/MeshFiles.h"
#include "Bridge/Files/PhotographShape.h"
#include "Bridge/Files/PictureFiles.h"
#include "Bridge/Files/WindFiles.h"
#include "Scene/TextLetters.h"
#include "Shapes/ThinShape.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMathTextFreeTypeTextRenderer.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <utility>

namespace waft
{
namespace
{

// Longest side of a picture that targets are sampled from; larger ones are averaged down.
constexpr int LongestSide = 600;

// Colours of an image as a picture, averaged over blocks when it is large.
Result PictureFromImage(vtkImageData* image, Picture& picture)
{
  int size[3];
  image->GetDimensions(size);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  const int channels = values ? values->GetNumberOfComponents() : 0;
  if (size[0] < 1 || size[1] < 1 || channels < 1 || channels > 4)
  {
    return Result::Error("expected a picture with 1 to 4 channels, found " +
                         std::to_string(channels));
  }
  const double full = values->GetDataType() == VTK_UNSIGNED_CHAR    ? 255.0
                      : values->GetDataType() == VTK_UNSIGNED_SHORT ? 65535.0
                                                                    : 1.0;
  const int block = (std::max(size[0], size[1]) + LongestSide - 1) / LongestSide;
  picture = Picture();
  picture.Width = (size[0] + block - 1) / block;
  picture.Height = (size[1] + block - 1) / block;
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      double sum[4] = { 0.0, 0.0, 0.0, 0.0 };
      int count = 0;
      for (int j = y * block; j < std::min((y + 1) * block, size[1]); ++j)
      {
        for (int i = x * block; i < std::min((x + 1) * block, size[0]); ++i)
        {
          const vtkIdType at = static_cast<vtkIdType>(j) * size[0] + i;
          const bool isGrey = channels < 3;
          for (int c = 0; c < 3; ++c)
          {
            sum[c] += values->GetComponent(at, isGrey ? 0 : c) / full;
          }
          const bool hasAlpha = channels == 2 || channels == 4;
          sum[3] += hasAlpha ? values->GetComponent(at, channels - 1) / full : 1.0;
          ++count;
        }
      }
      picture.Pixels.push_back({ float(sum[0] / count), float(sum[1] / count),
                                 float(sum[2] / count), float(sum[3] / count) });
    }
  }
  return Result::Ok();
}

// The smallest part of a picture that holds all its ink.
Picture Cropped(const Picture& picture)
{
  int x0 = picture.Width;
  int x1 = -1;
  int y0 = picture.Height;
  int y1 = -1;
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * picture.Width + x; };
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      if (picture.Pixels[at(x, y)][3] > 0.f)
      {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
      }
    }
  }
  Picture cropped;
  cropped.Width = std::max(0, x1 - x0 + 1);
  cropped.Height = std::max(0, y1 - y0 + 1);
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      cropped.Pixels.push_back(picture.Pixels[at(x, y)]);
    }
  }
  return cropped;
}

} // namespace

Result VtkSceneAssets::LoadBuiltinShape(const std::string& builtin, double size, Shape& shape) const
{
  return MakeBuiltinShape(builtin, size, shape);
}

Result VtkSceneAssets::LoadShapeMesh(const std::string& path, double size, Shape& shape) const
{
  if (IsPictureName(path))
  {
    PhotographOptions options;
    options.Length = size > 0.0 ? size : options.Length;
    return LoadPhotographShape(path, options, shape);
  }
  WAFT_RETURN_IF_FAILED(this->LoadAlignedShape(path, shape));
  return AlignShape(size, shape.Mesh);
}

Result VtkSceneAssets::LoadAlignedShape(const std::string& path, Shape& shape) const
{
  SurfaceFile surface;
  WAFT_RETURN_IF_FAILED(ReadSurfaceFile(path, surface));
  shape.Mesh = std::move(surface.Mesh);
  shape.TextureCoordinates = std::move(surface.TextureCoordinates);
  return Result::Ok();
}

Result VtkSceneAssets::LoadMesh(const std::string& path, TriangleMesh& mesh) const
{
  SurfaceFile surface;
  WAFT_RETURN_IF_FAILED(ReadSurfaceFile(path, surface));
  mesh = std::move(surface.Mesh);
  return Result::Ok();
}

Result VtkSceneAssets::LoadPicture(const std::string& path, Picture& picture) const
{
  vtkNew<vtkImageData> image;
  WAFT_RETURN_IF_FAILED(ReadUprightPicture(path, image));
  return PictureFromImage(image, picture);
}

Result LoadPictureOf(const Shape& shape, Picture& picture)
{
  vtkNew<vtkImageData> image;
  WAFT_RETURN_IF_FAILED(shape.Texture.empty() ? ReadPng(shape.Skin, image)
                                              : ReadUprightPicture(shape.Texture, image));
  return PictureFromImage(image, picture);
}

Result ReadStoredPicture(const std::string& path, Picture& picture)
{
  vtkNew<vtkImageData> image;
  WAFT_RETURN_IF_FAILED(ReadPictureFile(path, image));
  return PictureFromImage(image, picture);
}

Result VtkSceneAssets::DrawText(const std::string& text, const std::string& font,
                                Picture& picture) const
{
  constexpr std::size_t longest = 1000;
  if (text.size() > longest)
  {
    return Result::Error("expected a text of at most " + std::to_string(longest) +
                         " bytes of valid UTF-8 without control characters");
  }
  std::string letters;
  WAFT_RETURN_IF_FAILED(LettersOf(text, letters));
  constexpr int height = 160; // pixels of the font
  vtkNew<vtkTextProperty> style;
  style->SetFontSize(height);
  style->SetColor(1.0, 1.0, 1.0);
  if (font == "sans")
  {
    style->SetFontFamilyToArial();
  }
  else if (font == "serif")
  {
    style->SetFontFamilyToTimes();
  }
  else if (font == "mono")
  {
    style->SetFontFamilyToCourier();
  }
  else
  {
    WAFT_RETURN_IF_FAILED(CheckFontFile(font));
    style->SetFontFamily(VTK_FONT_FILE);
    style->SetFontFile(font.c_str());
  }
  WAFT_RETURN_IF_FAILED(CheckLetters(style, font, letters));
  vtkNew<vtkMathTextFreeTypeTextRenderer> renderer;
  renderer->SetScaleToPowerOfTwo(false);
  vtkNew<vtkImageData> image;
  int size[2] = { 0, 0 };
  constexpr int dotsPerInch = 72; // a font's point is a pixel
  if (!renderer->RenderString(style, letters, image, size, dotsPerInch, vtkTextRenderer::FreeType))
  {
    return Result::Error("expected a text that the font \"" + font + "\" can draw");
  }
  Result result = PictureFromImage(image, picture);
  if (result)
  {
    picture = Cropped(picture);
  }
  return result && picture.IsEmpty()
           ? Result::Error("expected a text with something to draw, found none")
           : result;
}

Result VtkSceneAssets::LoadWind(const WindFile& file, const SceneInfo& scene,
                                FieldSeries& wind) const
{
  return ReadWindFile(file, scene, wind);
}

} // namespace waft
