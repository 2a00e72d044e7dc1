// SPDX-License-Identifier: BSD-3-Clause
// A flight as `waft synthesize` wrote it.
#pragma once

#include "Base/Mesh.h"
#include "Base/Motion.h"
#include "Base/Pose.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"
#include "Constraints/Constraint.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <string>
#include <vector>

namespace waft
{

struct FlightResults
{
  SceneInfo Scene;
  std::vector<Track> Tracks;
  std::vector<PoseTrack> PoseTracks;
  std::vector<MotionObject> Objects;
  std::vector<Shape> Shapes;
  std::vector<ObstacleMesh> Obstacles;
  std::vector<Constraint> Constraints; // with what became of them
  vtkNew<vtkPolyData> Poses;           // the file, with all that is in it
};

/// Reads the folder of a report.json. The folder may be a stranger's: files are found by the names
/// that Waft gives them, and no other, and no link is followed; of textures, which are named, those
/// below it count. Fails with the path of what is missing or wrong; results is as it was then.
Result ReadResults(const std::string& report, FlightResults& results);

} // namespace waft
