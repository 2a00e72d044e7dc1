// SPDX-License-Identifier: BSD-3-Clause
#include "Base/StateArchive.h"

#include <algorithm>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace waft
{

StateFileWriter::StateFileWriter(const std::string& path) : File(path)
{
  if (!this->File.Open())
  {
    this->Fail();
  }
}

bool StateFileWriter::Bytes(void* bytes, std::size_t size)
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
  return this->File.PutInPlace();
}

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
