// SPDX-License-Identifier: BSD-3-Clause
#include "Base/StateArchive.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <unistd.h>

namespace waft
{

StateFileWriter::StateFileWriter(const std::string& path) :
  Path(path), Part(path + ".part" + std::to_string(::getpid()))
{
  this->File = std::fopen(this->Part.c_str(), "wb");
  if (this->File == nullptr)
  {
    this->Reason = errno;
    this->Fail();
  }
}

StateFileWriter::~StateFileWriter()
{
  if (this->File != nullptr)
  {
    std::fclose(this->File);
    std::remove(this->Part.c_str());
  }
}

bool StateFileWriter::Bytes(void* bytes, std::size_t size)
{
  this->Checks.Add(bytes, size);
  if (std::fwrite(bytes, 1, size, this->File) == size)
  {
    return true;
  }
  this->Reason = errno;
  return false;
}

Result StateFileWriter::Commit()
{
  const auto fail = [this]()
  { return Result::Error("cannot write " + this->Path + ": " + std::strerror(this->Reason)); };
  const std::uint64_t sum = this->Checks.Sum();
  if (!this->IsGood())
  {
    return fail();
  }
  const bool written = std::fwrite(&sum, sizeof(sum), 1, this->File) == 1 &&
                       std::fflush(this->File) == 0 && ::fsync(::fileno(this->File)) == 0;
  this->Reason = errno;
  if (!written)
  {
    return fail();
  }
  const bool closed = std::fclose(this->File) == 0;
  this->File = nullptr;
  if (!closed || std::rename(this->Part.c_str(), this->Path.c_str()) != 0)
  {
    this->Reason = errno;
    std::remove(this->Part.c_str());
    return fail();
  }
  return Result::Ok();
}

StateFileReader::StateFileReader(const std::string& path)
{
  this->File = std::fopen(path.c_str(), "rb");
  long size = -1;
  if (this->File != nullptr && std::fseek(this->File, 0, SEEK_END) == 0)
  {
    size = std::ftell(this->File);
    std::rewind(this->File);
  }
  if (size < static_cast<long>(sizeof(std::uint64_t)))
  {
    this->Fail();
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

bool StateFileReader::Bytes(void* bytes, std::size_t size)
{
  if (size > this->Rest || std::fread(bytes, 1, size, this->File) != size)
  {
    return false;
  }
  this->Rest -= size;
  return true;
}

bool IsWholeStateFile(const std::string& path)
{
  StateFileReader file(path);
  if (!file.IsGood())
  {
    return false;
  }
  Digest sum;
  std::vector<char> part(std::size_t(1) << 20);
  while (file.Rest > 0)
  {
    const std::size_t size = std::min<std::uint64_t>(part.size(), file.Rest);
    if (!file.Bytes(part.data(), size))
    {
      return false;
    }
    sum.Add(part.data(), size);
  }
  std::uint64_t stated = 0;
  return std::fread(&stated, sizeof(stated), 1, file.File) == 1 && stated == sum.Sum();
}

} // namespace waft
