// SPDX-License-Identifier: BSD-3-Clause
// What a PLY file says that it holds. Private to this library.
#pragma once

#include "Files/TextLines.h"

#include <string>
#include <vector>

namespace waft
{

/// A type of a number: its bytes, and whether it is a float or below zero at times.
struct PlyType
{
  int Size = 0; // 0: none
  bool IsReal = false;
  bool IsSigned = false;
};

struct PlyProperty
{
  std::string Name;
  PlyType Type;
  PlyType Count; // of a list

  bool IsList() const { return this->Count.Size > 0; }
};

struct PlyElement
{
  std::string Name;
  long long Count = 0;
  std::vector<PlyProperty> Properties;
};

struct PlyHeader
{
  bool IsText = false;
  ByteOrder Order = ByteOrder::Little;
  std::vector<PlyElement> Elements;
};

/// Reads up to the line `end_header`.
Result ReadPlyHeader(TextLines& lines, PlyHeader& header);

} // namespace waft
