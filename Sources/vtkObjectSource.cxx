// SPDX-License-Identifier: BSD-3-Clause
#include "vtkObjectSource.h"

#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/ObjectOptions.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <string>
#include <vector>

vtkStandardNewMacro(vtkObjectSource);

namespace
{

using waft::StageInput;

const waft::StageInputs InputsOfObjects = {
  { "Input", StageInput::Type::Anything, StageInput::Number::Optional },
  { "Shapes", StageInput::Type::Blocks, StageInput::Number::Optional },
};

} // namespace

vtkObjectSource::vtkObjectSource()
{
  waft::TakeDefaults<waft::ObjectOptions>(*this);
  // paraview.simple connects whatever is active to the first port of a new source: it is not used.
  this->SetNumberOfInputPorts(SHAPES_PORT + 1);
}

double vtkObjectSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::ObjectOptions>(property, value);
}

vtkTypeBool vtkObjectSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                            vtkInformationVector* outputs)
{
  return waft::GuardedRequest(this, request, inputs, outputs, InputsOfObjects,
                              waft::RangesOf<waft::ObjectOptions>(*this),
                              [&](vtkInformationVector** taken) {
                                return this->Superclass::ProcessRequest(request, taken, outputs);
                              });
}

int vtkObjectSource::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(InputsOfObjects, port, info);
}

int vtkObjectSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                        vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  return 1;
}

int vtkObjectSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                 vtkInformationVector* outputs)
{
  auto options = waft::OptionsOf<waft::ObjectOptions>(*this);
  const waft::SceneInfo info = options.Info();
  if (vtkMultiBlockDataSet* bodies = vtkMultiBlockDataSet::GetData(inputs[SHAPES_PORT]))
  {
    std::vector<waft::Shape> shapes;
    if (const waft::Result read = waft::ShapesFromMultiBlock(bodies, shapes); !read)
    {
      return waft::Fail(this, outputs, read.Message());
    }
    const auto block = static_cast<std::size_t>(options.ShapeId);
    if (block >= shapes.size())
    {
      return waft::Fail(this, outputs,
                        "ShapeId: expected a block of Shapes, which has " +
                          std::to_string(shapes.size()) + ", found " +
                          std::to_string(options.ShapeId));
    }
    options.TakeBodyOf(shapes[block]);
  }
  std::vector<waft::MotionObject> objects;
  if (const waft::Result made = options.MakeObjects(objects); !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  waft::ObjectsToPolyData(objects, info, vtkPolyData::GetData(outputs), options.ObjectId >= 0);
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkObjectSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::ObjectOptions>(os, indent, *this);
}
