// SPDX-License-Identifier: BSD-3-Clause
// Which places of a scene file can be moved by the hand.
#include "Base/Types.h"
#include "Scene/JsonText.h"
#include "Scene/SceneEdits.h"

#include <algorithm>
#include <iterator>

namespace waft
{
namespace
{

constexpr double Thinnest = 0.02; // m, that a hand makes a box

class HandleList
{
public:
  explicit HandleList(const SceneJson& scene) : Root(scene) {}

  SceneJson Make()
  {
    const SceneInfo none;
    const auto has = [this](const char* section, const char* field, const SceneJson& otherwise)
    { return this->Root.value(section, SceneJson::object()).value(field, otherwise); };
    SceneJson made;
    made["min"] = has("domain", "min", ListOf(none.Bounds.Min));
    made["max"] = has("domain", "max", ListOf(none.Bounds.Max));
    this->Volume = { PointOf(made["min"]), PointOf(made["max"]) };
    made["frames"] = has("time", "frames", none.Time.NumberOfFrames);
    made["framesPerSecond"] = has("time", "framesPerSecond", none.Time.FramesPerSecond);
    this->AddObjects();
    this->AddConstraints();
    this->AddObstacles();
    this->AddForces();
    made["hasConstraints"] = this->Root.contains("constraints");
    made["lastObject"] = this->LastId;
    made["handles"] = std::move(this->Handles);
    return made;
  }

private:
  static SceneJson ListOf(const Vec3& v) { return SceneJson::array({ v.x(), v.y(), v.z() }); }
  static Vec3 PointOf(const SceneJson& list)
  {
    return Vec3(list[0].get<double>(), list[1].get<double>(), list[2].get<double>());
  }
  Vec3 PointAt(const std::string& pointer) const
  {
    return PointOf(this->Root.at(SceneJson::json_pointer(pointer)));
  }

  /// pointers: of the points that go along; the handle is in the middle of them.
  void Add(const char* kind, int object, int frame, const std::vector<std::string>& pointers)
  {
    Vec3 middle = Vec3::Zero();
    SceneJson moves = SceneJson::object();
    for (const std::string& pointer : pointers)
    {
      moves[pointer] = this->Root.at(SceneJson::json_pointer(pointer));
      middle += this->PointAt(pointer) / static_cast<double>(pointers.size());
    }
    this->Handles.push_back({ { "kind", kind },
                              { "object", object },
                              { "frame", frame },
                              { "place", ListOf(middle) },
                              { "moves", std::move(moves) } });
  }

  /// The two corners of a box, which stay in the volume, or as far out as they are, and apart.
  void AddCorners(const char* kind, const std::string& box)
  {
    const std::string lower = box + "/min", upper = box + "/max";
    const Vec3 low = this->PointAt(lower), high = this->PointAt(upper);
    const Vec3 thin = Vec3::Constant(Thinnest);
    this->Add(kind, -1, -1, { lower });
    this->Handles.back()["least"] = ListOf(low.cwiseMin(this->Volume.Min));
    this->Handles.back()["most"] = ListOf(low.cwiseMax(high - thin));
    this->Add(kind, -1, -1, { upper });
    this->Handles.back()["least"] = ListOf(high.cwiseMin(low + thin));
    this->Handles.back()["most"] = ListOf(high.cwiseMax(this->Volume.Max));
  }

  static double FrameOf(const SceneJson& frame) // of a window its end
  {
    return frame.is_object() ? frame["to"].get<double>() : frame.get<double>();
  }

  /// Moves the handles from the index `first` on by where the obstacle that an entry is `on` has
  /// its reference point.
  void GoOn(const SceneJson& entry, double frame, std::size_t first)
  {
    const SceneJson obstacles = this->Root.value("obstacles", SceneJson::array());
    for (std::size_t i = 0; entry.contains("on") && i < obstacles.size(); ++i)
    {
      if (obstacles[i].value("id", static_cast<int>(i)) != entry["on"])
      {
        continue;
      }
      const Vec3 at = ReferenceAt(obstacles[i], frame);
      for (std::size_t h = first; h < this->Handles.size(); ++h)
      {
        this->Handles[h]["place"] = ListOf(PointOf(this->Handles[h]["place"]) + at);
      }
    }
  }

  static Vec3 ReferenceAt(const SceneJson& obstacle, double frame)
  {
    const SceneJson keys = obstacle.value("motion", SceneJson::array());
    const auto after =
      std::find_if(keys.begin(), keys.end(),
                   [&](const SceneJson& key) { return key["frame"].get<double>() >= frame; });
    if (!keys.empty() && (after == keys.begin() || after == keys.end()))
    {
      return PointOf((after == keys.end() ? keys.back() : *after)["position"]);
    }
    if (!keys.empty())
    {
      const SceneJson& before = *std::prev(after);
      const double a = before["frame"], b = (*after)["frame"];
      const Vec3 from = PointOf(before["position"]);
      return from + (frame - a) / (b - a) * (PointOf((*after)["position"]) - from);
    }
    for (const char* field : { "center", "base", "position" })
    {
      if (obstacle.contains(field))
      {
        return PointOf(obstacle[field]);
      }
    }
    return obstacle.contains("min")
             ? Vec3(0.5 * (PointOf(obstacle["min"]) + PointOf(obstacle["max"])))
             : Vec3(Vec3::Zero());
  }

  void AddObjects()
  {
    int count = 0; // so far; of those that say no id it is the next one's
    const SceneJson entries = this->Root.value("objects", SceneJson::array());
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
      const SceneJson& entry = entries[i];
      const std::string pointer = "/objects/" + std::to_string(i);
      const std::size_t first = this->Handles.size();
      if (entry.contains("count"))
      {
        count += entry["count"].get<int>();
        this->Add("region", -1, 0, { pointer + "/region/min", pointer + "/region/max" });
        this->AddCorners("corner of region", pointer + "/region");
      }
      else if (entry.contains("positions"))
      {
        for (std::size_t k = 0; k < entry["positions"].size(); ++k)
        {
          this->Add("start", count++, 0, { pointer + "/positions/" + std::to_string(k) });
        }
      }
      else
      {
        const int id = entry.value("id", count++);
        this->Add("start", id, 0, { pointer + "/position" });
        this->LastId = std::max(this->LastId, id);
      }
      this->LastId = std::max(this->LastId, count - 1);
      this->GoOn(entry, 0.0, first);
    }
  }

  void AddConstraints()
  {
    const SceneJson entries = this->Root.value("constraints", SceneJson::array());
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
      const SceneJson& entry = entries[i];
      const std::string pointer = "/constraints/" + std::to_string(i);
      const std::string kind = entry["kind"].get<std::string>();
      const std::size_t first = this->Handles.size();
      const int at = entry.contains("frame") ? static_cast<int>(FrameOf(entry["frame"])) : 0;
      if (kind == "position" || kind == "rest")
      {
        this->Add(kind == "rest" ? "rest" : "mark", entry["object"], at, { pointer + "/value" });
      }
      else if (kind == "path")
      {
        int frame = entry["firstFrame"];
        for (std::size_t k = 0; k < entry["points"].size(); ++k)
        {
          this->Add("mark", entry["object"], frame++, { pointer + "/points/" + std::to_string(k) });
        }
      }
      else if (kind == "keyframe" && entry["targets"].contains("points"))
      {
        for (std::size_t k = 0; k < entry["targets"]["points"].size(); ++k)
        {
          this->Add("target", -1, at, { pointer + "/targets/points/" + std::to_string(k) });
        }
      }
      else if (kind == "keyframe" && entry["targets"].contains("origin"))
      {
        this->Add("targets", -1, at, { pointer + "/targets/origin" });
      }
      this->GoOn(entry, at, first);
    }
  }

  /// Of the form of each, the points that say where it is, and those that say how large.
  void AddObstacles()
  {
    const SceneJson entries = this->Root.value("obstacles", SceneJson::array());
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
      if (entries[i].contains("motion"))
      {
        continue;
      }
      std::vector<std::string> pointers;
      for (const char* field : { "min", "max", "center", "base", "top", "position" })
      {
        if (entries[i].contains(field))
        {
          pointers.push_back("/obstacles/" + std::to_string(i) + "/" + field);
        }
      }
      if (!pointers.empty())
      {
        this->Add("obstacle", -1, -1, pointers);
      }
      if (entries[i].contains("min"))
      {
        this->AddCorners("corner of obstacle", "/obstacles/" + std::to_string(i));
      }
      else if (entries[i].contains("base"))
      {
        this->AddEnds("end of obstacle", pointers);
      }
    }
  }

  void AddEnds(const char* kind, const std::vector<std::string>& pointers)
  {
    for (const std::string& pointer : pointers)
    {
      this->Add(kind, -1, -1, { pointer });
    }
  }

  /// Vortices, and winds that have a place.
  void AddForces()
  {
    const std::size_t vortices = this->Root.value("vortices", SceneJson::array()).size();
    for (std::size_t i = 0; i < vortices; ++i)
    {
      const std::string pointer = "/vortices/" + std::to_string(i);
      const std::vector<std::string> ends = { pointer + "/p1", pointer + "/p2" };
      this->Add("vortex", -1, -1, ends);
      this->AddEnds("end of vortex", ends);
    }
    const SceneJson winds = this->Root.value("winds", SceneJson::array());
    for (std::size_t i = 0; i < winds.size(); ++i)
    {
      if (winds[i].contains("center"))
      {
        this->Add("wind", -1, -1, { "/winds/" + std::to_string(i) + "/center" });
      }
    }
  }

  const SceneJson& Root;
  Box Volume;
  SceneJson Handles = SceneJson::array();
  int LastId = -1;
};

} // namespace

Result DescribeHandles(const std::string& text, const std::string& name, std::string& handles)
{
  try
  {
    const SceneJson scene = ParseText(text, name);
    handles = HandleList(scene).Make().dump();
    return Result::Ok();
  }
  catch (const SceneError& error)
  {
    return Result::Error(error.Message);
  }
  catch (const std::exception& error)
  {
    return Result::Error(name + ": " + error.what());
  }
}

} // namespace waft
