// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files, written without a copy of them in memory.
#pragma once

#include "Base/Result.h"

#include <set>
#include <string>

class vtkDataObject;

namespace waft
{

struct DataFileForm
{
  bool PacksWell = false; // by LZMA, which makes three quarters of what is rounded
  /// Doubles at points have the precision of floats, which take half the room where they are
  /// compressed; not the points themselves, nor arrays of these names.
  bool IsRounded = false;
  std::set<std::string> Exact;
};

/// A .vtp, .vti or .vtt, compressed, its values within the tags in base64: VTK 9.1 reads none after
/// them with Expat 2.6, nor with Debian's fixes of 2.5. Fails with the system's reason where the
/// file cannot be written; what there is of it by then stays.
Result WriteDataFile(const std::string& path, vtkDataObject* data, const DataFileForm& form);

} // namespace waft
