// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/VolumeData.h"

#include "Bridge/SceneData.h"

#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <string>

namespace waft
{

Result VolumeFromImage(vtkImageData* data, Volume& volume)
{
  if (data->GetNumberOfPoints() == 0)
  {
    return Result::Error("Input: expected an image with points");
  }
  if (!data->GetDirectionMatrix()->IsIdentity())
  {
    return Result::Error("Input: expected an image whose axes are those of the world");
  }
  volume = Volume();
  data->GetDimensions(volume.Dimensions.data());
  data->GetSpacing(volume.Spacing.data());
  data->GetPoint(0, volume.Origin.data());
  vtkPointData* arrays = data->GetPointData();
  const std::string ghosts = vtkDataSetAttributes::GhostArrayName();
  for (int a = 0; a < arrays->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = arrays->GetArray(a); // null when it is text
    if (!array || !array->GetName() || array->GetName() == ghosts ||
        (array->GetNumberOfComponents() != 1 && array->GetNumberOfComponents() != 3))
    {
      continue;
    }
    VolumeField field;
    field.Name = array->GetName();
    field.Components = array->GetNumberOfComponents();
    field.Values.resize(volume.NumberOfPoints() * field.Components);
    std::size_t next = 0;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < field.Components; ++c)
      {
        field.Values[next++] = static_cast<float>(array->GetComponent(i, c));
      }
    }
    volume.Fields.push_back(std::move(field));
  }
  return volume.Fields.empty()
           ? Result::Error("Input: expected a point data array of 1 or 3 components, found none")
           : Result::Ok();
}

void VolumeToImage(const Volume& volume, const SceneInfo& info, vtkImageData* data)
{
  data->Initialize();
  data->SetDimensions(volume.Dimensions.data());
  data->SetOrigin(volume.Origin.data());
  data->SetSpacing(volume.Spacing.data());
  for (const VolumeField& field : volume.Fields)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(field.Name.c_str());
    array->SetNumberOfComponents(field.Components);
    array->SetNumberOfTuples(data->GetNumberOfPoints());
    std::copy(field.Values.begin(), field.Values.end(), array->GetPointer(0));
    data->GetPointData()->AddArray(array);
  }
  SceneInfoToFieldData(info, data);
}

} // namespace waft
