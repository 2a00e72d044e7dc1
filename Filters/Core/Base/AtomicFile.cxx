// SPDX-License-Identifier: BSD-3-Clause
#include "Base/AtomicFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <unistd.h>

namespace waft
{

Result WriteWholeFile(const std::string& path, const std::string& bytes)
{
  const std::string part = path + ".part" + std::to_string(::getpid());
  const auto fail = [&]()
  {
    const std::string reason = std::strerror(errno);
    std::remove(part.c_str());
    return Result::Error("cannot write " + path + ": " + reason);
  };
  std::FILE* file = std::fopen(part.c_str(), "wb");
  if (file == nullptr)
  {
    return fail();
  }
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() &&
                       std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0;
  if (!written)
  {
    const int reason = errno;
    std::fclose(file);
    errno = reason;
    return fail();
  }
  if (std::fclose(file) != 0 || std::rename(part.c_str(), path.c_str()) != 0)
  {
    return fail();
  }
  return Result::Ok();
}

} // namespace waft
