// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/AnimationFile.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/PoseData.h"
#include "Export/GltfAnimation.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPolyData.h>

#include <cstddef>
#include <map>
#include <utility>

namespace waft
{
namespace
{

/// By ObjectId, the frames at which a body does what is asked of it: those of its rows, and when it
/// comes to lie, asked for or not.
Result FramesOfMarks(vtkPolyData* rows, vtkPolyData* poses, const Timeline& time,
                     std::map<int, std::vector<int>>& frames)
{
  std::vector<Constraint> constraints;
  if (rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(ConstraintsFromPolyData(rows, time, constraints));
  }
  for (const Constraint& row : constraints)
  {
    std::vector<int>& own = frames[row.ObjectId];
    own.insert(own.end(), { row.Frame, LastFrame(row), row.TouchDown, row.Settled, row.LiftOff });
  }
  vtkDataArray* ids = poses->GetCellData()->GetArray(names::ObjectId);
  for (const char* name : { names::TouchDown, names::Settled })
  {
    vtkDataArray* begun = poses->GetCellData()->GetArray(name);
    for (vtkIdType i = 0; begun != nullptr && i < begun->GetNumberOfTuples(); ++i)
    {
      frames[static_cast<int>(ids->GetTuple1(i))].push_back(static_cast<int>(begun->GetTuple1(i)));
    }
  }
  return Result::Ok();
}

} // namespace

Result WriteAnimation(const std::string& fileName, vtkPolyData* data,
                      const std::vector<MotionObject>& objects, std::vector<Shape> bodies,
                      vtkPolyData* rows, SceneInfo info, Monitor& monitor,
                      std::vector<std::string>& warnings)
{
  std::vector<Track> tracks;
  std::vector<PoseTrack> poses;
  WAFT_RETURN_IF_FAILED(PosesFromPolyData(data, tracks, poses));
  info.Time.NumberOfFrames = static_cast<int>(tracks[0].Positions.size());
  std::vector<AnimatedShape> shapes;
  for (Shape& body : bodies)
  {
    AnimatedShape shape;
    shape.Body = std::move(body);
    if (!shape.Body.Texture.empty())
    {
      const Result read = ReadImageFile(shape.Body.Texture, shape.Texture);
      if (!read)
      {
        warnings.push_back("shape '" + shape.Body.Name + "': " + read.Message());
      }
    }
    else if (!shape.Body.Skin.empty())
    {
      shape.Texture = { shape.Body.Skin, "image/png" };
    }
    shapes.push_back(std::move(shape));
  }
  std::map<int, std::vector<int>> marks;
  if (rows != nullptr)
  {
    WAFT_RETURN_IF_FAILED(FramesOfMarks(rows, data, info.Time, marks));
  }
  const ShapesOfTracks shapeOf("Poses", objects, shapes.size());
  std::vector<AnimatedObject> animated;
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    int shapeId = 0;
    WAFT_RETURN_IF_FAILED(shapeOf.Find(tracks[i].ObjectId, shapeId));
    std::vector<float> sizes;
    for (std::size_t k = 0; tracks[i].ComesOrGoes() && k < tracks[i].Positions.size(); ++k)
    {
      sizes.push_back(static_cast<float>(tracks[i].SizeAt(k)));
    }
    animated.push_back({ tracks[i].ObjectId, static_cast<std::size_t>(shapeId),
                         std::move(tracks[i].Positions), std::move(poses[i].Orientations),
                         std::move(marks[tracks[i].ObjectId]), std::move(sizes),
                         tracks[i].LoopTo });
    poses[i] = PoseTrack();
  }
  return WriteAnimationGlb(fileName, shapes, std::move(animated), info.Time.FramesPerSecond,
                           monitor, rows != nullptr ? MostWholeKeys : AnyNumberOfKeys, info.Bounds);
}

} // namespace waft
