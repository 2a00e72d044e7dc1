// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/ShapeMeasures.h"
#include "Base/TemporaryFolder.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ShapeData.h"

#include <vtkFeatherShapeSource.h>
#include <vtkFieldData.h>
#include <vtkLeafShapeSource.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPhotographShapeSource.h>

#include <gtest/gtest.h>

#include <filesystem>

using namespace waft;

namespace
{

Shape OnlyShape(vtkMultiBlockDataSetAlgorithm* source)
{
  source->Update();
  std::vector<Shape> shapes;
  EXPECT_TRUE(ShapesFromMultiBlock(source->GetOutput(), shapes));
  EXPECT_EQ(shapes.size(), 1u);
  return shapes.empty() ? Shape() : shapes[0];
}

} // namespace

TEST(ShapeSources, EachKindIsAShapeWithItsSkin)
{
  const test::TemporaryFolder folder;
  const std::string skin = folder.File("skin.png");
  vtkNew<vtkLeafShapeSource> leaf;
  vtkNew<vtkFeatherShapeSource> feather;
  leaf->SetTextureFile(skin);
  leaf->SetTextureSize(64);
  feather->SetTextureFile(skin);
  feather->SetTextureSize(64);
  const char* const names[] = { "leaf",  "maple",   "oak",     "willow", "birch",
                                "aspen", "feather", "contour", "down" };
  for (int i = 0; i < 9; ++i)
  {
    SCOPED_TRACE(names[i]);
    std::filesystem::remove(skin);
    vtkMultiBlockDataSetAlgorithm* source = leaf;
    if (i < 6)
    {
      leaf->SetKind(i);
    }
    else
    {
      feather->SetKind(i - 6);
      source = feather;
    }
    const Shape shape = OnlyShape(source);
    EXPECT_EQ(shape.Name, names[i]);
    EXPECT_EQ(shape.Texture, skin);
    EXPECT_TRUE(std::filesystem::exists(skin));
    EXPECT_NEAR(LargestExtent(shape.Mesh), i < 6 ? 0.1 : 0.2, 1e-9);
    EXPECT_LT(ShellCentroid(shape.Mesh).norm(), 1e-9);
    EXPECT_EQ(RemarkOnFlatTriangles(shape.Mesh), "");
    EXPECT_EQ(shape.TextureCoordinates.size(), shape.Mesh.Points.size());
    EXPECT_TRUE(source->GetOutput()->GetFieldData()->HasArray(names::Bounds));
  }
}

TEST(ShapeSources, APhotographBecomesABody)
{
  // A painted maple leaf stands for the photograph.
  const test::TemporaryFolder folder;
  const std::string picture = folder.File("maple.png");
  vtkNew<vtkLeafShapeSource> leaf;
  leaf->SetKind(1);
  leaf->SetTextureFile(picture);
  leaf->SetTextureSize(300);
  leaf->Update();
  vtkNew<vtkPhotographShapeSource> photograph;
  photograph->SetPhotograph(picture);
  const Shape shape = OnlyShape(photograph);
  EXPECT_EQ(shape.Name, "maple");
  EXPECT_EQ(shape.Texture, picture);
  EXPECT_GT(shape.Mesh.Triangles.size(), 200u);
  EXPECT_EQ(RemarkOnFlatTriangles(shape.Mesh), "");
  EXPECT_EQ(shape.TextureCoordinates.size(), shape.Mesh.Points.size());
}

TEST(ShapeSources, ErrorsNameThePlaceAndLeaveNothing)
{
  vtkNew<vtkPhotographShapeSource> photograph;
  ErrorLog errors(photograph);
  photograph->Update();
  EXPECT_TRUE(errors.Contains("Photograph: expected the name of a picture")) << errors.Text;
  EXPECT_EQ(photograph->GetOutput()->GetNumberOfBlocks(), 0u);
  photograph->SetPhotograph("/no/such/leaf.png");
  photograph->Update();
  EXPECT_TRUE(errors.Contains("/no/such/leaf.png")) << errors.Text;
  vtkNew<vtkLeafShapeSource> leaf;
  ErrorLog more(leaf);
  leaf->SetTextureFile("/no/such/folder/skin.png");
  leaf->Update();
  EXPECT_TRUE(more.Contains("/no/such/folder/skin.png")) << more.Text;
  EXPECT_EQ(leaf->GetOutput()->GetNumberOfBlocks(), 0u);
}
