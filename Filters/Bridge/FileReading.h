// SPDX-License-Identifier: BSD-3-Clause
// Running VTK's readers of files.
#pragma once

#include "Base/Result.h"

#include <string>

class vtkAlgorithm;

namespace waft
{

/// The extension in small letters with its dot.
std::string Extension(const std::string& path);

/// Updates a reader; its error text becomes the message instead of going to the console.
Result RunReader(vtkAlgorithm* reader);

} // namespace waft
