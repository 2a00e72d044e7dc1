// SPDX-License-Identifier: BSD-3-Clause
#include "Base/AtomicFile.h"

#include <cerrno>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <unistd.h>

namespace waft
{

namespace
{

/// Bytes after which what was written is pushed to the disk: who writes against the clock sees how
/// fast that is before the end.
constexpr std::size_t PushedBytes = std::size_t(4) << 20;

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

Result WritePart(PartFile& part, const std::string& bytes)
{
  if (part.Open())
  {
    part.Write(bytes.data(), bytes.size());
  }
  return part.Close();
}

} // namespace

PartFile::PartFile(const std::string& path) : Path(path) {}

PartFile::~PartFile()
{
  if (this->File != nullptr)
  {
    std::fclose(this->File);
  }
  if (this->IsMade && !this->IsInPlace)
  {
    std::remove(this->Part.c_str());
  }
}

const std::string& PartFile::Name()
{
  this->Make();
  return this->Part;
}

bool PartFile::Make()
{
  std::random_device chance;
  while (!this->IsMade)
  {
    this->Part = this->Path + ".part" + std::to_string(chance());
    constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    const int made = ::open(this->Part.c_str(), flags, 0666);
    this->IsMade = made >= 0;
    if (this->IsMade)
    {
      ::close(made);
    }
    else if (errno != EEXIST)
    {
      return this->Fail();
    }
  }
  return true;
}

bool PartFile::Fail()
{
  if (this->Reason == 0)
  {
    this->Reason = errno != 0 ? errno : EIO;
  }
  return false;
}

Result PartFile::Failure() const
{
  return Result::Error("cannot write " + this->Path + ": " + std::strerror(this->Reason),
                       ErrorKind::Disk);
}

bool PartFile::Open()
{
  if (!this->Make())
  {
    return false;
  }
  this->File = std::fopen(this->Part.c_str(), "wb");
  return this->File != nullptr || this->Fail();
}

bool PartFile::Write(const void* bytes, std::size_t size)
{
  const auto before = static_cast<std::size_t>(std::ftell(this->File));
  if (std::fwrite(bytes, 1, size, this->File) != size)
  {
    return this->Fail();
  }
  if ((before + size) / PushedBytes == before / PushedBytes)
  {
    return true;
  }
  return (std::fflush(this->File) == 0 && ::fdatasync(::fileno(this->File)) == 0) || this->Fail();
}

Result PartFile::Close()
{
  if (this->File != nullptr)
  {
    if (std::fflush(this->File) != 0 || ::fsync(::fileno(this->File)) != 0)
    {
      this->Fail();
    }
    if (std::fclose(this->File) != 0)
    {
      this->Fail();
    }
    this->File = nullptr;
  }
  return this->Reason == 0 ? Result::Ok() : this->Failure();
}

Result PartFile::PutInPlace()
{
  if (!this->IsMade)
  {
    errno = ENOENT;
    this->Fail();
    return this->Failure();
  }
  if (std::rename(this->Part.c_str(), this->Path.c_str()) != 0)
  {
    this->Fail();
    return this->Failure();
  }
  this->IsInPlace = true;
  return Result::Ok();
}

Result WriteWholeFile(const std::string& path, const std::string& bytes)
{
  PartFile part(path);
  WAFT_RETURN_IF_FAILED(WritePart(part, bytes));
  return part.PutInPlace();
}

Result WriteWholeFiles(const std::vector<FileContent>& files)
{
  Result result = Result::Ok();
  std::vector<std::filesystem::path> made;
  std::deque<PartFile> parts; // they do not move
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
    result = WritePart(parts.emplace_back(file.Path), file.Bytes);
    if (!result)
    {
      break;
    }
  }
  for (std::size_t i = 0; result && i < files.size(); ++i)
  {
    // What stands in the way (a folder of that name) is seen before anything is replaced.
    if (std::filesystem::is_directory(files[i].Path, error))
    {
      result = Result::Error("cannot write " + files[i].Path + ": it is a folder");
    }
  }
  for (auto part = parts.begin(); result && part != parts.end(); ++part)
  {
    result = part->PutInPlace();
  }
  parts.clear(); // and with them the files that were not put in place
  for (auto folder = made.rbegin(); !result && folder != made.rend(); ++folder)
  {
    std::filesystem::remove(*folder, error); // empty ones only
  }
  return result;
}

} // namespace waft
