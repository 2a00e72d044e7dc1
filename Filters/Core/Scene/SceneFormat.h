// SPDX-License-Identifier: BSD-3-Clause
// The parts of the writer of scenes, one a section of the file. Private to this library.
#pragma once

#include "Constraints/Constraint.h"
#include "Scene/SceneNode.h"
#include "Scene/WriteScene.h"

#include <map>
#include <string>
#include <vector>

namespace waft
{

class SceneFormat
{
public:
  SceneFormat(const Scene& scene, const SceneAssets& assets, std::string folder, std::string stem) :
    In(scene), Assets(assets), Folder(std::move(folder)), Stem(std::move(stem))
  {
  }

  /// Throws SceneError.
  SceneText Write();

private:
  // WriteScene.cxx
  void WriteInfo();
  void WriteShapes();
  SceneJson FormatShape(std::size_t place);
  bool FindBuiltin(const Shape& shape, SceneJson& json, Shape& found) const;
  std::string ClassName(int classId);
  void WriteObjects();
  SceneJson FormatObject(const MotionObject& object) const;
  std::string MeshFile(const std::string& what, bool isShape, std::size_t place);
  std::string Relative(const std::string& path, const std::string& owner) const;

  // WriteConstraints.cxx
  void WriteConstraints();
  std::vector<std::vector<const Constraint*>> Entries() const;
  bool FormatSimple(const std::vector<const Constraint*>& rows, SceneJson& json) const;
  bool FormatPath(const std::vector<const Constraint*>& rows, SceneJson& json) const;
  bool FormatKeyframe(const std::vector<const Constraint*>& rows, SceneJson& json) const;
  void SetTargets(const std::vector<const Constraint*>& targets, SceneJson& json) const;

  // WriteFields.cxx
  void WriteObstacles();
  SceneJson FormatObstacle(std::size_t place);
  bool FormatSurface(const TriangleMesh& mesh, SceneJson& json) const;
  SceneJson FormatMotion(const ObstacleMesh& obstacle, const Vec3& reference) const;
  bool IsGround(double& height) const;
  void WriteWinds();
  void WriteVortices();

  const Scene& In;
  const SceneAssets& Assets;
  std::string Folder;
  std::string Stem;
  SceneText Out;
  SceneJson Root;
  std::vector<std::string> ShapeNames; // as written, each once
  std::map<int, std::string> Classes;  // names of the ClassIds met so far
};

SceneJson FormatVector(const Vec3& v);
SceneJson FormatRotation(const Quat& q);

/// JSON with two blanks an indent; lists of numbers, or of lists of three, stay on a line.
std::string PrettyText(const SceneJson& json);

/// Numbers near `value` that are short in decimal, shortest first, `value` itself last.
std::vector<double> ShortNumbers(double value);

bool IsSameMesh(const TriangleMesh& a, const TriangleMesh& b);

} // namespace waft
