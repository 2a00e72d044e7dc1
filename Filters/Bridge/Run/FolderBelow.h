// SPDX-License-Identifier: BSD-3-Clause
// What is below a folder that may be a stranger's.
#pragma once

#include "Base/Result.h"

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace waft
{

/// A descriptor of a file, which it closes.
class Descriptor
{
public:
  explicit Descriptor(int number = -1) : Number(number) {}
  ~Descriptor() { this->Close(); }
  Descriptor(Descriptor&& other) noexcept : Number(other.Release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int Get() const { return this->Number; }
  bool IsOpen() const { return this->Number >= 0; }
  int Release();
  void Close();

private:
  int Number;
};

/// "a folder", "a pipe" and so on; empty of a regular file.
std::string KindOf(const struct stat& about);

/// Size and SHA-256 of a file, as manifests have them.
struct FileDigest
{
  std::uint64_t Size = 0;
  std::string Text; // sha256: and 64 digits
  bool operator==(const FileDigest& other) const
  {
    return this->Size == other.Size && this->Text == other.Text;
  }
};

/// "sha256:" and the digits of bytes.
std::string Sha256(const std::string& bytes);

/// A folder, named through links or not. Names are relative to it, with slashes; the system opens
/// them beneath its descriptor (openat2), and by their parts where it cannot, and follows no link
/// on the way. So neither a name that a file in it holds nor a link that lies in it leads out of
/// it. Each function fails where a name leads out, or a part of it is a link or no folder, and
/// where a part is missing, unless it says otherwise.
class FolderBelow
{
public:
  Result Open(const std::string& path);
  /// Of a folder below another.
  Result Open(const FolderBelow& folder, const std::string& name);
  bool IsOpen() const { return this->Own.IsOpen(); }
  const std::string& Path() const { return this->Place; }
  std::string PathOf(const std::string& name) const { return this->Place + "/" + name; }

  /// What has a name, be it a link; nothing where none has.
  Result About(const std::string& name, std::optional<struct stat>& about) const;
  /// Whether there is a file, or a folder; fails where there is something else.
  Result HasFile(const std::string& name, bool& isThere) const;
  Result HasFolder(const std::string& name, bool& isThere) const;
  /// Names of what is in it, sorted.
  Result Names(std::vector<std::string>& names) const;
  /// All below a folder in it ("": itself) that is no folder; nothing where that is not there.
  Result Everything(const std::string& name, std::map<std::string, struct stat>& found) const;
  /// A regular file; fails where nothing has the name.
  Result Read(const std::string& name, std::string& bytes) const;
  Result DigestOf(const std::string& name, FileDigest& digest) const;

  /// A descriptor, to write, of an empty file, which is made where nothing has its name. Fails
  /// where something else has; isGone, without a failure, where the folder itself was removed.
  Result OwnFile(const std::string& name, Descriptor& file, bool& isGone) const;
  /// A folder, and those that it is in, where they are not there yet.
  Result MakeFolder(const std::string& name) const;
  /// Renames a file or folder to a name below another folder; fails where something has it, unless
  /// that is to be replaced.
  Result Move(const std::string& name, const FolderBelow& target, const std::string& newName,
              bool replaces) const;
  /// Removes a file, or a link itself; nothing where none is there.
  Result Remove(const std::string& name) const;
  /// Removes a folder and those that it is in while they are empty.
  void RemoveEmpty(const std::string& name) const;
  /// Removes a folder in it and what is in that, as far as the system lets it.
  void RemoveAll(const std::string& name) const;
  /// The time of a file becomes now.
  void Touch(const std::string& name) const;

private:
  Result OpenName(const std::string& name, int flags, const std::string& what, Descriptor& file,
                  bool& isMissing, unsigned mode = 0) const;
  Result OpenRegular(const std::string& name, Descriptor& file) const;
  /// The folder that a name is in, and the name's last part.
  Result At(const std::string& name, Descriptor& folder, std::string& last, bool& isMissing) const;
  Result Missing(const std::string& name, const std::string& what) const;

  std::string Place;
  Descriptor Own;
};

/// The parts of a name below a folder; fails on an absolute one, and on one that leads above it.
Result PartsOf(const std::string& name, std::vector<std::string>& parts);

} // namespace waft
