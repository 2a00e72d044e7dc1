// SPDX-License-Identifier: BSD-3-Clause
// Shapes, objects and the frame of a scene file.
#include "Scene/WriteScene.h"

#include "Base/ShapeMeasures.h"
#include "Scene/SceneFormat.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
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

/// Texture coordinates are floats on their way through VTK.
bool IsSameTexture(const Shape& a, const Shape& b)
{
  return std::equal(a.TextureCoordinates.begin(), a.TextureCoordinates.end(),
                    b.TextureCoordinates.begin(), b.TextureCoordinates.end(),
                    [](const auto& u, const auto& v)
                    { return float(u[0]) == float(v[0]) && float(u[1]) == float(v[1]); });
}

} // namespace

std::string SceneFormat::Relative(const std::string& path, const std::string& owner) const
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  Require(!error && fs::is_regular_file(whole, error),
          owner + ": expected a file that exists, found none at \"" + path + "\"");
  const fs::path folder = fs::absolute(this->Folder, error).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder);
  return relative.empty() ? whole.string() : relative.generic_string();
}

std::string SceneFormat::MeshFile(const std::string& what, bool isShape, std::size_t place)
{
  std::string name = this->Stem + "." + what;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '-' ? c : '_'; });
  name = name.substr(0, 200) + ".vtp";
  this->Out.Meshes.push_back({ name, isShape, place });
  return name;
}

void SceneFormat::WriteInfo()
{
  const SceneInfo& info = this->In.Info;
  constexpr std::uint64_t largest = 9007199254740991; // 2^53 - 1: exact in any JSON reader
  Require(info.Time.NumberOfFrames >= 2,
          "NumberOfFrames: expected at least 2, found " + std::to_string(info.Time.NumberOfFrames));
  Require(info.Seed <= largest, "Seed: expected at most " + std::to_string(largest));
  Require(info.AirDensity > 0.0, "AirDensity: expected more than 0");
  this->Root["waft"] = 1;
  if (!this->In.Title.empty())
  {
    this->Root["title"] = this->In.Title;
  }
  this->Root["seed"] = info.Seed;
  this->Root["time"] = { { "frames", info.Time.NumberOfFrames },
                         { "framesPerSecond", info.Time.FramesPerSecond } };
  this->Root["domain"] = { { "min", FormatVector(info.Bounds.Min) },
                           { "max", FormatVector(info.Bounds.Max) } };
  this->Root["air"] = { { "density", info.AirDensity } };
}

bool SceneFormat::FindBuiltin(const Shape& shape, SceneJson& json, Shape& found) const
{
  for (const std::string& name : this->Assets.BuiltinShapeNames())
  {
    Shape made;
    if (!this->Assets.LoadBuiltinShape(name, 0.0, made) ||
        made.Mesh.Triangles != shape.Mesh.Triangles ||
        made.Mesh.Points.size() != shape.Mesh.Points.size())
    {
      continue;
    }
    for (const double size : ShortNumbers(LargestExtent(shape.Mesh)))
    {
      if (this->Assets.LoadBuiltinShape(name, size, made) && IsSameMesh(made.Mesh, shape.Mesh) &&
          IsSameTexture(made, shape))
      {
        json["builtin"] = name;
        json["size"] = size;
        found = std::move(made);
        return true;
      }
    }
  }
  return false;
}

std::string SceneFormat::ClassName(int classId)
{
  if (classId < 0)
  {
    return {};
  }
  const auto known = this->Classes.find(classId);
  if (known != this->Classes.end())
  {
    return known->second;
  }
  const auto place = static_cast<std::size_t>(classId);
  return this->Classes[classId] = place < this->In.Classes.size()
                                    ? this->In.Classes[place]
                                    : "class " + std::to_string(classId);
}

SceneJson SceneFormat::FormatShape(std::size_t place)
{
  const Shape& shape = this->In.Shapes[place];
  const std::string owner = "Shapes: block " + shape.Name;
  SceneJson json = SceneJson::object();
  Shape plain; // what the reader takes where the file is silent
  if (!this->FindBuiltin(shape, json, plain))
  {
    json["mesh"] = this->MeshFile("shape-" + this->ShapeNames[place], true, place);
    json["align"] = false;
  }
  if (!shape.Texture.empty())
  {
    json["texture"] = this->Relative(shape.Texture, owner + ": `Texture`");
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
  if (shape.Color != plain.Color || shape.Tint != plain.Tint)
  {
    const Vec3 color(shape.Color[0], shape.Color[1], shape.Color[2]);
    Require(color.minCoeff() >= 0.0 && color.maxCoeff() <= 1.0,
            owner + ": `Color`: expected numbers from 0 to 1");
    json["color"] = FormatVector(color);
  }
  if (shape.ClassId >= 0)
  {
    json["class"] = this->ClassName(shape.ClassId);
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
  const auto place = static_cast<std::size_t>(object.ShapeId);
  const Shape& shape = this->In.Shapes[place];
  SceneJson json = SceneJson::object();
  json["shape"] = this->ShapeNames[place];
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
  if (object.Orientation.coeffs() != Quat::Identity().coeffs())
  {
    json["orientation"] = FormatRotation(object.Orientation);
  }
  vector("angularVelocity", object.AngularVelocity);
  number("mass", object.Mass, ShellMass(shape));
  number("settlingSpeed", object.SettlingSpeed, shape.SettlingSpeed);
  number("clearanceRadius", object.ClearanceRadius, ClearanceRadius(shape));
  number("restHeight", object.RestHeight, RestHeight(shape));
  if (object.ClassId != shape.ClassId)
  {
    json["class"] = object.ClassId < 0 ? std::string() : this->Classes.at(object.ClassId);
  }
  return json;
}

void SceneFormat::WriteObjects()
{
  SceneJson list = SceneJson::array();
  std::set<int> ids;
  const SceneJson* last = nullptr; // what the last entry has besides its positions
  SceneJson common;
  for (std::size_t i = 0; i < this->In.Objects.size(); ++i)
  {
    const MotionObject& object = this->In.Objects[i];
    Require(ids.insert(object.ObjectId).second,
            "Objects: `ObjectId`: " + std::to_string(object.ObjectId) + " stands twice");
    (void)this->ClassName(object.ClassId); // classes are numbered as they are met
    SceneJson json = this->FormatObject(object);
    const bool hasOwnId = object.ObjectId != static_cast<int>(i);
    if (last != nullptr && !hasOwnId && json == common)
    {
      SceneJson& entry = list.back();
      if (entry.contains("position"))
      {
        entry["positions"] = SceneJson::array({ entry["position"] });
        entry.erase("position");
      }
      entry["positions"].push_back(FormatVector(object.Position));
      continue;
    }
    common = json;
    last = hasOwnId ? nullptr : &common;
    json["position"] = FormatVector(object.Position);
    if (hasOwnId)
    {
      json["id"] = object.ObjectId;
    }
    list.push_back(std::move(json));
  }
  if (!list.empty())
  {
    this->Root["objects"] = std::move(list);
  }
}

SceneText SceneFormat::Write()
{
  this->Root = SceneJson::object();
  this->WriteInfo();
  this->WriteShapes();
  this->WriteObjects();
  this->WriteConstraints();
  this->WriteObstacles();
  this->WriteWinds();
  this->WriteVortices();
  this->Out.Json = PrettyText(this->Root);
  return std::move(this->Out);
}

Result FormatScene(const Scene& scene, const SceneAssets& assets, const std::string& folder,
                   const std::string& stem, SceneText& text)
{
  try
  {
    text = SceneFormat(scene, assets, folder, stem).Write();
    return Result::Ok();
  }
  catch (const SceneError& error)
  {
    return Result::Error(error.Message);
  }
  catch (const std::exception& error) // a text that is no UTF-8
  {
    return Result::Error(std::string("the scene cannot be written: ") + error.what());
  }
}

} // namespace waft
