// SPDX-License-Identifier: BSD-3-Clause
// Obstacles, winds and vortices of a scene file.
#include "Base/Primitives.h"
#include "Obstacles/SurfaceRepair.h"
#include "Scene/MeshQueries.h"
#include "Scene/SceneReader.h"
#include "Scene/Solids.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace waft
{

namespace
{

// Whether the box around an obstacle meets the volume at any frame.
bool EntersVolume(const ObstacleMesh& obstacle, const Box& volume)
{
  const Box box = BoxAbout(obstacle.Mesh.Points);
  const auto meets = [&](const Vec3& offset)
  {
    return ((box.Min + offset).array() <= volume.Max.array()).all() &&
           ((box.Max + offset).array() >= volume.Min.array()).all();
  };
  return obstacle.Offsets.empty()
           ? meets(Vec3::Zero())
           : std::any_of(obstacle.Offsets.begin(), obstacle.Offsets.end(), meets);
}

// Whether a body is so small beside its coordinates that rounding may have folded it. Others of
// plain form do not cut themselves, and of a thousand spheres it need not be looked for.
bool IsNearlyRounded(const TriangleMesh& mesh)
{
  const Box box = BoxAbout(mesh.Points);
  const double farthest = box.Min.cwiseAbs().cwiseMax(box.Max.cwiseAbs()).maxCoeff();
  return !(box.Size().minCoeff() > 1e-6 * farthest);
}

std::string EndingOf(const std::string& path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

// Whether the y axis of a file is up, so that it is to be turned.
bool IsYUp(const SceneNode& node)
{
  if (!node.Has("up"))
  {
    return false;
  }
  const SceneNode up = node.At("up", "");
  const std::string axis = up.Text();
  if (axis != "y" && axis != "z")
  {
    up.Fail("y or z");
  }
  return axis == "y";
}

const SolidKind* FindSolid(const std::string& word)
{
  const std::vector<SolidKind>& kinds = SolidKinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const SolidKind& kind) { return kind.Word == word; });
  return found == kinds.end() ? nullptr : &*found;
}

PlainSolid ReadSolid(const SolidKind& kind, const SceneNode& node)
{
  PlainSolid solid;
  for (const SceneField& field : kind.Fields)
  {
    const bool isPoint = field.Holds == SceneValue::Vector;
    const SceneNode value =
      node.At(field.Name, isPoint ? "a point [x, y, z]" : "a radius in metres");
    if (isPoint)
    {
      solid.Points.push_back(value.Vector());
    }
    else
    {
      solid.Radius = value.Number();
    }
  }
  if (!kind.HasVolume(solid))
  {
    node.At(kind.Fields[solid.Points.size() - 1].Name, "").Fail(kind.Expected);
  }
  return solid;
}

} // namespace

void SceneReader::ReadObstacles(const SceneNode& node)
{
  const std::size_t count = node.Size("a list of obstacles");
  std::size_t places = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const SceneNode item = node.Item(i);
    ObstacleMesh obstacle = this->ReadObstacle(item, static_cast<int>(i));
    for (const ObstacleMesh& other : this->Out.Obstacles)
    {
      if (other.ObstacleId == obstacle.ObstacleId)
      {
        item.FailWith("expected an id of its own, found " + std::to_string(obstacle.ObstacleId) +
                      " for two obstacles");
      }
    }
    if (item.Has("file") && !item.Has("up") && EndingOf(item.At("file", "").Text()) == ".obj")
    {
      this->Warn(
        "obstacles whose axes are not known", item,
        "an .obj file does not say which axis is up: z was taken; state `up` (y as Blender and "
        "most others write them, or z)");
    }
    if (!EntersVolume(obstacle, this->Out.Info.Bounds))
    {
      this->Warn("obstacles outside the volume", item,
                 "the obstacle is outside the volume at all frames");
    }
    places += obstacle.Offsets.size();
    if (places > SceneLists::Places)
    {
      item.FailWith("expected at most " + std::to_string(SceneLists::Places) +
                    " places of obstacles that move, one a frame of each, found more");
    }
    this->Out.Obstacles.push_back(std::move(obstacle));
  }
}

ObstacleMesh SceneReader::ReadObstacle(const SceneNode& node, int index)
{
  std::string expected;
  for (const SolidKind& one : SolidKinds())
  {
    expected += (expected.empty() ? "" : ", ") + std::string(one.Word);
  }
  expected += " or mesh";
  const SceneNode kindNode = node.At("kind", expected);
  const std::string kind = kindNode.Text();
  const SolidKind* solid = FindSolid(kind);
  ObstacleMesh obstacle;
  std::vector<Vec3> positions; // of its reference point, one a frame; none where it stands still
  // Where its reference point is at frame 0.
  const auto first = [&](const Vec3& reference) -> Vec3
  {
    positions = node.Has("motion") ? this->ReadMotion(node.At("motion", "")) : std::vector<Vec3>();
    const double tolerance = 1e-12 * this->Out.Info.Bounds.Width();
    const bool isThere = positions.empty() || (positions.front() - reference).norm() <= tolerance;
    return isThere ? reference : positions.front();
  };
  Vec3 reference; // of the mesh as it is made
  if (solid != nullptr)
  {
    node.CheckFields(kind + "Obstacle");
    PlainSolid read = ReadSolid(*solid, node);
    reference = first(solid->Reference(read));
    read = MovedTo(*solid, read, reference);
    obstacle.Mesh = solid->Mesh(read);
  }
  else if (kind == "mesh")
  {
    node.CheckFields("meshObstacle");
    const SceneNode file = node.At("file", "a file of a closed surface");
    const std::string path = this->File(file);
    Check(file, [&] { return this->Assets.LoadMesh(path, obstacle.Mesh); });
    if (obstacle.Mesh.Triangles.empty())
    {
      file.Fail("a surface with triangles");
    }
    const bool isYUp = IsYUp(node);
    if (node.Has("up") && EndingOf(path) == ".glb")
    {
      node.At("up", "").FailWith(
        "expected no `up` of a .glb file, whose y axis is up by its format");
    }
    if (isYUp)
    {
      for (Vec3& p : obstacle.Mesh.Points)
      {
        p = Vec3(p.x(), -p.z(), p.y());
      }
    }
    double scale = 1.0;
    node.Take("scale", scale);
    Vec3 position = Vec3::Zero();
    node.Take("position", position);
    reference = first(position);
    for (Vec3& p : obstacle.Mesh.Points)
    {
      p = scale * p + reference;
    }
  }
  else
  {
    kindNode.Fail(expected);
  }
  obstacle.ObstacleId = index;
  node.Take("id", obstacle.ObstacleId, "an id");
  this->SetReference(obstacle.ObstacleId, reference);
  Result closed = RepairSurface(node.Pointer(), obstacle.Mesh);
  if (closed && (kind == "mesh" || IsNearlyRounded(obstacle.Mesh)))
  {
    closed = CheckSelfIntersection(node.Pointer(), obstacle.Mesh);
  }
  if (!closed)
  {
    throw SceneError{ closed.Message() };
  }
  const bool moves = std::any_of(positions.begin(), positions.end(),
                                 [&](const Vec3& at) { return at != positions.front(); });
  obstacle.Offsets.reserve(moves ? positions.size() : 0);
  for (std::size_t frame = 0; moves && frame < positions.size(); ++frame)
  {
    obstacle.Offsets.push_back(positions[frame] - reference);
  }
  return obstacle;
}

int SceneReader::ReadOn(const SceneNode& node) const
{
  int id = -1;
  if (node.Take("on", id, "the id of an obstacle") && this->ReferenceOf.count(id) == 0)
  {
    node.At("on", "").Fail("the id of an obstacle of the list");
  }
  return id;
}

Vec3 SceneReader::ReferenceAt(int obstacleId, int frame) const
{
  const auto reference = this->ReferenceOf.find(obstacleId);
  Vec3 place = reference != this->ReferenceOf.end() ? reference->second : Vec3(Vec3::Zero());
  for (const ObstacleMesh& obstacle : this->Out.Obstacles)
  {
    place += obstacle.ObstacleId == obstacleId ? obstacle.Offset(frame) : Vec3(Vec3::Zero());
  }
  return place;
}

// Straight between two keys, still before the first and after the last.
std::vector<Vec3> SceneReader::ReadMotion(const SceneNode& node) const
{
  std::vector<std::pair<int, Vec3>> keys;
  const std::size_t count = node.Size("a list of {frame, position}");
  for (std::size_t i = 0; i < count; ++i)
  {
    const SceneNode key = node.Item(i);
    key.CheckFields("motionKey");
    const SceneNode frameNode = key.At("frame", "a frame of the scene");
    const int frame = this->Frame(frameNode);
    if (!keys.empty() && frame <= keys.back().first)
    {
      frameNode.Fail("a frame after " + std::to_string(keys.back().first));
    }
    keys.emplace_back(frame, key.At("position", "a point [x, y, z]").Vector());
  }
  std::vector<Vec3> positions;
  std::size_t after = 0; // the first key not before the frame
  for (int frame = 0; !keys.empty() && frame < this->Out.Info.Time.NumberOfFrames; ++frame)
  {
    while (after < keys.size() && keys[after].first < frame)
    {
      ++after;
    }
    if (after == 0 || after == keys.size() || keys[after].first == frame)
    {
      positions.push_back(keys[std::min(after, keys.size() - 1)].second);
      continue;
    }
    const auto& [frameA, a] = keys[after - 1];
    const auto& [frameB, b] = keys[after];
    positions.emplace_back(a + double(frame - frameA) / (frameB - frameA) * (b - a));
  }
  return positions;
}

TriangleMesh MakeGround(const Box& bounds, double height)
{
  // Wider than the volume, so that its sides are never the nearest surface, and thick enough that
  // no step of an object crosses it.
  const double margin = bounds.Width();
  const double thickness = 0.25 * bounds.Width();
  Box slab;
  slab.Min = Vec3(bounds.Min.x() - margin, bounds.Min.y() - margin, height - thickness);
  slab.Max = Vec3(bounds.Max.x() + margin, bounds.Max.y() + margin, height);
  return MakeBox(slab);
}

void SceneReader::AddGround()
{
  if (!this->HasGround)
  {
    return;
  }
  int id = static_cast<int>(this->Out.Obstacles.size());
  for (const ObstacleMesh& obstacle : this->Out.Obstacles)
  {
    id = std::max(id, obstacle.ObstacleId + 1);
  }
  ObstacleMesh ground;
  ground.ObstacleId = id;
  ground.Mesh = MakeGround(this->Out.Info.Bounds, this->GroundHeight);
  this->Out.GroundId = id;
  this->Out.Obstacles.push_back(std::move(ground));
}

void SceneReader::ReadFront(const SceneNode& node)
{
  const SceneNode kind = node.At("kind", "");
  if (kind.Text() != "front")
  {
    kind.Fail("front; other winds have no kind");
  }
  node.CheckFields("windFront");
  WindFront front;
  front.Direction = node.At("direction", "a direction [x, y, z]").Direction();
  front.Speed = node.At("speed", "a speed in m/s").Number();
  if (!(front.Speed > 0.0))
  {
    node.At("speed", "").Fail("a speed above 0");
  }
  front.Strength = node.At("strength", "a strength in m/s^2").Number();
  node.Take("width", front.Width);
  if (node.Has("startFrame"))
  {
    front.StartTime = this->Out.Info.Time.Time(this->Frame(node.At("startFrame", "")));
  }
  const Box& volume = this->Out.Info.Bounds;
  front.Origin = (front.Direction.array() > 0.0).select(volume.Min, volume.Max);
  node.Take("origin", front.Origin);
  this->Out.Fronts.push_back(front);
}

void SceneReader::LiftByFronts()
{
  const Timeline& time = this->Out.Info.Time;
  const int last = time.NumberOfFrames - 1;
  for (Constraint& row : this->Out.Constraints)
  {
    for (const WindFront& front : this->Out.Fronts)
    {
      const double passes = front.PassesAt(row.Value) * time.FramesPerSecond;
      const double lain = row.Frame + (row.FrameFrom >= 0 ? time.FramesPerSecond : 1.0);
      if (IsRest(row.Kind) && row.Until == last && passes > lain && passes < last)
      {
        row.Until = static_cast<int>(std::ceil(passes));
      }
    }
  }
}

void SceneReader::ReadWinds(const SceneNode& node)
{
  const std::size_t count = node.Size("a list of winds");
  for (std::size_t i = 0; i < count; ++i)
  {
    const SceneNode item = node.Item(i);
    if (item.Has("file"))
    {
      item.CheckFields("windFile");
      const SceneNode file = item.At("file", "");
      const std::string path = this->File(file);
      const std::string extension = path.substr(std::min(path.rfind('.'), path.size()));
      if (extension != ".vti" && extension != ".pvd" && extension != ".vdb")
      {
        file.Fail("a .vti, .pvd or .vdb file");
      }
      WindFile wind;
      wind.Path = path;
      wind.Location = this->Name + ": " + file.Pointer();
      if (item.Has("array"))
      {
        wind.Array = item.At("array", "").Text();
        constexpr std::size_t longest = 1000;
        if (wind.Array.empty() || wind.Array.size() > longest)
        {
          item.At("array", "").Fail("the name of a field of the file");
        }
      }
      wind.IsYUp = IsYUp(item);
      int firstFrame = 0;
      if (item.Take("firstFrame", firstFrame, "a frame"))
      {
        wind.FirstFrame = firstFrame;
      }
      item.Take("scale", wind.Scale);
      this->Out.WindFiles.push_back(std::move(wind));
      continue;
    }
    if (item.Has("kind"))
    {
      this->ReadFront(item);
      continue;
    }
    item.CheckFields("analyticWind");
    AnalyticWind wind;
    wind.Direction = item.At("direction", "a direction [x, y, z]").Direction();
    wind.Strength = item.At("strength", "a strength in m/s^2").Number();
    wind.Center = item.At("center", "a point [x, y, z]").Vector();
    wind.Radius = item.At("radius", "a radius in metres").Number();
    wind.CenterTime = item.At("centerTime", "a time in seconds").Number();
    wind.Duration = item.At("duration", "a duration in seconds").Number();
    this->Out.Winds.push_back(wind);
  }
}

void SceneReader::ReadVortices(const SceneNode& node)
{
  const std::size_t count = node.Size("a list of vortices");
  for (std::size_t i = 0; i < count; ++i)
  {
    const SceneNode item = node.Item(i);
    item.CheckFields("vortex");
    Vortex vortex;
    vortex.VortexId = static_cast<int>(i);
    vortex.P1 = item.At("p1", "a pole [x, y, z]").Vector();
    vortex.P2 = item.At("p2", "a pole [x, y, z]").Vector();
    if (!((vortex.P2 - vortex.P1).norm() > 0.0))
    {
      item.At("p2", "").Fail("a pole apart from `p1`");
    }
    vortex.Strength = item.At("strength", "a strength in m^2/s^2").Number();
    vortex.CenterTime = item.At("centerTime", "a time in seconds").Number();
    vortex.Duration = item.At("duration", "a duration in seconds").Number();
    vortex.CoreRadius = item.At("coreRadius", "a radius in metres").Number();
    this->Out.Vortices.push_back(vortex);
  }
}

} // namespace waft
