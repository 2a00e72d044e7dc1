// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/StateStore.h"

#include "Base/AtomicFile.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <tuple>
#include <vector>

namespace waft
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* StateEnding = ".state";
constexpr std::size_t KeyDigits = 64;

bool IsKey(const std::string& text)
{
  return text.size() == KeyDigits &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool IsStateName(const std::string& name)
{
  return name.size() > KeyDigits && IsKey(name.substr(0, KeyDigits)) &&
         name.substr(KeyDigits) == StateEnding;
}

} // namespace

StateStore::StateStore(std::uint64_t most) : Most(most)
{
  const char* named = std::getenv("WAFT_CACHE");
  const char* home = std::getenv("HOME");
  const bool isNamed = named != nullptr && *named != '\0';
  if (!isNamed && (home == nullptr || *home == '\0'))
  {
    return;
  }
  const fs::path place = isNamed ? fs::path(named) : fs::path(home) / ".cache/waft";
  std::error_code failure;
  if (fs::create_directories(place, failure))
  {
    fs::permissions(place, fs::perms::owner_all, failure);
  }
  (void)this->Kept.Open(place.string());
}

std::string StateStore::Found(const std::string& key) const
{
  bool isThere = false;
  if (!this->Kept.IsOpen() || !IsKey(key) || !this->Kept.HasFile(key + StateEnding, isThere) ||
      !isThere)
  {
    return "";
  }
  this->Kept.Touch(key + StateEnding);
  return this->Kept.PathOf(key + StateEnding);
}

void StateStore::Make(const std::string& key,
                      const std::function<Result(const std::string&)>& write) const
{
  if (this->Kept.IsOpen() && IsKey(key) && this->Found(key).empty() &&
      write(this->Kept.PathOf(key + StateEnding)))
  {
    this->DropOldest(key + StateEnding);
  }
}

void StateStore::Keep(const std::string& key, const FolderBelow& folder,
                      const std::string& name) const
{
  bool isThere = false;
  if (!this->Kept.IsOpen() || !IsKey(key) || !folder.HasFile(name, isThere) || !isThere)
  {
    return;
  }
  if (!folder.Move(name, this->Kept, key + StateEnding, true)) // on another file system
  {
    PartFile part(this->Kept.PathOf(key + StateEnding));
    std::error_code failure;
    fs::copy_file(folder.PathOf(name), part.Name(), fs::copy_options::overwrite_existing, failure);
    if (failure || !part.PutInPlace())
    {
      return;
    }
  }
  this->DropOldest(key + StateEnding);
}

void StateStore::DropOldest(const std::string& latest) const
{
  std::vector<std::string> names;
  std::vector<std::tuple<std::int64_t, std::uint64_t, std::string>> held;
  std::uint64_t size = 0;
  (void)this->Kept.Names(names);
  for (const std::string& name : names)
  {
    std::optional<struct stat> about;
    if (IsStateName(name) && this->Kept.About(name, about) && about && KindOf(*about).empty())
    {
      held.emplace_back(about->st_mtime, about->st_size, name);
      size += static_cast<std::uint64_t>(about->st_size);
    }
  }
  std::sort(held.begin(), held.end());
  for (const auto& [used, bytes, name] : held)
  {
    if (size > this->Most && name != latest)
    {
      (void)this->Kept.Remove(name);
      size -= bytes;
    }
  }
}

} // namespace waft
