// SPDX-License-Identifier: BSD-3-Clause
#include "PipelineTesting.h"
#include "SceneSources.h"

#include "Base/TemporaryFolder.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Files/SceneFiles.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <cmath>

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
    const std::vector<waft::Shape> shapes = ShapesOf(reader);
    waft::SceneInfo info;
    ASSERT_TRUE(
      waft::SceneInfoFromFieldData(PolyOutput(reader, vtkMotionSceneReader::OBJECTS), info));
    ASSERT_TRUE(
      waft::ObjectsFromPolyData(PolyOutput(reader, vtkMotionSceneReader::OBJECTS), objects));
    ASSERT_TRUE(waft::ConstraintsFromPolyData(PolyOutput(reader, vtkMotionSceneReader::CONSTRAINTS),
                                              info.Time, rows));
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
      [{"frame": 0, "position": [0.5, 0.5, 1.5]}, {"frame": 60, "position": [1.5, 0.5, 1.5]}]}],
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
  const vtkIdType center = PointAt(wind, 0.0, 0.0, 2.0);
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
      "/obstacles/0/file: expected the signature of a PLY mesh" },
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

namespace
{

// A TIFF of 3 x 2 pixels, abc above def, with a note of how it was held.
std::string HeldTiff(int orientation)
{
  const auto number = [](int value, int size)
  {
    std::string bytes;
    for (int i = 0; i < size; ++i)
    {
      bytes += static_cast<char>(value >> 8 * i);
    }
    return bytes;
  };
  std::string file = std::string("II*\0", 4) + number(8, 4) + number(9, 2);
  for (const auto& [tag, value] :
       { std::pair(256, 3), std::pair(257, 2), std::pair(258, 8), std::pair(259, 1),
         std::pair(262, 1), std::pair(273, 122), std::pair(274, orientation), std::pair(277, 1),
         std::pair(279, 6) })
  {
    file += number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 4);
  }
  return file + number(0, 4) + "abcdef";
}

} // namespace

TEST(SceneFiles, PicturesAreTurnedAsTheyWereHeld)
{
  const waft::test::TemporaryFolder folder;
  const char* shown[] = { "abc/def",  "cba/fed",  "fed/cba",  "def/abc",
                          "ad/be/cf", "da/eb/fc", "fc/eb/da", "cf/be/ad" };
  for (int orientation = 1; orientation <= 8; ++orientation)
  {
    const std::string path = folder.Write("held.tif", HeldTiff(orientation));
    waft::Picture picture;
    const waft::Result result = waft::VtkSceneAssets().LoadPicture(path, picture);
    ASSERT_TRUE(result) << result.Message();
    std::string rows;
    for (int y = picture.Height - 1; y >= 0; --y)
    {
      for (int x = 0; x < picture.Width; ++x)
      {
        const auto& pixel = picture.Pixels[static_cast<std::size_t>(y * picture.Width + x)];
        rows += static_cast<char>(std::lround(255.0f * pixel[0]));
      }
      rows += y > 0 ? "/" : "";
    }
    EXPECT_EQ(rows, shown[orientation - 1]) << orientation;
    ASSERT_TRUE(waft::ReadStoredPicture(path, picture));
    EXPECT_EQ(picture.Width, 3) << "textures go by what is stored";
  }
}

TEST(SceneFiles, LettersThatAFontLacksAreNamed)
{
  const waft::VtkSceneAssets assets;
  waft::Picture picture;
  const auto errorOf = [&](const std::string& text, const std::string& font)
  { return assets.DrawText(text, font, picture).Message(); };
  const std::string lacks = "\" can draw, found letters that it lacks: ";
  EXPECT_EQ(errorOf("\u010cAJ", "serif"), "expected a text that the font \"serif" + lacks +
                                            "'\u010c' (U+010C); name a font file that has them");
  for (const auto& [text, font, letter] :
       { std::array{ "50 \u20ac", "mono", "U+20AC" }, std::array{ "A\u2192B", "sans", "U+2192" },
         std::array{ "\u041c\u0418\u0420", "sans",
                     "(U+041C), '\u0418' (U+0418), '\u0420' (U+0420)" },
         std::array{ "LOVE\U0001f342YOU", "sans", "U+1F342" },
         std::array{ "a\tb", "sans", "U+0009" } })
  {
    EXPECT_NE(errorOf(text, font).find(letter), std::string::npos) << errorOf(text, font);
  }
  for (const char* text :
       { "\u00c9T\u00c9", "one\ntwo", "a\u00a0b", "\u201cquoted\u201d \u2013 ~^|$x$" })
  {
    EXPECT_EQ(errorOf(text, "sans"), "") << text;
  }
}

TEST(SceneFiles, LettersAndTheirMarksAreDrawnAsOne)
{
  const waft::VtkSceneAssets assets;
  waft::Picture whole;
  waft::Picture parts;
  ASSERT_TRUE(assets.DrawText("\u00c9\u00dc\u00d1", "sans", whole));
  ASSERT_TRUE(assets.DrawText("E\u0301U\u0308N\u0303", "sans", parts));
  EXPECT_EQ(parts.Width, whole.Width);
  EXPECT_EQ(parts.Pixels, whole.Pixels);
}
