// SPDX-License-Identifier: BSD-3-Clause
// The parts of the reader of scenes, one a section of the file. Private to this library.
#pragma once

#include "Constraints/Arrivals.h"
#include "Obstacles/TriangleTree.h"
#include "Scene/LetterSpacing.h"
#include "Scene/NearObjects.h"
#include "Scene/Scene.h"
#include "Scene/SceneDrawings.h"
#include "Scene/SceneNode.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace waft
{

class SceneReader
{
public:
  SceneReader(std::string name, std::string folder, const SceneAssets& assets, Scene& scene) :
    Name(std::move(name)), Folder(std::move(folder)), Assets(assets), Out(scene)
  {
  }

  /// These throw SceneError. One entry is read after what the scene has already, as if it came next
  /// in the file, `index` in its list.
  void Read(const SceneNode& root);
  /// Keeps what keyframes draw in a plane as they are read.
  void KeepDrawings(std::vector<SceneDrawing>& drawings) { this->Drawings = &drawings; }
  void ReadShape(const SceneNode& node, const std::string& name);
  void ReadGround(const SceneNode& root);
  void AddGround();
  ObstacleMesh ReadObstacle(const SceneNode& node, int index);
  void ReadObjectEntry(const SceneNode& node, std::size_t index);
  void ReadConstraint(const SceneNode& node, int index);
  void ReadWinds(const SceneNode& node);
  void ReadFront(const SceneNode& node);
  /// What lies to the end is lifted by the first front that passes it.
  void LiftByFronts();
  /// "Any object" means any of the scene; a choice among a few is made here, once all rows are
  /// known.
  void AssignChosen(const SceneNode& node);

  /// Where the reference point of an obstacle is at frame 0, as its file has it.
  void SetReference(int obstacleId, const Vec3& place) { this->ReferenceOf[obstacleId] = place; }
  /// Where it is at a frame; of none (-1) the origin.
  Vec3 ReferenceAt(int obstacleId, int frame) const;

  /// Adds an object that no entry was read for.
  void AddObject(const MotionObject& object);
  /// Forgets what entries added behind the first `count`.
  void KeepObjects(std::size_t count);
  void KeepConstraints(std::size_t count);
  /// Does a row of the scene wait for AssignChosen?
  bool IsChosenLater(const Constraint& row) const { return this->Choices.count(row.Group) > 0; }

private:
  // A keyframe's target in the world.
  struct Target
  {
    Vec3 Position = Vec3::Zero();
    int ClassId = -1;
    double Across = 0.0,
           Up =
             0.0; // along the drawing's width and height; of points x and z (y where all are level)
    std::optional<TextPlace> Place;
  };
  // When rows of one entry are met.
  struct RowTimes
  {
    FrameWindow Window;
    bool IsWindow = false;
    bool IsOpen = false;     // the air chooses in it
    std::vector<int> Frames; // by target, where it does not
    void Set(std::size_t target, Constraint& row) const;
  };
  // Where targets of a text, a picture or a mesh lie.
  struct TargetFrame
  {
    Vec3 Origin = Vec3::Zero();
    Vec3 U = Vec3::UnitX();
    Vec3 V = Vec3::UnitY();
    double Width = 1.0;
  };

  // ReadScene.cxx
  void ReadInfo(const SceneNode& root);
  void ReadBreeze(const SceneNode& air);
  Result CheckLoop() const;
  int Frame(const SceneNode& node) const;
  std::string File(const SceneNode& node) const;
  /// Fails at `node` when `load`, which its value asks for, does.
  static void Check(const SceneNode& node, const std::function<Result()>& load);

  /// Adds a warning; of one kind ("obstacles outside the volume") the first few, the others are
  /// counted.
  void Warn(const char* kind, const SceneNode& node, const std::string& what);
  void WarnOfMore();

  // ReadShapes.cxx
  void ReadShapes(const SceneNode& node);
  void ReadObjects(const SceneNode& node);
  std::string KnownShapes() const;
  int ClassOf(const std::string& name);
  int FreeId(const SceneNode& node) const;
  std::vector<Vec3> SpreadObjects(const SceneNode& node, std::size_t entry, const Vec3& origin,
                                  double radius);

  // ReadFields.cxx
  void ReadObstacles(const SceneNode& node);
  std::vector<Vec3> ReadMotion(const SceneNode& node) const;
  /// `on`, the obstacle that values are relative to; -1: none.
  int ReadOn(const SceneNode& node) const;
  void ReadVortices(const SceneNode& node);

  // ReadConstraints.cxx
  void ReadConstraints(const SceneNode& node);
  /// What is asked of the pose: `facing` and `faceUp`.
  static void ReadSides(const SceneNode& node, Constraint& constraint);
  void ReadPath(const SceneNode& node, int row);
  /// Of a rest, `until` where it is there, else the last frame.
  int ReadUntil(const SceneNode& node, const RowTimes& times) const;
  void ReadHold(const SceneNode& node, Constraint& constraint) const;
  /// Of the rows of an entry from the index `first` on, one a target.
  void ReadLeave(const SceneNode& node, const std::vector<Target>& targets, int row,
                 std::size_t first);
  /// Of several, from a frame on.
  std::vector<Leaving> ReadLeavings(const SceneNode& leave, const std::vector<Target>& targets,
                                    int earliest, int entry) const;
  Vec3 ReadAway(const SceneNode& leave) const;

  // ReadTimes.cxx
  /// In the order of x, as from left to right, and of z.
  static std::vector<Target> StartsAsTargets(const std::vector<Vec3>& positions);
  /// Of the objects of an entry, -1 where they fly from the first frame.
  std::vector<int> ReadReleases(const SceneNode& node, const std::vector<Vec3>& positions,
                                int entry) const;
  RowTimes ReadTimes(const SceneNode& node, const std::vector<Target>& targets, int row) const;
  std::vector<double> ReadOrder(const SceneNode& node, const std::vector<Target>& targets,
                                TimeSpread spread, int row) const;
  void ReadKeyframe(const SceneNode& node, int row);
  int ObjectId(const SceneNode& node, int lowest) const;
  const MotionObject& Object(int id) const;
  std::vector<int> ObjectIds(const SceneNode& node, bool mayBeAny) const;

  // ReadTargets.cxx
  std::vector<Target> ReadTargets(const SceneNode& node, int row, std::size_t objects) const;
  std::vector<Target> ReadPoints(const SceneNode& node) const;
  int TargetClass(const SceneNode& node, const std::string& name) const;
  std::vector<Target> SamplePlane(const SceneNode& node, TargetMask mask, std::size_t count,
                                  const std::vector<int>& classIds, int row) const;
  std::vector<Target> SampleMesh(const SceneNode& node, std::size_t count, int row) const;
  TargetFrame ReadTargetFrame(const SceneNode& node, bool needsWidth) const;
  double BodyWidth(const TargetFrame& frame, int pixels) const;

  std::string Name;
  std::string Folder;
  const SceneAssets& Assets;
  Scene& Out;
  std::vector<SceneDrawing>* Drawings = nullptr; // where they are wanted
  bool HasGround = true;
  double GroundHeight = 0.0;
  std::map<int, std::size_t> IndexOfObject;           // by id
  std::map<int, Vec3> ReferenceOf;                    // of obstacles by id, at frame 0
  std::map<std::string, int> WarningsOf;              // by kind, how many there were
  NearObjects Placed;                                 // objects that were looked for room among
  std::vector<Box> BoxOfObstacle;                     // of those that were kept clear of
  std::map<std::size_t, TriangleTree> TreeOfObstacle; // of those whose box an object came near
  std::map<int, std::vector<int>> Choices; // by row of a keyframe, the ids that it may choose among
};

} // namespace waft
