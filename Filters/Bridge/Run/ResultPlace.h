// SPDX-License-Identifier: BSD-3-Clause
// Where a run's files go: which of those there an earlier run wrote, one run at a time, all files
// at once.
#pragma once

#include "Base/Result.h"
#include "Bridge/Run/FolderBelow.h"
#include "Scene/SceneNode.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace waft
{

/// What a run wrote, by name.
using Manifest = std::map<std::string, FileDigest>;

/// Of all files below a folder.
Result ManifestOf(const FolderBelow& folder, Manifest& manifest);
/// As it stands in a seal.
SceneJson ManifestRows(const Manifest& manifest);
/// That of a field of a file's JSON; the file's path is for messages.
Result ManifestFrom(const SceneJson& content, const std::string& field, const std::string& path,
                    Manifest& manifest);
/// That in a file of a folder; isThere: whether there is one. Fails where it is malformed.
Result ManifestIn(const FolderBelow& folder, const std::string& name, Manifest& manifest,
                  bool& isThere);
/// Whether a folder has, under a name, what a manifest says.
bool Fits(const FolderBelow& folder, const std::string& name, const FileDigest& entry);

/// Held by one run from Enter to Release. A file is Waft's when a manifest names it and its content
/// is still what the run wrote; everything else is the user's, and is neither replaced nor removed.
/// The manifest is part of one file of the results, their seal, which goes first and comes last
/// when results change hands (Documentation/Developer.md has the order of the steps): where there
/// is no seal the results are not whole, and where a change was cut short it is finished first. The
/// folder may be a stranger's: what seals and staged manifests say is looked at like any input.
class ResultPlace
{
public:
  struct Form
  {
    std::string Root; // the folder that names are relative to
    std::string Seal; // the JSON file that holds the manifest
    /// Name below Root of the folder that has the lock and what is staged; empty: Root itself. It
    /// goes when it is empty.
    std::string Room;
    std::function<bool(const std::string&)> Owns; // whether a name may be one of these; none: all
  };

  explicit ResultPlace(Form form);
  ~ResultPlace();
  ResultPlace(const ResultPlace&) = delete;
  ResultPlace& operator=(const ResultPlace&) = delete;

  static constexpr const char* LockName = ".waft-lock";

  const std::string& Root() const { return this->Own.Root; }
  std::string RoomPath() const;
  /// Fails when another run is at work there.
  Result Enter();
  bool IsHeld() const { return this->Lock.IsOpen(); }
  void Release();
  /// While it is held.
  const FolderBelow& Folder() const { return this->Whole; }
  const FolderBelow& Room() const { return this->Below; }

  /// What Enter and Check would say; makes nothing.
  Result Look(const std::vector<std::string>& names);
  /// Finishes a change that was cut short where results are to be read; one that goes on there is
  /// waited for.
  Result Settle();
  /// Fails where something that no run wrote, or that was changed since, stands in the way of files
  /// of these names (with a slash at their end: of folders of them), or among the earlier results.
  Result Check(const std::vector<std::string>& names) const;

  /// Where to write the file of this name for now; its folder is there.
  Result StagedPath(const std::string& name, std::string& path);
  /// The path of a new folder that is none of the results; Put gives it its place below Root.
  Result Apart(const std::string& name, std::string& path);
  Result Put(const std::string& name) const;
  /// The files at the staged paths take the place of those of the earlier run, all or none.
  /// content: what the seal is to say beside the manifest.
  Result Commit(SceneJson content);

private:
  Result TryToLock(bool& isBusy);
  Result Hold(bool& isBusy);
  Result FinishOthers();
  Result Finish(const std::string& staging) const;
  Result IsCutShort(const FolderBelow& room, bool& isCut) const;
  Result Earlier(Manifest& manifest) const;
  Result CheckOwn(const std::string& name, const Manifest& manifest) const;
  Result CheckNames(const std::vector<std::string>& names, const Manifest& earlier) const;
  Result Stage();
  bool IsOwned(const Manifest& manifest) const;

  Form Own;
  FolderBelow Whole, Below;
  Descriptor Lock;
  std::string Staging;           // the folder of what this run stages
  std::vector<std::string> Made; // folders to remove when they are empty in the end, the innermost
                                 // first
};

/// Fails unless files can be written in a folder, or it can be made; makes nothing.
Result CheckResultFolder(const std::string& folder);

} // namespace waft
