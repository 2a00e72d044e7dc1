// SPDX-License-Identifier: BSD-3-Clause
// A scene as the stages use it: everything expanded, nothing left to look up.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Constraints/Constraint.h"
#include "Scene/SceneAssets.h"

#include <optional>
#include <string>
#include <vector>

namespace waft
{

/// A wind that is read from a file: .vti, .pvd or .vdb.
struct WindFile
{
  std::string Path;              // resolved against the scene file's folder
  std::string Location;          // "FILE: /json/pointer", for messages
  std::string Array;             // name of the field in it; empty: `Wind`, `Velocity` and the like
  bool IsYUp = false;            // y is up in it, so that it is to be turned
  std::optional<int> FirstFrame; // of its first field; none: as the file or its name says
  double Scale = 1.0;            // of the values
};

/// Parts of a scene file as they were written, each a scene file itself, with names of files
/// resolved. FormatScene writes them back where they still make what the scene has. Empty: none.
struct AuthoredScene
{
  std::string Objects; // and the title, and the file's comments
  std::string Constraints;
  std::string Obstacles; // and the ground
  std::string Winds;
};

/// The sides that may be open, by the axes of SceneInfo::Open.
inline constexpr const char* OpenSides[] = { "x", "y", "top" };

/// The contents of a scene file. Shapes keep the order of the file (ShapeId is the index), objects
/// are numbered in the order of the expanded list, ClassId is the index in Classes.
struct Scene
{
  SceneInfo Info;
  std::string Title;
  std::vector<std::string> Classes;
  std::vector<Shape> Shapes;
  std::vector<MotionObject> Objects;
  std::vector<Constraint> Constraints;
  std::vector<ObstacleMesh> Obstacles; // the ground last, when there is one
  int GroundId = -1;                   // ObstacleId of the ground; -1: none
  std::vector<AnalyticWind> Winds;
  std::vector<WindFront> Fronts;
  std::vector<WindFile> WindFiles;
  std::vector<Vortex> Vortices;
  AuthoredScene Authored;
  std::vector<std::string> Warnings; // what was read and is odd, a sentence each
};

/// The slab that stands for the ground below a height [m].
TriangleMesh MakeGround(const Box& bounds, double height);

/// Reads a scene file, version 1 (Documentation/SceneFiles.md). A failure's message is
/// `FILE: /json/pointer: expected what, found what`, and the scene is left as it was.
Result ReadScene(const std::string& file, const SceneAssets& assets, Scene& scene);

/// The same from a text; file names are resolved against `folder`, `name` stands in messages.
Result ParseScene(const std::string& text, const std::string& name, const std::string& folder,
                  const SceneAssets& assets, Scene& scene);

/// Whether a file is JSON with a scene's version in it, right or not.
bool IsSceneFile(const std::string& file);

} // namespace waft
