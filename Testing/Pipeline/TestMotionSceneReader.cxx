// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"
#include "SceneSources.h"

#include "Base/TemporaryFolder.h"

#include "Base/ShapeMeasures.h"
#include "Bridge/ConstraintData.h"
#include "Bridge/SceneData.h"
#include "Bridge/SceneFiles.h"
#include "Bridge/ShapeData.h"

#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLeafShapeSource.h>
#include <vtkMotionSceneReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataWriter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace
{

vtkPolyData* PolyOutput(vtkAlgorithm* reader, int port)
{
  return vtkPolyData::SafeDownCast(reader->GetOutputDataObject(port));
}

vtkImageData* WindOutput(vtkAlgorithm* reader)
{
  return vtkImageData::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::WIND));
}

void WriteWind(const std::string& file, const char* array, float value)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  image->SetOrigin(-2.0, -2.0, 0.0);
  image->SetSpacing(2.0, 2.0, 2.0);
  vtkNew<vtkFloatArray> values;
  values->SetName(array);
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(27);
  for (vtkIdType i = 0; i < 27; ++i)
  {
    values->SetTuple3(i, value, 0.0, 2.0 * value);
  }
  image->GetPointData()->AddArray(values);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->Write();
}

} // namespace

TEST(MotionSceneReader, EveryPortCarriesTheSceneAndItsFrames)
{
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(SceneFile("leaves-letters.waft.json"));
  reader->Update();
  ASSERT_EQ(reader->GetNumberOfOutputPorts(), 6);
  for (int port = 0; port < 6; ++port)
  {
    SCOPED_TRACE(port);
    waft::SceneInfo info;
    info.Time.NumberOfFrames = 7;
    info.Seed = 99;
    ASSERT_TRUE(waft::SceneInfoFromFieldData(reader->GetOutputDataObject(port), info));
    EXPECT_EQ(info.Time.NumberOfFrames, 300);
    EXPECT_EQ(info.Seed, 7u);
    EXPECT_EQ(TimeSteps(reader, port).size(), 300u);
  }
  EXPECT_EQ(WindOutput(reader)->GetNumberOfPoints(), 0);
  EXPECT_EQ(PolyOutput(reader, vtkMotionSceneReader::VORTICES)->GetNumberOfCells(), 0);
  EXPECT_EQ(PolyOutput(reader, vtkMotionSceneReader::OBSTACLES)->GetNumberOfPoints(), 8)
    << "the ground";
}

TEST(MotionSceneReader, TheScenesOfTheProjectCanBeFlown)
{
  for (const char* name : { "leaves-letters.waft.json", "feather-waypoints.waft.json",
                            "feather-spiral.waft.json", "feather-maze.waft.json" })
  {
    SCOPED_TRACE(name);
    vtkNew<vtkMotionSceneReader> reader;
    reader->SetFileName(SceneFile(name));
    reader->Update();
    std::vector<waft::MotionObject> objects;
    std::vector<waft::Constraint> rows;
    std::vector<waft::Shape> shapes;
    waft::SceneInfo info;
    ASSERT_TRUE(
      waft::SceneInfoFromFieldData(PolyOutput(reader, vtkMotionSceneReader::OBJECTS), info));
    ASSERT_TRUE(
      waft::ObjectsFromPolyData(PolyOutput(reader, vtkMotionSceneReader::OBJECTS), objects));
    ASSERT_TRUE(waft::ConstraintsFromPolyData(PolyOutput(reader, vtkMotionSceneReader::CONSTRAINTS),
                                              info.Time, rows));
    ASSERT_TRUE(waft::ShapesFromMultiBlock(
      vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::SHAPES)),
      shapes));
    for (const waft::MotionObject& a : objects)
    {
      EXPECT_GT(info.Bounds.InnerDistance(a.Position), 2.0 * a.ClearanceRadius);
      EXPECT_GT(a.RestHeight, 0.0);
      for (const waft::MotionObject& b : objects)
      {
        EXPECT_TRUE(a.ObjectId == b.ObjectId || (a.Position - b.Position).norm() >
                                                  2.0 * (a.ClearanceRadius + b.ClearanceRadius));
      }
      EXPECT_FALSE(shapes[static_cast<std::size_t>(a.ShapeId)].Texture.empty());
    }
    for (const waft::Constraint& a : rows)
    {
      EXPECT_TRUE(info.Bounds.Contains(a.Value));
      for (const waft::Constraint& b : rows)
      {
        const bool isPair = a.Row == b.Row && a.Target < b.Target;
        EXPECT_TRUE(!isPair || (a.Value - b.Value).norm() > 0.8 * 0.18)
          << (a.Value - b.Value).norm();
      }
    }
    // From each mark the farthest start is within reach at a speed well under 1.3 m/s.
    for (const waft::Constraint& row : rows)
    {
      for (const waft::MotionObject& object : objects)
      {
        const double speed = (row.Value - object.Position).norm() / info.Time.Time(row.Frame);
        EXPECT_LT(speed, 0.8);
      }
    }
  }
}

TEST(MotionSceneReader, MovingObstaclesAndWindsFollowTheTime)
{
  waft::test::TemporaryFolder folder;
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "time": {"frames": 61},
    "ground": {"enabled": false},
    "obstacles": [{"kind": "box", "min": [0, 0, 1], "max": [1, 1, 2], "motion":
      [{"frame": 0, "position": [0, 0, 0]}, {"frame": 60, "position": [1, 0, 0]}]}],
    "winds": [{"direction": [0, 1, 0], "strength": 2, "center": [0, 0, 2], "radius": 1.5,
      "centerTime": 1, "duration": 0.5}]})"));
  const auto left = [&](double time)
  {
    reader->UpdateInformation();
    for (const int port : { vtkMotionSceneReader::OBSTACLES, vtkMotionSceneReader::WIND })
    {
      reader->GetOutputInformation(port)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(),
                                              time);
      reader->Update(port);
    }
    double bounds[6];
    PolyOutput(reader, vtkMotionSceneReader::OBSTACLES)->GetBounds(bounds);
    return bounds[0];
  };
  EXPECT_NEAR(left(1.0), 0.5, 1e-12);
  EXPECT_NEAR(left(0.0), 0.0, 1e-12);
  EXPECT_NEAR(left(2.0), 1.0, 1e-12);
  EXPECT_NEAR(left(0.5), 0.25, 1e-12);
  vtkImageData* wind = WindOutput(reader);
  vtkDataArray* values = wind->GetPointData()->GetArray("Wind");
  ASSERT_TRUE(values);
  const vtkIdType center = wind->FindPoint(0.0, 0.0, 2.0);
  EXPECT_NEAR(values->GetComponent(center, 1), 2.0 * std::exp(-0.5), 1e-6);
  EXPECT_EQ(values->GetComponent(center, 0), 0.0);
}

TEST(MotionSceneReader, ReadsTheSceneOnceForAllFrames)
{
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(SceneFile("feather-waypoints.waft.json"));
  reader->Update();
  ExecutionCount count(reader);
  reader->Update();
  EXPECT_EQ(count.Value, 0);
}

TEST(MotionSceneReader, MeshesOfShapesAndObstacles)
{
  waft::test::TemporaryFolder folder;
  folder.Write("body.obj", Tetrahedron);
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(folder.Write("a.waft.json", R"({"waft": 1, "ground": {"enabled": false},
    "shapes": {"own": {"mesh": "body.obj", "size": 0.3}},
    "objects": [{"shape": "own", "position": [0, 0, 3]}],
    "obstacles": [{"kind": "mesh", "file": "body.obj", "scale": 0.5, "position": [1, 0, 0]}]})"));
  reader->Update();
  std::vector<waft::Shape> shapes;
  ASSERT_TRUE(waft::ShapesFromMultiBlock(
    vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::SHAPES)),
    shapes));
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].Name, "own");
  EXPECT_NEAR(waft::LargestExtent(shapes[0].Mesh), 0.3, 1e-12);
  EXPECT_LT(waft::ShellCentroid(shapes[0].Mesh).norm(), 1e-12);
  double bounds[6];
  PolyOutput(reader, vtkMotionSceneReader::OBSTACLES)->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], 1.0, 1e-12);
  EXPECT_NEAR(bounds[1], 2.0, 1e-12);
}

TEST(MotionSceneReader, TrianglesWithoutAreaAreToldWithTheirMesh)
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

TEST(MotionSceneReader, APhotographIsAShape)
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
  std::vector<waft::Shape> shapes;
  ASSERT_TRUE(waft::ShapesFromMultiBlock(
    vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::SHAPES)),
    shapes));
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

TEST(MotionSceneReader, WindFilesAndSeries)
{
  waft::test::TemporaryFolder folder;
  WriteWind(folder.File("a.vti"), "Wind", 1.f);
  WriteWind(folder.File("b.vti"), "Wind", 3.f);
  WriteWind(folder.File("v.vti"), "Velocity", 1.f);
  folder.Write("series.pvd", R"(<VTKFile type="Collection"><Collection>
    <DataSet timestep="0" file="a.vti"/><DataSet timestep="2" file="b.vti"/>
    </Collection></VTKFile>)");
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(
    folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "series.pvd"}]})"));
  reader->UpdateInformation();
  reader->GetOutputInformation(5)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 1.0);
  reader->Update(5);
  vtkDataArray* values = WindOutput(reader)->GetPointData()->GetArray("Wind");
  ASSERT_TRUE(values);
  EXPECT_EQ(values->GetNumberOfTuples(), 27);
  EXPECT_NEAR(values->GetComponent(13, 0), 2.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(13, 2), 4.0, 1e-6);

  reader->SetFileName(folder.Write("v.waft.json", R"({"waft": 1, "winds": [{"file": "v.vti"}]})"));
  reader->Update(5);
  EXPECT_TRUE(WindOutput(reader)->GetPointData()->HasArray("Velocity"));
  EXPECT_FALSE(WindOutput(reader)->GetPointData()->HasArray("Wind"));

  ErrorLog errors(reader);
  reader->SetFileName(folder.Write(
    "mixed.waft.json", R"({"waft": 1, "winds": [{"file": "v.vti"}, {"file": "a.vti"}]})"));
  reader->Update();
  EXPECT_TRUE(errors.Contains("/winds/0/file: expected the only wind")) << errors.Text;
}

// Fixtures/wind_0000.vdb and wind_0030.vdb: 5^3 voxels of 1 m from (-2, -2, 0) on with
// Wind = (s, s / 2, x), s = 1 and 3.
TEST(MotionSceneReader, VolumesAreASeriesByTheirNumbers)
{
  waft::test::TemporaryFolder folder;
  const std::string fixtures = std::string(WAFT_SOURCE_DIR) + "/Testing/Pipeline/Fixtures";
  for (const char* name : { "wind_0000.vdb", "wind_0030.vdb" })
  {
    std::filesystem::copy_file(fixtures + "/" + name, folder.File(name));
  }
  vtkNew<vtkMotionSceneReader> reader;
  reader->SetFileName(
    folder.Write("a.waft.json", R"({"waft": 1, "winds": [{"file": "wind_0000.vdb"}]})"));
  reader->UpdateInformation();
  reader->GetOutputInformation(5)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 0.5);
  reader->Update(5);
  vtkDataArray* values = WindOutput(reader)->GetPointData()->GetArray("Wind");
  ASSERT_TRUE(values);
  ASSERT_EQ(values->GetNumberOfTuples(), 125);
  const vtkIdType place = WindOutput(reader)->FindPoint(1.0, 0.0, 3.0);
  EXPECT_NEAR(values->GetComponent(place, 0), 2.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(place, 1), 1.0, 1e-6);
  EXPECT_NEAR(values->GetComponent(place, 2), 1.0, 1e-6);
}

TEST(MotionSceneReader, ErrorsNameThePlaceAndEmptyTheOutputs)
{
  waft::test::TemporaryFolder folder;
  folder.Write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.Write("broken.ply", "this is no ply file\n");
  const std::string cases[][2] = {
    { R"({"waft": 1, "colour": 2})", "/colour: expected one of the fields" },
    { R"({"waft": 1,)", "line 1, column" },
    { R"({"waft": 1, "obstacles": [{"kind": "mesh", "file": "open.obj"}]})", "/obstacles/0" },
    { R"({"waft": 1, "obstacles": [{"kind": "mesh", "file": "broken.ply"}]})",
      "/obstacles/0/file: expected a" },
    { R"({"waft": 1, "shapes": {"a": {"mesh": "none.stl"}}})", "/shapes/a/mesh: expected a file" },
  };
  vtkNew<vtkMotionSceneReader> reader;
  for (const auto& bad : cases)
  {
    reader->SetFileName(SceneFile("feather-waypoints.waft.json"));
    reader->Update();
    ASSERT_EQ(PolyOutput(reader, vtkMotionSceneReader::OBJECTS)->GetNumberOfPoints(), 1);
    ErrorLog errors(reader);
    reader->SetFileName(folder.Write("bad.waft.json", bad[0]));
    reader->Update();
    EXPECT_TRUE(errors.Contains("bad.waft.json: " + bad[1]) || errors.Contains(bad[1]))
      << bad[0] << "\n"
      << errors.Text;
    EXPECT_TRUE(errors.Contains("bad.waft.json: ")) << errors.Text;
    for (const int port : { 0, 1, 2, 4 })
    {
      EXPECT_EQ(PolyOutput(reader, port)->GetNumberOfPoints(), 0) << port;
    }
    EXPECT_EQ(
      vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(vtkMotionSceneReader::SHAPES))
        ->GetNumberOfBlocks(),
      0u);
  }
  ErrorLog errors(reader);
  reader->SetFileName("/nowhere/x.waft.json");
  reader->Update();
  EXPECT_TRUE(errors.Contains("/nowhere/x.waft.json: expected a scene file")) << errors.Text;
  reader->SetFileName("");
  reader->Update();
  EXPECT_TRUE(errors.Contains("FileName: expected a scene file")) << errors.Text;
}

TEST(SceneFiles, TextIsDrawnAndCropped)
{
  const waft::VtkSceneAssets assets;
  waft::Picture picture;
  ASSERT_TRUE(assets.DrawText("WAFT", "sans", picture));
  EXPECT_GT(picture.Width, 2 * picture.Height);
  double ink = 0.0;
  double edges = 0.0;
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      const double alpha = picture.Pixels[static_cast<std::size_t>(y * picture.Width + x)][3];
      ink += alpha / (picture.Width * picture.Height);
      edges += y == 0 || y == picture.Height - 1 ? alpha : 0.0;
    }
  }
  EXPECT_GT(ink, 0.1);
  EXPECT_LT(ink, 0.6);
  EXPECT_GT(edges, 0.0) << "cropped to the ink";
  // The right way up: the bar of a T is at the top.
  ASSERT_TRUE(assets.DrawText("T", "sans", picture));
  double top = 0.0;
  double bottom = 0.0;
  for (int x = 0; x < picture.Width; ++x)
  {
    top += picture.Pixels[static_cast<std::size_t>((picture.Height - 3) * picture.Width + x)][3];
    bottom += picture.Pixels[static_cast<std::size_t>(2 * picture.Width + x)][3];
  }
  EXPECT_GT(top, 3.0 * bottom);
  EXPECT_FALSE(assets.DrawText(" ", "sans", picture));
}

TEST(SceneFiles, PicturesAreRead)
{
  const waft::VtkSceneAssets assets;
  waft::Picture picture;
  const waft::Result result =
    assets.LoadPicture(std::string(WAFT_SOURCE_DIR) + "/Data/Shapes/leaf-green.png", picture);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_EQ(picture.Width, 384);
  EXPECT_EQ(picture.Pixels[0][3], 0.f) << "a corner is clear";
  EXPECT_FALSE(assets.LoadPicture(std::string(WAFT_SOURCE_DIR) + "/LICENSE", picture));
}
