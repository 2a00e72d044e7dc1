// SPDX-License-Identifier: BSD-3-Clause
// Rows as the constraints of a scene file: single rows, paths and keyframes.
#include "Constraints/Arrivals.h"
#include "Scene/AuthoredParts.h"
#include "Scene/SceneComparison.h"
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

/// What is asked of the pose.
void FormatSides(const Constraint& row, SceneJson& json)
{
  if (!row.Facing.isZero())
  {
    json["facing"]["direction"] = FormatVector(row.Facing);
    json["facing"]["tolerance"] = row.FacingTolerance;
  }
  if (row.Side != FaceUp::Any)
  {
    json["faceUp"] = ToString(row.Side);
  }
}

bool HaveSameSides(const Constraint& a, const Constraint& b)
{
  return a.Facing == b.Facing && a.FacingTolerance == b.FacingTolerance && a.Side == b.Side;
}

/// Frames of a window as ranks. False where there are none that give them.
bool FormatOrder(const FrameWindow& window, const std::vector<int>& frames, SceneJson& json)
{
  for (const TimeSpread spread : { TimeSpread::Even, TimeSpread::EaseIn, TimeSpread::EaseOut })
  {
    std::map<int, int> rankOf; // by frame
    for (std::size_t k = 0; k < frames.size(); ++k)
    {
      rankOf[FrameAt(window, spread, PartOfRank(k, frames.size()))] = static_cast<int>(k);
    }
    SceneJson ranks = SceneJson::array();
    for (const int frame : frames)
    {
      const auto found = rankOf.find(frame);
      if (found != rankOf.end())
      {
        ranks.push_back(found->second);
      }
    }
    if (ranks.size() == frames.size())
    {
      json["order"] = std::move(ranks);
      json["spread"] = ToString(spread);
      return true;
    }
  }
  return false;
}

/// When rows of one entry are met: at one frame, in a window by the air, or one after another in
/// it, as ranks. False where the format has no way to say it.
bool FormatTimes(const std::vector<const Constraint*>& rows, SceneJson& json)
{
  const Constraint& first = *rows.front();
  FrameWindow window{ first.FrameFrom, first.Frame };
  bool areSame = true;
  for (const Constraint* row : rows)
  {
    if (row->FrameFrom != first.FrameFrom || row->IsOpenWindow != first.IsOpenWindow)
    {
      return false;
    }
    areSame = areSame && row->Frame == first.Frame;
    window.To = std::max(window.To, row->Frame);
  }
  if (areSame && !first.IsOpenWindow)
  {
    json["frame"] = first.Frame; // though it was one of a window
    return true;
  }
  if (window.From < 0 || (first.IsOpenWindow && !areSame))
  {
    return false;
  }
  json["frame"]["from"] = window.From;
  json["frame"]["to"] = window.To;
  if (first.IsOpenWindow)
  {
    return true;
  }
  std::vector<int> frames;
  for (const Constraint* row : rows)
  {
    frames.push_back(row->Frame);
  }
  return FormatOrder(window, frames, json);
}

/// How long it is held, and on what.
void FormatStay(const Constraint& row, SceneJson& json)
{
  if (row.On >= 0)
  {
    json["on"] = row.On;
  }
  if (row.Hold > 0)
  {
    json["hold"] = row.Hold;
    if (row.Drifts != 0)
    {
      json["drift"] = true;
    }
    if (row.HoldRadius > 0.0)
    {
      json["holdRadius"] = row.HoldRadius;
    }
  }
}

/// How those of one entry go: at one frame, or in a window as ranks. False where some stay, or go
/// otherwise.
bool FormatLeave(const std::vector<const Constraint*>& rows, SceneJson& json)
{
  const Leaving& first = rows.front()->Goes;
  FrameWindow window{ first.From, first.From };
  std::vector<int> frames;
  for (const Constraint* row : rows)
  {
    Leaving alike = row->Goes;
    alike.From = first.From;
    if (!(alike == first) || (row->Goes.From < 0) != (first.From < 0))
    {
      return false;
    }
    frames.push_back(row->Goes.From);
    window.From = std::min(window.From, row->Goes.From);
    window.To = std::max(window.To, row->Goes.From);
  }
  if (first.From < 0)
  {
    return true;
  }
  json["leave"] = FormatLeaving(first);
  if (window.From < window.To)
  {
    json["leave"]["frame"] = { { "from", window.From }, { "to", window.To } };
    return FormatOrder(window, frames, json["leave"]);
  }
  return true;
}

bool StayAlike(const Constraint& a, const Constraint& b)
{
  return a.Hold == b.Hold && a.Drifts == b.Drifts && a.HoldRadius == b.HoldRadius && a.On == b.On;
}

/// Whether the targets of a keyframe may be rows of this kind.
bool IsOfKeyframe(ConstraintKind kind)
{
  switch (kind)
  {
    case ConstraintKind::Position:
    case ConstraintKind::Rest: // "velocity": "rest"
      return true;
    case ConstraintKind::Velocity: // beside a target
    case ConstraintKind::Acceleration:
    case ConstraintKind::Orientation:
      break;
  }
  return false;
}

} // namespace

/// Rows that belong to one entry of the list: those of a group, else of a number.
std::vector<SceneFormat::Rows> SceneFormat::Entries() const
{
  std::vector<Rows> entries;
  std::map<std::pair<bool, int>, std::size_t> indices;
  for (const Constraint& row : this->In.Constraints)
  {
    const auto [found, isNew] = indices.try_emplace(EntryOf(row), entries.size());
    if (isNew)
    {
      entries.emplace_back();
    }
    entries[found->second].push_back(&row);
  }
  return entries;
}

bool SceneFormat::FormatSimple(const Rows& rows, SceneJson& json) const
{
  const Constraint& row = *rows.front();
  const bool lasts = TraitsOf(row.Kind).Lasts;
  if (rows.size() > 1 || row.Group >= 0 || row.ClassId >= 0 || (lasts && row.Radius > 0.0))
  {
    return false;
  }
  if (row.ObjectId < 0 && !IsPositional(row.Kind))
  {
    throw SceneError{ NameOf(row) + ": a " + ToString(row.Kind) +
                      " of any object (-1), expected the id of one" };
  }
  json["kind"] = ToString(row.Kind);
  json["object"] = row.ObjectId;
  (void)FormatTimes(rows, json);
  if (lasts)
  {
    json["until"] = row.Until;
  }
  json["value"] = IsAttitude(row.Kind)
                    ? FormatRotation(row.Orientation)
                    : FormatVector(row.Value - this->Reader.ReferenceAt(row.On, row.Frame));
  if (row.Radius > 0.0)
  {
    json["radius"] = row.Radius;
  }
  FormatStay(row, json);
  (void)FormatLeave(rows, json);
  FormatSides(row, json);
  return true;
}

bool SceneFormat::FormatPath(const Rows& rows, SceneJson& json) const
{
  const Constraint& first = *rows.front();
  SceneJson points = SceneJson::array();
  for (const Constraint* row : rows)
  {
    if (row->Kind != ConstraintKind::Position || row->Group >= 0 || row->ClassId >= 0 ||
        !row->Facing.isZero() || row->Hold > 0 || row->On >= 0 || row->Goes.From >= 0 ||
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

void SceneFormat::SetTargets(const Rows& targets, SceneJson& json) const
{
  SceneJson points = SceneJson::array();
  SceneJson classes = SceneJson::array();
  bool hasClasses = false;
  for (const Constraint* row : targets)
  {
    points.push_back(FormatVector(row->Value - this->Reader.ReferenceAt(row->On, row->Frame)));
    classes.push_back(row->ClassId < 0 ? std::string()
                                       : this->In.Classes[static_cast<std::size_t>(row->ClassId)]);
    hasClasses = hasClasses || row->ClassId >= 0;
  }
  json["targets"]["points"] = std::move(points);
  if (hasClasses)
  {
    json["targets"]["classes"] = std::move(classes);
  }
}

/// Positions at one frame, each with or each without one and the same velocity.
bool SceneFormat::FormatKeyframe(const Rows& rows, SceneJson& json) const
{
  const Constraint& first = *rows.front();
  Rows targets;
  Rows velocities;
  for (const Constraint* row : rows)
  {
    if (IsOfKeyframe(row->Kind))
    {
      if (row->Kind != first.Kind || row->Radius != first.Radius || !StayAlike(*row, first) ||
          !HaveSameSides(*row, first) ||
          (IsRest(row->Kind) && row->Until != first.Until && row->Until != row->Goes.From))
      {
        return false;
      }
      targets.push_back(row);
      continue;
    }
    const bool follows = !targets.empty() && velocities.size() + 1 == targets.size() &&
                         row->Row == targets.back()->Row && row->Target == targets.back()->Target &&
                         row->ObjectId == targets.back()->ObjectId;
    if (row->Kind != ConstraintKind::Velocity || row->Radius != 0.0 || !follows ||
        row->Frame != targets.back()->Frame || first.Kind != ConstraintKind::Position ||
        (!velocities.empty() && row->Value != velocities.front()->Value))
    {
      return false;
    }
    velocities.push_back(row);
  }
  std::set<int> named;
  std::set<std::pair<int, int>> numbers;
  bool isAssigned = false;
  for (const Constraint* row : targets)
  {
    isAssigned = isAssigned || row->ObjectId >= 0;
    if ((row->ObjectId >= 0 && !named.insert(row->ObjectId).second) ||
        !numbers.emplace(row->Row, row->Target).second)
    {
      return false;
    }
  }
  if (targets.empty() || targets.size() > this->In.Objects.size() ||
      (!velocities.empty() && velocities.size() != targets.size()))
  {
    return false;
  }
  if (!FormatTimes(targets, json) || !FormatLeave(targets, json))
  {
    json = SceneJson::object();
    return false;
  }
  json["kind"] = "keyframe";
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
  if (IsRest(first.Kind))
  {
    json["velocity"] = "rest";
    if (first.Goes.From < 0 || first.Until != first.Goes.From) // else it lies until it goes
    {
      json["until"] = first.Until;
    }
  }
  else if (!velocities.empty())
  {
    json["velocity"] = FormatVector(velocities.front()->Value);
  }
  if (first.Radius > 0.0)
  {
    json["radius"] = first.Radius;
  }
  FormatStay(first, json);
  FormatSides(first, json);
  return true;
}

/// In one entry where the format has one for them, else one by one: this loses nothing where every
/// row says whose it is.
std::vector<SceneJson> SceneFormat::PlainRows(const Rows& rows) const
{
  SceneJson json = SceneJson::object();
  if (this->FormatSimple(rows, json) || this->FormatPath(rows, json) ||
      this->FormatKeyframe(rows, json))
  {
    return { json };
  }
  std::vector<SceneJson> list;
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
    alone.Radius = RadiusOf(alone);
    SceneJson single = SceneJson::object();
    (void)this->FormatSimple({ &alone }, single);
    list.push_back(std::move(single));
  }
  return list;
}

/// Reads an entry; what it gives stays in Written where it gives these rows.
bool SceneFormat::ReadsAsRows(const SceneJson& entry, int index, const Rows& rows)
{
  const auto& read = this->Written.Constraints;
  const std::size_t before = read.size();
  const auto isSame = [](const SceneReader& reader, const Constraint& a, const Constraint& b)
  { return IsSameRow(a, b, !reader.IsChosenLater(a)); };
  bool fits = IsReadable([&] { this->Reader.ReadConstraint(SceneNode(entry, ""), index); }) &&
              read.size() - before == rows.size();
  for (std::size_t i = 0; fits && i < rows.size(); ++i)
  {
    fits = isSame(this->Reader, read[before + i], *rows[i]);
  }
  if (!fits)
  {
    this->Reader.KeepConstraints(before);
  }
  return fits;
}

/// All rows as entries. keepsChoices: also authored keyframes that choose among a few objects,
/// which is seen once all rows are known; isSame: whether they chose as the scene has it.
SceneJson SceneFormat::FormatRows(bool keepsChoices, bool& isSame)
{
  const SceneJson authored = AuthoredList(this->In.Authored.Constraints, "constraints");
  auto& read = this->Written.Constraints;
  this->Reader.KeepConstraints(0);
  SceneJson list = SceneJson::array();
  Rows inOrder;
  for (const Rows& rows : this->Entries())
  {
    const auto row = static_cast<std::size_t>(std::max(rows.front()->Row, 0));
    const std::size_t before = read.size();
    inOrder.insert(inOrder.end(), rows.begin(), rows.end());
    if (row < authored.size() &&
        this->ReadsAsRows(authored[row], static_cast<int>(list.size()), rows))
    {
      if (keepsChoices || !this->Reader.IsChosenLater(read.back()))
      {
        list.push_back(this->AsWritten(authored[row]));
        continue;
      }
      this->Reader.KeepConstraints(before);
    }
    for (const SceneJson& json : this->PlainRows(rows))
    {
      const std::string pointer = "/constraints/" + std::to_string(list.size());
      this->Reader.ReadConstraint(SceneNode(json, pointer), static_cast<int>(list.size()));
      list.push_back(json);
    }
  }
  isSame = IsReadable([&] { this->Reader.AssignChosen(SceneNode(list, "/constraints")); });
  for (std::size_t i = 0; isSame && i < inOrder.size(); ++i)
  {
    isSame = read[i].ObjectId == inOrder[i]->ObjectId;
  }
  return list;
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
  bool isSame = true;
  SceneJson list = this->FormatRows(true, isSame);
  if (!isSame)
  {
    list = this->FormatRows(false, isSame);
  }
  if (!list.empty())
  {
    this->Root["constraints"] = std::move(list);
  }
}

} // namespace waft
