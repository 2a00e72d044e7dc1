// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirAssimilation.h"

#include "Air/Run/AssimilationRun.h"
#include "Base/NumberText.h"
#include "Constraints/ConstraintCheck.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{
namespace
{

constexpr int LeastFrames = 8;
constexpr double EnoughControl = 0.065; // of the flow at the bodies
constexpr double LargeControl = 0.3;    // of the flow, that is told
constexpr std::size_t MostTold = 10;
constexpr const char* Finished = "finish";

/// " (its mark at frame 30)", " (its 4 marks at frames 30 to 60)": those that somebody asked for.
std::string MarksText(const std::vector<Constraint>& rows)
{
  int count = 0, first = 0, last = 0;
  for (const Constraint& row : rows)
  {
    if (row.Row != OfNoRow)
    {
      first = count == 0 ? row.Frame : std::min(first, row.Frame);
      last = count == 0 ? row.Frame : std::max(last, row.Frame);
      ++count;
    }
  }
  const std::string marks = count == 1 ? "its mark" : "its " + std::to_string(count) + " marks";
  return count == 0 ? "" : " (" + marks + " " + FramesText(first, last) + ")";
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

Result AssimilationRun::Run(AssimilationState* memory)
{
  WAFT_RETURN_IF_FAILED(CheckTracks(this->Input, LeastFrames));
  WAFT_RETURN_IF_FAILED(this->Obstacles.Build(this->Input.Obstacles));
  WAFT_RETURN_IF_FAILED(this->SetUpDrifters());
  this->SetUpScene();
  this->Key = KeyOf(this->Input, this->Options);
  this->ShowPaths();
  const bool isEdit = this->Edit(memory);
  if (memory != nullptr)
  {
    *memory = AssimilationState();
  }
  const Result result = isEdit ? Result::Ok() : this->Solve();
  if (!result)
  {
    return result;
  }
  this->Output.Tracks.clear(); // what was shown so far
  if (!this->Drawn.Velocity.IsEmpty())
  {
    this->Finish(result.IsStopped());
  }
  else
  {
    this->KeepPlan();
  }
  if (!result.IsStopped())
  {
    this->Leave(memory);
  }
  return result;
}

Result AssimilationRun::Solve()
{
  Result result = Result::Ok();
  int round = 0;
  if (!this->Resume(round))
  {
    result = this->Draw();
    if (!result || result.IsStopped())
    {
      this->Drawn.Velocity = HalfSeries();
      return result;
    }
    result = this->FirstDrift();
    this->KeepCheckpoint(0, result);
  }
  if (this->Options.Rounds == 0 && !result.IsStopped())
  {
    const HalfSeries plain = this->Drawn.Velocity;
    result = this->FindWind(plain, 0);
  }
  for (; round < this->Options.Rounds && !result.IsStopped() && this->GoesOn(); ++round)
  {
    HalfSeries plain = this->Drawn.Velocity;
    result = this->FindWind(plain, round);
    if (!result.IsStopped())
    {
      result = this->SimulateAgain(std::move(plain), round);
    }
    WAFT_RETURN_IF_FAILED(result);
    this->KeepCheckpoint(round + 1, result);
  }
  return result;
}

bool AssimilationRun::GoesOn() const
{
  const AssimilationRound& last = this->Output.Rounds.back();
  const bool isLate = this->Options.TimeLimit > 0.0 && this->Seconds() > this->Options.TimeLimit;
  return last.Control > EnoughControl * last.Flow && !isLate;
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
      if (row.ObjectId != track.ObjectId)
      {
        continue;
      }
      if (IsBinding(row, this->Output.Report))
      {
        rows.push_back(row);
      }
      else if (row.Status == ConstraintStatus::Unreachable && IsPositional(row.Kind))
      {
        // The plan comes as near as it can.
        Constraint near = row;
        near.Kind = ConstraintKind::Position;
        near.Value = track.Positions[static_cast<std::size_t>(row.Frame)];
        near.Radius = 0.0;
        rows.push_back(near);
      }
    }
    if (object->second->VelocityGiven != 0)
    {
      Constraint row;
      row.ObjectId = track.ObjectId;
      row.Kind = ConstraintKind::Velocity;
      row.Value = object->second->Velocity;
      row.Row = row.Target = OfNoRow;
      rows.push_back(row);
    }
    this->Drifters.emplace_back(this->Around, *object->second, track.Positions, rows);
    this->Paths.push_back(track.Positions);
  }
  return Result::Ok();
}

void AssimilationRun::ShowPaths()
{
  if (!this->Caller.ShowsSoFar())
  {
    return;
  }
  this->Output.Tracks.resize(this->Paths.size());
  for (std::size_t o = 0; o < this->Paths.size(); ++o)
  {
    this->Output.Tracks[o].ObjectId = this->Drifters[o].Object().ObjectId;
    this->Output.Tracks[o].Positions = this->Paths[o];
  }
}

// Before there is an air the plan is the best so far.
void AssimilationRun::KeepPlan()
{
  this->Output.Warnings.push_back("stopped before there was an air: the paths are the plan's");
  this->Output.Tracks = this->Input.Tracks;
  for (const Track& track : this->Output.Tracks)
  {
    this->Output.Controls.emplace_back(track.Positions.size(), Vec3::Zero());
  }
  MeasureResiduals(this->Output.Constraints, this->Output.Tracks, this->Input.Objects,
                   this->Obstacles, this->Input.Scene, this->Output.Report);
}

void AssimilationRun::Finish(bool isStopped)
{
  if (isStopped)
  {
    this->Output.Warnings.push_back("stopped: objects may come too near to each other");
  }
  else
  {
    this->LandFreeBodies();
    this->KeepApart();
  }
  const AirSampler air(this->Drawn.Velocity);
  const std::size_t count = this->Drifters.size();
  std::vector<char> clear(count, 1);
  this->Parallel(count,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t o = begin; o < end; ++o)
                   {
                     // What an edit left alone is exact already.
                     clear[o] = this->IsKept(o) || this->FinishPath(o, air) ? 1 : 0;
                   }
                 });
  if (!this->Output.Rounds.empty() && this->Output.Rounds.back().Stage == Finished)
  {
    this->Output.Rounds.pop_back(); // of the run that this one goes on from
  }
  this->Note(Finished, nullptr);
  this->TellLargeHands();
  for (std::size_t o = 0; o < count; ++o)
  {
    if (!clear[o])
    {
      this->Output.Warnings.push_back("object " +
                                      std::to_string(this->Drifters[o].Object().ObjectId) +
                                      ": the path leaves less than the clearance asked for, " +
                                      NumberText(this->Drifters[o].Object().ClearanceRadius) +
                                      " m: give its marks more room beside what is in the way");
    }
    Track track;
    track.ObjectId = this->Drifters[o].Object().ObjectId;
    track.Positions = this->Paths[o];
    const DriftProblem problem = this->Drifters[o].Problem(air);
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
          row.LiftOff = own.LiftOff;
        }
      }
    }
    if (const Constraint* landing = this->Drifters[o].FreeLanding())
    {
      this->Output.Constraints.push_back(*landing);
    }
  }
  MeasureResiduals(this->Output.Constraints, this->Output.Tracks, this->Input.Objects,
                   this->Obstacles, this->Input.Scene, this->Output.Report);
  this->Output.Air = std::make_shared<DrawnAir>(std::move(this->Drawn));
  this->Output.Vortices = this->Scene.Forces.Vortices;
}

AssimilationRun::HandOf AssimilationRun::Hand(std::size_t o, const AirSampler& air) const
{
  const DriftProblem problem = this->Drifters[o].Problem(air);
  const std::vector<Vec3>& path = this->Paths[o];
  const std::vector<Vec3> controls = DriftControls(problem, air, path);
  HandOf hand;
  for (std::size_t k = 0; k < controls.size(); ++k)
  {
    if (problem.Flight[k] >= 1.0)
    {
      hand.Control += controls[k].squaredNorm();
      hand.Flow += air.Between(static_cast<int>(k), 0.5 * (path[k] + path[k + 1])).squaredNorm();
      ++hand.Steps;
    }
  }
  return hand;
}

void AssimilationRun::Note(const std::string& stage, const CommonWind* common)
{
  const AirSampler air(this->Drawn.Velocity);
  const std::size_t count = this->Drifters.size();
  std::vector<HandOf> hands(count);
  std::vector<double> winds(count, 0.0);
  this->Parallel(count,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t o = begin; o < end; ++o)
                   {
                     hands[o] = this->Hand(o, air);
                     winds[o] = common ? this->WindAlong(o, *common, air) : 0.0;
                   }
                 });
  HandOf all;
  double wind = 0.0;
  std::vector<double> byObject;
  for (std::size_t o = 0; o < count; ++o)
  {
    all.Control += hands[o].Control;
    all.Flow += hands[o].Flow;
    all.Steps += hands[o].Steps;
    wind += winds[o];
    byObject.push_back(hands[o].Rms(hands[o].Control));
  }
  std::sort(byObject.begin(), byObject.end());
  AssimilationRound row;
  row.Stage = stage;
  row.Candidate = this->Candidate;
  row.Control = all.Rms(all.Control);
  row.MedianControl = byObject[byObject.size() / 2];
  row.Flow = all.Rms(all.Flow);
  row.Wind = all.Rms(wind);
  row.Seconds = this->Seconds();
  this->Output.Rounds.push_back(row);
}

double AssimilationRun::WindAlong(std::size_t o, const CommonWind& common,
                                  const AirSampler& air) const
{
  const DriftProblem problem = this->Drifters[o].Problem(air);
  const std::vector<Vec3>& path = this->Paths[o];
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < path.size(); k += WindStride)
  {
    if (IsFreeStep(problem, path, static_cast<int>(k)))
    {
      const Vec3 middle = 0.5 * (path[k] + path[k + 1]);
      sum += WindStride * common.At(middle, static_cast<double>(k) + 0.5).squaredNorm();
    }
  }
  return sum;
}

void AssimilationRun::TellLargeHands()
{
  const AirSampler air(this->Drawn.Velocity);
  const double flow = this->Output.Rounds.back().Flow;
  std::size_t told = 0;
  for (std::size_t o = 0; o < this->Drifters.size(); ++o)
  {
    const HandOf hand = this->Hand(o, air);
    const double part = flow > 0.0 ? hand.Rms(hand.Control) / flow : 0.0;
    if (part <= LargeControl || ++told > MostTold)
    {
      continue;
    }
    this->Output.Warnings.push_back(
      "object " + std::to_string(this->Drifters[o].Object().ObjectId) +
      MarksText(this->Drifters[o].Rows()) +
      ": the air does not take it there: what moves it besides is " +
      std::to_string(std::lround(100.0 * part)) +
      " % of the flow's velocity: give it more time between its marks, or marks that are nearer");
  }
  if (told > MostTold)
  {
    this->Output.Warnings.push_back("and " + std::to_string(told - MostTold) +
                                    " more objects that the air does not take to their marks");
  }
}

double AssimilationRun::Seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
}

std::uint64_t SeedOfAir(const AssimilationInput& input, const AssimilationOptions& options)
{
  return options.Seed < 0 ? input.Scene.Seed : static_cast<std::uint64_t>(options.Seed);
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
                     AssimilationOutput& output, AssimilationState* memory)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  return AssimilationRun(input, options, solids, parallel, monitor, output).Run(memory);
}

} // namespace waft
