// SPDX-License-Identifier: BSD-3-Clause
// Shapes and objects of a scene file.
#include "Base/NumberText.h"
#include "Base/ShapeMeasures.h"
#include "Scene/AuthoredParts.h"
#include "Scene/BlueNoise.h"
#include "Scene/MeshQueries.h"
#include "Scene/SceneReader.h"

#include <algorithm>
#include <filesystem>

namespace waft
{

void SceneReader::ReadShapes(const SceneNode& node)
{
  for (const std::string& name : node.Fields())
  {
    this->ReadShape(node.At(name, ""), name);
  }
}

void SceneReader::ReadShape(const SceneNode& node, const std::string& name)
{
  node.CheckFields("shape");
  const double size = node.Has("size") ? node.At("size", "").Number() : 0.0;
  Shape shape;
  if (node.Has("builtin") == node.Has("mesh"))
  {
    node.Fail("either `builtin` or `mesh`");
  }
  if (node.Has("builtin") && node.Has("align"))
  {
    node.At("align", "").FailWith("expected `align` with `mesh` only");
  }
  if (node.Has("builtin"))
  {
    const SceneNode builtin = node.At("builtin", "");
    Check(builtin, [&] { return this->Assets.LoadBuiltinShape(builtin.Text(), size, shape); });
  }
  else
  {
    const SceneNode mesh = node.At("mesh", "");
    const bool mustAlign = !node.Has("align") || node.At("align", "").Boolean();
    if (!mustAlign && node.Has("size"))
    {
      node.At("size", "").FailWith("expected no `size` of a mesh that is taken as it is (`align`)");
    }
    const std::string file = this->File(mesh);
    Check(mesh,
          [&]
          {
            return mustAlign ? this->Assets.LoadShapeMesh(file, size, shape)
                             : this->Assets.LoadAlignedShape(file, shape);
          });
    if (!(SurfaceArea(shape.Mesh) > 0.0))
    {
      mesh.FailWith("expected a surface with an area, found none in \"" +
                    ShortenedPath(mesh.Text()) + "\"");
    }
    const std::string flat = RemarkOnFlatTriangles(shape.Mesh);
    if (!flat.empty())
    {
      this->Warn("shapes with flat triangles", mesh,
                 "\"" + ShortenedPath(mesh.Text()) + "\": " + flat);
    }
  }
  shape.Name = name;
  if (node.Has("texture"))
  {
    // A body without its picture still flies: it goes on in its plain colour.
    const SceneNode texture = node.At("texture", "");
    const std::filesystem::path path = FileOfScene(this->Name, this->Folder, texture.Text());
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error))
    {
      shape.Texture = path.lexically_normal().string();
    }
    else
    {
      this->Warn("textures that are not there", texture,
                 "expected a file that exists, found none at \"" + ShortenedPath(path.string()) +
                   "\"; the shape goes on without a texture");
    }
  }
  node.Take("areaDensity", shape.AreaDensity);
  node.Take("thickness", shape.Thickness);
  node.Take("dragCoefficient", shape.DragCoefficient);
  node.Take("settlingSpeed", shape.SettlingSpeed);
  const double mass = ShellMass(shape);
  if (!limits::Mass.Holds(mass))
  {
    node.FailWith("expected a surface and an areaDensity whose product [kg] is " +
                  limits::Mass.Text() + ", found " + NumberText(mass));
  }
  if (node.Has("color"))
  {
    const SceneNode color = node.At("color", "");
    const Vec3 rgb = color.Vector();
    shape.Color = { rgb[0], rgb[1], rgb[2] };
    shape.Tint = shape.Color;
  }
  if (node.Has("class"))
  {
    shape.ClassId = this->ClassOf(node.At("class", "").Text());
  }
  this->Out.Shapes.push_back(std::move(shape));
}

// The names of the first few, for messages.
std::string SceneReader::KnownShapes() const
{
  constexpr std::size_t most = 10;
  const auto& shapes = this->Out.Shapes;
  std::string known = shapes.empty() ? "there are none" : "";
  for (std::size_t s = 0; s < std::min(most, shapes.size()); ++s)
  {
    known += (s == 0 ? "" : ", ") + Shortened(shapes[s].Name);
  }
  return shapes.size() <= most ? known
                               : known + " and " + std::to_string(shapes.size() - most) + " more";
}

// Classes are numbered as they are met.
int SceneReader::ClassOf(const std::string& name)
{
  auto& classes = this->Out.Classes;
  const auto found = std::find(classes.begin(), classes.end(), name);
  const auto index = static_cast<int>(found - classes.begin());
  if (found == classes.end())
  {
    classes.push_back(name);
  }
  return index;
}

// The id of the next object: what the entry says, or its index in the expanded list.
int SceneReader::FreeId(const SceneNode& node) const
{
  const int id = node.Has("id") ? static_cast<int>(node.At("id", "").Integer("an id"))
                                : static_cast<int>(this->Out.Objects.size());
  if (this->IndexOfObject.count(id) > 0)
  {
    node.FailWith("expected an id of its own, found " + std::to_string(id) + " for two objects");
  }
  return id;
}

void SceneReader::ReadObjects(const SceneNode& node)
{
  const std::size_t entries = node.Size("a list of objects");
  for (std::size_t entry = 0; entry < entries; ++entry)
  {
    const SceneNode item = node.Item(entry);
    this->ReadObjectEntry(item, entry);
    if (this->Out.Objects.size() > SceneLists::Objects)
    {
      item.FailWith("expected at most " + std::to_string(SceneLists::Objects) +
                    " objects in a scene, found more");
    }
  }
}

void SceneReader::ReadObjectEntry(const SceneNode& node, std::size_t index)
{
  const bool inRegion = node.Has("count") || node.Has("region");
  const bool atPositions = !inRegion && node.Has("positions");
  node.CheckFields(inRegion ? "objectsInRegion"
                            : (atPositions ? "objectsAtPositions" : "singleObject"));
  const SceneNode shapeNode = node.At("shape", "the name of a shape");
  const std::string shapeName = shapeNode.Text();
  const auto& shapes = this->Out.Shapes;
  const auto shape =
    std::find_if(shapes.begin(), shapes.end(), [&](const Shape& s) { return s.Name == shapeName; });
  if (shape == shapes.end())
  {
    shapeNode.Fail("the name of a shape (" + this->KnownShapes() + ")");
  }
  MotionObject object;
  object.ShapeId = static_cast<int>(shape - shapes.begin());
  object.ClassId = shape->ClassId;
  object.SettlingSpeed = shape->SettlingSpeed;
  object.ClearanceRadius = ClearanceRadius(*shape);
  object.RestHeight = RestHeight(*shape);
  object.Mass = ShellMass(*shape);
  node.Take("mass", object.Mass);
  node.Take("settlingSpeed", object.SettlingSpeed);
  node.Take("clearanceRadius", object.ClearanceRadius);
  node.Take("restHeight", object.RestHeight);
  if (node.Has("class"))
  {
    const std::string name = node.At("class", "").Text();
    object.ClassId = name.empty() ? -1 : this->ClassOf(name);
  }
  object.VelocityGiven = node.Take("velocity", object.Velocity) ? 1 : 0;
  object.OrientationGiven = node.Take("orientation", object.Orientation) ? 1 : 0;
  node.Take("angularVelocity", object.AngularVelocity);
  object.On = this->ReadOn(node);
  const Vec3 origin = this->ReferenceAt(object.On, 0);
  std::vector<Vec3> positions;
  if (inRegion)
  {
    positions = this->SpreadObjects(node, index, origin, object.ClearanceRadius);
  }
  else if (atPositions)
  {
    const SceneNode list = node.At("positions", "");
    const std::size_t count = list.Size("a list of points");
    for (std::size_t i = 0; i < count; ++i)
    {
      positions.push_back(origin + list.Item(i).Vector());
    }
  }
  else
  {
    positions.push_back(origin + node.At("position", "a point [x, y, z]").Vector());
  }
  bool appears = false;
  node.Take("appears", appears);
  object.Appears = appears ? 1 : 0;
  const std::vector<int> releases = this->ReadReleases(node, positions, static_cast<int>(index));
  std::vector<Leaving> leavings(positions.size());
  if (node.Has("leave"))
  {
    const int released = std::max(0, *std::max_element(releases.begin(), releases.end()));
    leavings = this->ReadLeavings(node.At("leave", ""), StartsAsTargets(positions), released,
                                  static_cast<int>(index));
  }
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    object.ObjectId = this->FreeId(node);
    object.Position = positions[i];
    object.Release = releases[i];
    object.Goes = leavings[i];
    this->AddObject(object);
  }
}

void SceneReader::AddObject(const MotionObject& object)
{
  this->IndexOfObject[object.ObjectId] = this->Out.Objects.size();
  this->Out.Objects.push_back(object);
}

void SceneReader::KeepObjects(std::size_t count)
{
  while (this->Out.Objects.size() > count)
  {
    this->IndexOfObject.erase(this->Out.Objects.back().ObjectId);
    this->Out.Objects.pop_back();
  }
  if (this->Placed.Count() > count)
  {
    this->Placed = NearObjects();
  }
}

std::vector<Vec3> SceneReader::SpreadObjects(const SceneNode& node, std::size_t entry,
                                             const Vec3& origin, double radius)
{
  const auto count = static_cast<std::size_t>(
    node.At("count", "a number of objects").Integer("a number of objects"));
  const SceneNode regionNode = node.At("region", "a region {min, max}");
  regionNode.CheckFields("region");
  Box region;
  region.Min = origin + regionNode.At("min", "a point [x, y, z]").Vector();
  region.Max = origin + regionNode.At("max", "a point [x, y, z]").Vector();
  if (region.Size().minCoeff() < 0.0)
  {
    regionNode.Fail("a region whose max is not below its min");
  }
  std::uint64_t seed = this->Out.Info.Seed;
  node.Take("seed", seed, "a seed");
  const auto& objects = this->Out.Objects;
  while (this->Placed.Count() < objects.size())
  {
    const MotionObject& next = objects[this->Placed.Count()];
    this->Placed.Add(next.Position, next.ClearanceRadius);
  }
  const auto& obstacles = this->Out.Obstacles;
  while (this->BoxOfObstacle.size() < obstacles.size())
  {
    this->BoxOfObstacle.push_back(BoxAbout(obstacles[this->BoxOfObstacle.size()].Mesh.Points));
  }
  const auto isAdmissible = [&](const Vec3& x)
  {
    if (this->Out.Info.Bounds.InnerDistance(x) < radius || !this->Placed.HasRoom(x, radius))
    {
      return false;
    }
    for (std::size_t o = 0; o < obstacles.size(); ++o)
    {
      const Box& box = this->BoxOfObstacle[o];
      const Vec3 away = (box.Min - x).cwiseMax(x - box.Max).cwiseMax(0.0);
      if (away.squaredNorm() > radius * radius * (1.0 + 1e-9))
      {
        continue;
      }
      const auto tree = this->TreeOfObstacle.try_emplace(o, obstacles[o].Mesh).first;
      if (!IsOutside(tree->second, x, radius))
      {
        return false;
      }
    }
    return true;
  };
  std::vector<Vec3> taken;
  for (const MotionObject& other : objects)
  {
    taken.push_back(other.Position);
  }
  const std::vector<Vec3> positions = SpreadInBox(region, count, seed, entry, isAdmissible, taken);
  if (positions.size() < count)
  {
    regionNode.FailWith("expected room for " + std::to_string(count) + " objects of radius " +
                        std::to_string(radius) +
                        " m inside the volume and clear of obstacles and other objects, found " +
                        std::to_string(positions.size()) + " places");
  }
  double nearest = 1e300;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      nearest = std::min(nearest, (positions[i] - positions[j]).norm());
    }
  }
  if (nearest < 2.0 * radius)
  {
    this->Warn("regions that are crowded", regionNode,
               std::to_string(count) + " objects start as near as " + std::to_string(nearest) +
                 " m in this region and are " + std::to_string(2.0 * radius) + " m wide");
  }
  return positions;
}

} // namespace waft
