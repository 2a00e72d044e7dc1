// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographShapeSource.h"

#include "Bridge/PhotographShape.h"
#include "Bridge/StageExecution.h"

#include <vtkObjectFactory.h>

#include <filesystem>

vtkStandardNewMacro(vtkPhotographShapeSource);

vtkTypeBool vtkPhotographShapeSource::ProcessRequest(vtkInformation* request,
                                                     vtkInformationVector** inputs,
                                                     vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "Threshold", this->Threshold, waft::limits::Finite },
      { "Detail", this->Detail, waft::limits::Finite } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

waft::Result vtkPhotographShapeSource::MakeShape(waft::Shape& shape)
{
  if (this->Photograph.empty())
  {
    return waft::Result::Error("Photograph: expected the name of a picture");
  }
  waft::PhotographOptions options;
  this->TakeBending(options);
  options.Threshold = this->Threshold;
  options.Detail = this->Detail;
  options.Triangles = this->NumberOfTriangles;
  const waft::Result made = waft::LoadPhotographShape(this->Photograph, options, shape);
  if (!made)
  {
    return waft::Result::Error("Photograph " + this->Photograph + ": " + made.Message());
  }
  shape.Name = std::filesystem::path(this->Photograph).stem().string();
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
