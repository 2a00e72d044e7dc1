// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/FolderBelow.h"

#include <openssl/evp.h>

#include <dirent.h>
#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t Deepest = 64;                        // folders, one in the other
constexpr std::size_t Longest = 255;                       // bytes of a name
constexpr std::uint64_t MostRead = std::uint64_t(1) << 28; // bytes of a file that is read whole
constexpr int AsFolder = O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

std::string Words(int reason)
{
  switch (reason)
  {
    case ELOOP:
      return "it is a link, or below one";
    case ENOTDIR:
      return "it, or what it is in, is no folder";
    case EISDIR:
      return "it is a folder";
    case ENXIO:
      return "it is a socket";
    case EACCES:
      return "it may not be opened";
    default:
      return std::strerror(reason);
  }
}

Result SystemFailure(const std::string& path, int reason)
{
  return Result::Error(path + ": " + std::strerror(reason), ErrorKind::Disk);
}

std::string Joined(const std::vector<std::string>& parts, std::size_t count)
{
  std::string name;
  for (std::size_t i = 0; i < count; ++i)
  {
    name += (i > 0 ? "/" : "") + parts[i];
  }
  return name;
}

/// What has these parts as its name below a descriptor; below 0 with errno.
int OpenBeneath(int folder, const std::vector<std::string>& parts, int flags, unsigned mode)
{
  open_how how{};
  how.flags = static_cast<std::uint64_t>(flags | O_NOFOLLOW | O_CLOEXEC);
  how.mode = (flags & O_CREAT) != 0 ? mode : 0;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS;
  const std::string name = Joined(parts, parts.size());
  const long opened = ::syscall(SYS_openat2, folder, name.c_str(), &how, sizeof(how));
  if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) // an older system, or a container
  {
    return static_cast<int>(opened);
  }
  Descriptor way;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i)
  {
    Descriptor next(::openat(folder, parts[i].c_str(), O_PATH | AsFolder));
    if (!next.IsOpen())
    {
      return -1;
    }
    way = std::move(next);
    folder = way.Get();
  }
  return ::openat(folder, parts.back().c_str(), flags | O_NOFOLLOW | O_CLOEXEC, mode);
}

class Sha256Sum
{
public:
  Sha256Sum() { ::EVP_DigestInit_ex(this->Context.get(), ::EVP_sha256(), nullptr); }
  void Add(const void* bytes, std::size_t size)
  {
    ::EVP_DigestUpdate(this->Context.get(), bytes, size);
  }
  std::string Text()
  {
    std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
    unsigned size = 0;
    ::EVP_DigestFinal_ex(this->Context.get(), sum.data(), &size);
    std::string text = "sha256:";
    for (unsigned i = 0; i < size; ++i)
    {
      char digits[3];
      std::snprintf(digits, sizeof(digits), "%02x", sum[i]);
      text += digits;
    }
    return text;
  }

private:
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> Context{ ::EVP_MD_CTX_new(),
                                                              ::EVP_MD_CTX_free };
};

/// Hands over a file piece by piece; errno where it cannot be read.
template <class Take>
int ReadPieces(int file, const Take& take)
{
  std::vector<char> piece(std::size_t(1) << 20);
  while (true)
  {
    const ssize_t size = ::read(file, piece.data(), piece.size());
    if (size == 0 || (size < 0 && errno != EINTR))
    {
      return size == 0 ? 0 : errno;
    }
    if (size > 0 && !take(piece.data(), static_cast<std::size_t>(size)))
    {
      return EFBIG;
    }
  }
}

/// Renames to a name that nothing has. Where the system cannot rename so, a file has both names for
/// a moment, and of a folder it is looked first.
int MoveNew(int from, const char* name, int to, const char* newName)
{
  constexpr unsigned noReplace = 1;
  if (::syscall(SYS_renameat2, from, name, to, newName, noReplace) == 0)
  {
    return 0;
  }
  if (errno != ENOSYS && errno != EINVAL && errno != ENOTSUP)
  {
    return errno;
  }
  if (::linkat(from, name, to, newName, 0) == 0)
  {
    return ::unlinkat(from, name, 0) == 0 ? 0 : errno;
  }
  struct stat about = {};
  if (errno == EEXIST || ::fstatat(to, newName, &about, AT_SYMLINK_NOFOLLOW) == 0)
  {
    return EEXIST;
  }
  return ::renameat(from, name, to, newName) == 0 ? 0 : errno;
}

std::vector<std::string> NamesIn(int folder)
{
  std::vector<std::string> names;
  DIR* entries = ::fdopendir(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  while (const dirent* entry = entries != nullptr ? ::readdir(entries) : nullptr)
  {
    if (std::strcmp(entry->d_name, ".") != 0 && std::strcmp(entry->d_name, "..") != 0)
    {
      names.emplace_back(entry->d_name);
    }
  }
  if (entries != nullptr)
  {
    ::closedir(entries);
  }
  std::sort(names.begin(), names.end());
  return names;
}

void RemoveTree(int folder, const std::string& name, std::size_t depth)
{
  if (::unlinkat(folder, name.c_str(), 0) == 0 || depth > Deepest)
  {
    return;
  }
  const Descriptor inner(::openat(folder, name.c_str(), O_RDONLY | AsFolder));
  if (inner.IsOpen())
  {
    for (const std::string& own : NamesIn(inner.Get()))
    {
      RemoveTree(inner.Get(), own, depth + 1);
    }
    ::unlinkat(folder, name.c_str(), AT_REMOVEDIR);
  }
}

} // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept
{
  if (this != &other)
  {
    this->Close();
    this->Number = other.Release();
  }
  return *this;
}

int Descriptor::Release()
{
  return std::exchange(this->Number, -1);
}

void Descriptor::Close()
{
  if (this->IsOpen())
  {
    ::close(this->Release());
  }
}

std::string KindOf(const struct stat& about)
{
  switch (about.st_mode & S_IFMT)
  {
    case S_IFREG:
      return "";
    case S_IFDIR:
      return "a folder";
    case S_IFIFO:
      return "a pipe";
    case S_IFSOCK:
      return "a socket";
    case S_IFLNK:
      return "a link";
    default:
      return "a device";
  }
}

std::string Sha256(const std::string& bytes)
{
  Sha256Sum sum;
  sum.Add(bytes.data(), bytes.size());
  return sum.Text();
}

Result PartsOf(const std::string& name, std::vector<std::string>& parts)
{
  parts.clear();
  bool isRight = !name.empty() && name[0] != '/' && name.find('\0') == std::string::npos;
  for (std::size_t begin = 0; isRight && begin < name.size();)
  {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    if (!part.empty() && part != ".")
    {
      parts.push_back(part);
    }
    isRight = part != ".." && part.size() <= Longest;
    begin = end + 1;
  }
  return isRight && !parts.empty() && parts.size() <= Deepest
           ? Result::Ok()
           : Result::Error("'" + name.substr(0, 100) +
                           "': expected the name of a file below the folder");
}

Result FolderBelow::Open(const std::string& path)
{
  this->Place = path;
  this->Own = Descriptor(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return this->IsOpen() ? Result::Ok()
                        : Result::Error(path + ": " + std::strerror(errno) + "; expected a folder");
}

Result FolderBelow::Open(const FolderBelow& folder, const std::string& name)
{
  bool isMissing = false;
  WAFT_RETURN_IF_FAILED(
    folder.OpenName(name, O_RDONLY | O_DIRECTORY, "a folder", this->Own, isMissing));
  this->Place = folder.PathOf(name);
  return isMissing ? folder.Missing(name, "a folder") : Result::Ok();
}

Result FolderBelow::Missing(const std::string& name, const std::string& what) const
{
  return Result::Error(this->PathOf(name) + ": " + std::strerror(ENOENT) + "; expected " + what);
}

Result FolderBelow::OpenName(const std::string& name, int flags, const std::string& what,
                             Descriptor& file, bool& isMissing, unsigned mode) const
{
  std::vector<std::string> parts;
  WAFT_RETURN_IF_FAILED(PartsOf(name, parts));
  file = Descriptor(OpenBeneath(this->Own.Get(), parts, flags, mode));
  isMissing = !file.IsOpen() && errno == ENOENT;
  if (file.IsOpen() || isMissing)
  {
    return Result::Ok();
  }
  const std::string words = Words(errno);
  return words == std::strerror(errno)
           ? SystemFailure(this->PathOf(name), errno)
           : Result::Error(this->PathOf(name) + ": " + words + "; expected " + what);
}

Result FolderBelow::At(const std::string& name, Descriptor& folder, std::string& last,
                       bool& isMissing) const
{
  std::vector<std::string> parts;
  WAFT_RETURN_IF_FAILED(PartsOf(name, parts));
  last = parts.back();
  isMissing = false;
  if (parts.size() > 1)
  {
    return this->OpenName(Joined(parts, parts.size() - 1), O_PATH | O_DIRECTORY, "a folder", folder,
                          isMissing);
  }
  folder = Descriptor(::dup(this->Own.Get()));
  return folder.IsOpen() ? Result::Ok() : SystemFailure(this->Place, errno);
}

Result FolderBelow::About(const std::string& name, std::optional<struct stat>& about) const
{
  about.reset();
  Descriptor folder;
  std::string last;
  bool isMissing = false;
  WAFT_RETURN_IF_FAILED(this->At(name, folder, last, isMissing));
  struct stat found = {};
  if (!isMissing && ::fstatat(folder.Get(), last.c_str(), &found, AT_SYMLINK_NOFOLLOW) == 0)
  {
    about = found;
  }
  return isMissing || about || errno == ENOENT ? Result::Ok()
                                               : SystemFailure(this->PathOf(name), errno);
}

Result FolderBelow::HasFile(const std::string& name, bool& isThere) const
{
  std::optional<struct stat> about;
  WAFT_RETURN_IF_FAILED(this->About(name, about));
  isThere = about.has_value();
  return !about || KindOf(*about).empty()
           ? Result::Ok()
           : Result::Error(this->PathOf(name) + ": expected a file, found " + KindOf(*about));
}

Result FolderBelow::HasFolder(const std::string& name, bool& isThere) const
{
  std::optional<struct stat> about;
  WAFT_RETURN_IF_FAILED(this->About(name, about));
  isThere = about.has_value();
  if (!about || S_ISDIR(about->st_mode))
  {
    return Result::Ok();
  }
  const std::string found = KindOf(*about);
  return Result::Error(this->PathOf(name) + ": expected a folder, found " +
                       (found.empty() ? "a file" : found));
}

Result FolderBelow::Names(std::vector<std::string>& names) const
{
  names = NamesIn(this->Own.Get());
  return Result::Ok();
}

Result FolderBelow::Everything(const std::string& name,
                               std::map<std::string, struct stat>& found) const
{
  std::vector<std::string> names;
  if (name.empty())
  {
    WAFT_RETURN_IF_FAILED(this->Names(names));
  }
  else
  {
    bool isThere = false;
    WAFT_RETURN_IF_FAILED(this->HasFolder(name, isThere));
    if (!isThere)
    {
      return Result::Ok();
    }
    FolderBelow inner;
    WAFT_RETURN_IF_FAILED(inner.Open(*this, name));
    WAFT_RETURN_IF_FAILED(inner.Names(names));
  }
  for (const std::string& own : names)
  {
    const std::string whole = name.empty() ? own : name + "/" + own;
    std::optional<struct stat> about;
    WAFT_RETURN_IF_FAILED(this->About(whole, about));
    if (about && S_ISDIR(about->st_mode))
    {
      WAFT_RETURN_IF_FAILED(this->Everything(whole, found));
    }
    else if (about)
    {
      found[whole] = *about;
    }
  }
  return Result::Ok();
}

namespace
{

constexpr int Look = O_RDONLY | O_NONBLOCK | O_NOCTTY; // a pipe without a writer is not waited for

Result CheckRegular(const Descriptor& file, const std::string& path)
{
  struct stat about = {};
  if (::fstat(file.Get(), &about) != 0)
  {
    return SystemFailure(path, errno);
  }
  const std::string kind = KindOf(about);
  return kind.empty() ? Result::Ok() : Result::Error(path + ": expected a file, found " + kind);
}

} // namespace

Result FolderBelow::OpenRegular(const std::string& name, Descriptor& file) const
{
  bool isMissing = false;
  WAFT_RETURN_IF_FAILED(this->OpenName(name, Look, "a file", file, isMissing));
  if (isMissing)
  {
    return this->Missing(name, "a file");
  }
  return CheckRegular(file, this->PathOf(name));
}

Result FolderBelow::Read(const std::string& name, std::string& bytes) const
{
  bytes.clear();
  Descriptor file;
  WAFT_RETURN_IF_FAILED(this->OpenRegular(name, file));
  const int reason = ReadPieces(file.Get(),
                                [&](const char* piece, std::size_t size)
                                {
                                  bytes.append(piece, size);
                                  return bytes.size() <= MostRead;
                                });
  return reason == 0
           ? Result::Ok()
           : Result::Error(this->PathOf(name) + ": cannot be read: " + std::strerror(reason));
}

Result FolderBelow::DigestOf(const std::string& name, FileDigest& digest) const
{
  Descriptor file;
  WAFT_RETURN_IF_FAILED(this->OpenRegular(name, file));
  Sha256Sum sum;
  digest.Size = 0;
  const int reason = ReadPieces(file.Get(),
                                [&](const char* piece, std::size_t size)
                                {
                                  sum.Add(piece, size);
                                  digest.Size += size;
                                  return true;
                                });
  digest.Text = sum.Text();
  return reason == 0 ? Result::Ok() : SystemFailure(this->PathOf(name), reason);
}

Result FolderBelow::OwnFile(const std::string& name, Descriptor& file, bool& isGone) const
{
  WAFT_RETURN_IF_FAILED(this->OpenName(name, O_RDWR | O_CREAT | O_NONBLOCK,
                                       "an empty file, or none", file, isGone, 0666));
  if (isGone)
  {
    return Result::Ok();
  }
  struct stat about = {};
  if (::fstat(file.Get(), &about) != 0)
  {
    return SystemFailure(this->PathOf(name), errno);
  }
  const std::string kind = KindOf(about);
  return kind.empty() && about.st_size == 0
           ? Result::Ok()
           : Result::Error(this->PathOf(name) + ": expected an empty file, or none, found " +
                           (kind.empty() ? "another" : kind));
}

Result FolderBelow::MakeFolder(const std::string& name) const
{
  std::vector<std::string> parts;
  WAFT_RETURN_IF_FAILED(PartsOf(name, parts));
  for (std::size_t count = 1; count <= parts.size(); ++count)
  {
    Descriptor folder;
    std::string last;
    bool isMissing = false;
    WAFT_RETURN_IF_FAILED(this->At(Joined(parts, count), folder, last, isMissing));
    if (::mkdirat(folder.Get(), last.c_str(), 0777) != 0 && errno != EEXIST)
    {
      return SystemFailure(this->PathOf(name), errno);
    }
  }
  return Result::Ok();
}

Result FolderBelow::Move(const std::string& name, const FolderBelow& target,
                         const std::string& newName, bool replaces) const
{
  Descriptor from, to;
  std::string last, newLast;
  bool isMissing = false, isTargetMissing = false;
  WAFT_RETURN_IF_FAILED(this->At(name, from, last, isMissing));
  WAFT_RETURN_IF_FAILED(target.At(newName, to, newLast, isTargetMissing));
  const int failed =
    replaces ? (::renameat(from.Get(), last.c_str(), to.Get(), newLast.c_str()) == 0 ? 0 : errno)
             : MoveNew(from.Get(), last.c_str(), to.Get(), newLast.c_str());
  return failed == 0 ? Result::Ok() : SystemFailure(target.PathOf(newName), failed);
}

Result FolderBelow::Remove(const std::string& name) const
{
  Descriptor folder;
  std::string last;
  bool isMissing = false;
  WAFT_RETURN_IF_FAILED(this->At(name, folder, last, isMissing));
  return isMissing || ::unlinkat(folder.Get(), last.c_str(), 0) == 0 || errno == ENOENT
           ? Result::Ok()
           : SystemFailure(this->PathOf(name), errno);
}

void FolderBelow::RemoveEmpty(const std::string& name) const
{
  std::vector<std::string> parts;
  if (!PartsOf(name, parts))
  {
    return;
  }
  for (std::size_t count = parts.size(); count > 0; --count)
  {
    Descriptor folder;
    std::string last;
    bool isMissing = false;
    if (!this->At(Joined(parts, count), folder, last, isMissing) || isMissing ||
        ::unlinkat(folder.Get(), last.c_str(), AT_REMOVEDIR) != 0)
    {
      return;
    }
  }
}

void FolderBelow::RemoveAll(const std::string& name) const
{
  Descriptor folder;
  std::string last;
  bool isMissing = false;
  if (this->At(name, folder, last, isMissing) && !isMissing)
  {
    RemoveTree(folder.Get(), last, 0);
  }
}

void FolderBelow::Touch(const std::string& name) const
{
  Descriptor folder;
  std::string last;
  bool isMissing = false;
  if (this->At(name, folder, last, isMissing) && !isMissing)
  {
    ::utimensat(folder.Get(), last.c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
  }
}

} // namespace waft
