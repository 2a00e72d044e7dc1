// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionSceneFileWriter.h"

#include "Bridge/Data/SceneBlocks.h"
#include "Bridge/Files/SceneOutput.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/SceneFileOptions.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>

#include <vector>

vtkStandardNewMacro(vtkMotionSceneFileWriter);

int vtkMotionSceneFileWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  return 1;
}

void vtkMotionSceneFileWriter::WriteData()
{
  waft::SceneContents scene;
  waft::Result result =
    waft::SceneFromBlocks(vtkMultiBlockDataSet::SafeDownCast(this->GetInput()), scene);
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
