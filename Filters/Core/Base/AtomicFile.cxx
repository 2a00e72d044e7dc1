// SPDX-License-Identifier: BSD-3-Clause
#include "Base/AtomicFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace waft
{

namespace
{

std::string PartOf(const std::string& path)
{
  return path + ".part" + std::to_string(::getpid());
}

Result Failure(const std::string& path)
{
  const std::string reason = std::strerror(errno);
  std::remove(PartOf(path).c_str());
  return Result::Error("cannot write " + path + ": " + reason);
}

Result WritePart(const std::string& path, const std::string& bytes)
{
  const std::string part = PartOf(path);
  const auto fail = [&]() { return Failure(path); };
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
  return std::fclose(file) == 0 ? Result::Ok() : fail();
}

Result PutInPlace(const std::string& path)
{
  return std::rename(PartOf(path).c_str(), path.c_str()) == 0 ? Result::Ok() : Failure(path);
}

/// The folders above a file that are not there, the outermost first.
std::vector<std::filesystem::path> MissingFolders(const std::string& path)
{
  std::vector<std::filesystem::path> missing;
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code error;
  while (!folder.empty() && !std::filesystem::exists(folder, error))
  {
    missing.insert(missing.begin(), folder);
    folder = folder.parent_path();
  }
  return missing;
}

} // namespace

Result WriteWholeFile(const std::string& path, const std::string& bytes)
{
  WAFT_RETURN_IF_FAILED(WritePart(path, bytes));
  return PutInPlace(path);
}

Result WriteWholeFiles(const std::vector<FileContent>& files)
{
  Result result = Result::Ok();
  std::vector<std::filesystem::path> made;
  std::vector<std::string> parts;
  std::error_code error;
  for (const FileContent& file : files)
  {
    for (const std::filesystem::path& folder : MissingFolders(file.Path))
    {
      if (std::filesystem::create_directory(folder, error))
      {
        made.push_back(folder);
      }
    }
    result = WritePart(file.Path, file.Bytes);
    if (!result)
    {
      break;
    }
    parts.push_back(file.Path);
  }
  for (std::size_t i = 0; result && i < files.size(); ++i)
  {
    // What stands in the way (a folder of that name) is seen before anything is replaced.
    if (std::filesystem::is_directory(files[i].Path, error))
    {
      result = Result::Error("cannot write " + files[i].Path + ": it is a folder");
    }
  }
  for (std::size_t i = 0; result && i < files.size(); ++i)
  {
    result = PutInPlace(files[i].Path);
  }
  for (const std::string& path : parts)
  {
    std::remove(PartOf(path).c_str()); // those that were not put in place
  }
  for (auto folder = made.rbegin(); !result && folder != made.rend(); ++folder)
  {
    std::filesystem::remove(*folder, error); // empty ones only
  }
  return result;
}

} // namespace waft
