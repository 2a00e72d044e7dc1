// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/DatabaseFile.h"

#include "Store/StateFile.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace waft
{
namespace
{

constexpr StateKind DatabaseKind = { "motion database", 2 };

using ProvenanceRows = std::vector<std::array<std::string, 2>>;

bool AreForceTypesKnown(const MotionDatabase& database)
{
  const auto isKnown = [](ForceType type) { return type <= ForceType::Vortex; };
  return std::all_of(
    database.Segments.begin(), database.Segments.end(),
    [&isKnown](const Segment& segment)
    { return std::all_of(segment.ForceTypes.begin(), segment.ForceTypes.end(), isKnown); });
}

} // namespace

Result WriteDatabase(const std::string& path, const MotionDatabase& database)
{
  StateFileWriter file(path, DatabaseKind);
  ProvenanceRows rows;
  for (const auto& [name, value] : database.Provenance)
  {
    rows.push_back({ name, value });
  }
  file.Values(database, rows);
  return file.Commit();
}

Result ReadDatabase(const std::string& path, MotionDatabase& database)
{
  database = MotionDatabase();
  MotionDatabase read;
  const auto content = [&read](StateArchive& file)
  {
    ProvenanceRows rows;
    file.Values(read, rows);
    for (const auto& [name, value] : rows)
    {
      read.Provenance[name] = value;
    }
    return AreForceTypesKnown(read);
  };
  const StateLack lack = ReadStateFile(path, DatabaseKind, {}, content);
  if (lack != StateLack::None)
  {
    return Result::Error(path + ": expected a motion database that Waft wrote, found that it " +
                         ToString(lack, DatabaseKind));
  }
  if (const Result valid = read.Validate(); !valid)
  {
    return Result::Error(path + ": " + valid.Message());
  }
  database = std::move(read);
  return Result::Ok();
}

} // namespace waft
