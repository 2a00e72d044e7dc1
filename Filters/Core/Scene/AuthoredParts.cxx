// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/AuthoredParts.h"

#include "Scene/TextFonts.h"

#include <filesystem>

namespace waft
{

namespace
{

// The format's own lists and objects nest 6 deep; comments, which nobody checks, a million.
constexpr int MostLevels = 8;

SceneJson Shallow(const SceneJson& json, int levels = MostLevels)
{
  if (!json.is_structured())
  {
    return json;
  }
  if (levels == 0)
  {
    return nullptr;
  }
  SceneJson copy = json.is_array() ? SceneJson::array() : SceneJson::object();
  for (const auto& item : json.items())
  {
    if (json.is_array())
    {
      copy.push_back(Shallow(item.value(), levels - 1));
    }
    else
    {
      copy[item.key()] = Shallow(item.value(), levels - 1);
    }
  }
  return copy;
}

class PartsOfFile
{
public:
  PartsOfFile(const SceneJson& root, const std::string& name, const std::string& folder) :
    Root(root), Name(name), Folder(folder)
  {
  }

  /// Of some sections; an empty text where the file has none of them.
  std::string Text(const std::vector<std::string>& sections) const
  {
    SceneJson part = this->Version();
    for (const std::string& name : sections)
    {
      if (this->Root.contains(name))
      {
        part[name] = Shallow(this->Root[name]);
        this->Resolve(part[name]);
      }
    }
    return part.size() > 1 ? Dump(part) : std::string();
  }
  /// A ground that nobody speaks of is there.
  std::string ObstacleText() const
  {
    const std::string text = this->Text({ "ground", "obstacles" });
    return text.empty() ? Dump(this->Version()) : text;
  }
  std::string ShapeText(const std::string& name) const
  {
    SceneJson part = this->Version();
    part["shapes"][name] = Shallow(this->Root["shapes"][name]);
    this->Resolve(part["shapes"]);
    return Dump(part);
  }

private:
  SceneJson Version() const
  {
    SceneJson part = SceneJson::object();
    part["waft"] = this->Root["waft"];
    return part;
  }
  void Resolve(SceneJson& section) const
  {
    const auto absolute = [&](const std::string& name)
    {
      std::error_code error;
      const auto path =
        std::filesystem::absolute(FileOfScene(this->Name, this->Folder, name), error);
      return error ? name : path.lexically_normal().string();
    };
    for (SceneJson& entry : section)
    {
      RenameFiles(entry, absolute);
    }
  }
  // A folder's name need not be UTF-8; such a part names files that are not there.
  static std::string Dump(const SceneJson& part)
  {
    return part.dump(-1, ' ', false, SceneJson::error_handler_t::replace);
  }

  const SceneJson& Root;
  const std::string& Name;
  const std::string& Folder;
};

} // namespace

std::filesystem::path FileOfScene(const std::string& scene, const std::string& folder,
                                  const std::string& name)
{
  const std::filesystem::path beside = std::filesystem::path(folder) / name;
  std::error_code error;
  if (!std::filesystem::exists(beside, error) && std::filesystem::is_symlink(scene, error))
  {
    const auto behind = std::filesystem::canonical(scene, error).parent_path() / name;
    if (std::filesystem::exists(behind, error))
    {
      return behind;
    }
  }
  return beside;
}

void RenameFiles(SceneJson& entry, const std::function<std::string(const std::string&)>& rename)
{
  if (!entry.is_object())
  {
    return;
  }
  for (const char* field : { "mesh", "texture", "file", "image", "font" })
  {
    const auto found = entry.find(field);
    if (found != entry.end() && found->is_string() &&
        !(std::string(field) == "font" && IsFontFamily(found->get<std::string>())))
    {
      *found = rename(found->get<std::string>());
    }
  }
  const auto targets = entry.find("targets");
  if (targets != entry.end())
  {
    RenameFiles(*targets, rename);
  }
}

void KeepAuthored(const SceneJson& root, const std::string& name, const std::string& folder,
                  Scene& scene)
{
  const PartsOfFile parts(root, name, folder);
  std::vector<std::string> ofObjects = { "title", "objects" };
  for (const auto& item : root.items())
  {
    if (!item.key().empty() && item.key().front() == '_')
    {
      ofObjects.push_back(item.key());
    }
  }
  scene.Authored.Objects = parts.Text(ofObjects);
  scene.Authored.Constraints = parts.Text({ "constraints" });
  scene.Authored.Obstacles = parts.ObstacleText();
  scene.Authored.Winds = parts.Text({ "winds" });
  for (Shape& shape : scene.Shapes)
  {
    shape.Authored = parts.ShapeText(shape.Name);
  }
}

SceneJson AuthoredPart(const std::string& text)
{
  const auto keeps = [](int depth, SceneJson::parse_event_t event, const SceneJson&)
  { return !IsTooDeep(depth, event); };
  const SceneJson json = SceneJson::parse(text, keeps, false);
  return json.is_object() ? Shallow(json) : SceneJson::object();
}

SceneJson AuthoredList(const std::string& text, const char* section)
{
  const SceneJson part = AuthoredPart(text);
  const auto found = part.find(section);
  return found != part.end() && found->is_array() ? *found : SceneJson::array();
}

} // namespace waft
