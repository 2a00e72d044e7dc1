// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshCuts.h"

#include "Bridge/Data/Columns.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Rotation/MeshCuts.h"

#include <vtkDataSetAttributes.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <map>

vtkStandardNewMacro(vtkMeshCuts);

namespace
{

/// A motion as it is read, and its views.
struct ReadMotion
{
  waft::SceneInfo Scene;
  std::vector<waft::Track> Tracks;
  std::vector<waft::PoseTrack> Poses;
  std::vector<waft::MotionObject> Objects;
  std::vector<waft::Shape> Shapes;
  std::vector<waft::Constraint> Rows;
  std::vector<waft::ContactMesh> Meshes;
  waft::PosedMotion Motion;
};

waft::Result Read(vtkPolyData* poses, vtkPolyData* objects, vtkMultiBlockDataSet* shapes,
                  vtkPolyData* rows, ReadMotion& read)
{
  WAFT_RETURN_IF_FAILED(waft::SceneInfoFromFieldData(poses, read.Scene));
  WAFT_RETURN_IF_FAILED(waft::PosesFromPolyData(poses, read.Tracks, read.Poses));
  WAFT_RETURN_IF_FAILED(waft::ObjectsFromPolyData(objects, read.Objects));
  WAFT_RETURN_IF_FAILED(waft::BodiesFromMultiBlock(shapes, read.Shapes));
  if (rows != nullptr && rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(waft::ConstraintsFromPolyData(rows, read.Scene.Time, read.Rows));
  }
  const waft::ShapesOfTracks shapeOf("Poses", read.Objects, read.Shapes.size());
  std::map<int, const waft::MotionObject*> objectOf;
  for (const waft::MotionObject& object : read.Objects)
  {
    objectOf[object.ObjectId] = &object;
  }
  for (const waft::Track& track : read.Tracks)
  {
    int shape = 0;
    WAFT_RETURN_IF_FAILED(shapeOf.Find(track.ObjectId, shape));
    read.Motion.Objects.push_back(objectOf[track.ObjectId]);
    if (track.Positions.size() != read.Tracks.front().Positions.size())
    {
      return waft::Result::Error("Poses: object " + std::to_string(track.ObjectId) + " has " +
                                 std::to_string(track.Positions.size()) +
                                 " frames, expected as many as the first: " +
                                 std::to_string(read.Tracks.front().Positions.size()));
    }
  }
  read.Meshes = waft::ContactMeshesOf(read.Shapes);
  read.Motion.Tracks = &read.Tracks;
  read.Motion.Poses = &read.Poses;
  read.Motion.Meshes = &read.Meshes;
  waft::TakeRests(read.Rows, read.Motion);
  return waft::Result::Ok();
}

} // namespace

std::string vtkMeshCuts::Find(vtkPolyData* poses, vtkPolyData* objects,
                              vtkMultiBlockDataSet* shapes, vtkPolyData* constraints,
                              vtkTable* cuts)
{
  if (poses == nullptr || objects == nullptr || shapes == nullptr || cuts == nullptr)
  {
    return "expected Poses, Objects, Shapes and a table, found none of one of them";
  }
  ReadMotion read;
  const waft::Result result = Read(poses, objects, shapes, constraints, read);
  if (!result)
  {
    return result.Message();
  }
  const waft::KeptDistances kept =
    waft::KeptOf(read.Motion, read.Rows, read.Scene.Time.FramesPerSecond);
  const std::vector<waft::MeshCut> found =
    waft::FindMeshCuts(read.Motion, kept, waft::TouchedDepth, waft::SmpFor());
  vtkFieldData* columns = cuts->GetRowData();
  waft::AddColumn(columns, "Frame", found, &waft::MeshCut::Frame);
  waft::AddColumn(columns, "ObjectA", found,
                  [&](const waft::MeshCut& cut) { return read.Tracks[cut.A].ObjectId; });
  waft::AddColumn(columns, "ObjectB", found,
                  [&](const waft::MeshCut& cut) { return read.Tracks[cut.B].ObjectId; });
  waft::AddColumn(columns, "NearMarks", found,
                  [](const waft::MeshCut& cut) { return cut.NearMarks ? 1 : 0; });
  return {};
}
