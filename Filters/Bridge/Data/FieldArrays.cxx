// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/FieldArrays.h"

#include "Base/WindFields.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ImageLattice.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>

namespace waft
{
namespace
{

std::vector<NamedField> FieldsOf(vtkDataSetAttributes* attributes)
{
  std::vector<NamedField> fields;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    // What is no array of numbers has no component that could be a wind's.
    vtkDataArray* array = attributes->GetArray(i);
    const char* name = attributes->GetArrayName(i);
    fields.push_back({ name ? name : "", array ? array->GetNumberOfComponents() : 0 });
  }
  return fields;
}

std::string ListOf(vtkImageData* data)
{
  return ListOfFields(FieldsOf(data->GetPointData())) + " of points, " +
         ListOfFields(FieldsOf(data->GetCellData())) + " of cells";
}

// By its name in the pipeline, where nothing is guessed.
Result ChooseNamed(vtkImageData* data, FieldRole role, std::vector<std::size_t>& chosen,
                   FieldMeaning& meaning)
{
  const std::vector<NamedField> fields = FieldsOf(data->GetPointData());
  for (const char* name : { names::Wind, names::Velocity })
  {
    for (std::size_t i = 0; i < fields.size() && (role == FieldRole::Wind || name != names::Wind);
         ++i)
    {
      if (fields[i].Name == name && fields[i].Components == 3)
      {
        chosen = { i };
        meaning = name == names::Wind ? FieldMeaning::Acceleration : FieldMeaning::Velocity;
        return Result::Ok();
      }
    }
  }
  return Result::Error(std::string("expected the point data array ") +
                       (role == FieldRole::Wind ? "`Wind` or `Velocity`" : "`Velocity`") +
                       " of 3 components, found, with their components: " + ListOf(data));
}

// The points in the middles of cells; of a flat lattice its own along that axis.
void MoveToCells(SeriesLattice& lattice)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (lattice.Dimensions[axis] > 1)
    {
      --lattice.Dimensions[axis];
      const auto a = static_cast<Eigen::Index>(axis);
      lattice.Origin[a] += 0.5 * lattice.Spacing[a];
    }
  }
}

} // namespace

double FieldArrays::Value(vtkIdType i, int component) const
{
  return this->Arrays.size() == 1
           ? this->Arrays[0]->GetComponent(i, component)
           : this->Arrays[static_cast<std::size_t>(component)]->GetComponent(i, 0);
}

bool FieldArrays::CopyTo(std::vector<std::array<float, 3>>& values) const
{
  auto* floats = this->Arrays.size() == 1 ? vtkFloatArray::SafeDownCast(this->Arrays[0]) : nullptr;
  if (floats == nullptr || floats->GetNumberOfComponents() != 3 ||
      floats->GetNumberOfTuples() != static_cast<vtkIdType>(values.size()))
  {
    return false;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    std::copy_n(floats->GetPointer(static_cast<vtkIdType>(3 * i)), 3, values[i].begin());
  }
  return true;
}

Result FindField(vtkImageData* data, FieldRole role, const std::string& array, FieldArrays& found)
{
  found = FieldArrays();
  vtkDataSetAttributes* attributes = data->GetPointData();
  WindFields chosen;
  if (role != FieldRole::WindFile)
  {
    WAFT_RETURN_IF_FAILED(ChooseNamed(data, role, chosen.Fields, chosen.Meaning));
  }
  else if (!ChooseWind(FieldsOf(attributes), array, chosen))
  {
    attributes = data->GetCellData();
    if (!ChooseWind(FieldsOf(attributes), array, chosen))
    {
      return NoWind(array, ListOf(data));
    }
  }
  found.Lattice.Meaning = chosen.Meaning;
  WAFT_RETURN_IF_FAILED(LatticeFromImage(data, "image", found.Lattice));
  if (attributes != data->GetPointData())
  {
    MoveToCells(found.Lattice);
  }
  for (const std::size_t index : chosen.Fields)
  {
    vtkDataArray* values = attributes->GetArray(static_cast<int>(index));
    found.Name += (found.Name.empty() ? "" : ", ") + std::string(values->GetName());
    if (static_cast<std::size_t>(values->GetNumberOfTuples()) != found.Lattice.NumberOfPoints())
    {
      return Result::Error("array `" + std::string(values->GetName()) + "`: expected " +
                           std::to_string(found.Lattice.NumberOfPoints()) +
                           " values, one a point of the lattice, found " +
                           std::to_string(values->GetNumberOfTuples()));
    }
    found.Arrays.push_back(values);
  }
  return Result::Ok();
}

} // namespace waft
