// SPDX-License-Identifier: BSD-3-Clause
// Rows as the constraints of a scene file: single rows, paths and keyframes.
#include "Scene/SceneFormat.h"

#include <algorithm>
#include <map>
#include <set>

namespace waft
{

namespace
{

std::string NameOf(const Constraint& row)
{
  return "Constraints: row " + std::to_string(row.Row) + ", target " + std::to_string(row.Target);
}

} // namespace

/// Rows that belong to one entry of the list: those of a group, else of a number.
std::vector<std::vector<const Constraint*>> SceneFormat::Entries() const
{
  std::vector<std::vector<const Constraint*>> entries;
  std::map<std::pair<bool, int>, std::size_t> places;
  for (const Constraint& row : this->In.Constraints)
  {
    const std::pair<bool, int> key(row.Group >= 0, row.Group >= 0 ? row.Group : row.Row);
    const auto [found, isNew] = places.try_emplace(key, entries.size());
    if (isNew)
    {
      entries.emplace_back();
    }
    entries[found->second].push_back(&row);
  }
  return entries;
}

bool SceneFormat::FormatSimple(const std::vector<const Constraint*>& rows, SceneJson& json) const
{
  const Constraint& row = *rows.front();
  const bool lasts = TraitsOf(row.Kind).Lasts;
  if (rows.size() > 1 || row.Group >= 0 || row.ClassId >= 0 || (lasts && row.Radius > 0.0))
  {
    return false;
  }
  if (row.ObjectId < 0 && !IsPlace(row.Kind))
  {
    throw SceneError{ NameOf(row) + ": a " + ToString(row.Kind) +
                      " of any object (-1), expected the id of one" };
  }
  json["kind"] = ToString(row.Kind);
  json["object"] = row.ObjectId;
  json["frame"] = row.Frame;
  if (lasts)
  {
    json["until"] = row.Until;
  }
  json["value"] = IsAttitude(row.Kind) ? FormatRotation(row.Orientation) : FormatVector(row.Value);
  if (row.Radius > 0.0)
  {
    json["radius"] = row.Radius;
  }
  return true;
}

bool SceneFormat::FormatPath(const std::vector<const Constraint*>& rows, SceneJson& json) const
{
  const Constraint& first = *rows.front();
  SceneJson points = SceneJson::array();
  for (const Constraint* row : rows)
  {
    if (row->Kind != ConstraintKind::Position || row->Group >= 0 || row->ClassId >= 0 ||
        row->ObjectId < 0 || row->ObjectId != first.ObjectId || row->Target != first.Target ||
        row->Radius != first.Radius || row->Frame != first.Frame + static_cast<int>(points.size()))
    {
      return false;
    }
    points.push_back(FormatVector(row->Value));
  }
  json["kind"] = "path";
  json["object"] = first.ObjectId;
  json["firstFrame"] = first.Frame;
  json["points"] = std::move(points);
  if (first.Radius > 0.0)
  {
    json["radius"] = first.Radius;
  }
  return true;
}

void SceneFormat::SetTargets(const std::vector<const Constraint*>& targets, SceneJson& json) const
{
  SceneJson points = SceneJson::array();
  SceneJson classes = SceneJson::array();
  bool hasClasses = false;
  for (const Constraint* row : targets)
  {
    points.push_back(FormatVector(row->Value));
    const auto known = this->Classes.find(row->ClassId);
    if (row->ClassId >= 0 && known == this->Classes.end())
    {
      throw SceneError{ NameOf(*row) + ": `ClassId`: expected the class of an object, found " +
                        std::to_string(row->ClassId) };
    }
    classes.push_back(row->ClassId < 0 ? std::string() : known->second);
    hasClasses = hasClasses || row->ClassId >= 0;
  }
  json["targets"]["points"] = std::move(points);
  if (hasClasses)
  {
    json["targets"]["classes"] = std::move(classes);
  }
}

/// Places at one frame, each with or each without one and the same velocity.
bool SceneFormat::FormatKeyframe(const std::vector<const Constraint*>& rows, SceneJson& json) const
{
  const Constraint& first = *rows.front();
  std::vector<const Constraint*> targets;
  std::vector<const Constraint*> velocities;
  for (const Constraint* row : rows)
  {
    if (IsPlace(row->Kind))
    {
      if (row->Kind != first.Kind || row->Frame != first.Frame || row->Radius != first.Radius ||
          (row->Kind == ConstraintKind::Rest && row->Until != first.Until))
      {
        return false;
      }
      targets.push_back(row);
      continue;
    }
    const bool follows = !targets.empty() && velocities.size() + 1 == targets.size() &&
                         row->Row == targets.back()->Row && row->Target == targets.back()->Target &&
                         row->ObjectId == targets.back()->ObjectId;
    if (row->Kind != ConstraintKind::Velocity || row->Frame != first.Frame || row->Radius != 0.0 ||
        !follows || first.Kind != ConstraintKind::Position ||
        (!velocities.empty() && row->Value != velocities.front()->Value))
    {
      return false;
    }
    velocities.push_back(row);
  }
  std::set<int> named;
  std::set<std::pair<int, int>> places;
  bool isAssigned = false;
  for (const Constraint* row : targets)
  {
    isAssigned = isAssigned || row->ObjectId >= 0;
    if ((row->ObjectId >= 0 && !named.insert(row->ObjectId).second) ||
        !places.emplace(row->Row, row->Target).second)
    {
      return false;
    }
  }
  if (targets.empty() || targets.size() > this->In.Objects.size() ||
      (!velocities.empty() && velocities.size() != targets.size()))
  {
    return false;
  }
  json["kind"] = "keyframe";
  json["frame"] = first.Frame;
  this->SetTargets(targets, json);
  if (isAssigned)
  {
    SceneJson objects = SceneJson::array();
    for (const Constraint* row : targets)
    {
      objects.push_back(row->ObjectId);
    }
    json["objects"] = std::move(objects);
    json["assign"] = "inOrder";
  }
  if (first.Kind == ConstraintKind::Rest)
  {
    json["velocity"] = "rest";
    json["until"] = first.Until;
  }
  else if (!velocities.empty())
  {
    json["velocity"] = FormatVector(velocities.front()->Value);
  }
  if (first.Radius > 0.0)
  {
    json["radius"] = first.Radius;
  }
  return true;
}

void SceneFormat::WriteConstraints()
{
  std::set<int> ids;
  for (const MotionObject& object : this->In.Objects)
  {
    ids.insert(object.ObjectId);
  }
  for (const Constraint& row : this->In.Constraints)
  {
    if (row.ObjectId >= 0 && ids.count(row.ObjectId) == 0)
    {
      throw SceneError{ NameOf(row) + ": `ObjectId`: expected the id of an object, found " +
                        std::to_string(row.ObjectId) };
    }
  }
  SceneJson list = SceneJson::array();
  for (const std::vector<const Constraint*>& rows : this->Entries())
  {
    SceneJson json = SceneJson::object();
    if (this->FormatSimple(rows, json) || this->FormatPath(rows, json) ||
        this->FormatKeyframe(rows, json))
    {
      list.push_back(std::move(json));
      continue;
    }
    // One by one: this loses nothing where every row says whose it is.
    for (const Constraint* row : rows)
    {
      if (row->ObjectId < 0)
      {
        throw SceneError{ NameOf(*row) + ": " + std::to_string(rows.size()) +
                          " rows belong together, some to any object (-1): expected at most as "
                          "many targets as there are objects (" +
                          std::to_string(this->In.Objects.size()) +
                          "), of one kind, frame and Radius" };
      }
      Constraint alone = *row;
      alone.Group = alone.ClassId = -1;
      alone.Radius = alone.Kind == ConstraintKind::Rest ? 0.0 : alone.Radius;
      SceneJson single = SceneJson::object();
      (void)this->FormatSimple({ &alone }, single);
      list.push_back(std::move(single));
    }
  }
  if (!list.empty())
  {
    this->Root["constraints"] = std::move(list);
  }
}

} // namespace waft
