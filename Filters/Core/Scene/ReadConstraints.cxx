// SPDX-License-Identifier: BSD-3-Clause
// Constraints of a scene file: each becomes rows of one object at one frame.
#include "Constraints/Keyframes.h"
#include "Scene/SceneReader.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace waft
{

int SceneReader::ObjectId(const SceneNode& node, int lowest) const
{
  // Ids that are not the indices in the list leave gaps.
  const int last = this->IndexOfObject.empty() ? -1 : this->IndexOfObject.rbegin()->first;
  const char* what = lowest < 0 ? "the id of an object or -1 for any" : "the id of an object";
  const int id = static_cast<int>(node.Integer(lowest, last, what));
  if (id >= 0 && this->IndexOfObject.count(id) == 0)
  {
    node.Fail(what);
  }
  return id;
}

const MotionObject& SceneReader::Object(int id) const
{
  return this->Out.Objects[this->IndexOfObject.at(id)];
}

void SceneReader::ReadConstraints(const SceneNode& node)
{
  const std::size_t rows = node.Size("a list of constraints");
  for (std::size_t row = 0; row < rows; ++row)
  {
    const SceneNode item = node.Item(row);
    const std::size_t before = this->Out.Constraints.size();
    this->ReadConstraint(item, static_cast<int>(row));
    for (std::size_t i = before; i < this->Out.Constraints.size(); ++i)
    {
      Constraint& read = this->Out.Constraints[i];
      read.Release = read.ObjectId >= 0 ? this->Object(read.ObjectId).Release : -1;
    }
    if (this->Out.Constraints.size() > SceneLists::Rows)
    {
      item.FailWith("expected constraints of at most " + std::to_string(SceneLists::Rows) +
                    " points and targets in all, found more");
    }
  }
  this->AssignChosen(node);
  SetHolds(this->Out.Info.Time.NumberOfFrames - 1, this->Out.Constraints);
}

void SceneReader::KeepConstraints(std::size_t count)
{
  while (this->Out.Constraints.size() > count)
  {
    this->Choices.erase(this->Out.Constraints.back().Group);
    this->Out.Constraints.pop_back();
  }
}

void SceneReader::ReadConstraint(const SceneNode& node, int index)
{
  std::string expected;
  for (int k = 0; k < NumberOfConstraintKinds; ++k)
  {
    expected += ToString(static_cast<ConstraintKind>(k)) + std::string(", ");
  }
  expected += "path or keyframe";
  const SceneNode kindNode = node.At("kind", expected);
  const std::string kind = kindNode.Text();
  if (kind == "path")
  {
    this->ReadPath(node, index);
    return;
  }
  if (kind == "keyframe")
  {
    this->ReadKeyframe(node, index);
    return;
  }
  const ConstraintTraits* simple = FindConstraintKind(kind);
  if (simple == nullptr)
  {
    kindNode.Fail(expected);
  }
  node.CheckFields(kind + "Constraint");
  Constraint constraint;
  constraint.Row = index;
  constraint.Kind = simple->Kind;
  constraint.ObjectId =
    this->ObjectId(node.At("object", "the id of an object"), simple->IsPositional ? -1 : 0);
  if (IsAttitude(simple->Kind))
  {
    constraint.Orientation = node.At("value", "a quaternion [w, x, y, z]").Rotation();
  }
  else
  {
    constraint.Value = node.At("value", "a vector [x, y, z]").Vector();
  }
  node.Take("radius", constraint.Radius);
  RowTimes times;
  if (simple->IsPositional)
  {
    times = this->ReadTimes(node, { Target{ constraint.Value } }, index);
  }
  else
  {
    times.Window.To = this->Frame(node.At("frame", "a frame of the scene"));
  }
  times.Set(0, constraint);
  if (simple->IsPositional)
  {
    constraint.On = this->ReadOn(node);
    constraint.Value += this->ReferenceAt(constraint.On, constraint.Frame);
  }
  this->ReadHold(node, constraint);
  if (simple->Lasts)
  {
    constraint.Until = this->ReadUntil(node, times);
  }
  ReadSides(node, constraint);
  this->Out.Constraints.push_back(constraint);
  if (simple->IsPositional)
  {
    this->ReadLeave(node, { Target{ constraint.Value } }, index, this->Out.Constraints.size() - 1);
  }
}

void SceneReader::ReadSides(const SceneNode& node, Constraint& constraint)
{
  if (node.Has("facing"))
  {
    const SceneNode facing = node.At("facing", "");
    if (constraint.Kind != ConstraintKind::Position)
    {
      facing.FailWith(
        "expected `facing` only where objects do not rest: `faceUp` says how they lie");
    }
    facing.CheckFields("facing");
    const SceneNode direction = facing.At("direction", "a direction [x, y, z]");
    const double length = direction.Vector().norm();
    if (!(length > 1e-12))
    {
      direction.Fail("a direction that is not zero");
    }
    constraint.Facing = direction.Vector() / length;
    facing.Take("tolerance", constraint.FacingTolerance);
  }
  if (node.Has("faceUp"))
  {
    const SceneNode side = node.At("faceUp", "");
    if (!IsRest(constraint.Kind))
    {
      side.FailWith("expected `faceUp` only with \"velocity\": \"rest\"");
    }
    const FaceUp* found = FindFaceUp(side.Text());
    if (found == nullptr)
    {
      side.Fail("any, up or down");
    }
    constraint.Side = *found;
  }
}

void SceneReader::ReadHold(const SceneNode& node, Constraint& constraint) const
{
  bool drifts = false;
  node.Take("drift", drifts);
  if (node.Take("holdRadius", constraint.HoldRadius) && !drifts)
  {
    node.At("holdRadius", "").FailWith("expected `holdRadius` only with `drift`");
  }
  if (node.Has("hold"))
  {
    constraint.Hold = static_cast<int>(
      node.At("hold", "")
        .Integer(0, this->Out.Info.Time.NumberOfFrames - 1, "a number of frames of the scene"));
  }
  constraint.Drifts = drifts ? 1 : 0;
  if (drifts && (constraint.Hold == 0 || node.Has("on")))
  {
    node.At("drift", "")
      .FailWith(
        "expected `drift` only with `hold`, and not `on` an obstacle, which takes it along");
  }
  if (constraint.Hold > 0 && IsRest(constraint.Kind))
  {
    node.At("hold", "")
      .FailWith("expected `hold` only where objects do not rest: `until` says how long they lie");
  }
  if (constraint.Hold > 0 && constraint.Radius > 0.0)
  {
    node.At("hold", "").FailWith("expected `hold` only with radius 0: who is held is at its place");
  }
}

int SceneReader::ReadUntil(const SceneNode& node, const RowTimes& times) const
{
  const int last = this->Out.Info.Time.NumberOfFrames - 1;
  if (!node.Has("until"))
  {
    return last;
  }
  const int second =
    times.IsWindow ? static_cast<int>(std::lround(this->Out.Info.Time.FramesPerSecond)) : 0;
  return static_cast<int>(node.At("until", "")
                            .Integer(times.Window.To + second, last,
                                     second > 0
                                       ? "a frame at least one second after the last arrival"
                                       : "a frame not before `frame`"));
}

void SceneReader::ReadPath(const SceneNode& node, int row)
{
  node.CheckFields("pathConstraint");
  Constraint constraint;
  constraint.Row = row;
  constraint.ObjectId = this->ObjectId(node.At("object", "the id of an object"), 0);
  const int first = this->Frame(node.At("firstFrame", "a frame of the scene"));
  node.Take("radius", constraint.Radius);
  const SceneNode points = node.At("points", "a list of points, one a frame");
  const std::size_t count = points.Size("a list of points, one a frame");
  const int room = this->Out.Info.Time.NumberOfFrames - first;
  if (count == 0 || count > static_cast<std::size_t>(room))
  {
    points.FailWith("expected 1 to " + std::to_string(room) + " points, one a frame from frame " +
                    std::to_string(first) + " to the last, found " + std::to_string(count));
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    constraint.Frame = first + static_cast<int>(i);
    constraint.Until = constraint.Frame;
    constraint.Value = points.Item(i).Vector();
    this->Out.Constraints.push_back(constraint);
  }
}

std::vector<int> SceneReader::ObjectIds(const SceneNode& node, bool mayBeAny) const
{
  std::vector<int> ids;
  for (const MotionObject& object : this->Out.Objects)
  {
    ids.push_back(object.ObjectId);
  }
  if (node.Has("objects"))
  {
    ids.clear();
    const SceneNode list = node.At("objects", "");
    const std::size_t count = list.Size("a list of ids of objects");
    std::set<int> seen;
    for (std::size_t i = 0; i < count; ++i)
    {
      const int id = this->ObjectId(list.Item(i), mayBeAny ? -1 : 0);
      if (id >= 0 && !seen.insert(id).second)
      {
        list.Item(i).Fail("an id that is not in the list already");
      }
      ids.push_back(id);
    }
  }
  return ids;
}

void SceneReader::AssignChosen(const SceneNode& node)
{
  if (this->Choices.empty())
  {
    return;
  }
  std::vector<Constraint> assigned = this->Out.Constraints;
  AssignKeyframes(this->Out.Objects, assigned, this->Choices);
  for (std::size_t i = 0; i < assigned.size(); ++i)
  {
    Constraint& row = this->Out.Constraints[i];
    if (this->Choices.count(row.Group) == 0)
    {
      continue;
    }
    row.ObjectId = assigned[i].ObjectId;
    row.Release = assigned[i].Release;
    row.Choice = assigned[i].Choice;
    if (row.ObjectId < 0)
    {
      node.Item(static_cast<std::size_t>(row.Row))
        .FailWith("expected enough objects of class \"" +
                  Shortened(this->Out.Classes[row.ClassId]) + "\" in `objects`, found too few");
    }
  }
}

void SceneReader::ReadKeyframe(const SceneNode& node, int row)
{
  node.CheckFields("keyframeConstraint");
  Constraint constraint;
  constraint.Row = row;
  constraint.Group = row;
  node.Take("radius", constraint.Radius);
  bool rests = false;
  std::optional<Vec3> velocity;
  if (node.Has("velocity"))
  {
    const SceneNode v = node.At("velocity", "");
    rests = v.IsString() && v.Text() == "rest";
    const bool isNone = v.IsString() && v.Text() == "none";
    if (!rests && !isNone && !v.IsArray())
    {
      v.Fail("a vector [x, y, z], \"rest\" or \"none\"");
    }
    if (v.IsArray())
    {
      velocity = v.Vector();
    }
  }
  if (rests)
  {
    constraint.Kind = ConstraintKind::Rest;
  }
  else if (node.Has("until"))
  {
    node.At("until", "").FailWith("expected `until` only with \"velocity\": \"rest\"");
  }
  ReadSides(node, constraint);
  this->ReadHold(node, constraint);
  if (constraint.Hold > 0 && velocity)
  {
    node.At("velocity", "").FailWith("expected no velocity with `hold`, which is still");
  }
  bool inOrder = false;
  if (node.Has("assign"))
  {
    const SceneNode assign = node.At("assign", "");
    inOrder = assign.Text() == "inOrder";
    if (!inOrder && assign.Text() != "optimal")
    {
      assign.Fail("optimal or inOrder");
    }
  }
  // In order, -1 leaves a target to any of the objects that the list does not name.
  const std::vector<int> ids = this->ObjectIds(node, inOrder);
  const SceneNode targetsNode = node.At("targets", "targets");
  const std::vector<Target> targets = this->ReadTargets(targetsNode, row, ids.size());
  if (targets.size() > ids.size())
  {
    targetsNode.FailWith("expected at most " + std::to_string(ids.size()) +
                         " targets (the number of objects), found " +
                         std::to_string(targets.size()));
  }
  const RowTimes times = this->ReadTimes(node, targets, row);
  constraint.On = this->ReadOn(node);
  const int until = rests ? this->ReadUntil(node, times) : 0;
  const std::size_t first = this->Out.Constraints.size();
  std::vector<int> assigned(targets.size(), -1);
  if (inOrder)
  {
    std::copy_n(ids.begin(), targets.size(), assigned.begin());
  }
  else if (node.Has("objects") && ids.size() < this->Out.Objects.size())
  {
    this->Choices[row] = ids;
  }
  for (std::size_t t = 0; t < targets.size(); ++t)
  {
    constraint.Target = static_cast<int>(t);
    constraint.ObjectId = assigned[t];
    constraint.ClassId = targets[t].ClassId;
    constraint.Value = targets[t].Position;
    times.Set(t, constraint);
    constraint.Value += this->ReferenceAt(constraint.On, constraint.Frame);
    constraint.Until = rests ? until : constraint.Frame;
    this->Out.Constraints.push_back(constraint);
    if (velocity)
    {
      Constraint moving = constraint;
      moving.Kind = ConstraintKind::Velocity;
      moving.Value = *velocity;
      moving.On = -1;
      moving.Radius = 0.0;
      moving.Facing = Vec3::Zero();
      this->Out.Constraints.push_back(moving);
    }
  }
  this->ReadLeave(node, targets, row, first);
}

} // namespace waft
