// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/ResultFiles.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/DataFiles.h"
#include "Constraints/ConstraintCheck.h"
#include "Obstacles/ObstacleSet.h"

#include <vtkMultiBlockDataSet.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

namespace waft
{
namespace
{

namespace fs = std::filesystem;

constexpr unsigned int MostShapes = 100000;

/// The files of a folder.
class ResultFolder
{
public:
  explicit ResultFolder(fs::path root) : Root(std::move(root)) {}

  std::string PathOf(const std::string& name) const { return (this->Root / name).string(); }
  /// Whether it is a file, reached without a link and below the folder.
  bool Has(const std::string& name) const
  {
    fs::path at = this->Root;
    const fs::path inner(name);
    if (inner.empty() || inner.is_absolute())
    {
      return false;
    }
    std::error_code error;
    for (const fs::path& part : inner)
    {
      at /= part;
      if (part == ".." || part == "." || fs::is_symlink(fs::symlink_status(at, error)))
      {
        return false;
      }
    }
    return fs::is_regular_file(fs::symlink_status(at, error));
  }
  Result Read(const std::string& name, vtkPolyData* data) const
  {
    const std::string path = this->PathOf(name);
    if (!this->Has(name))
    {
      return Result::Error(path + ": expected a file that `waft synthesize` wrote, found none");
    }
    return About(path, ReadPolyDataFile(path, data));
  }
  static Result About(const std::string& path, const Result& result)
  {
    return result ? result : Result::Error(path + ": " + result.Message());
  }

private:
  fs::path Root;
};

Result ReadPoses(const ResultFolder& folder, FlightResults& read)
{
  WAFT_RETURN_IF_FAILED(folder.Read("poses.vtp", read.Poses));
  const std::string path = folder.PathOf("poses.vtp");
  WAFT_RETURN_IF_FAILED(
    ResultFolder::About(path, SceneInfoFromFieldData(read.Poses.Get(), read.Scene)));
  return ResultFolder::About(path, PosesFromPolyData(read.Poses, read.Tracks, read.PoseTracks));
}

// The names in shapes.vtm are left alone: its surfaces are numbered.
Result ReadShapes(const ResultFolder& folder, FlightResults& read)
{
  const auto nameOf = [](unsigned int shape)
  { return "shapes/shapes_" + std::to_string(shape) + ".vtp"; };
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int shape = 0; shape < MostShapes && (shape == 0 || folder.Has(nameOf(shape)));
       ++shape)
  {
    vtkNew<vtkPolyData> surface;
    WAFT_RETURN_IF_FAILED(folder.Read(nameOf(shape), surface));
    blocks->SetBlock(shape, surface);
  }
  WAFT_RETURN_IF_FAILED(
    ResultFolder::About(folder.PathOf("shapes"), BodiesFromMultiBlock(blocks, read.Shapes)));
  for (Shape& shape : read.Shapes)
  {
    shape.Texture = folder.Has(shape.Texture) ? folder.PathOf(shape.Texture) : std::string();
  }
  return Result::Ok();
}

// Those that move have a file a frame.
Result ReadObstacles(const ResultFolder& folder, FlightResults& read)
{
  const auto stepOf = [](int frame)
  {
    char name[64];
    std::snprintf(name, sizeof name, "obstacles/obstacles_%04d.vtp", frame);
    return std::string(name);
  };
  const Timeline& line = read.Scene.Time;
  const bool move = !folder.Has("obstacles.vtp") && folder.Has(stepOf(0));
  ObstacleCollector collected;
  for (int frame = 0; frame < (move ? line.NumberOfFrames : 1); ++frame)
  {
    vtkNew<vtkPolyData> surface;
    const std::string name = move ? stepOf(frame) : "obstacles.vtp";
    WAFT_RETURN_IF_FAILED(folder.Read(name, surface));
    WAFT_RETURN_IF_FAILED(ResultFolder::About(
      folder.PathOf(name), collected.Add(surface, frame / line.FramesPerSecond, line)));
  }
  read.Obstacles = collected.Take();
  return Result::Ok();
}

/// Places that are passed are looked at again; of other rows the file says what became of them.
void Judge(FlightResults& read)
{
  std::map<std::pair<int, int>, ReportRow> lines;
  std::vector<Constraint> passed;
  for (const Constraint& row : read.Constraints)
  {
    if (IsPassing(row.Kind) && row.Status == ConstraintStatus::Met)
    {
      ReportRow& line = lines[{ row.Row, row.Target }];
      line.Row = row.Row;
      line.Target = row.Target;
      line.Kind = row.Kind;
      passed.push_back(row);
    }
  }
  std::vector<ReportRow> report;
  for (const auto& [key, line] : lines)
  {
    report.push_back(line);
  }
  MeasureResiduals(passed, read.Tracks, read.Objects, ObstacleSet(), read.Scene, report);
  TakeStatuses(report, read.Constraints);
}

Result ReadConstraints(const ResultFolder& folder, FlightResults& read)
{
  if (!folder.Has("constraints.vtp"))
  {
    return Result::Ok();
  }
  vtkNew<vtkPolyData> rows;
  WAFT_RETURN_IF_FAILED(folder.Read("constraints.vtp", rows));
  if (rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(
      ResultFolder::About(folder.PathOf("constraints.vtp"),
                          ConstraintsFromPolyData(rows, read.Scene.Time, read.Constraints)));
    Judge(read);
  }
  return Result::Ok();
}

} // namespace

Result ReadResults(const std::string& report, FlightResults& results)
{
  const fs::path file = report;
  const ResultFolder folder(file.parent_path());
  if (!folder.Has(file.filename().string()))
  {
    return Result::Error(report + ": expected the report of a folder of results, found no file");
  }
  FlightResults read;
  WAFT_RETURN_IF_FAILED(ReadPoses(folder, read));
  vtkNew<vtkPolyData> objects;
  WAFT_RETURN_IF_FAILED(folder.Read("objects.vtp", objects));
  WAFT_RETURN_IF_FAILED(
    ResultFolder::About(folder.PathOf("objects.vtp"), ObjectsFromPolyData(objects, read.Objects)));
  WAFT_RETURN_IF_FAILED(ReadShapes(folder, read));
  WAFT_RETURN_IF_FAILED(ReadObstacles(folder, read));
  WAFT_RETURN_IF_FAILED(ReadConstraints(folder, read));
  results.Scene = read.Scene;
  results.Tracks = std::move(read.Tracks);
  results.PoseTracks = std::move(read.PoseTracks);
  results.Objects = std::move(read.Objects);
  results.Shapes = std::move(read.Shapes);
  results.Obstacles = std::move(read.Obstacles);
  results.Constraints = std::move(read.Constraints);
  results.Poses->ShallowCopy(read.Poses);
  return Result::Ok();
}

} // namespace waft
