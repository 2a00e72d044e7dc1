// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/SmokeData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ImageLattice.h"
#include "Bridge/Data/SceneData.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace waft
{
namespace
{

template <typename ArrayType, typename Value>
void AddValues(vtkImageData* data, const char* name, const Value* values, int components)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(data->GetNumberOfPoints());
  std::copy(values, values + components * data->GetNumberOfPoints(), array->GetPointer(0));
  data->GetPointData()->AddArray(array);
}

} // namespace

void SmokeFrameToImage(const SmokeFrame& frame, const SceneInfo& info, vtkImageData* data)
{
  data->Initialize();
  LatticeToImage(frame, data);
  AddValues<vtkFloatArray>(data, names::Velocity, frame.Velocity.data()->data(), 3);
  AddValues<vtkFloatArray>(data, names::Density, frame.Density.data(), 1);
  AddValues<vtkFloatArray>(data, names::Pressure, frame.Pressure.data(), 1);
  AddValues<vtkFloatArray>(data, names::Vorticity, frame.Vorticity.data()->data(), 3);
  AddValues<vtkFloatArray>(data, names::VortexForce, frame.VortexForce.data()->data(), 3);
  AddValues<vtkFloatArray>(data, names::WindForce, frame.WindForce.data()->data(), 3);
  AddValues<vtkUnsignedCharArray>(data, names::Obstacle, frame.Obstacle.data(), 1);
  data->GetPointData()->SetActiveScalars(names::Density);
  data->GetPointData()->SetActiveVectors(names::Velocity);
  SceneInfoToFieldData(info, data);
}

} // namespace waft
