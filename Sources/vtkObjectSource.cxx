// SPDX-License-Identifier: BSD-3-Clause
#include "vtkObjectSource.h"

#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/ObjectOptions.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkObjectSource);

vtkObjectSource::vtkObjectSource()
{
  this->SetNumberOfInputPorts(1);
}

void vtkObjectSource::RemoveAllShapes()
{
  this->SetInputConnection(nullptr);
}

int vtkObjectSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

vtkTypeBool vtkObjectSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                            vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::ObjectOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkObjectSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                        vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  waft::SetStandsStill(outputs->GetInformationObject(0), true);
  return 1;
}

int vtkObjectSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                 vtkInformationVector* outputs)
{
  const auto options = waft::OptionsOf<waft::ObjectOptions>(*this);
  const waft::SceneInfo info = options.Info();
  auto* given = vtkMultiBlockDataSet::GetData(inputs[0]);
  std::vector<waft::Shape> shapes;
  std::vector<waft::MotionObject> objects;
  waft::Result made = given ? waft::ShapesFromMultiBlock(given, shapes) : waft::Result::Ok();
  made = made ? options.MakeObjects(given ? &shapes : nullptr, objects) : made;
  if (!made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  vtkPolyData* data = vtkPolyData::GetData(outputs);
  waft::ObjectsToPolyData(objects, info, data, options.ObjectId >= 0);
  if (given)
  {
    waft::NameShape(shapes[static_cast<std::size_t>(options.ShapeId)], data);
  }
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkObjectSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::ObjectOptions>(os, indent, *this);
}
