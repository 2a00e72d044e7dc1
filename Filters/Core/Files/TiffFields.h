// SPDX-License-Identifier: BSD-3-Clause
// The directory of a TIFF. Private to this library.
#pragma once

#include "Base/Result.h"
#include "Files/FileBytes.h"

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace waft
{

/// A field of a TIFF directory: its numbers, where they are whole.
class TiffFields
{
public:
  /// Fails on another signature, and on a field that is not in the file.
  Result Read(std::string_view file);

  ByteOrder Order() const { return this->Bytes; }
  bool Has(int tag) const { return this->Fields.count(tag) > 0; }
  /// Its first number.
  std::uint64_t Number(int tag, std::uint64_t absent) const;
  /// All of them; none of a field that is absent.
  const std::vector<std::uint64_t>& Numbers(int tag) const;

private:
  ByteOrder Bytes = ByteOrder::Little;
  std::map<int, std::vector<std::uint64_t>> Fields;
};

/// The byte order that a TIFF's signature says; false of another file.
bool IsTiff(std::string_view file, ByteOrder& order);

} // namespace waft
