// SPDX-License-Identifier: BSD-3-Clause
// Meshes and photographs that a scene file names, as shapes and obstacles of the reader.
#include "PipelineTesting.h"
#include "SceneSources.h"

#include "Base/ShapeMeasures.h"
#include "Base/TemporaryFolder.h"

#include <vtkLeafShapeSource.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

TEST(SceneShapes, MeshesOfShapesAndObstacles)
{
  waft::test::TemporaryFolder folder;
  folder.Write("body.obj", Tetrahedron);
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "ground": {"enabled": false},
    "shapes": {"own": {"mesh": "body.obj", "size": 0.3}},
    "objects": [{"shape": "own", "position": [0, 0, 3]}],
    "obstacles": [{"kind": "mesh", "file": "body.obj", "scale": 0.5, "position": [1, 0, 0]}]})"));
  reader->Update();
  const std::vector<waft::Shape> shapes = ShapesOf(reader);
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].Name, "own");
  EXPECT_NEAR(waft::LargestExtent(shapes[0].Mesh), 0.3, 1e-12);
  EXPECT_LT(waft::ShellCentroid(shapes[0].Mesh).norm(), 1e-12);
  double bounds[6];
  vtkPolyData::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::OBSTACLES))
    ->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], 1.0, 1e-12);
  EXPECT_NEAR(bounds[1], 2.0, 1e-12);
}

TEST(SceneShapes, NoPolygonIsLeftOut)
{
  // A quad that crosses itself, one that is bent far and a flat one, each of two triangles.
  const waft::test::TemporaryFolder folder;
  folder.Write("body.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 7\nv 1 1 1\n"
                           "v 0 1 6\nf 1 2 3 4\nf 5 6 7 8\nf 1 3 2 4\n");
  // The same and a strip of two.
  folder.Write("body.vtp", R"(<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">
    <PolyData><Piece NumberOfPoints="8" NumberOfStrips="1" NumberOfPolys="3">
    <Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
      0 0 0 1 1 0 1 0 0 0 1 0 0 0 1 1 0 7 1 1 1 0 1 6</DataArray></Points>
    <Strips><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
      <DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Strips>
    <Polys><DataArray type="Int64" Name="connectivity" format="ascii">
        0 1 2 3 4 5 6 7 0 2 1 3</DataArray>
      <DataArray type="Int64" Name="offsets" format="ascii">4 8 12</DataArray></Polys>
    </Piece></PolyData></VTKFile>)");
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "shapes": {
    "own": {"mesh": "body.obj", "size": 0.3}, "vtk": {"mesh": "body.vtp", "size": 0.3}}})"));
  reader->Update();
  const std::vector<waft::Shape> shapes = ShapesOf(reader);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].Mesh.Triangles.size(), 6u);
  EXPECT_EQ(shapes[1].Mesh.Triangles.size(), 8u);
  EXPECT_EQ(shapes[1].Mesh.Triangles[6], (std::array<int, 3>{ 0, 1, 2 }));
  EXPECT_EQ(shapes[1].Mesh.Triangles[7], (std::array<int, 3>{ 2, 1, 3 }));
}

TEST(SceneShapes, TrianglesWithoutAreaAreReportedWithTheirMesh)
{
  waft::test::TemporaryFolder folder;
  folder.Write("body.obj", std::string(Tetrahedron) + "f 1 2 1\n");
  folder.Write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  vtkNew<vtkMotionSceneReader> reader;
  for (const char* align : { "true", "false" })
  {
    ErrorLog warnings(reader, vtkCommand::WarningEvent);
    ErrorLog errors(reader);
    const std::string taken = std::string("\", \"align\": ") + align + "}}}";
    reader->SetFileName(
      folder.Write(std::string("a") + align + ".waft.json",
                   R"({"waft": 1, "shapes": {"own": {"mesh": "body.obj)" + taken));
    reader->Update();
    EXPECT_EQ(errors.Text, "");
    EXPECT_TRUE(warnings.Contains("/shapes/own/mesh: \"body.obj\": 1 of 5 triangles has no area"))
      << warnings.Text;
    reader->SetFileName(
      folder.Write(std::string("b") + align + ".waft.json",
                   R"({"waft": 1, "shapes": {"own": {"mesh": "line.obj)" + taken));
    reader->Update();
    EXPECT_TRUE(errors.Contains("/shapes/own/mesh: expected a surface with an area, found none"))
      << errors.Text;
  }
}

TEST(SceneShapes, APhotographIsAShape)
{
  waft::test::TemporaryFolder folder;
  vtkNew<vtkLeafShapeSource> painted; // stands for the photograph
  painted->SetKind(1);
  painted->SetTextureFile(folder.File("leaf.png"));
  painted->SetTextureSize(300);
  painted->Update();
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1,
    "shapes": {"mine": {"mesh": "leaf.png", "size": 0.3, "areaDensity": 0.07}},
    "objects": [{"shape": "mine", "position": [0, 0, 3]}]})"));
  reader->Update();
  const std::vector<waft::Shape> shapes = ShapesOf(reader);
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].Name, "mine");
  EXPECT_EQ(shapes[0].Texture, folder.File("leaf.png"));
  EXPECT_EQ(shapes[0].AreaDensity, 0.07);
  EXPECT_NEAR(waft::LargestExtent(shapes[0].Mesh), 0.3, 1e-9);
  EXPECT_LT(waft::ShellCentroid(shapes[0].Mesh).norm(), 1e-9);
  EXPECT_EQ(shapes[0].TextureCoordinates.size(), shapes[0].Mesh.Points.size());
  // A leaf and not its rectangle: about 0.4 of the square, and curled.
  EXPECT_LT(waft::SurfaceArea(shapes[0].Mesh), 0.7 * 0.3 * 0.3);
  EXPECT_GT(waft::RestHeight(shapes[0]), 0.002);

  ErrorLog errors(reader);
  folder.Write("none.png", "no picture");
  reader->SetFileName(folder.Write("b.waft.json", R"({"waft": 1,
    "shapes": {"mine": {"mesh": "none.png"}}, "objects": []})"));
  reader->Update();
  EXPECT_TRUE(errors.Contains("/shapes/mine/mesh")) << errors.Text;
}
