// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/SceneBlocks.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstring>

namespace waft
{
namespace
{

constexpr const char* Title = "Title";

enum Block : unsigned int
{
  ObjectsBlock,
  ConstraintsBlock,
  ObstaclesBlock,
  ShapesBlock,
  VorticesBlock,
  WindBlock
};

void SetBlock(vtkMultiBlockDataSet* data, unsigned int at, const char* name, vtkDataObject* block)
{
  data->SetBlock(at, block);
  data->GetMetaData(at)->Set(vtkCompositeDataSet::NAME(), name);
}

/// The block of a name and type, null when there is none.
template <typename Type>
Type* FindBlock(vtkMultiBlockDataSet* data, const char* name)
{
  for (unsigned int i = 0; i < data->GetNumberOfBlocks(); ++i)
  {
    const char* known =
      data->HasMetaData(i) ? data->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : nullptr;
    if (known && std::strcmp(known, name) == 0)
    {
      return Type::SafeDownCast(data->GetBlock(i));
    }
  }
  return nullptr;
}

std::string MotionName(int obstacleId)
{
  return "Motion " + std::to_string(obstacleId);
}

Result ObstaclesFromBlock(vtkPolyData* block, const Timeline& line,
                          std::vector<ObstacleMesh>& obstacles)
{
  ObstacleCollector collector;
  WAFT_RETURN_IF_FAILED(collector.Add(block, 0.0, line));
  obstacles = collector.Take();
  for (ObstacleMesh& obstacle : obstacles)
  {
    const std::string name = MotionName(obstacle.ObstacleId);
    if (vtkDataArray* array = block->GetFieldData()->GetArray(name.c_str()))
    {
      WAFT_RETURN_IF_FAILED(ReadVectors(
        { block->GetFieldData(), "Obstacles: field data array", array->GetNumberOfTuples() },
        name.c_str(), obstacle.Offsets));
    }
  }
  return Result::Ok();
}

} // namespace

void SceneToBlocks(const SceneContents& scene, vtkMultiBlockDataSet* data)
{
  const Scene& parts = scene.Parts;
  const SceneInfo& info = parts.Info;
  vtkNew<vtkPolyData> objects, constraints, obstacles, vortices;
  vtkNew<vtkMultiBlockDataSet> shapes, wind;
  ObjectsToPolyData(parts.Objects, info, objects);
  AddArrivals(parts.Constraints, {}, objects);
  ConstraintsToPolyData(parts.Constraints, info, constraints);
  ObstaclesToPolyData(parts.Obstacles, 0.0, info, obstacles);
  AuthoredToFieldData(parts.Authored.Objects, objects);
  AuthoredToFieldData(parts.Authored.Constraints, constraints);
  AuthoredToFieldData(parts.Authored.Obstacles, obstacles);
  for (const ObstacleMesh& obstacle : parts.Obstacles)
  {
    if (obstacle.IsMoving())
    {
      AddVectors(obstacles->GetFieldData(), MotionName(obstacle.ObstacleId).c_str(),
                 obstacle.Offsets);
    }
  }
  VorticesToPolyData(parts.Vortices, info, vortices);
  ShapesToMultiBlock(parts.Shapes, info, shapes);
  for (std::size_t step = 0; step < scene.Wind.Times.size(); ++step)
  {
    vtkNew<vtkImageData> image;
    FieldSeriesToImage(scene.Wind, scene.Wind.Times[step], info, image);
    AddDoubles(image->GetFieldData(), names::Time, { scene.Wind.Times[step] });
    AuthoredToFieldData(parts.Authored.Winds, image);
    wind->SetBlock(static_cast<unsigned int>(step), image);
  }
  data->Initialize();
  SetBlock(data, ObjectsBlock, "Objects", objects);
  SetBlock(data, ConstraintsBlock, "Constraints", constraints);
  SetBlock(data, ObstaclesBlock, "Obstacles", obstacles);
  SetBlock(data, ShapesBlock, "Shapes", shapes);
  SetBlock(data, VorticesBlock, "Vortices", vortices);
  SetBlock(data, WindBlock, "Wind", wind);
  AddStrings(data->GetFieldData(), Title, { parts.Title });
  SceneInfoToFieldData(info, data);
}

Result SceneFromBlocks(vtkMultiBlockDataSet* data, SceneContents& scene)
{
  SceneContents read;
  Scene& parts = read.Parts;
  auto* objects = FindBlock<vtkPolyData>(data, "Objects");
  if (objects == nullptr)
  {
    return Result::Error("the scene: expected a block `Objects`, found none");
  }
  WAFT_RETURN_IF_FAILED(SceneInfoFromFieldData(data, parts.Info));
  WAFT_RETURN_IF_FAILED(SceneInfoFromFieldData(objects, parts.Info));
  if (objects->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(ObjectsFromPolyData(objects, parts.Objects));
  }
  parts.Authored.Objects = AuthoredFromFieldData(objects);
  auto* constraints = FindBlock<vtkPolyData>(data, "Constraints");
  parts.Authored.Constraints = AuthoredFromFieldData(constraints);
  if (constraints && constraints->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(ConstraintsFromPolyData(constraints, parts.Info.Time, parts.Constraints));
  }
  auto* obstacles = FindBlock<vtkPolyData>(data, "Obstacles");
  parts.Authored.Obstacles = AuthoredFromFieldData(obstacles);
  if (obstacles && obstacles->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(ObstaclesFromBlock(obstacles, parts.Info.Time, parts.Obstacles));
  }
  if (auto* shapes = FindBlock<vtkMultiBlockDataSet>(data, "Shapes"))
  {
    WAFT_RETURN_IF_FAILED(ShapesFromMultiBlock(shapes, parts.Shapes));
  }
  if (auto* vortices = FindBlock<vtkPolyData>(data, "Vortices"))
  {
    WAFT_RETURN_IF_FAILED(VorticesFromPolyData(vortices, parts.Vortices));
  }
  if (auto* wind = FindBlock<vtkMultiBlockDataSet>(data, "Wind"))
  {
    FieldCollector collector;
    for (unsigned int step = 0; step < wind->GetNumberOfBlocks(); ++step)
    {
      auto* image = vtkImageData::SafeDownCast(wind->GetBlock(step));
      vtkDataArray* time = image ? image->GetFieldData()->GetArray(names::Time) : nullptr;
      if (time == nullptr || time->GetNumberOfTuples() == 0 ||
          !limits::Time.Holds(time->GetComponent(0, 0)))
      {
        return Result::Error("Wind: block " + std::to_string(step) +
                             ": expected an image with the field data `Time`");
      }
      parts.Authored.Winds = AuthoredFromFieldData(image);
      WAFT_RETURN_IF_FAILED(collector.Add(image, time->GetComponent(0, 0)));
    }
    read.Wind = collector.Take();
  }
  parts.Title = FirstString(data->GetFieldData(), Title);
  scene = std::move(read);
  return Result::Ok();
}

} // namespace waft
