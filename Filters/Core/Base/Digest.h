// SPDX-License-Identifier: BSD-3-Clause
// Sums over bytes that tell damaged or other data apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace waft
{

/// Two sums over words of eight bytes that mix differently (the finishers of MurmurHash3 and
/// splitmix64). They do not depend on how the bytes are cut into pieces. No guard against malice.
class Digest
{
public:
  void Add(const void* bytes, std::size_t size);

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
