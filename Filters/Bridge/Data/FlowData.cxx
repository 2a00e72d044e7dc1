// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/FlowData.h"

#include "Base/Limits.h"
#include "Bridge/Data/ArrayNames.h"

#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace waft
{
namespace
{

Result ReadField(vtkImageData* data, const char* name, bool isNeeded,
                 std::vector<std::array<float, 3>>& values)
{
  vtkDataArray* array = data->GetPointData()->GetArray(name);
  if (!array && !isNeeded)
  {
    values.clear();
    return Result::Ok();
  }
  if (!array || array->GetNumberOfComponents() != 3)
  {
    return Result::Error(std::string("Input: expected the point data array `") + name +
                         "` of 3 components");
  }
  if (array->GetNumberOfTuples() != data->GetNumberOfPoints())
  {
    return Result::Error(std::string("Input: array `") + name + "`: expected " +
                         std::to_string(data->GetNumberOfPoints()) + " entries, found " +
                         std::to_string(array->GetNumberOfTuples()));
  }
  values.resize(static_cast<std::size_t>(array->GetNumberOfTuples()));
  if (auto* floats = vtkFloatArray::SafeDownCast(array))
  {
    std::memcpy(values.data(), floats->GetPointer(0), values.size() * sizeof(values[0]));
  }
  else
  {
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        values[i][c] = static_cast<float>(array->GetComponent(static_cast<vtkIdType>(i), c));
      }
    }
  }
  const auto reach = static_cast<float>(limits::Velocity.High);
  const auto bad = std::find_if(values.begin(), values.end(),
                                [reach](const std::array<float, 3>& v)
                                {
                                  const bool holds = std::abs(v[0]) <= reach &&
                                                     std::abs(v[1]) <= reach &&
                                                     std::abs(v[2]) <= reach;
                                  return !holds; // as NaN does not
                                });
  return bad == values.end()
           ? Result::Ok()
           : Result::Error(std::string("Input: array `") + name + "`: entry " +
                           std::to_string(bad - values.begin()) + ": expected finite numbers, " +
                           limits::Velocity.Text() + " each");
}

} // namespace

Result FlowFrameFromImage(vtkImageData* data, double time, FlowFrame& frame)
{
  frame.Time = time;
  WAFT_RETURN_IF_FAILED(ReadField(data, names::Velocity, true, frame.Velocity));
  WAFT_RETURN_IF_FAILED(ReadField(data, names::VortexForce, false, frame.VortexForce));
  return ReadField(data, names::WindForce, false, frame.WindForce);
}

bool SolidVoxels::Contains(const Vec3& x) const
{
  if (this->Values.empty())
  {
    return false;
  }
  double solid = 0.0;
  int low[3];
  double fraction[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const int last = this->Lattice.Dimensions[axis] - 1;
    const double cell =
      std::clamp((x[axis] - this->Lattice.Origin[axis]) / this->Lattice.Spacing[axis], 0.0,
                 static_cast<double>(last));
    low[axis] = std::min(static_cast<int>(cell), std::max(last - 1, 0));
    fraction[axis] = cell - low[axis];
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1.0;
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis)
    {
      const bool isHigh = ((corner >> axis) & 1) != 0;
      const int last = this->Lattice.Dimensions[axis] - 1;
      weight *= isHigh ? fraction[axis] : 1.0 - fraction[axis];
      index = index * static_cast<std::size_t>(last + 1) + std::min(low[axis] + isHigh, last);
    }
    solid += this->Values[index] != 0 ? weight : 0.0;
  }
  return solid > 0.5;
}

void SolidVoxelsFromImage(vtkImageData* data, const PointLattice& lattice, SolidVoxels& solid)
{
  vtkDataArray* array = data->GetPointData()->GetArray(names::Obstacle);
  solid.Lattice = lattice;
  solid.Values.clear();
  if (array && array->GetNumberOfComponents() == 1)
  {
    solid.Values.resize(static_cast<std::size_t>(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < solid.Values.size(); ++i)
    {
      solid.Values[i] = array->GetComponent(static_cast<vtkIdType>(i), 0) != 0.0 ? 1 : 0;
    }
  }
}

} // namespace waft
