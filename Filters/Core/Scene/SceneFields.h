// SPDX-License-Identifier: BSD-3-Clause
// The fields of a scene file, once: the reader refuses what is not here, and the published schema
// is made from it.
#pragma once

#include "Base/Limits.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace waft
{

/// How many there may be of what a scene lists: as many as a look at the scene (`waft check`) takes
/// 10 s and 1 GB for.
struct SceneLists
{
  static constexpr std::size_t Shapes = 1000;
  static constexpr std::size_t Entries = 10000; ///< Of objects, and of constraints.
  static constexpr std::size_t Objects = 20000; ///< Of all entries together.
  static constexpr std::size_t Rows = 100000;   ///< Of all constraints together.
  static constexpr std::size_t Obstacles = 1000;
  static constexpr std::size_t Keys = 10000;      ///< Of the motion of an obstacle.
  static constexpr std::size_t Places = 10000000; ///< Of all obstacles that move, one a frame each.
  static constexpr std::size_t Winds = 1000;
  static constexpr std::size_t Vortices = 10000;
  static constexpr std::size_t Colors = 100;     ///< Of the classes of a picture.
  static constexpr std::size_t Bytes = 32000000; ///< Of the file.
};

/// What a field holds, or each entry of it where it is a list.
enum class SceneValue
{
  Number,
  Whole,      ///< A whole number.
  Flag,       ///< true or false.
  Name,       ///< A text of one line.
  Lines,      ///< A text to be drawn, which may have line breaks.
  File,       ///< The path of one.
  Font,       ///< The path of one, or the name of a family.
  Word,       ///< One of some words.
  Vector,     ///< Three numbers.
  Quaternion, ///< Four numbers.
  Color,      ///< Three numbers.
  Part,       ///< An object of another kind.
};

/// How many of what it holds stand in a field.
enum class SceneCount
{
  One,
  OneOrList, ///< Or a list of whole numbers in its range.
  List,
  Named, ///< An object of entries by names that are free.
};

/// All that there is to know of a field; the published schema is made from it (SceneSchema.h).
struct SceneField
{
  static constexpr std::size_t NoList = static_cast<std::size_t>(-1);

  SceneField(const char* name, SceneValue holds, std::optional<limits::Range> range = std::nullopt,
             const char* sentence = "") :
    Name(name),
    Holds(holds), Range(range), Sentence(sentence)
  {
  }
  SceneField(const char* name, SceneValue holds, const char* sentence) :
    SceneField(name, holds, std::nullopt, sentence)
  {
  }

  /// What follows changes a field and gives it back, so that a table reads as a list.
  SceneField& Required();
  SceneField& Or(const char* json); ///< Its default.
  /// The kind of object that it holds, or of a number or a word the one that may stand in its
  /// place.
  SceneField& Of(const char* part);
  /// Of a word: which there are; of a file: endings; of a vector: words that may stand in its
  /// place.
  SceneField& Among(std::vector<std::string> words);
  SceneField& Letters(std::size_t most); ///< From one to so many.
  SceneField& List(std::size_t most, std::size_t fewest = 0);
  SceneField& OrList(std::size_t most);
  SceneField& Named(std::size_t most);

  std::string Name;
  SceneValue Holds;
  /// Of its number, or of every number in it; none of a text or an object.
  std::optional<limits::Range> Range;
  std::string Sentence; ///< Unit, meaning, and what holds without it where that is no value.
  std::string Default;  ///< JSON; empty where there is none.
  std::string Part;
  std::vector<std::string> Words;
  bool IsRequired = false;
  SceneCount Count = SceneCount::One;
  std::size_t Most = NoList; ///< Of the entries in it, where it has entries.
  std::size_t Fewest = 0;
  std::size_t MostLetters = NoList;
};

/// The fields that one kind of JSON object may have. Name is the schema's definition of that kind
/// ("scene" is its root).
struct SceneFieldTable
{
  /// Null where the kind has no such field.
  const SceneField* Find(const std::string& field) const;

  std::string Name;
  std::vector<SceneField> Fields;
  std::string Sentence = {};
};

const std::vector<SceneFieldTable>& SceneFieldTables();

/// The table of a name; an empty one when there is none.
const SceneFieldTable& SceneFieldsOf(const std::string& name);

} // namespace waft
