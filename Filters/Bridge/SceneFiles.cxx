// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/SceneFiles.h"

#include "Bridge/FieldCollectors.h"
#include "Bridge/FileReading.h"
#include "Bridge/PhotographShape.h"
#include "Shapes/ThinShape.h"

#include <vtkCompositeDataGeometryFilter.h>
#include <vtkDataArray.h>
#include <vtkGLTFReader.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkImageReader2Factory.h>
#include <vtkMathTextFreeTypeTextRenderer.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTextProperty.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>

namespace waft
{
namespace
{

// Longest side of a picture that targets are sampled from; larger ones are averaged down.
constexpr int LongestSide = 600;

template <class Reader>
Result ReadWith(const std::string& path, vtkPolyData* data)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  const Result result = RunReader(reader);
  if (result)
  {
    data->ShallowCopy(reader->GetOutputDataObject(0));
  }
  return result;
}

Result ReadGltf(const std::string& path, vtkPolyData* data)
{
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(path.c_str());
  Result result = RunReader(reader);
  if (!result)
  {
    return result;
  }
  vtkNew<vtkCompositeDataGeometryFilter> surfaces;
  surfaces->SetInputConnection(reader->GetOutputPort());
  surfaces->Update();
  data->ShallowCopy(surfaces->GetOutput());
  return result;
}

// Triangles of a mesh file, z up.
Result ReadTriangles(const std::string& path, vtkPolyData* triangles, TriangleMesh& mesh)
{
  const std::string extension = Extension(path);
  vtkNew<vtkPolyData> data;
  Result result = extension == ".vtp"   ? ReadWith<vtkXMLPolyDataReader>(path, data)
                  : extension == ".obj" ? ReadWith<vtkOBJReader>(path, data)
                  : extension == ".ply" ? ReadWith<vtkPLYReader>(path, data)
                  : extension == ".stl" ? ReadWith<vtkSTLReader>(path, data)
                  : extension == ".glb" || extension == ".gltf"
                    ? ReadGltf(path, data)
                    : Result::Error("expected a .vtp, .obj, .ply, .stl or .glb file, found \"" +
                                    extension + "\"");
  if (!result)
  {
    return result;
  }
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(data);
  filter->PassLinesOff();
  filter->PassVertsOff();
  filter->Update();
  triangles->ShallowCopy(filter->GetOutput());
  if (triangles->GetNumberOfPolys() == 0)
  {
    return Result::Error("expected a surface with triangles, found none");
  }
  result = MeshFromPolyData(triangles, "mesh", mesh);
  if (extension == ".glb" || extension == ".gltf")
  {
    for (Vec3& p : mesh.Points)
    {
      p = Vec3(p.x(), -p.z(), p.y());
    }
  }
  return result;
}

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

std::vector<std::string> VtkSceneAssets::BuiltinShapeNames() const
{
  std::vector<std::string> names;
  for (const BuiltinShape& builtin : BuiltinShapes())
  {
    names.push_back(builtin.Name);
  }
  return names;
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
  vtkNew<vtkPolyData> triangles;
  Result result = ReadTriangles(path, triangles, shape.Mesh);
  if (!result)
  {
    return result;
  }
  shape.TextureCoordinates.clear();
  if (vtkDataArray* coordinates = triangles->GetPointData()->GetTCoords())
  {
    for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
    {
      shape.TextureCoordinates.push_back(
        { coordinates->GetComponent(i, 0), coordinates->GetComponent(i, 1) });
    }
  }
  return result;
}

Result VtkSceneAssets::LoadMesh(const std::string& path, TriangleMesh& mesh) const
{
  vtkNew<vtkPolyData> triangles;
  return ReadTriangles(path, triangles, mesh);
}

Result VtkSceneAssets::LoadPicture(const std::string& path, Picture& picture) const
{
  const auto reader = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2(path.c_str()));
  if (!reader)
  {
    return Result::Error("expected a picture (.png, .jpg, .tif, .bmp ...), found another file");
  }
  reader->SetFileName(path.c_str());
  const Result result = RunReader(reader);
  return result ? PictureFromImage(reader->GetOutput(), picture) : result;
}

Result VtkSceneAssets::DrawText(const std::string& text, const std::string& font,
                                Picture& picture) const
{
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
    style->SetFontFamily(VTK_FONT_FILE);
    style->SetFontFile(font.c_str());
  }
  vtkNew<vtkMathTextFreeTypeTextRenderer> renderer;
  renderer->SetScaleToPowerOfTwo(false);
  vtkNew<vtkImageData> image;
  int size[2] = { 0, 0 };
  constexpr int dotsPerInch = 72; // a font's point is a pixel
  if (!renderer->RenderString(style, text, image, size, dotsPerInch, vtkTextRenderer::FreeType))
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

} // namespace waft
