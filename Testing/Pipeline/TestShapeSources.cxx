// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"

#include "Base/ShapeMeasures.h"
#include "Base/TemporaryFolder.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/SceneFiles.h"

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
  leaf->SetTextureSize(64);
  feather->SetTextureSize(64);
  const char* const names[] = { "leaf",  "maple",   "oak",     "willow", "birch",
                                "aspen", "feather", "contour", "down" };
  for (int i = 0; i < 9; ++i)
  {
    SCOPED_TRACE(names[i]);
    vtkPaintedShapeSource* source = leaf;
    if (i < 6)
    {
      leaf->SetKind(i);
    }
    else
    {
      feather->SetKind(i - 6);
      source = feather;
    }
    source->SetSaveSkinAs(std::string());
    const Shape shape = OnlyShape(source);
    EXPECT_EQ(shape.Name, names[i]);
    EXPECT_EQ(shape.Texture, "");
    Picture painted, saved;
    EXPECT_EQ(LoadPictureOf(shape, painted).Message(), "");
    EXPECT_GT(painted.Width, 10);
    source->SetSaveSkinAs(skin);
    const Shape named = OnlyShape(source);
    EXPECT_EQ(named.Texture, skin);
    EXPECT_EQ(named.Skin, "");
    EXPECT_EQ(LoadPictureOf(named, saved).Message(), "");
    EXPECT_EQ(saved.Pixels, painted.Pixels);
    EXPECT_NEAR(LargestExtent(shape.Mesh), i < 6 ? 0.1 : 0.2, 1e-9);
    EXPECT_LT(ShellCentroid(shape.Mesh).norm(), 1e-9);
    EXPECT_EQ(RemarkOnFlatTriangles(shape.Mesh), "");
    EXPECT_EQ(shape.TextureCoordinates.size(), shape.Mesh.Points.size());
    EXPECT_TRUE(source->GetOutput()->GetFieldData()->HasArray(names::Bounds));
  }
}

TEST(ShapeSources, SavingASkinLeavesFilesOfOthersAlone)
{
  const test::TemporaryFolder folder;
  const std::string own = folder.Write("own.png", "somebody's");
  vtkNew<vtkFeatherShapeSource> feather;
  feather->SetTextureSize(32);
  const std::string skin = OnlyShape(feather).Skin;
  ErrorLog errors(feather);
  feather->SetTextureFile(own);
  feather->Update();
  EXPECT_TRUE(errors.Contains("Save Skin As: " + own + ": nothing was written")) << errors.Text;
  EXPECT_EQ(std::filesystem::file_size(own), 10u);
  errors.Text.clear();
  const std::string former = folder.Write("former.png", skin); // without a mark
  feather->SetSaveSkinAs(former);
  feather->Update();
  EXPECT_GT(std::filesystem::file_size(former), skin.size());
  feather->SetVeinColor(1.0, 0.0, 0.0); // its own
  feather->Update();
  EXPECT_EQ(errors.Text, "");
  EXPECT_EQ(feather->GetOutput()->GetNumberOfBlocks(), 1u);
  std::filesystem::resize_file(former, std::filesystem::file_size(former) - 1);
  feather->SetVeinColor(0.0, 1.0, 0.0); // changed since
  feather->Update();
  EXPECT_TRUE(errors.Contains(former + ": nothing was written")) << errors.Text;
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
