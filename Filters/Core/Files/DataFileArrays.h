// SPDX-License-Identifier: BSD-3-Clause
// The values of the arrays in a VTK XML file: where they are and how many bytes of them. Private to
// this library.
#pragma once

#include "Files/DataFileCheck.h"
#include "Files/FileBytes.h"

#include <string>
#include <string_view>

namespace waft
{

/// Bytes of a value of an array's type, 1 of String and Bit; 0 where it is none.
int BytesOfType(std::string_view type);

/// What an array's element says of its values, before it is known where they are.
struct ArrayClaim
{
  std::string Location;
  std::string_view Format; // ascii, binary, appended
  double Bytes = -1.0;     // of all values; -1: only the array's own header says
  double Texts = -1.0;     // the most that there is room for; -1: its values are numbers
  std::size_t At = 0;      // of inline values: their byte; of appended ones: their offset
};

/// Bytes of the values of arrays: in memory, and as they are in the file.
struct ArrayBytes
{
  double InMemory = 0.0;
  double InFile = 0.0;
};

/// How a file keeps the values of its arrays.
struct DataFileArrays
{
  explicit DataFileArrays(std::string_view text) : Text(text) {}

  std::string_view Text;   // the whole file
  std::string_view Packer; // the compressor; empty: none
  int WordSize = 4;        // bytes of a number in the header of an array
  ByteOrder Order = ByteOrder::Little;
  std::string_view Appended;
  bool IsRaw = false; // the appended ones; others are base64

  bool IsPacked() const { return !this->Packer.empty(); }
  /// More of anything does not fit in the file.
  double Most() const;
  /// Are the values there, and as many as the claim says? Adds to the bytes of others.
  Result Check(const ArrayClaim& claim, ArrayBytes& bytes) const;
  /// Has an array that passed Check no more texts than there is room for? Readers do not look.
  Result CheckTexts(const ArrayClaim& claim, const BlockUnpacker& unpack) const;
};

} // namespace waft
