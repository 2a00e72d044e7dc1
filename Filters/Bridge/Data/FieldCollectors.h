// SPDX-License-Identifier: BSD-3-Clause
// Surfaces and fields that vary in time, gathered step by step into the form that Core reads, and
// lattices of Core as images.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Bridge/Data/FieldArrays.h"

#include <vtkType.h>

#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkImageData;
class vtkPolyData;

namespace waft
{

/// Triangles of a surface (polygons are fanned, strips refused); owner: for messages.
Result MeshFromPolyData(vtkPolyData* data, const std::string& owner, TriangleMesh& mesh);

/// Obstacles as one surface with the point data `ObstacleId`.
void ObstaclesToPolyData(const std::vector<ObstacleMesh>& obstacles, double frame,
                         const SceneInfo& info, vtkPolyData* data);
/// Gives a shallow copy of such a surface the points of another frame.
void MoveObstacles(const std::vector<ObstacleMesh>& obstacles, double frame, vtkPolyData* data);

/// Gathers the obstacles over the steps of a time-varying surface. Every obstacle may move, not
/// turn or deform. Without `ObstacleId` what hangs together is one. Blocks are put together: an id
/// that an earlier block has as well becomes the least that none has.
class ObstacleCollector
{
public:
  /// The surface, or blocks of surfaces, at one time [s]; one without points adds nothing. Steps
  /// come in increasing order of time (the same step again is passed over, an earlier one refused).
  /// Data whose points did not change since the last step cost nothing, and where points alone did
  /// nothing but these is read.
  Result Add(vtkDataObject* data, double time, const Timeline& line);
  std::vector<ObstacleMesh> Take();

private:
  Result Split(const std::vector<vtkPolyData*>& surfaces, double time);
  Result Move(const std::vector<vtkPolyData*>& surfaces, double time, const Timeline& line);

  std::vector<ObstacleMesh> Obstacles;            // as they stood first, displaced at the steps
  std::vector<std::vector<std::size_t>> PointsOf; // of each, in all surfaces one after another
  std::vector<int> Frames;                        // of the steps seen
  std::vector<vtkMTimeType> LastChange;           // of the points of each surface
  std::vector<vtkMTimeType> LastLayout;           // of the triangles and ids of each
  double LastTime = 0.0;
};

/// Gathers the steps of a time-varying image.
class FieldCollector
{
public:
  /// array: as FindField has it.
  explicit FieldCollector(FieldRole role = FieldRole::Wind, std::string array = {}) :
    Role(role), Array(std::move(array))
  {
  }
  /// As that of ObstacleCollector.
  Result Add(vtkImageData* data, double time);
  /// Those since the last call.
  FieldSeries Take();

private:
  FieldRole Role; // errors begin with its name
  std::string Array;
  FieldSeries Series; // not yet taken
  bool HasLattice = false;
  double LastTime = 0.0;
};

/// A series at a time as an image with the array `Wind` or `Velocity`, at one of its own times to
/// the last bit; without a point where the series has none.
void FieldSeriesToImage(const FieldSeries& series, double time, const SceneInfo& info,
                        vtkImageData* data);

} // namespace waft
