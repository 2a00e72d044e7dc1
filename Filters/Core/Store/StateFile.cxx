// SPDX-License-Identifier: BSD-3-Clause
#include "Store/StateFile.h"

#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace waft
{
namespace
{

constexpr const char* Format = "Waft state 1"; // of what is before and behind the content

class StateFileReader : public StateArchive
{
public:
  explicit StateFileReader(const std::string& path);
  ~StateFileReader() override;
  StateFileReader(const StateFileReader&) = delete;
  void operator=(const StateFileReader&) = delete;

  bool IsReading() const override { return true; }
  std::uint64_t Left() const override { return this->Rest; }
  bool IsAtEnd() const { return this->IsGood() && this->Rest == 0; }
  /// Whether the checksum is that of the bytes before it. Before anything is read.
  bool IsWhole();

protected:
  bool Get(void* bytes, std::size_t size) override;

private:
  std::FILE* File = nullptr;
  std::uint64_t Rest = 0; // bytes before the checksum
};

StateFileReader::StateFileReader(const std::string& path)
{
  // Without O_NONBLOCK a pipe that nobody writes to would be waited for.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status = {};
  if (file >= 0 && (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)))
  {
    ::close(file);
  }
  else if (file >= 0)
  {
    this->File = ::fdopen(file, "rb");
  }
  long size = -1;
  if (this->File != nullptr && std::fseek(this->File, 0, SEEK_END) == 0)
  {
    size = std::ftell(this->File);
    std::rewind(this->File);
  }
  if (size < static_cast<long>(sizeof(std::uint64_t)))
  {
    this->Refuse();
    return;
  }
  this->Rest = static_cast<std::uint64_t>(size) - sizeof(std::uint64_t);
}

StateFileReader::~StateFileReader()
{
  if (this->File != nullptr)
  {
    std::fclose(this->File);
  }
}

bool StateFileReader::Get(void* bytes, std::size_t size)
{
  if (size > this->Rest || std::fread(bytes, 1, size, this->File) != size)
  {
    return false;
  }
  this->Rest -= size;
  return true;
}

bool StateFileReader::IsWhole()
{
  const std::uint64_t size = this->Rest;
  Digest sum;
  std::vector<char> part(std::size_t(1) << 20);
  while (this->Rest > 0)
  {
    const std::size_t count = std::min<std::uint64_t>(part.size(), this->Rest);
    if (!this->Get(part.data(), count))
    {
      return false;
    }
    sum.Add(part.data(), count);
  }
  std::uint64_t stated = 0;
  const bool isWhole =
    std::fread(&stated, sizeof(stated), 1, this->File) == 1 && stated == sum.Sum();
  std::rewind(this->File);
  this->Rest = size;
  return isWhole;
}

/// Whether something is lost where the file is replaced or removed that never was a state.
bool IsOfOthers(const std::string& path)
{
  StateFileReader file(path);
  std::string format;
  file.Values(format);
  return std::filesystem::exists(path) && format != Format;
}

} // namespace

void RemoveStateFile(const std::string& path)
{
  if (!IsOfOthers(path))
  {
    (void)std::remove(path.c_str());
  }
}

StateFileWriter::StateFileWriter(const std::string& path, const StateKind& kind,
                                 std::uint64_t key) :
  Path(path),
  File(path)
{
  if (!this->File.Open())
  {
    this->Refuse();
  }
  const std::string format = Format, name = kind.Name;
  this->Values(format, name, kind.Version, key);
}

bool StateFileWriter::Put(const void* bytes, std::size_t size)
{
  this->Checks.Add(bytes, size);
  return this->File.Write(bytes, size);
}

Result StateFileWriter::Commit()
{
  const std::uint64_t sum = this->Checks.Sum();
  if (this->IsGood())
  {
    this->File.Write(&sum, sizeof(sum));
  }
  WAFT_RETURN_IF_FAILED(this->File.Close());
  if (IsOfOthers(this->Path))
  {
    return Result::Error(this->Path + ": nothing was written: expected a new name or a file that "
                                      "Waft keeps a state in, found another, which is left alone");
  }
  return this->File.PutInPlace();
}

std::string ToString(StateLack lack, const StateKind& kind)
{
  switch (lack)
  {
    case StateLack::None:
      return "";
    case StateLack::NoFile:
      return "is no file";
    case StateLack::Damaged:
      return "is damaged";
    case StateLack::OtherKind:
      return "is no " + std::string(kind.Name) + " of this version";
    case StateLack::OtherKey:
      return "belongs to other inputs or properties";
    case StateLack::Incomplete:
      return "is incomplete";
  }
  return "";
}

StateLack ReadStateFile(const std::string& path, const StateKind& kind,
                        std::optional<std::uint64_t> key, const StateContent& content)
{
  StateFileReader file(path);
  if (!file.IsGood())
  {
    return StateLack::NoFile;
  }
  if (!file.IsWhole())
  {
    return StateLack::Damaged;
  }
  std::string format, name;
  int version = 0;
  std::uint64_t own = 0;
  file.Values(format, name, version, own);
  if (format != Format || name != kind.Name || version != kind.Version)
  {
    return StateLack::OtherKind;
  }
  if (key && *key != own)
  {
    return StateLack::OtherKey;
  }
  return content(file) && file.IsAtEnd() ? StateLack::None : StateLack::Incomplete;
}

} // namespace waft
