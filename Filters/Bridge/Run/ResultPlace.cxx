// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/ResultPlace.h"

#include "Base/AtomicFile.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <random>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace waft
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* Staged = "manifest.json";
constexpr std::chrono::seconds Patience{ 20 }; // that results may take to change hands
constexpr const char* Stays =
  "it stays as it is: move it away, or choose another place for the results";

std::string NotOurs()
{
  return std::string("no run of waft wrote it: ") + Stays;
}

/// Four letters and digits that go with four others.
std::string CheckOf(const std::string& start)
{
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyz234567";
  const std::string digits = Sha256("temporary of waft: " + start).substr(7, 5);
  const unsigned long bits = std::stoul(digits, nullptr, 16);
  std::string check;
  for (int shift = 15; shift >= 0; shift -= 5)
  {
    check += letters[(bits >> shift) & 31u];
  }
  return check;
}

/// A name of which can be told that Waft made it.
std::string TemporaryName()
{
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device chance;
  std::string start;
  for (int i = 0; i < 4; ++i)
  {
    start += letters[chance() % 36];
  }
  return ".waft-" + start + CheckOf(start);
}

bool IsTemporary(const std::string& name)
{
  constexpr std::size_t head = 6, half = 4;
  return name.size() == head + 2 * half && name.compare(0, head, ".waft-") == 0 &&
         name.substr(head + half) == CheckOf(name.substr(head, half));
}

/// Names of the folders in which runs stage, or staged, their files.
Result StagingsIn(const FolderBelow& room, std::vector<std::string>& stagings)
{
  std::vector<std::string> names;
  WAFT_RETURN_IF_FAILED(room.Names(names));
  for (const std::string& name : names)
  {
    std::optional<struct stat> about;
    if (IsTemporary(name))
    {
      WAFT_RETURN_IF_FAILED(room.About(name, about));
    }
    if (about && S_ISDIR(about->st_mode))
    {
      stagings.push_back(name);
    }
  }
  return Result::Ok();
}

bool IsSame(const Descriptor& file, const std::string& path)
{
  struct stat own = {}, found = {};
  return ::fstat(file.Get(), &own) == 0 && ::lstat(path.c_str(), &found) == 0 &&
         own.st_dev == found.st_dev && own.st_ino == found.st_ino;
}

bool MayWriteIn(const std::string& folder)
{
  return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

std::string ParentOf(const std::string& name)
{
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

bool IsDigest(const std::string& text)
{
  return text.size() == 71 && text.compare(0, 7, "sha256:") == 0 &&
         text.find_first_not_of("0123456789abcdef", 7) == std::string::npos;
}

Result ParseJson(const std::string& text, const std::string& path, SceneJson& content)
{
  content = SceneJson::parse(
    text,
    [](int depth, SceneJson::parse_event_t event, SceneJson&) { return !IsTooDeep(depth, event); },
    false);
  return content.is_object()
           ? Result::Ok()
           : Result::Error(path + ": expected JSON in UTF-8, an object, found something else");
}

} // namespace

Result CheckResultFolder(const std::string& folder)
{
  std::error_code failure;
  fs::path place = fs::absolute(folder, failure);
  while (!fs::exists(place, failure) && place.has_relative_path())
  {
    if (failure && failure != std::errc::no_such_file_or_directory)
    {
      return Result::Error(folder.substr(0, 200) +
                           ": expected the name of a folder: " + failure.message());
    }
    place = place.parent_path();
  }
  if (!fs::is_directory(place, failure))
  {
    return Result::Error(place.string() + ": expected a folder for the results, found a file");
  }
  return MayWriteIn(place.string())
           ? Result::Ok()
           : Result::Error(place.string() + ": expected a folder that may be written in");
}

Result ManifestOf(const FolderBelow& folder, Manifest& manifest)
{
  std::map<std::string, struct stat> found;
  WAFT_RETURN_IF_FAILED(folder.Everything("", found));
  for (const auto& [name, about] : found)
  {
    if (KindOf(about).empty())
    {
      WAFT_RETURN_IF_FAILED(folder.DigestOf(name, manifest[name]));
    }
  }
  return Result::Ok();
}

SceneJson ManifestRows(const Manifest& manifest)
{
  SceneJson rows = SceneJson::array();
  for (const auto& [name, entry] : manifest)
  {
    rows.push_back({ { "name", name }, { "size", entry.Size }, { "digest", entry.Text } });
  }
  return rows;
}

Result ManifestFrom(const SceneJson& content, const std::string& field, const std::string& path,
                    Manifest& manifest)
{
  const auto rows = content.find(field);
  if (rows == content.end() || !rows->is_array())
  {
    return Result::Error(path + ": /" + field + ": expected a list of files");
  }
  for (std::size_t i = 0; i < rows->size(); ++i)
  {
    const SceneJson& row = (*rows)[i];
    const std::string place = path + ": /" + field + "/" + std::to_string(i);
    const bool isRight =
      row.is_object() && row.size() == 3 && row.contains("name") && row["name"].is_string() &&
      row.contains("size") && row["size"].is_number_unsigned() && row.contains("digest") &&
      row["digest"].is_string() && IsDigest(row["digest"].get_ref<const std::string&>());
    if (!isRight)
    {
      return Result::Error(place + ": expected name, size and digest (sha256: and 64 digits)");
    }
    std::vector<std::string> parts;
    const Result named = PartsOf(row["name"].get<std::string>(), parts);
    if (!named)
    {
      return Result::Error(place + "/name: " + named.Message());
    }
    std::string name;
    for (const std::string& part : parts)
    {
      name += (name.empty() ? "" : "/") + part;
    }
    manifest[name] = { row["size"].get<std::uint64_t>(), row["digest"].get<std::string>() };
  }
  return Result::Ok();
}

Result ManifestIn(const FolderBelow& folder, const std::string& name, Manifest& manifest,
                  bool& isThere)
{
  std::string text;
  SceneJson content;
  isThere = folder.Read(name, text) && ParseJson(text, name, content) &&
            content.find("manifest") != content.end();
  return isThere ? ManifestFrom(content, "manifest", folder.PathOf(name), manifest) : Result::Ok();
}

bool Fits(const FolderBelow& folder, const std::string& name, const FileDigest& entry)
{
  std::optional<struct stat> about;
  FileDigest found;
  return folder.About(name, about) && about && KindOf(*about).empty() &&
         static_cast<std::uint64_t>(about->st_size) == entry.Size && folder.DigestOf(name, found) &&
         found == entry;
}

ResultPlace::ResultPlace(Form form) : Own(std::move(form)) {}

ResultPlace::~ResultPlace()
{
  this->Release();
}

std::string ResultPlace::RoomPath() const
{
  return this->Own.Room.empty() ? this->Own.Root : this->Own.Root + "/" + this->Own.Room;
}

Result ResultPlace::Enter()
{
  bool isBusy = false;
  return this->Hold(isBusy);
}

Result ResultPlace::Hold(bool& isBusy)
{
  WAFT_RETURN_IF_FAILED(CheckResultFolder(this->Own.Root));
  while (!this->IsHeld())
  {
    WAFT_RETURN_IF_FAILED(this->TryToLock(isBusy));
  }
  const Result finished = this->FinishOthers();
  if (!finished)
  {
    this->Release();
  }
  return finished;
}

Result ResultPlace::FinishOthers()
{
  bool isCut = false;
  WAFT_RETURN_IF_FAILED(this->IsCutShort(this->Below, isCut));
  std::vector<std::string> stagings;
  WAFT_RETURN_IF_FAILED(StagingsIn(this->Below, stagings));
  for (const std::string& staging : stagings)
  {
    std::optional<struct stat> about;
    WAFT_RETURN_IF_FAILED(this->Below.About(staging + "/" + Staged, about));
    if (about)
    {
      WAFT_RETURN_IF_FAILED(this->Finish(staging));
    }
    this->Below.RemoveAll(staging);
  }
  return Result::Ok();
}

// The system takes the lock from a process that dies. Does nothing where a run that ended meanwhile
// took lock or folder away.
Result ResultPlace::TryToLock(bool& isBusy)
{
  std::error_code failure;
  std::vector<std::string> missing;
  for (fs::path folder = this->Own.Root; !folder.empty() && !fs::exists(folder, failure);
       folder = folder.parent_path())
  {
    missing.push_back(folder.string());
  }
  this->Made = missing.empty() ? this->Made : missing;
  fs::create_directories(this->Own.Root, failure);
  if (failure)
  {
    return Result::Error(this->Own.Root + ": " + failure.message() + "; expected a folder");
  }
  FolderBelow folder, room;
  const Result opened = folder.Open(this->Own.Root);
  if (!opened && !fs::exists(this->Own.Root, failure))
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(opened);
  if (!this->Own.Room.empty())
  {
    WAFT_RETURN_IF_FAILED(folder.MakeFolder(this->Own.Room));
    WAFT_RETURN_IF_FAILED(room.Open(folder, this->Own.Room));
  }
  else
  {
    WAFT_RETURN_IF_FAILED(room.Open(this->Own.Root));
  }
  Descriptor lock;
  bool isGone = false;
  WAFT_RETURN_IF_FAILED(room.OwnFile(LockName, lock, isGone));
  if (isGone)
  {
    return Result::Ok();
  }
  if (::flock(lock.Get(), LOCK_EX | LOCK_NB) != 0)
  {
    isBusy = errno == EWOULDBLOCK;
    return isBusy ? Result::Error(this->RoomPath() + ": another run of waft is at work there")
                  : Result::Error(this->RoomPath() + ": cannot be locked: " + std::strerror(errno),
                                  ErrorKind::Disk);
  }
  if (IsSame(lock, this->RoomPath() + "/" + LockName))
  {
    this->Whole = std::move(folder);
    this->Below = std::move(room);
    this->Lock = std::move(lock);
  }
  return Result::Ok();
}

void ResultPlace::Release()
{
  if (!this->IsHeld())
  {
    return;
  }
  if (!this->Staging.empty())
  {
    this->Below.RemoveAll(this->Staging);
  }
  this->Staging.clear();
  if (IsSame(this->Lock, this->RoomPath() + "/" + LockName))
  {
    (void)this->Below.Remove(LockName);
  }
  this->Lock.Close();
  this->Whole = FolderBelow();
  this->Below = FolderBelow();
  std::error_code failure; // something is in it
  if (!this->Own.Room.empty())
  {
    fs::remove(this->RoomPath(), failure);
  }
  for (const std::string& folder : this->Made)
  {
    ::rmdir(folder.c_str());
  }
}

Result ResultPlace::IsCutShort(const FolderBelow& room, bool& isCut) const
{
  isCut = false;
  std::optional<struct stat> about;
  for (const char* former : { ".waft-move", ".waft-put" })
  {
    WAFT_RETURN_IF_FAILED(room.About(former, about));
    if (about)
    {
      return Result::Error(
        room.PathOf(former) +
        ": an earlier build of Waft 0.1.0 was cut short while its results changed hands: move the "
        "files of its folder `new` (or, for the results before, `old`) to their places by hand, "
        "then remove it");
    }
  }
  std::vector<std::string> stagings;
  WAFT_RETURN_IF_FAILED(StagingsIn(room, stagings));
  for (const std::string& staging : stagings)
  {
    WAFT_RETURN_IF_FAILED(room.About(staging + "/" + Staged, about));
    isCut = isCut || about;
  }
  return Result::Ok();
}

Result ResultPlace::Look(const std::vector<std::string>& names)
{
  WAFT_RETURN_IF_FAILED(CheckResultFolder(this->Own.Root));
  std::error_code failure;
  if (!fs::is_directory(this->Own.Root, failure))
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(this->Enter());
  const Result checked = this->Check(names);
  this->Release();
  return checked;
}

Result ResultPlace::Settle()
{
  const auto end = std::chrono::steady_clock::now() + Patience;
  while (true)
  {
    std::error_code failure;
    bool isCut = false;
    FolderBelow room;
    if (fs::is_directory(this->RoomPath(), failure))
    {
      WAFT_RETURN_IF_FAILED(room.Open(this->RoomPath()));
      WAFT_RETURN_IF_FAILED(this->IsCutShort(room, isCut));
    }
    if (!isCut)
    {
      return Result::Ok();
    }
    if (!MayWriteIn(this->RoomPath()))
    {
      return Result::Error(this->RoomPath() +
                           ": a change of results was cut short there: it waits for a command of "
                           "waft that may write in the folder");
    }
    bool isBusy = false;
    const Result entered = this->Hold(isBusy);
    this->Release();
    if (entered || !isBusy || std::chrono::steady_clock::now() > end)
    {
      return entered;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

bool ResultPlace::IsOwned(const Manifest& manifest) const
{
  return !this->Own.Owns ||
         std::all_of(manifest.begin(), manifest.end(),
                     [this](const auto& entry) { return this->Own.Owns(entry.first); });
}

// With the seal.
Result ResultPlace::Earlier(Manifest& manifest) const
{
  bool isThere = false;
  WAFT_RETURN_IF_FAILED(ManifestIn(this->Whole, this->Own.Seal, manifest, isThere));
  std::optional<struct stat> about;
  WAFT_RETURN_IF_FAILED(this->Whole.About(this->Own.Seal, about));
  if (!isThere && !about)
  {
    return Result::Ok();
  }
  if (!isThere || !this->IsOwned(manifest))
  {
    return Result::Error(this->Whole.PathOf(this->Own.Seal) + ": " + NotOurs());
  }
  return this->Whole.DigestOf(this->Own.Seal, manifest[this->Own.Seal]);
}

Result ResultPlace::CheckOwn(const std::string& name, const Manifest& manifest) const
{
  std::optional<struct stat> about;
  WAFT_RETURN_IF_FAILED(this->Whole.About(name, about));
  const auto entry = manifest.find(name);
  if (!about || (entry != manifest.end() && Fits(this->Whole, name, entry->second)))
  {
    return Result::Ok();
  }
  const bool isChanged = entry != manifest.end() && KindOf(*about).empty();
  return Result::Error(
    this->Whole.PathOf(name) + ": " +
    (isChanged ? std::string("it was changed since a run wrote it: ") + Stays : NotOurs()));
}

Result ResultPlace::CheckNames(const std::vector<std::string>& names, const Manifest& earlier) const
{
  std::set<std::string> found;
  for (const std::string& name : names)
  {
    std::map<std::string, struct stat> below;
    std::optional<struct stat> about;
    const bool isFolder = !name.empty() && name.back() == '/';
    const Result looked = isFolder ? this->Whole.Everything(name.substr(0, name.size() - 1), below)
                                   : this->Whole.About(name, about);
    if (!looked)
    {
      return Result::Error(this->Whole.PathOf(name) + ": " + NotOurs());
    }
    for (const auto& [inner, own] : below)
    {
      found.insert(inner);
    }
    if (about)
    {
      found.insert(name);
    }
  }
  for (const auto& [name, entry] : earlier)
  {
    found.insert(name);
  }
  for (const std::string& name : found)
  {
    WAFT_RETURN_IF_FAILED(this->CheckOwn(name, earlier));
  }
  return Result::Ok();
}

Result ResultPlace::Check(const std::vector<std::string>& names) const
{
  Manifest earlier;
  WAFT_RETURN_IF_FAILED(this->Earlier(earlier));
  return this->CheckNames(names, earlier);
}

// It goes with the run, also when that dies.
Result ResultPlace::Stage()
{
  while (this->Staging.empty())
  {
    const std::string name = TemporaryName();
    if (::mkdir(this->Below.PathOf(name).c_str(), 0700) == 0)
    {
      this->Staging = name;
    }
    else if (errno != EEXIST)
    {
      return Result::Error(this->Below.PathOf(name) + ": " + std::strerror(errno), ErrorKind::Disk);
    }
  }
  return Result::Ok();
}

Result ResultPlace::StagedPath(const std::string& name, std::string& path)
{
  return this->Apart("new/" + name, path);
}

Result ResultPlace::Apart(const std::string& name, std::string& path)
{
  WAFT_RETURN_IF_FAILED(this->Stage());
  const std::string staged = this->Staging + "/" + name;
  const bool isFile = name.compare(0, 4, "new/") == 0;
  path = this->Below.PathOf(staged);
  return this->Below.MakeFolder(isFile ? ParentOf(staged) : staged);
}

Result ResultPlace::Put(const std::string& name) const
{
  return this->Below.Move(this->Staging + "/" + name, this->Whole, name, false);
}

Result ResultPlace::Commit(SceneJson content)
{
  WAFT_RETURN_IF_FAILED(this->Stage());
  const std::string staging = this->Staging;
  const auto write = [this](const std::string& name, const SceneJson& json)
  {
    return WriteWholeFile(this->Below.PathOf(name),
                          json.dump(2, ' ', true, SceneJson::error_handler_t::replace) + "\n");
  };
  const auto diskError = [](const Result& failed)
  { return Result::Error(failed.Message(), ErrorKind::Disk); };
  FolderBelow made;
  WAFT_RETURN_IF_FAILED(made.Open(this->Below, staging + "/new"));
  Manifest earlier, added;
  WAFT_RETURN_IF_FAILED(ManifestOf(made, added));
  WAFT_RETURN_IF_FAILED(this->Earlier(earlier));
  std::vector<std::string> names;
  for (const auto& [name, entry] : added)
  {
    names.push_back(name);
  }
  const Result checked = this->CheckNames(names, earlier);
  if (!checked)
  {
    return diskError(checked); // it came there while the run was computing
  }
  content["manifest"] = ManifestRows(added);
  WAFT_RETURN_IF_FAILED(write(staging + "/new/" + this->Own.Seal, content));
  WAFT_RETURN_IF_FAILED(made.DigestOf(this->Own.Seal, added[this->Own.Seal]));
  WAFT_RETURN_IF_FAILED(write(staging + "/" + Staged, { { "seal", this->Own.Seal },
                                                        { "new", ManifestRows(added) },
                                                        { "old", ManifestRows(earlier) } }));
  this->Staging.clear(); // from here on it is finished, by whomever
  const Result finished = this->Finish(staging);
  if (!finished)
  {
    return diskError(finished);
  }
  this->Below.RemoveAll(staging);
  return Result::Ok();
}

// Takes a change of results that is staged whole to its end, from wherever it was cut short.
Result ResultPlace::Finish(const std::string& staging) const
{
  const std::string name = staging + "/" + Staged;
  const std::string path = this->Below.PathOf(name);
  std::string text;
  SceneJson change;
  WAFT_RETURN_IF_FAILED(this->Below.Read(name, text));
  WAFT_RETURN_IF_FAILED(ParseJson(text, path, change));
  Manifest added, old;
  WAFT_RETURN_IF_FAILED(ManifestFrom(change, "new", path, added));
  WAFT_RETURN_IF_FAILED(ManifestFrom(change, "old", path, old));
  const auto named = change.find("seal");
  const std::string seal =
    named != change.end() && named->is_string() ? named->get<std::string>() : "";
  if (added.count(seal) == 0 || !this->IsOwned(added) || !this->IsOwned(old))
  {
    return Result::Error(path + ": expected names of these results alone, with that of their seal "
                                "in /new");
  }
  std::map<std::string, std::string> waiting;
  for (const auto& [own, entry] : added)
  {
    const std::string staged = staging + "/new/" + own;
    std::optional<struct stat> about;
    WAFT_RETURN_IF_FAILED(this->Below.About(staged, about));
    if (about)
    {
      waiting[own] = staged;
    }
  }
  if (waiting.count(seal) == 0) // which comes last
  {
    return Result::Ok();
  }
  for (const auto& [own, staged] : waiting)
  {
    if (!Fits(this->Below, staged, added[own]))
    {
      return Result::Error(this->Below.PathOf(staged) +
                           ": expected the file that a run left there for " +
                           this->Whole.PathOf(own) + ", found another: remove " +
                           this->Below.PathOf(staging) + " and do anew what was cut short");
    }
    const Result ours = this->CheckOwn(own, old);
    if (!ours)
    {
      return Result::Error(ours.Message() + "; the results that are to come there wait in " +
                           this->Below.PathOf(staging));
    }
  }
  const auto moveIn = [&](const std::string& own, bool replaces)
  {
    const std::string folder = ParentOf(own);
    WAFT_RETURN_IF_FAILED(folder.empty() ? Result::Ok() : this->Whole.MakeFolder(folder));
    return this->Below.Move(waiting[own], this->Whole, own, replaces);
  };
  WAFT_RETURN_IF_FAILED(this->Whole.Remove(seal));
  for (const auto& [own, staged] : waiting)
  {
    WAFT_RETURN_IF_FAILED(own == seal ? Result::Ok() : moveIn(own, old.count(own) > 0));
  }
  for (const auto& [own, entry] : old)
  {
    if (added.count(own) == 0 && Fits(this->Whole, own, entry))
    {
      WAFT_RETURN_IF_FAILED(this->Whole.Remove(own));
      this->Whole.RemoveEmpty(ParentOf(own));
    }
  }
  return moveIn(seal, false);
}

} // namespace waft
