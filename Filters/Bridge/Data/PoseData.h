// SPDX-License-Identifier: BSD-3-Clause
// Poses (tracks that turn) and the meshes posed by them.
#pragma once

#include "Base/Mesh.h"
#include "Base/Motion.h"
#include "Base/Pose.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"

#include <vtkNew.h>

#include <array>
#include <map>
#include <string>
#include <vector>

class vtkPointData;
class vtkPolyData;

namespace waft
{

struct RotationOutput;

/// Tracks plus the point data `Orientation`, `AngularVelocity`, `Torque`. poses: one for each
/// track, in their order. left: as TracksToPolyData says.
void PosesToPolyData(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses,
                     const SceneInfo& info, vtkPolyData* data, vtkPointData* left = nullptr);
/// Adds to poses what is known of their turning. Of each line: what its body turns and glides by.
/// Of each line and of all, as field data: `Agreement` (double[2], degrees), the median and the
/// 90th percentile of how far turning in the air leads away from poses that came with their path;
/// NaN of a line without, and nothing where no line has any. Of all: `TurningLimit` (degrees a
/// frame).
void AddTurning(const RotationOutput& rotation, vtkPolyData* data);
/// Places and poses alone: of a large scene all that tracks have would be most of the memory. Needs
/// `Orientation`; angular velocities are zero where they are absent.
Result PosesFromPolyData(vtkPolyData* data, std::vector<Track>& tracks,
                         std::vector<PoseTrack>& poses);

/// Which shape the object of a track has.
class ShapesOfTracks
{
public:
  /// input: what the tracks are called in messages. There is a shape at least.
  ShapesOfTracks(std::string input, const std::vector<MotionObject>& objects,
                 std::size_t numberOfShapes);
  /// Fails where there is no such object, or not the shape that it names.
  Result Find(int objectId, int& shapeId) const;

private:
  std::string Input;
  int NumberOfShapes;
  std::map<int, int> OfObject;
};

/// All objects' meshes as one surface: triangles, texture coordinates, `ObjectId` and `ShapeId` (of
/// points and cells) are made once, points, normals and `Speed` for each frame. What shapes look
/// like is in its field data (LooksToFieldData); coordinates of a shape without any are zero.
class PosedMeshes
{
public:
  PosedMeshes();
  ~PosedMeshes();
  /// Every track has an object, every object a shape (Fails otherwise). colors: by shape, of each
  /// of its points, 0..1.
  Result Build(const std::vector<Shape>& shapes,
               const std::vector<std::vector<std::array<double, 3>>>& colors,
               const std::vector<MotionObject>& objects, const std::vector<Track>& tracks,
               const SceneInfo& info);
  /// frame is clamped to the frames there are. tracks: the ones of Build. Bodies that are not in
  /// the shot are points.
  void Fill(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses, int frame,
            vtkPolyData* data) const;

  /// Of each track the frame from which its body is still (SettledFrames), as the point data
  /// `Settled`.
  void SetSettled(const std::vector<int>& frames);
  /// The height [m] of an obstacle that is flat and reaches past the whole floor of the volume, as
  /// the field data `Ground`; nothing where there is none.
  void SetGround(const std::vector<ObstacleMesh>& obstacles, const Box& volume);

private:
  struct Body
  {
    std::vector<Vec3> Points;
    std::vector<Vec3> Normals;
  };
  std::vector<Body> Bodies;             // by shape
  std::vector<std::size_t> BodyOfTrack; // by track
  double FramesPerSecond = 1.0;
  vtkNew<vtkPolyData> Template; // without points
};

} // namespace waft
