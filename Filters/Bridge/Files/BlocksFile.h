// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"

#include <string>

class vtkMultiBlockDataSet;

namespace waft
{

/// A .vtm, and its blocks' files in a folder of its name, which is made. Fails with the path of
/// what cannot be written.
Result WriteBlocksFile(const std::string& path, vtkMultiBlockDataSet* data);

} // namespace waft
