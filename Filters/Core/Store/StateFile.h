// SPDX-License-Identifier: BSD-3-Clause
// The one format of what is kept on disk to go on from: what it is, of which version, the key of
// what it was made from, the content, and a checksum of all.
#pragma once

#include "Base/AtomicFile.h"
#include "Base/Result.h"
#include "Base/StateArchive.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace waft
{

/// What a file holds, in words, and the version of how that is put down.
struct StateKind
{
  const char* Name;
  int Version;
};

/// Writes a file whole or not at all.
class StateFileWriter : public StateArchive
{
public:
  /// key: digest of all that the content follows from (DigestOf); 0 where nobody asks.
  StateFileWriter(const std::string& path, const StateKind& kind, std::uint64_t key = 0);

  bool IsReading() const override { return false; }
  /// The file takes its place, its checksum at the end. Errors name the path and the reason, which
  /// a file there that is none of this format is, too; what stood there before is then untouched
  /// and nothing is left beside it.
  Result Commit();

protected:
  bool Put(const void* bytes, std::size_t size) override;

private:
  std::string Path;
  PartFile File;
  Digest Checks;
};

/// Removes a file of this format, whole or damaged; leaves any other alone.
void RemoveStateFile(const std::string& path);

/// Why a file is not gone on from.
enum class StateLack
{
  None,
  NoFile,    // or none that could hold anything
  Damaged,   // cut short or changed since it was written
  OtherKind, // or another version of this kind
  OtherKey,
  Incomplete // its content ends too early or too late, or cannot be
};

/// In words that follow the name of the file: "is damaged".
std::string ToString(StateLack lack, const StateKind& kind);

/// Reads a content; false where it cannot be.
using StateContent = std::function<bool(StateArchive& file)>;

/// Reads what StateFileWriter wrote; content is called for a whole file of this kind and key alone,
/// without a key of any. What it read where a lack is returned is to be thrown away.
StateLack ReadStateFile(const std::string& path, const StateKind& kind,
                        std::optional<std::uint64_t> key, const StateContent& content);

} // namespace waft
