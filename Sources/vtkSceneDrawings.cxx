// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSceneDrawings.h"

#include "Bridge/Data/Arrays.h"
#include "Bridge/Files/SceneFiles.h"
#include "Scene/SceneDrawings.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>

#include <algorithm>

vtkStandardNewMacro(vtkSceneDrawings);

namespace
{

void ToImage(const waft::SceneDrawing& drawing, vtkImageData* image)
{
  const waft::TargetMask& mask = drawing.Mask;
  const double pixel = drawing.Width / mask.Width;
  image->SetDimensions(mask.Width, mask.Height, 1);
  image->SetSpacing(pixel, pixel, pixel);
  image->SetOrigin(-0.5 * pixel * (mask.Width - 1), -0.5 * pixel * (mask.Height - 1), 0.0);
  vtkNew<vtkFloatArray> weights;
  weights->SetName("Weight");
  weights->SetNumberOfTuples(static_cast<vtkIdType>(mask.Weights.size()));
  std::copy(mask.Weights.begin(), mask.Weights.end(), weights->GetPointer(0));
  image->GetPointData()->AddArray(weights);
  waft::AddInts(image->GetFieldData(), "Row", { drawing.Row });
  waft::AddVectors(image->GetFieldData(), "Origin", { drawing.Origin });
  waft::AddVectors(image->GetFieldData(), "U", { drawing.U });
  waft::AddVectors(image->GetFieldData(), "V", { drawing.V });
}

} // namespace

std::string vtkSceneDrawings::Read(const std::string& fileName, vtkMultiBlockDataSet* drawings)
{
  if (drawings == nullptr)
  {
    return "expected blocks to fill, found none";
  }
  std::vector<waft::SceneDrawing> read;
  if (const waft::Result result = waft::ReadDrawings(fileName, waft::VtkSceneAssets(), read);
      !result)
  {
    return result.Message();
  }
  drawings->Initialize();
  for (const waft::SceneDrawing& drawing : read)
  {
    vtkNew<vtkImageData> image;
    ToImage(drawing, image);
    drawings->SetBlock(drawings->GetNumberOfBlocks(), image);
  }
  return {};
}
