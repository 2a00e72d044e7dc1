// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographShapeSource.h"

#include "Bridge/SceneFiles.h"
#include "Scene/TargetSampling.h"
#include "Shapes/Photograph.h"

#include <vtkObjectFactory.h>

#include <filesystem>

vtkStandardNewMacro(vtkPhotographShapeSource);

waft::Result vtkPhotographShapeSource::MakeShape(waft::Shape& shape)
{
  if (this->Photograph.empty())
  {
    return waft::Result::Error("Photograph: expected the name of a picture");
  }
  const auto failed = [this](const waft::Result& result)
  { return waft::Result::Error("Photograph " + this->Photograph + ": " + result.Message()); };
  waft::Picture picture;
  if (waft::Result read = waft::VtkSceneAssets().LoadPicture(this->Photograph, picture); !read)
  {
    return failed(read);
  }
  waft::TargetMask shown = waft::MaskFromPicture(picture, {});
  waft::PhotographOptions options;
  this->TakeBending(options);
  options.Threshold = this->Threshold;
  options.Detail = this->Detail;
  options.Triangles = this->NumberOfTriangles;
  const waft::Result made = waft::MakePhotographSheet(
    { shown.Width, shown.Height, std::move(shown.Weights) }, options, shape);
  if (!made)
  {
    return failed(made);
  }
  shape.Name = std::filesystem::path(this->Photograph).stem().string();
  shape.Texture = this->Photograph;
  return waft::Result::Ok();
}

void vtkPhotographShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Photograph: " << this->Photograph << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "Detail: " << this->Detail << "\n";
  os << indent << "NumberOfTriangles: " << this->NumberOfTriangles << "\n";
}
