// SPDX-License-Identifier: BSD-3-Clause
// The parts of the writer of scenes, one a section of the file. Private to this library.
#pragma once

#include "Scene/SceneReader.h"
#include "Scene/WriteScene.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace waft
{

/// Writes the sections in the order in which they are read. An authored entry is written as it is
/// when reading it, behind what is written already, gives what the scene has; else what the scene
/// has is written in the plainest words.
class SceneFormat
{
public:
  SceneFormat(const Scene& scene, const SceneAssets& assets, std::string folder, std::string stem);

  /// Throws SceneError.
  SceneText Write();

private:
  // WriteScene.cxx
  void WriteInfo();
  void CheckLists() const;
  std::string SideFile(const std::string& what, const char* ending) const;
  std::string ExistingFile(const std::string& path, const std::string& owner) const;
  std::string Relative(const std::string& path) const;
  SceneJson AsWritten(SceneJson entry);

  // WriteShapes.cxx
  void NameClasses();
  void WriteShapes();
  bool ReadsAsShape(const SceneJson& entry, Shape& read);
  SceneJson FormatShape(std::size_t index);
  void WriteObjects();
  std::size_t AuthoredObjects(const SceneJson& entry, std::size_t first, std::size_t index,
                              SceneJson& json);
  SceneJson FormatObject(const MotionObject& object) const;

  // WriteConstraints.cxx
  using Rows = std::vector<const Constraint*>;
  void WriteConstraints();
  std::vector<Rows> Entries() const;
  SceneJson FormatRows(bool keepsChoices, bool& isSame);
  bool ReadsAsRows(const SceneJson& entry, int index, const Rows& rows);
  std::vector<SceneJson> PlainRows(const Rows& rows) const;
  bool FormatSimple(const Rows& rows, SceneJson& json) const;
  bool FormatPath(const Rows& rows, SceneJson& json) const;
  bool FormatKeyframe(const Rows& rows, SceneJson& json) const;
  void SetTargets(const Rows& targets, SceneJson& json) const;

  // WriteFields.cxx
  void WriteObstacles();
  SceneJson FormatObstacle(std::size_t index, int position, const SceneJson* authored);
  SceneJson FormatMotion(const ObstacleMesh& obstacle) const;
  std::size_t FindGround(const SceneJson& authored);
  void WriteWinds();
  void WriteVortices();

  Scene In; // classes numbered as they are met in the file
  std::string Folder;
  std::string Stem;
  SceneText Out;
  SceneJson Root;
  std::vector<std::string> ShapeNames; // as written, each once
  Scene Written;                       // what the file reads as so far
  SceneReader Reader;
};

/// Whether a text of the format can be read; what `read` throws then is what is wrong with it.
bool IsReadable(const std::function<void()>& read);

/// Throws on a name that the reader would refuse (SceneNode::Text); owner: whose it is.
void RequireName(const std::string& name, const std::string& owner);

SceneJson FormatVector(const Vec3& v);
SceneJson FormatRotation(const Quat& q);
/// Of an object that goes at one frame.
SceneJson FormatLeaving(const Leaving& leaving);
SceneJson FormatWind(const AnalyticWind& wind);
SceneJson FormatFront(const WindFront& front, double framesPerSecond);

} // namespace waft
