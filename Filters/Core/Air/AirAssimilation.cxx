// SPDX-License-Identifier: BSD-3-Clause
#include "Air/AirAssimilation.h"

#include "Air/AssimilationRun.h"
#include "Constraints/ConstraintCheck.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{
namespace
{

constexpr int LeastFrames = 8;
constexpr double EnoughControl = 0.05; // of the bodies' motion

Result CheckInput(const AssimilationInput& input)
{
  const int frames = input.Scene.Time.NumberOfFrames;
  if (input.Tracks.empty())
  {
    return Result::Error("Tracks: no track, at least one expected");
  }
  if (frames < LeastFrames)
  {
    return Result::Error("NumberOfFrames: at least " + std::to_string(LeastFrames) +
                         " expected, found " + std::to_string(frames));
  }
  for (const Track& track : input.Tracks)
  {
    const std::string name = "Tracks, object " + std::to_string(track.ObjectId);
    if (track.Positions.size() != static_cast<std::size_t>(frames))
    {
      return Result::Error(name + ": " + std::to_string(track.Positions.size()) +
                           " points, one a frame (" + std::to_string(frames) + ") expected");
    }
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      if (!track.Positions[k].allFinite())
      {
        return Result::Error(name + ": not a finite position at frame " + std::to_string(k));
      }
    }
  }
  return Result::Ok();
}

} // namespace

AssimilationRun::AssimilationRun(const AssimilationInput& input, const AssimilationOptions& options,
                                 const SolidsOn& solids, const ParallelFor& parallel,
                                 Monitor& monitor, AssimilationOutput& output) :
  Input(input),
  Options(options), Solids(solids), Parallel(parallel), Caller(monitor),
  Output(output), Around{ input.Scene, this->Obstacles, options.Inertia }
{
}

Result AssimilationRun::Run()
{
  WAFT_RETURN_IF_FAILED(CheckInput(this->Input));
  WAFT_RETURN_IF_FAILED(this->Obstacles.Build(this->Input.Obstacles));
  WAFT_RETURN_IF_FAILED(this->SetUpDrifters());
  this->SetUpScene();
  Result result = this->Draw();
  if (!result || result.IsStopped())
  {
    return result;
  }
  result = this->FirstDrift();
  if (this->Options.Rounds == 0 && !result.IsStopped())
  {
    this->FindWind();
  }
  for (int round = 0; round < this->Options.Rounds && !result.IsStopped() && this->GoesOn();
       ++round)
  {
    const FieldSeries plain = this->Air;
    this->FindWind();
    result = this->SimulateAgain(plain, round);
    WAFT_RETURN_IF_FAILED(result);
  }
  this->Finish();
  return result;
}

bool AssimilationRun::GoesOn() const
{
  const AssimilationRound& last = this->Output.Rounds.back();
  const bool isLate = this->Options.TimeLimit > 0.0 && this->Seconds() > this->Options.TimeLimit;
  return last.Control > EnoughControl * last.Motion && !isLate;
}

Result AssimilationRun::SetUpDrifters()
{
  this->Output.Constraints = this->Input.Constraints;
  this->Output.Report = JudgeConstraints(this->Input.Constraints, this->Input.Objects,
                                         this->Obstacles, this->Input.Scene);
  std::map<int, const MotionObject*> objects;
  for (const MotionObject& object : this->Input.Objects)
  {
    objects[object.ObjectId] = &object;
  }
  for (const Track& track : this->Input.Tracks)
  {
    const auto object = objects.find(track.ObjectId);
    if (object == objects.end())
    {
      return Result::Error("Objects: no object " + std::to_string(track.ObjectId) +
                           ", which Tracks has");
    }
    std::vector<Constraint> rows;
    for (const Constraint& row : this->Input.Constraints)
    {
      if (row.ObjectId == track.ObjectId && IsBinding(row, this->Output.Report))
      {
        rows.push_back(row);
      }
    }
    this->Drifters.emplace_back(this->Around, *object->second, track.Positions, rows);
    this->Paths.push_back(track.Positions);
  }
  return Result::Ok();
}

void AssimilationRun::Finish()
{
  const AirSampler air(this->Air);
  const std::size_t count = this->Drifters.size();
  std::vector<char> clear(count, 1);
  this->Parallel(count,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t o = begin; o < end; ++o)
                   {
                     clear[o] = this->FinishPath(o, air) ? 1 : 0;
                   }
                 });
  this->Note("finish", nullptr);
  for (std::size_t o = 0; o < count; ++o)
  {
    if (!clear[o])
    {
      this->Output.Warnings.push_back("object " +
                                      std::to_string(this->Drifters[o].Object().ObjectId) +
                                      ": the path leaves less than the clearance asked for");
    }
    Track track;
    track.ObjectId = this->Drifters[o].Object().ObjectId;
    track.Positions = this->Paths[o];
    const DriftProblem problem = this->Drifters[o].Problem();
    const std::vector<Vec3> between = DriftControls(problem, air, track.Positions);
    std::vector<Vec3> controls(track.Positions.size(), Vec3::Zero());
    for (std::size_t f = 0; f < track.Positions.size(); ++f)
    {
      track.AirVelocities.push_back(air.At(static_cast<int>(f), track.Positions[f]));
      const std::size_t before = f > 0 ? f - 1 : 0;
      const std::size_t after = std::min(f, between.size() - 1);
      controls[f] = 0.5 * (between[before] + between[after]);
    }
    this->Output.Tracks.push_back(std::move(track));
    this->Output.Controls.push_back(std::move(controls));
    for (Constraint& row : this->Output.Constraints)
    {
      for (const Constraint& own : this->Drifters[o].Rows())
      {
        if (own.Row == row.Row && own.Target == row.Target && own.ObjectId == row.ObjectId)
        {
          row.TouchDown = own.TouchDown;
        }
      }
    }
  }
  MeasureResiduals(this->Output.Constraints, this->Output.Tracks, this->Input.Objects,
                   this->Obstacles, this->Input.Scene, this->Output.Report);
  this->Output.Air = std::move(this->Air);
  this->Output.Vortices = this->Scene.Forces.Vortices;
}

void AssimilationRun::Note(const std::string& stage, const CommonWind* common)
{
  const AirSampler air(this->Air);
  AssimilationRound row;
  row.Stage = stage;
  row.Candidate = this->Candidate;
  std::vector<double> byObject;
  double sum = 0.0, motion = 0.0, wind = 0.0;
  std::size_t count = 0;
  const double step = this->Input.Scene.Time.Step();
  std::vector<std::vector<Vec3>> velocities(this->Input.Tracks.front().Positions.size() - 1);
  for (std::size_t o = 0; o < this->Drifters.size(); ++o)
  {
    const DriftProblem problem = this->Drifters[o].Problem();
    const std::vector<Vec3> controls = DriftControls(problem, air, this->Paths[o]);
    double own = 0.0;
    std::size_t steps = 0;
    for (std::size_t k = 0; k < controls.size(); ++k)
    {
      if (problem.Flight[k] >= 1.0)
      {
        own += controls[k].squaredNorm();
        ++steps;
        velocities[k].push_back((this->Paths[o][k + 1] - this->Paths[o][k]) / step);
        if (common && k % WindStride == 0)
        {
          wind +=
            WindStride *
            common->At(0.5 * (this->Paths[o][k] + this->Paths[o][k + 1]), k + 0.5).squaredNorm();
        }
      }
    }
    sum += own;
    count += steps;
    byObject.push_back(steps > 0 ? std::sqrt(own / static_cast<double>(steps)) : 0.0);
  }
  for (const std::vector<Vec3>& at : velocities)
  {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& v : at)
    {
      mean += v / static_cast<double>(at.size());
    }
    for (const Vec3& v : at)
    {
      motion += (v - mean).squaredNorm();
    }
  }
  std::sort(byObject.begin(), byObject.end());
  const double all = std::max<double>(1.0, static_cast<double>(count));
  row.Control = std::sqrt(sum / all);
  row.MedianControl = byObject[byObject.size() / 2];
  row.Motion = std::sqrt(motion / all);
  row.Wind = std::sqrt(wind / all);
  row.Seconds = this->Seconds();
  this->Output.Rounds.push_back(row);
}

double AssimilationRun::Seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Begun).count();
}

std::array<int, 3> AirLatticeDimensions(const Box& volume, const AssimilationOptions& options)
{
  const Vec3 size = volume.Size();
  const double cell = size.maxCoeff() / (options.LatticeResolution - 1);
  std::array<int, 3> points{};
  for (int c = 0; c < 3; ++c)
  {
    points[static_cast<std::size_t>(c)] =
      std::max(3, static_cast<int>(std::lround(size[c] / cell)) + 1);
  }
  return points;
}

Result AssimilateAir(const AssimilationInput& input, const AssimilationOptions& options,
                     const SolidsOn& solids, const ParallelFor& parallel, Monitor& monitor,
                     AssimilationOutput& output)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  return AssimilationRun(input, options, solids, parallel, monitor, output).Run();
}

} // namespace waft
