// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/FlightFiles.h"

#include "Base/AtomicFile.h"
#include "Bridge/Data/AirData.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/SpacetimeData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/AnimationFile.h"
#include "Bridge/Files/BlocksFile.h"
#include "Bridge/Files/DataWriting.h"
#include "Bridge/Files/FlightJson.h"
#include "Bridge/Files/SeriesFiles.h"
#include "Bridge/Files/ShapeColors.h"
#include "Export/PosesCsv.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace waft
{
namespace
{

namespace fs = std::filesystem;

// Between two images of the air it is as good as straight (1 % off), at any frame rate [s].
constexpr double AirInterval = 0.1;
// Binary digits below the typical value that replay can tell from more: figures of `waft measure`
// change by some per cent.
constexpr int AirDigits = 4;
constexpr std::size_t WindSteps = 10; // of the air, from one at which its force is written on
// What reads back bit for bit beside points: what else poses.csv says but velocities, which follow
// from points, and time.
const std::set<std::string> Exact = { names::Time, names::Orientation, names::AngularVelocity };

/// Rows with when their rests touched and were still as the bodies were turned.
std::vector<Constraint> PosedRows(const Motion& motion)
{
  std::map<std::pair<int, int>, const JoinedRow*> begun;
  for (const JoinedRow& line : motion.Report)
  {
    if (line.Settled >= 0)
    {
      begun[{ line.Row, line.Target }] = &line;
    }
  }
  std::vector<Constraint> rows = motion.Rows();
  for (Constraint& row : rows)
  {
    const auto found = begun.find({ row.Row, row.Target });
    if (found != begun.end())
    {
      row.TouchDown = found->second->TouchDown;
      row.Settled = found->second->Settled;
    }
  }
  return rows;
}

std::vector<std::string> ColumnsOf(vtkTable* table)
{
  std::vector<std::string> columns;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    columns.emplace_back(table->GetColumnName(i));
  }
  return columns;
}

bool IsNumber(const std::string& text)
{
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

/// A text as a cell of a table.
std::string Quoted(std::string text)
{
  if (!text.empty() && std::string("=+-@\t\r").find(text[0]) != std::string::npos &&
      !IsNumber(text))
  {
    text.insert(0, "'");
  }
  if (text.find_first_of(",\"\r\n") == std::string::npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char letter : text)
  {
    quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  }
  return quoted + "\"";
}

Result NotWritten(const std::string& path, const std::string& reason)
{
  return Result::Error(path + ": could not be written: " + reason, ErrorKind::Disk);
}

vtkSmartPointer<vtkDataObject> Stamped(vtkDataObject* data, double time)
{
  data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  return data;
}

/// A flight that is being written.
class Flight
{
public:
  Flight(const Scene& scene, const Motion& motion, const FlightFileOptions& options,
         Monitor& monitor, std::vector<std::string>& warnings) :
    TheScene(scene),
    Made(motion), Options(options), Watch(monitor), Warnings(warnings)
  {
  }

  Result Write()
  {
    WAFT_RETURN_IF_FAILED(this->WritePlanned());
    WAFT_RETURN_IF_FAILED(this->WriteBodies());
    WAFT_RETURN_IF_FAILED(this->WriteTables());
    if (this->HasFit())
    {
      vtkNew<vtkPolyData> fit;
      AirVortexFitToPolyData(this->Made.Fit, this->Info(), fit);
      WAFT_RETURN_IF_FAILED(this->WriteData(fit, "fitted_vortices.vtp"));
    }
    return this->Options.HasFields ? this->WriteFields() : Result::Ok();
  }

  SceneJson Report() const
  {
    return MotionAsJson(this->TheScene.Info, this->Made, this->Poses, this->Convergence);
  }

private:
  const SceneInfo& Info() const { return this->TheScene.Info; }
  std::string PathOf(const std::string& name) const { return this->Options.Folder + "/" + name; }
  bool HasAir() const { return !this->Made.Air.Air->Velocity.IsEmpty(); }
  bool HasFit() const { return this->Made.Efforts.count(ChainStage::VortexFit) > 0; }
  bool IsAssimilated() const { return !this->Made.Air.Tracks.empty(); }
  bool IsOptimised() const { return !this->Made.Optimised.Tracks.empty(); }

  Result WriteData(vtkDataObject* data, const std::string& name, const DataFileForm& form = {})
  {
    const Result written = WriteDataFile(this->PathOf(name), Stamped(data, 0.0), form);
    return written ? written : NotWritten(name, written.Message());
  }
  Result WriteTracks(vtkPolyData* tracks, const std::string& name)
  {
    DataFileForm form;
    form.IsRounded = true;
    form.Exact = Exact;
    return this->WriteData(tracks, name, form);
  }
  Result Copy(const std::string& from, const std::string& name) const;

  Result WritePlanned();
  Result WriteBodies();
  Result WriteShapes();
  Result WriteObstacles();
  Result WriteTables();
  Result WriteFields();
  Result WriteAir();
  void TakePoses();

  const Scene& TheScene;
  const Motion& Made;
  const FlightFileOptions& Options;
  Monitor& Watch;
  std::vector<std::string>& Warnings;
  vtkNew<vtkPolyData> Poses;
  vtkNew<vtkTable> Convergence;
};

Result Flight::Copy(const std::string& from, const std::string& name) const
{
  std::error_code wrong;
  fs::copy_file(from, this->PathOf(name), wrong);
  return wrong ? NotWritten(name, wrong.message()) : Result::Ok();
}

Result Flight::WritePlanned()
{
  if (!this->Options.PlannedFile.empty())
  {
    return this->Copy(this->Options.PlannedFile, "planned.vtp");
  }
  vtkNew<vtkPolyData> tracks;
  TracksToPolyData(this->Made.Plan.Tracks, this->Info(), tracks);
  return this->WriteData(tracks, "planned.vtp");
}

void Flight::TakePoses()
{
  PosesToPolyData(this->Made.Tracks, this->Made.Turned.Poses, this->Info(), this->Poses);
  AddDoubles(this->Poses->GetCellData(), names::Shift, this->Made.Laid);
  AddTurning(this->Made.Turned, this->Poses);
  AddRowTimes(this->Made.RowsAtLast(), this->Poses);
}

Result Flight::WriteBodies()
{
  this->TakePoses();
  WAFT_RETURN_IF_FAILED(this->WriteTracks(this->Poses, "poses.vtp"));
  vtkNew<vtkPolyData> objects;
  ObjectsToPolyData(this->TheScene.Objects, this->Info(), objects);
  AddArrivals(this->Made.Rows(), this->Made.Tracks, objects);
  AuthoredToFieldData(this->TheScene.Authored.Objects, objects);
  WAFT_RETURN_IF_FAILED(this->WriteData(objects, "objects.vtp"));
  WAFT_RETURN_IF_FAILED(this->WriteShapes());
  WAFT_RETURN_IF_FAILED(this->WriteObstacles());
  vtkNew<vtkPolyData> rows;
  ConstraintsToPolyData(PosedRows(this->Made), this->Info(), rows);
  WAFT_RETURN_IF_FAILED(this->WriteData(rows, "constraints.vtp"));
  if (this->Options.HasAnimation)
  {
    vtkNew<vtkMultiBlockDataSet> blocks;
    ShapesToMultiBlock(this->TheScene.Shapes, this->Info(), blocks);
    std::vector<Shape> bodies;
    WAFT_RETURN_IF_FAILED(BodiesFromMultiBlock(blocks, bodies)); // as other programs have them
    WAFT_RETURN_IF_FAILED(WriteAnimation(this->PathOf("animation.glb"), this->Poses,
                                         this->TheScene.Objects, std::move(bodies), rows,
                                         this->Info(), this->Watch, this->Warnings));
  }
  return this->Options.HasCsv
           ? WritePosesCsv(this->PathOf("poses.csv"), this->Made.Tracks, this->Made.Turned.Poses,
                           this->Info().Time, this->Watch)
           : Result::Ok();
}

// Copies of the pictures on surfaces lie beside them, so that they can be drawn from anywhere, and
// on another machine.
Result Flight::WriteShapes()
{
  std::vector<Shape> shapes = this->TheScene.Shapes;
  std::map<std::string, std::string> pictures;
  for (Shape& shape : shapes)
  {
    if (!shape.Texture.empty()) // of one that is missing the scene's reader has warned
    {
      const std::string name = "shapes/picture_" + std::to_string(pictures.size()) +
                               fs::path(shape.Texture).extension().string();
      const std::string& own = pictures.emplace(shape.Texture, name).first->second;
      shape.Texture = fs::is_regular_file(shape.Texture) ? own : "";
    }
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  ShapesToMultiBlock(shapes, this->Info(), blocks);
  WAFT_RETURN_IF_FAILED(WriteBlocksFile(this->PathOf("shapes.vtm"), blocks));
  for (const auto& [source, name] : pictures)
  {
    if (fs::is_regular_file(source))
    {
      WAFT_RETURN_IF_FAILED(this->Copy(source, name));
    }
  }
  return Result::Ok();
}

Result Flight::WriteObstacles()
{
  const bool isMoving =
    std::any_of(this->TheScene.Obstacles.begin(), this->TheScene.Obstacles.end(),
                [](const ObstacleMesh& obstacle) { return obstacle.IsMoving(); });
  vtkNew<vtkPolyData> obstacles;
  ObstaclesToPolyData(this->TheScene.Obstacles, 0.0, this->Info(), obstacles);
  AuthoredToFieldData(this->TheScene.Authored.Obstacles, obstacles);
  if (!isMoving)
  {
    return this->WriteData(obstacles, "obstacles.vtp");
  }
  return WriteSeries(this->Options.Folder, "obstacles", ".vtp", TimesOf(this->Info().Time), {},
                     [&](double time)
                     {
                       vtkNew<vtkPolyData> moved;
                       moved->ShallowCopy(obstacles);
                       MoveObstacles(this->TheScene.Obstacles,
                                     time * this->Info().Time.FramesPerSecond, moved);
                       return Stamped(moved, time);
                     });
}

Result Flight::WriteTables()
{
  vtkNew<vtkTable> report;
  JoinedReportToTable(this->Made.Report, this->Info(), report);
  WAFT_RETURN_IF_FAILED(
    WriteCsv(this->PathOf("constraints.csv"), report,
             { "Row", "Target", "ObjectId", "Frame", "Kind", "Residual", "Status", "Message",
               "TouchDown", "Settled", "LiftOff", "Arrival", "Release", "Leave" }));
  ConvergenceToTable(this->Made.Optimised.Convergence, this->Info(), this->Convergence);
  WAFT_RETURN_IF_FAILED(WriteCsv(this->PathOf("convergence.csv"), this->Convergence, {}));
  if (!this->IsAssimilated())
  {
    return Result::Ok();
  }
  vtkNew<vtkTable> rounds;
  RoundsToTable(this->Made.Air.Rounds, this->Info(), rounds);
  return WriteCsv(this->PathOf("rounds.csv"), rounds, {});
}

Result Flight::WriteFields()
{
  const AssimilationOutput& air = this->Made.Air;
  const SpacetimeOutput& optimised = this->Made.Optimised;
  vtkNew<vtkPolyData> drifting;
  if (this->IsAssimilated())
  {
    TracksToPolyData(air.Tracks, this->Info(), drifting);
    AddControls(air, drifting);
    AddRowTimes(air.Constraints, drifting);
    WAFT_RETURN_IF_FAILED(this->WriteTracks(drifting, "assimilated.vtp"));
  }
  vtkNew<vtkPolyData> vortices;
  if (this->IsOptimised())
  {
    vtkNew<vtkPolyData> tracks;
    OptimisedToPolyData(optimised, this->Info(), tracks);
    AddRowTimes(this->Made.Rows(), tracks);
    WAFT_RETURN_IF_FAILED(this->WriteTracks(tracks, "optimized.vtp"));
    VorticesToPolyData(optimised.Vortices, this->Info(), vortices);
  }
  else if (this->IsAssimilated())
  {
    WAFT_RETURN_IF_FAILED(this->Copy(this->PathOf("assimilated.vtp"), "optimized.vtp"));
    VorticesToPolyData(air.Vortices, this->Info(), vortices);
  }
  else
  {
    vtkNew<vtkPolyData> tracks;
    TracksToPolyData(this->Made.Plan.Tracks, this->Info(), tracks);
    WAFT_RETURN_IF_FAILED(this->WriteTracks(tracks, "optimized.vtp"));
    VorticesToPolyData(this->Made.Plan.Vortices, this->Info(), vortices);
  }
  WAFT_RETURN_IF_FAILED(this->WriteData(vortices, "vortices.vtp"));
  if (this->Options.IsHurried)
  {
    return Result::Ok();
  }
  const std::vector<double> times = TimesOf(this->Info().Time);
  const auto frameAt = [this](double time)
  { return static_cast<int>(std::lround(time * this->Info().Time.FramesPerSecond)); };
  if (this->Options.HasMeshes)
  {
    PosedMeshes meshes;
    std::vector<std::vector<std::array<double, 3>>> colors;
    std::transform(this->TheScene.Shapes.begin(), this->TheScene.Shapes.end(),
                   std::back_inserter(colors), ColorsOfPoints);
    WAFT_RETURN_IF_FAILED(meshes.Build(this->TheScene.Shapes, colors, this->TheScene.Objects,
                                       this->Made.Tracks, this->Info()));
    meshes.SetSettled(SettledFrames(this->Made.RowsAtLast(), this->Made.Tracks));
    meshes.SetGround(this->TheScene.Obstacles, this->Info().Bounds);
    WAFT_RETURN_IF_FAILED(WriteSeries(this->Options.Folder, "meshes", ".vtp", times, {},
                                      [&](double time)
                                      {
                                        vtkNew<vtkPolyData> posed;
                                        meshes.Fill(this->Made.Tracks, this->Made.Turned.Poses,
                                                    frameAt(time), posed);
                                        return Stamped(posed, time);
                                      }));
  }
  if (this->Options.HasParticles && !optimised.Particles.Frames.empty())
  {
    WAFT_RETURN_IF_FAILED(WriteSeries(this->Options.Folder, "particles", ".vtp", times, {},
                                      [&](double time)
                                      {
                                        vtkNew<vtkPolyData> gas;
                                        ParticlesToPolyData(optimised.Particles, frameAt(time),
                                                            this->Info(), gas);
                                        return Stamped(gas, time);
                                      }));
  }
  if (this->IsOptimised() && !optimised.Particles.Frames.empty())
  {
    WAFT_RETURN_IF_FAILED(WriteSeries(this->Options.Folder, "wind", ".vti", times, {},
                                      [&](double time)
                                      {
                                        vtkNew<vtkImageData> wind;
                                        FieldSeriesToImage(optimised.Wind, time, this->Info(),
                                                           wind);
                                        return Stamped(wind, time);
                                      }));
  }
  return this->HasAir() ? this->WriteAir() : Result::Ok();
}

Result Flight::WriteAir()
{
  const SampledAir& air = *this->Made.Air.Air;
  const bool isWhole = this->Options.HasAllAir;
  const std::vector<double> times = TimesOf(this->Info().Time);
  const std::vector<std::size_t> steps = Spaced(times, isWhole ? 0.0 : AirInterval);
  DataFileForm form;
  form.PacksWell = !isWhole; // which would take longer than the flight
  const auto imageAt = [&](double time, bool isWind)
  {
    vtkNew<vtkImageData> image;
    FieldSeriesToImage((isWind ? air.Wind : air.Velocity).Around(time), time, this->Info(), image);
    if (isWind || !isWhole) // else as it was solved with, in halves
    {
      RoundPoints(image, AirDigits);
    }
    return vtkSmartPointer<vtkDataObject>(image);
  };
  WAFT_RETURN_IF_FAILED(WriteSeries(
    this->Options.Folder, "air", ".vti", times, form,
    [&](double time) { return imageAt(time, false); }, steps));
  if (!air.Wind.IsEmpty())
  {
    const std::vector<std::size_t> apart = Spaced(times, AirInterval);
    std::vector<std::size_t> few;
    for (std::size_t i = 0; i < apart.size(); i += isWhole ? 1 : WindSteps)
    {
      few.push_back(apart[i]);
    }
    WAFT_RETURN_IF_FAILED(WriteSeries(
      this->Options.Folder, "air_wind", ".vti", times, form,
      [&](double time) { return imageAt(time, true); }, few));
  }
  return this->Options.AirStateFile.empty()
           ? Result::Ok()
           : this->Copy(this->Options.AirStateFile, "assimilated.state");
}

} // namespace

Result WriteFlight(const Scene& scene, const Motion& motion, const FlightFileOptions& options,
                   Monitor& monitor, SceneJson& report, std::vector<std::string>& warnings)
{
  Flight flight(scene, motion, options, monitor, warnings);
  WAFT_RETURN_IF_FAILED(flight.Write());
  report = flight.Report();
  return Result::Ok();
}

Result WritePlan(const SceneInfo& info, const PlanOutput& plan, const std::string& folder)
{
  vtkNew<vtkPolyData> tracks, rows, vortices;
  TracksToPolyData(plan.Tracks, info, tracks);
  ConstraintsToPolyData(plan.Constraints, info, rows);
  VorticesToPolyData(plan.Vortices, info, vortices);
  for (const auto& [data, name] : { std::pair<vtkPolyData*, const char*>(tracks, "planned.vtp"),
                                    { rows, "constraints.vtp" },
                                    { vortices, "vortices.vtp" } })
  {
    const Result written = WriteDataFile(folder + "/" + name, Stamped(data, 0.0), {});
    if (!written)
    {
      return NotWritten(name, written.Message());
    }
  }
  return Result::Ok();
}

void JoinedReportToTable(const std::vector<JoinedRow>& report, const SceneInfo& info,
                         vtkTable* table)
{
  std::vector<JoinedRow> lines;
  std::copy_if(report.begin(), report.end(), std::back_inserter(lines),
               [](const JoinedRow& line) { return line.Target != OfNoRow; });
  ReportToTable({ lines.begin(), lines.end() }, info, table);
  AddColumn(table->GetRowData(), names::LiftOff, lines, &JoinedRow::LiftOff);
}

std::string CellText(vtkTable* table, vtkIdType row, const char* column)
{
  const vtkVariant value = table->GetValueByName(row, column);
  if (!value.IsDouble() && !value.IsFloat())
  {
    return value.ToString();
  }
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", value.ToDouble());
  return std::isnan(value.ToDouble()) ? "" : text;
}

Result WriteCsv(const std::string& path, vtkTable* table, const std::vector<std::string>& columns)
{
  const std::vector<std::string> own = columns.empty() ? ColumnsOf(table) : columns;
  std::string text;
  const auto addLine = [&](const auto& cellOf)
  {
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      text += (i > 0 ? "," : "") + Quoted(cellOf(own[i]));
    }
    text += "\n";
  };
  addLine([](const std::string& column) { return column; });
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    addLine([&](const std::string& column) { return CellText(table, row, column.c_str()); });
  }
  return WriteWholeFile(path, text);
}

} // namespace waft
