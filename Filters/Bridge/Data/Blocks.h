// SPDX-License-Identifier: BSD-3-Clause
// Inputs that consist of blocks (groups, extracted blocks, partitions), as what their readers take:
// merged where that means something, else refused in words. Data without a point, cell or row count
// as nothing, whatever their kind; owner is the input's name, for messages.
#pragma once

#include "Base/Result.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;
class vtkMultiBlockDataSet;
class vtkPolyData;

namespace waft
{

/// All surfaces that an input has: its blocks in their order, or itself.
Result SurfacesOf(vtkDataObject* data, const std::string& owner,
                  std::vector<vtkPolyData*>& surfaces);
/// When the points of each changed last; 0 without points.
std::vector<vtkMTimeType> PointChanges(const std::vector<vtkPolyData*>& surfaces);
/// The only surface that it has; an empty one where it has none.
Result OneSurface(vtkDataObject* data, const std::string& owner,
                  vtkSmartPointer<vtkPolyData>& surface);
/// All of them appended. Fails where one lacks an array that another has, and where they are of
/// scenes of another volume or time line. Field data are those of the first that has them.
Result MergedSurface(vtkDataObject* data, const std::string& owner,
                     vtkSmartPointer<vtkPolyData>& surface);
/// The only image; an empty one where it has none.
Result OneImage(vtkDataObject* data, const std::string& owner,
                vtkSmartPointer<vtkImageData>& image);
/// Partitions become blocks, and a group of one list of blocks is that list.
Result ListOfBlocks(vtkDataObject* data, const std::string& owner,
                    vtkSmartPointer<vtkMultiBlockDataSet>& blocks);

} // namespace waft
