// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files, checked before and after VTK's readers.
#pragma once

#include "Base/Result.h"

#include <string>

class vtkImageData;
class vtkMultiBlockDataSet;
class vtkPolyData;

namespace waft
{

// Each fails on a file of another type, one that is cut or damaged, and counts that it cannot hold;
// a message begins with the place in the file.

/// A .vtp; its cells are of points that are there.
Result ReadPolyDataFile(const std::string& path, vtkPolyData* data);
/// A .vti.
Result ReadImageFile(const std::string& path, vtkImageData* data);
/// A .vtm of surfaces and tables, with all their files; and the look before it.
Result ReadBlocksFile(const std::string& path, vtkMultiBlockDataSet* data);
Result CheckBlocksFile(const std::string& path);

} // namespace waft
