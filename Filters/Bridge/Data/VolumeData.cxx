// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/VolumeData.h"

#include "Base/Limits.h"
#include "Bridge/Data/ImageLattice.h"
#include "Bridge/Data/SceneData.h"

#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <string>

namespace waft
{

Result VolumeFromImage(vtkImageData* data, Volume& volume)
{
  volume = Volume();
  WAFT_RETURN_IF_FAILED(LatticeFromImage(data, "Input", volume));
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
        const double value = array->GetComponent(i, c);
        if (!limits::Around0(1e30).Holds(value))
        {
          return Result::Error("Input: array `" + field.Name + "`: entry " + std::to_string(i) +
                               " is not a finite number of at most 1e30");
        }
        field.Values[next++] = static_cast<float>(value);
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
  LatticeToImage(volume, data);
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
