// SPDX-License-Identifier: BSD-3-Clause
// Shapes and objects as a scene file has them.
#include "Base/ShapeMeasures.h"
#include "Scene/AuthoredParts.h"
#include "Scene/SceneComparison.h"
#include "Scene/SceneFormat.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace waft
{

namespace
{

void Require(bool holds, const std::string& message)
{
  if (!holds)
  {
    throw SceneError{ message };
  }
}

/// A text of an entry; an empty one where it has none.
std::string TextOf(const SceneJson& entry, const char* field)
{
  const auto found = entry.is_object() ? entry.find(field) : entry.end();
  return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The entry of a shape in its part of the file, by whatever name it stands there.
SceneJson AuthoredShape(const Shape& shape)
{
  const SceneJson part = AuthoredPart(shape.Authored);
  const auto shapes = part.find("shapes");
  return shapes != part.end() && shapes->is_object() && shapes->size() == 1 ? *shapes->begin()
                                                                            : SceneJson::object();
}

/// Entries of objects by the first id that each gives.
std::map<int, SceneJson> ByFirstId(const SceneJson& list)
{
  std::map<int, SceneJson> entries;
  const auto number = [](const SceneJson& entry, const char* field, double fallback)
  {
    const auto found = entry.find(field);
    return found != entry.end() && found->is_number() ? found->get<double>() : fallback;
  };
  double next = 0.0;
  for (const SceneJson& entry : list)
  {
    if (!entry.is_object())
    {
      continue;
    }
    const double id = number(entry, "id", next);
    if (limits::Id.Holds(id))
    {
      entries.emplace(static_cast<int>(id), entry);
    }
    next += entry.contains("positions") ? static_cast<double>(entry["positions"].size())
                                        : number(entry, "count", 1.0);
  }
  return entries;
}

} // namespace

/// Numbers the classes as the reader will meet them, and gives them their authored names.
void SceneFormat::NameClasses()
{
  std::map<int, int> numbers;
  std::set<std::string> taken;
  std::vector<std::string> names;
  const auto meet = [&](int& classId, const SceneJson& entry)
  {
    if (classId < 0)
    {
      return;
    }
    const auto [found, isNew] = numbers.try_emplace(classId, static_cast<int>(names.size()));
    if (isNew)
    {
      const auto index = static_cast<std::size_t>(classId);
      const std::string authored = TextOf(entry, "class");
      const std::string wanted = !authored.empty() ? authored
                                 : index < this->In.Classes.size()
                                   ? this->In.Classes[index]
                                   : "class " + std::to_string(classId);
      RequireName(wanted, "Classes");
      std::string name = wanted;
      for (int k = 2; !taken.insert(name).second; ++k)
      {
        name = wanted + " " + std::to_string(k);
      }
      names.push_back(name);
    }
    classId = found->second;
  };
  for (Shape& shape : this->In.Shapes)
  {
    meet(shape.ClassId, AuthoredShape(shape));
  }
  const std::map<int, SceneJson> entries =
    ByFirstId(AuthoredList(this->In.Authored.Objects, "objects"));
  for (MotionObject& object : this->In.Objects)
  {
    const auto behind = entries.upper_bound(object.ObjectId);
    meet(object.ClassId, behind == entries.begin() ? SceneJson() : std::prev(behind)->second);
  }
  for (Constraint& row : this->In.Constraints)
  {
    const auto known = numbers.find(row.ClassId);
    if (row.ClassId >= 0 && known == numbers.end())
    {
      throw SceneError{ "Constraints: row " + std::to_string(row.Row) + ", target " +
                        std::to_string(row.Target) +
                        ": `ClassId`: expected the class of an object, found " +
                        std::to_string(row.ClassId) };
    }
    row.ClassId = row.ClassId < 0 ? row.ClassId : known->second;
  }
  this->In.Classes = std::move(names);
}

bool SceneFormat::ReadsAsShape(const SceneJson& entry, Shape& read)
{
  const bool isRead = IsReadable([&] { this->Reader.ReadShape(SceneNode(entry, ""), "authored"); });
  if (isRead)
  {
    read = std::move(this->Written.Shapes.back());
    this->Written.Shapes.pop_back();
  }
  return isRead;
}

SceneJson SceneFormat::FormatShape(std::size_t index)
{
  const Shape& shape = this->In.Shapes[index];
  const std::string owner = "Shapes: block " + shape.Name;
  const SceneJson authored = AuthoredShape(shape);
  Shape read;
  if (this->ReadsAsShape(authored, read) && IsSameShape(read, shape))
  {
    return this->AsWritten(authored);
  }
  SceneJson body = SceneJson::object(); // the authored words about the surface alone
  for (const char* field : { "builtin", "mesh", "size", "align" })
  {
    if (authored.contains(field))
    {
      body[field] = authored[field];
    }
  }
  SceneJson json = SceneJson::object();
  Shape plain; // what the reader takes where the file is silent
  if (this->ReadsAsShape(body, read) && IsSameBody(read, shape))
  {
    json = this->AsWritten(body);
    plain = std::move(read);
  }
  else
  {
    const std::string file = this->SideFile("shape-" + this->ShapeNames[index], ".vtp");
    this->Out.Meshes.push_back({ file, true, index });
    json["mesh"] = file;
    json["align"] = false;
  }
  if (!shape.Texture.empty())
  {
    json["texture"] = this->ExistingFile(shape.Texture, owner + ": `Texture`");
  }
  else if (!shape.Skin.empty())
  {
    const std::string file = this->SideFile("shape-" + this->ShapeNames[index], ".png");
    this->Out.Skins.push_back({ file, index });
    json["texture"] = file;
  }
  const auto number = [&](const char* field, const char* array, double value, double fallback)
  {
    Require(value > 0.0 && std::isfinite(value),
            owner + ": `" + array + "`: expected more than 0, found " + std::to_string(value));
    if (value != fallback)
    {
      json[field] = value;
    }
  };
  number("areaDensity", "AreaDensity", shape.AreaDensity, plain.AreaDensity);
  number("thickness", "Thickness", shape.Thickness, plain.Thickness);
  number("dragCoefficient", "DragCoefficient", shape.DragCoefficient, plain.DragCoefficient);
  number("settlingSpeed", "SettlingSpeed", shape.SettlingSpeed, plain.SettlingSpeed);
  // The one that is seen: with a texture its tint, else the colour.
  const std::array<double, 3>& seen = shape.HasPicture() ? shape.Tint : shape.Color;
  if (seen != (shape.HasPicture() ? plain.Tint : plain.Color))
  {
    const Vec3 color(seen[0], seen[1], seen[2]);
    Require(color.minCoeff() >= 0.0 && color.maxCoeff() <= 1.0,
            owner + ": `Color`: expected numbers from 0 to 1");
    json["color"] = FormatVector(color);
  }
  if (shape.ClassId >= 0)
  {
    json["class"] = this->In.Classes[static_cast<std::size_t>(shape.ClassId)];
  }
  return json;
}

void SceneFormat::WriteShapes()
{
  std::set<std::string> taken;
  for (const Shape& shape : this->In.Shapes)
  {
    // A name that begins with _ would be a comment.
    const std::string wanted =
      shape.Name.empty() || shape.Name.front() == '_' ? "shape" + shape.Name : shape.Name;
    RequireName(wanted, "Shapes: block " + wanted);
    std::string name = wanted;
    for (int k = 2; !taken.insert(name).second; ++k)
    {
      name = wanted + " " + std::to_string(k);
    }
    this->ShapeNames.push_back(name);
  }
  SceneJson shapes = SceneJson::object();
  for (std::size_t i = 0; i < this->In.Shapes.size(); ++i)
  {
    shapes[this->ShapeNames[i]] = this->FormatShape(i);
    this->Written.Shapes.push_back(this->In.Shapes[i]);
    this->Written.Shapes.back().Name = this->ShapeNames[i];
  }
  if (!shapes.empty())
  {
    this->Root["shapes"] = shapes;
  }
}

SceneJson SceneFormat::FormatObject(const MotionObject& object) const
{
  const std::string owner = "Objects: object " + std::to_string(object.ObjectId);
  Require(object.ShapeId >= 0 && static_cast<std::size_t>(object.ShapeId) < this->In.Shapes.size(),
          owner + ": `ShapeId`: expected a block of Shapes, 0 to " +
            std::to_string(static_cast<int>(this->In.Shapes.size()) - 1) + ", found " +
            std::to_string(object.ShapeId));
  Require(object.ObjectId >= 0 && object.ObjectId <= 1000000000,
          owner + ": `ObjectId`: expected 0 to 1000000000");
  Require(object.Mass > 0.0, owner + ": `Mass`: expected more than 0");
  Require(object.SettlingSpeed >= 0.0 && object.ClearanceRadius >= 0.0 && object.RestHeight >= 0.0,
          owner + ": expected a SettlingSpeed, ClearanceRadius and RestHeight of 0 or more");
  const auto index = static_cast<std::size_t>(object.ShapeId);
  const Shape& shape = this->In.Shapes[index];
  SceneJson json = SceneJson::object();
  json["shape"] = this->ShapeNames[index];
  const auto vector = [&](const char* field, const Vec3& value)
  {
    if (value != Vec3::Zero())
    {
      json[field] = FormatVector(value);
    }
  };
  const auto number = [&](const char* field, double value, double fallback)
  {
    if (value != fallback)
    {
      json[field] = value;
    }
  };
  if (object.VelocityGiven != 0)
  {
    json["velocity"] = FormatVector(object.Velocity);
  }
  if (object.OrientationGiven != 0)
  {
    json["orientation"] = FormatRotation(object.Orientation);
  }
  vector("angularVelocity", object.AngularVelocity);
  number("mass", object.Mass, ShellMass(shape));
  number("settlingSpeed", object.SettlingSpeed, shape.SettlingSpeed);
  number("clearanceRadius", object.ClearanceRadius, ClearanceRadius(shape));
  number("restHeight", object.RestHeight, RestHeight(shape));
  if (object.Release > 0)
  {
    json["release"] = object.Release;
    if (object.Appears != 0)
    {
      json["appears"] = true;
    }
  }
  if (object.On >= 0)
  {
    json["on"] = object.On;
  }
  if (object.Goes.From >= 0)
  {
    json["leave"] = FormatLeaving(object.Goes);
  }
  if (object.ClassId != shape.ClassId)
  {
    json["class"] = object.ClassId < 0 ? std::string()
                                       : this->In.Classes[static_cast<std::size_t>(object.ClassId)];
  }
  return json;
}

/// How many objects from the first on an authored entry still gives, and the entry as it is
/// written; 0 where it gives others.
std::size_t SceneFormat::AuthoredObjects(const SceneJson& entry, std::size_t first,
                                         std::size_t index, SceneJson& json)
{
  json = entry;
  const int id = this->In.Objects[first].ObjectId;
  if (entry.contains("position") && id != static_cast<int>(first))
  {
    json["id"] = id; // what came before has changed in number
  }
  const auto& read = this->Written.Objects;
  const std::size_t left = this->In.Objects.size() - first;
  bool isSame = IsReadable([&] { this->Reader.ReadObjectEntry(SceneNode(json, ""), index); }) &&
                read.size() > first && read.size() - first <= left;
  const std::size_t count = isSame ? read.size() - first : 0;
  for (std::size_t i = first; isSame && i < first + count; ++i)
  {
    isSame = IsSameObject(read[i], this->In.Objects[i]);
  }
  this->Reader.KeepObjects(first);
  return isSame ? count : 0;
}

void SceneFormat::WriteObjects()
{
  std::set<int> ids;
  for (const MotionObject& object : this->In.Objects)
  {
    Require(ids.insert(object.ObjectId).second,
            "Objects: `ObjectId`: " + std::to_string(object.ObjectId) + " stands twice");
  }
  const std::map<int, SceneJson> entries =
    ByFirstId(AuthoredList(this->In.Authored.Objects, "objects"));
  SceneJson list = SceneJson::array();
  SceneJson common; // what the last entry has besides its positions; null where no other may join
  for (std::size_t i = 0; i < this->In.Objects.size();)
  {
    const MotionObject& object = this->In.Objects[i];
    SceneJson json = this->FormatObject(object);
    const SceneJson place = FormatVector(object.Position - this->Reader.ReferenceAt(object.On, 0));
    const auto entry = entries.find(object.ObjectId);
    SceneJson authored;
    std::size_t count =
      entry == entries.end() ? 0 : this->AuthoredObjects(entry->second, i, list.size(), authored);
    const bool isPlain = count == 0;
    const bool hasOwnId = object.ObjectId != static_cast<int>(i);
    count = isPlain ? 1 : count;
    if (!isPlain)
    {
      list.push_back(std::move(authored));
      common = nullptr;
    }
    else if (!hasOwnId && json == common)
    {
      SceneJson& last = list.back();
      if (last.contains("position"))
      {
        last["positions"] = SceneJson::array({ last["position"] });
        last.erase("position");
      }
      last["positions"].push_back(place);
    }
    else
    {
      common = hasOwnId ? SceneJson() : json;
      json["position"] = place;
      if (hasOwnId)
      {
        json["id"] = object.ObjectId;
      }
      list.push_back(std::move(json));
    }
    for (; count > 0; --count)
    {
      this->Reader.AddObject(this->In.Objects[i++]);
    }
  }
  if (!list.empty())
  {
    this->Root["objects"] = std::move(list);
  }
}

} // namespace waft
