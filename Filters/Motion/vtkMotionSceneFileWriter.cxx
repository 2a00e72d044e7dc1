// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionSceneFileWriter.h"

#include "Bridge/Data/Blocks.h"
#include "Bridge/Data/SceneBlocks.h"
#include "Bridge/Files/SceneOutput.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/SceneFileOptions.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

#include <vector>

vtkStandardNewMacro(vtkMotionSceneFileWriter);

namespace
{

using waft::StageInput;

const waft::StageInputs Inputs = {
  { "Input", StageInput::Type::Blocks },
};

} // namespace

vtkMotionSceneFileWriter::vtkMotionSceneFileWriter()
{
  waft::TakeDefaults<waft::SceneSaveOptions>(*this);
}

int vtkMotionSceneFileWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(Inputs, port, info);
}

void vtkMotionSceneFileWriter::WriteData()
{
  waft::SceneContents scene;
  vtkSmartPointer<vtkMultiBlockDataSet> blocks;
  waft::Result result = waft::ListOfBlocks(this->GetInput(), Inputs.front().Name, blocks);
  result = result ? waft::SceneFromBlocks(blocks, scene) : result;
  std::vector<std::string> remarks;
  result = result ? waft::WriteSceneFiles(scene, this->FileName, remarks) : result;
  for (const std::string& remark : remarks)
  {
    vtkWarningMacro(<< remark);
  }
  if (!result)
  {
    vtkErrorMacro(<< result.Message());
    this->SetErrorCode(vtkErrorCode::UserError);
  }
}

void vtkMotionSceneFileWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SceneSaveOptions>(os, indent, *this);
}
