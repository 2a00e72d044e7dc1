// SPDX-License-Identifier: BSD-3-Clause
// Sums over bytes that tell damaged or other data apart.
#pragma once

#include "Base/Types.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace waft
{

/// Two sums over words of eight bytes that mix differently (the finishers of MurmurHash3 and
/// splitmix64). They do not depend on how the bytes are cut into pieces. No guard against malice.
class Digest
{
public:
  void Add(const void* bytes, std::size_t size);
  template <typename Number>
  void Add(Number number)
  {
    static_assert(std::is_arithmetic_v<Number> || std::is_enum_v<Number>, "a number");
    this->Add(&number, sizeof(Number));
  }
  void Add(const Vec3& v) { this->Add(v.data(), 3 * sizeof(double)); }
  /// Numbers, arrays of numbers or points, and how many they are.
  template <typename Item>
  void AddList(const std::vector<Item>& items)
  {
    static_assert(std::is_trivially_copyable_v<Item> || std::is_same_v<Item, Vec3>, "numbers");
    this->Add(items.size());
    this->Add(items.data(), items.size() * sizeof(Item));
  }
  template <typename Matrix>
  void AddMatrix(const Matrix& matrix)
  {
    this->Add(matrix.size());
    this->Add(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  }

  /// The first of the sums; both, in sixteen bytes.
  std::uint64_t Sum() const;
  std::string Text() const;

private:
  struct Sums
  {
    std::uint64_t A = 0x2545f4914f6cdd1dull, B = 0;
    void AddWord(std::uint64_t word);
  };
  Sums Finished() const;

  Sums Now;
  std::uint64_t Rest = 0; // bytes that do not fill a word yet
  std::size_t Held = 0;   // and how many they are
};

} // namespace waft
