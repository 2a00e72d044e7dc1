// SPDX-License-Identifier: BSD-3-Clause
// Data that go from Core to VTK come back as they were.
#include "Base/Primitives.h"
#include "Base/Random.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

using namespace waft;

namespace
{

std::vector<Track> TwoTracks()
{
  Random random(4);
  std::vector<Track> tracks(2);
  for (int t = 0; t < 2; ++t)
  {
    tracks[t].ObjectId = 10 + t;
    for (int k = 0; k < 5; ++k)
    {
      tracks[t].Positions.push_back(random.Direction());
      tracks[t].VortexIds.push_back(k - 1);
      tracks[t].ForceTypes.push_back(static_cast<ForceType>(k % 3));
      tracks[t].Forces.push_back(random.Direction());
    }
  }
  return tracks;
}

} // namespace

TEST(Bridge, TracksComeBackBitForBit)
{
  const std::vector<Track> tracks = TwoTracks();
  vtkNew<vtkPolyData> data;
  TracksToPolyData(tracks, SceneInfo(), data);
  EXPECT_EQ(data->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(data->GetNumberOfLines(), 2);
  std::vector<Track> back;
  ASSERT_TRUE(TracksFromPolyData(data, back));
  ASSERT_EQ(back.size(), 2u);
  for (int t = 0; t < 2; ++t)
  {
    EXPECT_EQ(back[t].ObjectId, tracks[t].ObjectId);
    EXPECT_EQ(back[t].Positions, tracks[t].Positions);
    EXPECT_EQ(back[t].VortexIds, tracks[t].VortexIds);
    EXPECT_EQ(back[t].ForceTypes, tracks[t].ForceTypes);
    EXPECT_EQ(back[t].Forces, tracks[t].Forces);
    EXPECT_TRUE(back[t].AirVelocities.empty());
  }
}

TEST(Bridge, WhatTurningDoesNotNeedOfTracksStaysWhereItIs)
{
  std::vector<Track> tracks = TwoTracks();
  for (Track& track : tracks)
  {
    track.AirVelocities = track.Forces;
    track.SphVelocities = track.Positions;
  }
  vtkNew<vtkPolyData> given, again;
  TracksToPolyData(tracks, SceneInfo(), given);
  std::vector<Track> flights;
  vtkNew<vtkPointData> left;
  ASSERT_TRUE(FlightsFromPolyData(given, flights, left));
  EXPECT_EQ(flights[1].AirVelocities, tracks[1].AirVelocities);
  EXPECT_TRUE(flights[1].Forces.empty());
  EXPECT_EQ(left->GetNumberOfArrays(), 6);
  TracksToPolyData(flights, SceneInfo(), again, left);
  vtkPointData* arrays = given->GetPointData();
  ASSERT_EQ(again->GetPointData()->GetNumberOfArrays(), arrays->GetNumberOfArrays());
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    EXPECT_STREQ(again->GetPointData()->GetArrayName(i), arrays->GetArrayName(i));
  }
  EXPECT_EQ(again->GetPointData()->GetArray("Force"), arrays->GetArray("Force"));

  // Of one precision less it is read, and what is no number is named.
  vtkNew<vtkFloatArray> rough;
  rough->DeepCopy(arrays->GetArray("Force"));
  rough->SetName("Force");
  arrays->AddArray(rough);
  ASSERT_TRUE(FlightsFromPolyData(given, flights, left));
  EXPECT_EQ(left->GetArray("Force"), nullptr);
  EXPECT_LT((flights[1].Forces[2] - tracks[1].Forces[2]).norm(), 1e-6);
  arrays->GetArray("SPHVelocity")->SetComponent(3, 1, std::nan(""));
  const Result result = FlightsFromPolyData(given, flights, left);
  EXPECT_EQ(result.Message(), "Tracks: array `SPHVelocity`: entry 3 is not a finite number");
}

TEST(Bridge, TracksWhosePointsAreInAnotherOrderAreReadWhole)
{
  const std::vector<Track> tracks = TwoTracks();
  vtkNew<vtkPolyData> given;
  TracksToPolyData(tracks, SceneInfo(), given);
  vtkNew<vtkCellArray> lines;
  for (const vtkIdType first : { 5, 0 })
  {
    lines->InsertNextCell(5);
    for (vtkIdType k = 0; k < 5; ++k)
    {
      lines->InsertCellPoint(first + k);
    }
  }
  given->SetLines(lines);
  std::vector<Track> flights;
  vtkNew<vtkPointData> left;
  ASSERT_TRUE(FlightsFromPolyData(given, flights, left));
  EXPECT_EQ(left->GetNumberOfArrays(), 0);
  EXPECT_EQ(flights[0].Forces, tracks[1].Forces);
}

TEST(Bridge, NamesArrayAndEntryOfANumberThatIsNotFinite)
{
  vtkNew<vtkPolyData> data;
  TracksToPolyData(TwoTracks(), SceneInfo(), data);
  data->GetPointData()->GetArray("Force")->SetComponent(3, 1,
                                                        std::numeric_limits<double>::quiet_NaN());
  std::vector<Track> back;
  const Result result = TracksFromPolyData(data, back);
  EXPECT_FALSE(result);
  EXPECT_EQ(result.Message(), "Tracks: array `Force`: entry 3 is not a finite number");
}

TEST(Bridge, ConstraintsComeBack)
{
  std::vector<Constraint> rows(3);
  rows[0].ObjectId = 4;
  rows[0].Frame = 20;
  rows[0].Value = Vec3(1.0, 2.0, 3.0);
  rows[0].Radius = 0.25;
  rows[1].Kind = ConstraintKind::Orientation;
  rows[1].Orientation = Quat(0.5, -0.5, 0.5, -0.5);
  rows[1].Row = 1;
  rows[2].Kind = ConstraintKind::Rest;
  rows[2].Value = Vec3(0.1, 0.2, 0.3);
  rows[2].Frame = 200;
  rows[2].Until = 250;
  rows[2].Row = 2;
  rows[2].Group = 5;
  rows[2].Status = ConstraintStatus::Unreachable;
  vtkNew<vtkPolyData> data;
  ConstraintsToPolyData(rows, SceneInfo(), data);
  double point[3];
  data->GetPoint(2, point);
  EXPECT_EQ(Vec3(point[0], point[1], point[2]), rows[2].Value);
  std::vector<Constraint> back;
  ASSERT_TRUE(ConstraintsFromPolyData(data, Timeline(), back));
  ASSERT_EQ(back.size(), 3u);
  EXPECT_EQ(back[0].Value, rows[0].Value);
  EXPECT_EQ(back[0].Radius, 0.25);
  EXPECT_EQ(back[1].Orientation.coeffs(), rows[1].Orientation.coeffs());
  EXPECT_EQ(back[2].Until, 250);
  EXPECT_EQ(back[2].Group, 5);
  EXPECT_EQ(back[0].Status, ConstraintStatus::Met);
  EXPECT_EQ(back[2].Status, ConstraintStatus::Unreachable);

  const Result late = ConstraintsFromPolyData(data, Timeline{ 100, 30.0 }, back);
  EXPECT_EQ(late.Message(), "Constraints: vertex 2: array `Frame`: expected 0 to 99, found 200");
}

TEST(Bridge, AReportComesBackAlsoFromTexts)
{
  ReportRow met, missed;
  met.Row = 3;
  met.Target = 1;
  met.ObjectId = 7;
  met.Kind = ConstraintKind::Rest;
  met.TouchDown = 20;
  met.Settled = 24;
  missed.Frame = 12;
  missed.Residual = std::numeric_limits<double>::quiet_NaN();
  missed.Status = ConstraintStatus::Unreachable;
  missed.Message = "it comes within 0.2 m";
  vtkNew<vtkTable> table, texts;
  ReportToTable({ met, missed }, SceneInfo(), table);
  for (int column = 0; column < table->GetNumberOfColumns(); ++column)
  {
    std::vector<std::string> values;
    for (int row = 0; row < 2; ++row)
    {
      const vtkVariant cell = table->GetValue(row, column);
      values.push_back(cell.IsDouble() && std::isnan(cell.ToDouble()) ? "" : cell.ToString());
    }
    AddStrings(texts->GetRowData(), table->GetColumnName(column), values);
  }
  for (vtkTable* given : { table.Get(), texts.Get() })
  {
    std::vector<ReportRow> read;
    ASSERT_TRUE(ReportFromTable(given, "report", read));
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(std::tie(read[0].Row, read[0].Target, read[0].ObjectId, read[0].Kind),
              std::tie(met.Row, met.Target, met.ObjectId, met.Kind));
    EXPECT_EQ(std::tie(read[0].TouchDown, read[0].Settled, read[0].Residual),
              std::tie(met.TouchDown, met.Settled, met.Residual));
    EXPECT_EQ(std::tie(read[1].Frame, read[1].Status, read[1].Message),
              std::tie(missed.Frame, missed.Status, missed.Message));
    EXPECT_TRUE(std::isnan(read[1].Residual));
  }
}

TEST(Bridge, AReportThatIsNoneIsNamedByLineAndColumn)
{
  const auto messageOf = [](const char* column, const char* text)
  {
    vtkNew<vtkTable> table;
    ReportToTable({ ReportRow() }, SceneInfo(), table);
    table->RemoveColumnByName(column);
    if (text != nullptr)
    {
      AddStrings(table->GetRowData(), column, { text });
    }
    std::vector<ReportRow> read;
    return ReportFromTable(table, "report", read).Message();
  };
  EXPECT_EQ(messageOf("Row", nullptr), "report: no column `Row`");
  EXPECT_EQ(messageOf("Row", "one"),
            "report: line 1: column `Row`: expected a whole number, found `one`");
  EXPECT_EQ(messageOf("Residual", "far"),
            "report: line 1: column `Residual`: expected a number, found `far`");
  EXPECT_EQ(messageOf("Kind", "wish"),
            "report: line 1: column `Kind`: expected a kind of constraint, found `wish`");
  EXPECT_EQ(messageOf("Status", "done"),
            "report: line 1: column `Status`: expected a status, found `done`");
}

TEST(Bridge, VorticesAndObjectsComeBack)
{
  std::vector<Vortex> vortices(2);
  vortices[1].VortexId = 9;
  vortices[1].P2 = Vec3(1.0, 1.0, 2.0);
  vortices[1].Strength = -3.0;
  vortices[1].Confidence = 0.5;
  vtkNew<vtkPolyData> data;
  VorticesToPolyData(vortices, SceneInfo(), data);
  std::vector<Vortex> back;
  ASSERT_TRUE(VorticesFromPolyData(data, back));
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[1].P2, vortices[1].P2);
  EXPECT_EQ(back[1].Strength, -3.0);
  EXPECT_EQ(back[1].Confidence, 0.5);

  std::vector<MotionObject> objects(2);
  vtkNew<vtkPolyData> table;
  ObjectsToPolyData(objects, SceneInfo(), table);
  std::vector<MotionObject> read;
  EXPECT_EQ(ObjectsFromPolyData(table, read).Message(),
            "Objects: array `ObjectId`: 0 stands twice, ids must differ");
}

TEST(Bridge, ObstaclesThatMoveAreSeenAsDisplacements)
{
  ObstacleMesh box;
  box.ObstacleId = 3;
  box.Mesh.Points = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1) };
  box.Mesh.Triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  ObstacleMesh still = box;
  still.ObstacleId = 1;
  for (int frame = 0; frame < 4; ++frame)
  {
    box.Offsets.push_back(Vec3(0.1 * frame * frame, 0.0, -0.2 * frame));
  }
  SceneInfo info;
  info.Time.NumberOfFrames = 4;
  ObstacleCollector collector;
  for (int frame = 0; frame < 4; ++frame)
  {
    vtkNew<vtkPolyData> data;
    ObstaclesToPolyData({ box, still }, frame, info, data);
    ASSERT_TRUE(collector.Add(data, info.Time.Time(frame), info.Time));
  }
  const std::vector<ObstacleMesh> back = collector.Take();
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].ObstacleId, 1);
  EXPECT_FALSE(back[0].IsMoving());
  EXPECT_EQ(back[0].Mesh.Points, still.Mesh.Points);
  ASSERT_EQ(back[1].Offsets.size(), 4u);
  for (int frame = 0; frame < 4; ++frame)
  {
    EXPECT_LT((back[1].Offsets[frame] - box.Offsets[frame]).norm(), 1e-12);
  }
}

TEST(Bridge, AnObstacleThatTurnsIsRefused)
{
  ObstacleMesh box;
  box.Mesh.Points = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1) };
  box.Mesh.Triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  ObstacleMesh turned = box;
  for (Vec3& point : turned.Mesh.Points)
  {
    point = Vec3(-point.y(), point.x(), point.z());
  }
  ObstacleCollector collector;
  vtkNew<vtkPolyData> first;
  ObstaclesToPolyData({ box }, 0, SceneInfo(), first);
  ASSERT_TRUE(collector.Add(first, 0.0, Timeline()));
  vtkNew<vtkPolyData> second;
  ObstaclesToPolyData({ turned }, 0, SceneInfo(), second);
  const Result result = collector.Add(second, 0.1, Timeline());
  EXPECT_NE(result.Message().find("obstacle 0"), std::string::npos) << result.Message();
}

TEST(Bridge, ASurfaceWithoutIdsIsSplitIntoItsSolids)
{
  ObstacleMesh box, onIt;
  box.Mesh = MakeBox({ Vec3(-1, -1, 0), Vec3(1, 1, 0.2) });
  onIt.Mesh = MakeBox({ Vec3(-0.3, -0.3, 0.2), Vec3(0.3, 0.3, 0.8) }); // shares a part of a face
  onIt.ObstacleId = 7;
  vtkNew<vtkPolyData> data;
  ObstaclesToPolyData({ box, onIt }, 0, SceneInfo(), data);
  data->GetPointData()->RemoveArray("ObstacleId");
  ObstacleCollector collector;
  ASSERT_TRUE(collector.Add(data, 0.0, Timeline()));
  const std::vector<ObstacleMesh> back = collector.Take();
  ASSERT_EQ(back.size(), 2u);
  const auto corners = [](const TriangleMesh& mesh)
  {
    std::vector<Vec3> points;
    for (const std::array<int, 3>& triangle : mesh.Triangles)
    {
      for (const int corner : triangle)
      {
        points.push_back(mesh.Points[static_cast<std::size_t>(corner)]);
      }
    }
    return points;
  };
  EXPECT_EQ(back[0].ObstacleId, 0);
  EXPECT_EQ(corners(back[0].Mesh), corners(box.Mesh));
  EXPECT_EQ(back[1].ObstacleId, 1);
  EXPECT_EQ(corners(back[1].Mesh), corners(onIt.Mesh));
  EXPECT_EQ(back[1].Mesh.Points.size(), 8u);
}

TEST(Bridge, ASurfaceOfNothingIsNoObstacle)
{
  ObstacleCollector collector;
  vtkNew<vtkPolyData> nothing;
  ASSERT_TRUE(collector.Add(nothing, 0.0, Timeline()));
  EXPECT_TRUE(collector.Take().empty());
}

TEST(Bridge, WindStepsComeBack)
{
  FieldSeries wind;
  wind.Dimensions = { 3, 2, 2 };
  wind.Origin = Vec3(-1.0, 0.0, 0.5);
  wind.Spacing = Vec3(1.0, 2.0, 0.5);
  Random random(8);
  for (const double time : { 0.0, 0.5 })
  {
    wind.Times.push_back(time);
    wind.Values.emplace_back();
    for (int i = 0; i < 12; ++i)
    {
      wind.Values.back().push_back(
        { float(random.Uniform()), float(random.Uniform()), float(random.Uniform()) });
    }
  }
  FieldCollector collector;
  for (const double time : wind.Times)
  {
    vtkNew<vtkImageData> image;
    FieldSeriesToImage(wind, time, SceneInfo(), image);
    ASSERT_TRUE(collector.Add(image, time));
  }
  const FieldSeries back = collector.Take();
  EXPECT_EQ(back.Values, wind.Values);
  EXPECT_EQ(back.Origin, wind.Origin);
  EXPECT_EQ(back.Meaning, FieldMeaning::Acceleration);
}

TEST(Bridge, AWindByAnotherNameIsWarnedOf)
{
  vtkNew<vtkImageData> image;
  FieldSeries wind;
  wind.Dimensions = { 2, 2, 2 };
  wind.Times = { 0.0 };
  wind.Values.assign(1, FieldSeries::Field(8));
  FieldSeriesToImage(wind, 0.0, SceneInfo(), image);
  image->GetPointData()->GetArray("Wind")->SetName("U");
  FieldCollector collector;
  EXPECT_EQ(collector.Add(image, 0.0).Message(),
            "Wind: expected the point data array `Wind` or `Velocity` of 3 components, found, with "
            "their components: `U` (3) of points, none of cells");
  FieldCollector air(FieldRole::Air);
  EXPECT_NE(air.Add(image, 0.0).Message().find("Air: expected the point data array `Velocity`"),
            std::string::npos);
  FieldCollector file(FieldRole::WindFile);
  EXPECT_TRUE(file.Add(image, 0.0));
  EXPECT_EQ(file.Take().Meaning, FieldMeaning::Velocity);
}

TEST(Bridge, ShapesComeBack)
{
  Shape leaf;
  leaf.Name = "leaf";
  leaf.Mesh.Points = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0) };
  leaf.Mesh.Triangles = { { 0, 1, 2 } };
  leaf.TextureCoordinates = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  leaf.Texture = "leaf.png";
  leaf.Color = { 0.5, 0.25, 0.125 };
  leaf.Tint = { 0.75, 0.5, 1.0 };
  leaf.SettlingSpeed = 0.7;
  vtkNew<vtkMultiBlockDataSet> data;
  ShapesToMultiBlock({ leaf }, SceneInfo(), data);
  std::vector<Shape> back;
  ASSERT_TRUE(ShapesFromMultiBlock(data, back));
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].Name, "leaf");
  EXPECT_EQ(back[0].Mesh.Points, leaf.Mesh.Points);
  EXPECT_EQ(back[0].Mesh.Triangles, leaf.Mesh.Triangles);
  EXPECT_EQ(back[0].TextureCoordinates, leaf.TextureCoordinates);
  EXPECT_EQ(back[0].Texture, "leaf.png");
  EXPECT_EQ(back[0].Color, leaf.Color);
  EXPECT_EQ(back[0].Tint, leaf.Tint);
  EXPECT_EQ(back[0].SettlingSpeed, 0.7);
}
