// SPDX-License-Identifier: BSD-3-Clause
// Scene files of the project, a mesh that scenes of tests may name, and what the reader makes of
// them.
#pragma once

#include "Bridge/Data/ShapeData.h"

#include <vtkMotionSceneReader.h>
#include <vtkMultiBlockDataSet.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

inline std::string SceneFile(const std::string& name)
{
  return std::string(WAFT_SOURCE_DIR) + "/Data/Scenes/" + name;
}

/// An .obj file: a closed surface that is no box, sphere or cylinder, z up.
constexpr const char* Tetrahedron =
  "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

inline std::vector<waft::Shape> ShapesOf(vtkMotionSceneReader* reader)
{
  std::vector<waft::Shape> shapes;
  const waft::Result result = waft::ShapesFromMultiBlock(
    vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::SHAPES)),
    shapes);
  EXPECT_TRUE(result) << result.Message();
  return shapes;
}
