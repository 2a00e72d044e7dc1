// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionSceneWriter.h"

#include "Bridge/Data/SceneBlocks.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/FileWriting.h"
#include "Bridge/Files/SceneOutput.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/SceneFileOptions.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <vector>

vtkStandardNewMacro(vtkMotionSceneWriter);

namespace
{

enum InputPort
{
  ObjectsPort,
  ConstraintsPort,
  ObstaclesPort,
  ShapesPort,
  VorticesPort,
  WindPort,
  NumberOfInputs
};

using waft::StageInput;

const waft::StageInputs Inputs = {
  { "Objects", StageInput::Type::Merged },
  { "Constraints", StageInput::Type::Merged, StageInput::Number::Optional },
  { "Obstacles", StageInput::Type::Surfaces, StageInput::Number::Optional },
  { "Shapes", StageInput::Type::Blocks, StageInput::Number::Optional },
  { "Vortices", StageInput::Type::Merged, StageInput::Number::Optional },
  { "Wind", StageInput::Type::Image, StageInput::Number::Optional },
};

} // namespace

struct vtkMotionSceneWriter::Internals : waft::KeptStage
{
  vtkMotionSceneWriter* Self;
  bool IsWritten = false;

  explicit Internals(vtkMotionSceneWriter* self) :
    KeptStage(self, ObjectsPort, ObstaclesPort, WindPort), Self(self)
  {
  }
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
};

waft::Result vtkMotionSceneWriter::Internals::Run(vtkInformationVector** inputs, waft::Monitor&)
{
  this->IsWritten = false;
  waft::SceneContents scene;
  waft::Scene& parts = scene.Parts;
  parts.Info = this->Scene;
  parts.Title = this->Self->Title;
  vtkPolyData* objects = vtkPolyData::GetData(inputs[ObjectsPort]);
  if (objects->GetNumberOfPoints() > 0) // a scene may have none so far
  {
    WAFT_RETURN_IF_FAILED(waft::ObjectsFromPolyData(objects, parts.Objects));
  }
  WAFT_RETURN_IF_FAILED(this->TakeConstraints(inputs[ConstraintsPort], parts.Constraints));
  parts.Obstacles = this->Fields.TakeObstacles();
  const auto authored = [&](int port)
  { return waft::AuthoredFromFieldData(vtkDataObject::GetData(inputs[port])); };
  parts.Authored = { authored(ObjectsPort), authored(ConstraintsPort), authored(ObstaclesPort),
                     authored(WindPort) };
  scene.Wind = this->Fields.TakeWind();
  if (auto* shapes = vtkMultiBlockDataSet::GetData(inputs[ShapesPort]))
  {
    WAFT_RETURN_IF_FAILED(waft::ShapesFromMultiBlock(shapes, parts.Shapes));
  }
  if (vtkPolyData* vortices = vtkPolyData::GetData(inputs[VorticesPort]))
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(vortices, parts.Vortices));
  }
  if (!this->Self->FileName.empty())
  {
    std::vector<std::string> remarks;
    WAFT_RETURN_IF_FAILED(waft::WriteSceneFiles(scene, this->Self->FileName, remarks));
    for (const std::string& remark : remarks)
    {
      vtkWarningWithObjectMacro(this->Self, << remark);
    }
    this->IsWritten = true;
  }
  waft::SceneToBlocks(scene, this->Kept<vtkMultiBlockDataSet>(0));
  return waft::Result::Ok();
}

vtkMotionSceneWriter::vtkMotionSceneWriter() : Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::SceneWriteOptions>(*this);
  this->SetNumberOfInputPorts(NumberOfInputs);
}

vtkMotionSceneWriter::~vtkMotionSceneWriter() = default;

int vtkMotionSceneWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(Inputs, port, info);
}

vtkTypeBool vtkMotionSceneWriter::ProcessRequest(vtkInformation* request,
                                                 vtkInformationVector** inputs,
                                                 vtkInformationVector* outputs)
{
  return waft::GuardedRequest(this, request, inputs, outputs, Inputs,
                              waft::RangesOf<waft::SceneWriteOptions>(*this),
                              [&](vtkInformationVector** taken) {
                                return this->Superclass::ProcessRequest(request, taken, outputs);
                              });
}

int vtkMotionSceneWriter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                             vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkMotionSceneWriter::RequestUpdateExtent(vtkInformation* request,
                                              vtkInformationVector** inputs,
                                              vtkInformationVector* outputs)
{
  return this->Impl->RequestUpdateExtent(request, inputs, outputs);
}

int vtkMotionSceneWriter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                      vtkInformationVector* outputs)
{
  return this->Impl->RequestData(request, inputs, outputs);
}

bool vtkMotionSceneWriter::Write()
{
  return waft::WriteAnew(this, this->FileName, ".waft.json", this->Impl->IsWritten);
}

void vtkMotionSceneWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SceneWriteOptions>(os, indent, *this);
}
