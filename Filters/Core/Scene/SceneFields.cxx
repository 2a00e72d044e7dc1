// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneFields.h"

namespace waft
{

const std::vector<SceneFieldTable>& SceneFieldTables()
{
  static const std::vector<SceneFieldTable> tables = {
    { "scene",
      { "waft", "title", "seed", "time", "domain", "ground", "shapes", "objects", "constraints",
        "obstacles", "winds", "vortices", "air" } },
    { "time", { "frames", "framesPerSecond" } },
    { "domain", { "min", "max" } },
    { "ground", { "height", "enabled" } },
    { "air", { "density" } },
    { "shape",
      { "builtin", "mesh", "align", "texture", "size", "areaDensity", "thickness",
        "dragCoefficient", "settlingSpeed", "color", "class" } },
    { "singleObject",
      { "shape", "position", "id", "velocity", "orientation", "angularVelocity", "mass",
        "settlingSpeed", "clearanceRadius", "restHeight", "class" } },
    { "objectsInRegion",
      { "shape", "count", "region", "seed", "velocity", "orientation", "angularVelocity", "mass",
        "settlingSpeed", "clearanceRadius", "restHeight", "class" } },
    { "objectsAtPositions",
      { "shape", "positions", "velocity", "orientation", "angularVelocity", "mass", "settlingSpeed",
        "clearanceRadius", "restHeight", "class" } },
    { "region", { "min", "max" } },
    { "positionConstraint", { "kind", "object", "frame", "value", "radius" } },
    { "restConstraint", { "kind", "object", "frame", "until", "value" } },
    { "velocityConstraint", { "kind", "object", "frame", "value", "radius" } },
    { "accelerationConstraint", { "kind", "object", "frame", "value", "radius" } },
    { "orientationConstraint", { "kind", "object", "frame", "value", "radius" } },
    { "pathConstraint", { "kind", "object", "firstFrame", "points", "radius" } },
    { "keyframeConstraint",
      { "kind", "frame", "targets", "objects", "assign", "velocity", "until", "radius" } },
    { "pointTargets", { "points", "classes" } },
    { "textTargets", { "text", "font", "origin", "u", "v", "width", "count" } },
    { "imageTargets", { "image", "origin", "u", "v", "width", "count", "classes" } },
    { "meshTargets", { "mesh", "origin", "u", "v", "width", "count" } },
    { "boxObstacle", { "kind", "min", "max", "id", "motion" } },
    { "sphereObstacle", { "kind", "center", "radius", "id", "motion" } },
    { "cylinderObstacle", { "kind", "base", "top", "radius", "id", "motion" } },
    { "meshObstacle", { "kind", "file", "position", "scale", "id", "motion" } },
    { "motionKey", { "frame", "position" } },
    { "analyticWind", { "direction", "strength", "center", "radius", "centerTime", "duration" } },
    { "windFile", { "file" } },
    { "vortex", { "p1", "p2", "strength", "centerTime", "duration", "coreRadius" } },
  };
  return tables;
}

const SceneFieldTable& SceneFieldsOf(const std::string& name)
{
  static const SceneFieldTable none;
  for (const SceneFieldTable& table : SceneFieldTables())
  {
    if (table.Name == name)
    {
      return table;
    }
  }
  return none;
}

} // namespace waft
