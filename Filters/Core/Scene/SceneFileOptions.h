// SPDX-License-Identifier: BSD-3-Clause
// The scene files that a user names.
#pragma once

#include "Base/OptionFields.h"

#include <string>

namespace waft
{

struct SceneReadOptions
{
  std::string FileName;
  bool OnEveryRank = false;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField("FileName", "The scene file. Setting it reads the file anew."), of.FileName...);
    visit(
      FlagField("OnEveryRank",
                "Every MPI process gives the whole scene, not the first alone: for scripts that "
                "each process runs by itself."),
      of.OnEveryRank...);
  }
};

struct SceneWriteOptions
{
  std::string FileName;
  std::string Title;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField("FileName",
                    "The file to write, ending in .waft.json; nothing is written without one."),
          of.FileName...);
    visit(TextField("Title", "The scene's title."), of.Title...);
  }
};

/// Of a scene that was gathered before.
struct SceneSaveOptions
{
  std::string FileName;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField("FileName", "The file to write."), of.FileName...);
  }
};

} // namespace waft
