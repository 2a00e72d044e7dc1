// SPDX-License-Identifier: BSD-3-Clause
// The arrays of an image that are a wind or the air.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Result.h"

#include <vtkType.h>

#include <array>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace waft
{

/// Where images come from, which says what is looked for in them.
enum class FieldRole
{
  Wind,     // of the pipeline: point data `Wind` (an acceleration), without it `Velocity`
  WindFile, // of another program: what ChooseWind takes, of points or of cells
  Air       // point data `Velocity`
};

/// A vector at each point of a lattice: the image's points, or the middles of its cells.
struct FieldArrays
{
  SeriesLattice Lattice;             // without times
  std::vector<vtkDataArray*> Arrays; // one of three components, or three of one
  std::string Name;                  // of the array, for messages

  double Value(vtkIdType i, int component) const;
  /// All of them where they are floats side by side, as Waft's own are; else false, and nothing.
  bool CopyTo(std::vector<std::array<float, 3>>& values) const;
};

/// Finds them; array: the name that a wind's file was asked for. Fails, listing what the image has.
Result FindField(vtkImageData* data, FieldRole role, const std::string& array, FieldArrays& found);

} // namespace waft
