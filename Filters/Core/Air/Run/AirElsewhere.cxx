// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirElsewhere.h"

#include "Air/Run/AirSetup.h"
#include "Base/Digest.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace waft
{
namespace
{

/// Of some bytes, as fast as they are read: four sums side by side.
std::uint64_t QuickSum(const void* bytes, std::size_t size)
{
  constexpr std::size_t count = 4;
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ull; // odd
  std::uint64_t sums[count] = { 1, 2, 3, 4 };
  const char* at = static_cast<const char*>(bytes);
  const auto add = [&](std::size_t lane, const char* from, std::size_t length)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, from, length);
    sums[lane] = (sums[lane] ^ word) * factor;
    sums[lane] ^= sums[lane] >> 29;
  };
  std::size_t done = 0;
  for (; done + count * sizeof(std::uint64_t) <= size; done += count * sizeof(std::uint64_t))
  {
    for (std::size_t lane = 0; lane < count; ++lane)
    {
      add(lane, at + done + lane * sizeof(std::uint64_t), sizeof(std::uint64_t));
    }
  }
  for (; done < size; done += sizeof(std::uint64_t))
  {
    add(0, at + done, std::min(sizeof(std::uint64_t), size - done));
  }
  Digest digest;
  digest.Add(sums, sizeof(sums));
  return digest.Sum();
}

/// Of an air's values and times; never 0.
std::uint64_t SumOf(const HalfSeries& air, const ParallelFor& parallel)
{
  std::vector<std::uint64_t> sums(air.Values.size());
  parallel(sums.size(),
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t k = begin; k < end; ++k)
             {
               sums[k] = QuickSum(air.Values[k].data(), sizeof(Half3) * air.Values[k].size());
             }
           });
  Digest digest;
  digest.Add(sums.data(), sizeof(std::uint64_t) * sums.size());
  digest.Add(air.Times.data(), sizeof(double) * air.Times.size());
  return std::max<std::uint64_t>(digest.Sum(), 1);
}

/// What bodies do depends on all the time.
struct ToldRun
{
  MotionProblem Problem; // of the Tracks their places alone
  AssimilationOptions Options;
  std::vector<Formation> Formations;
  bool HasSolids = false;
};

template <class Told>
void MoveRun(StateArchive& stream, Told& told)
{
  stream.Values(told.Problem, told.Formations, told.HasSolids);
  AssimilationOptions::VisitAir(stream, told.Options);
}

template <class Air>
void MoveAir(StateArchive& stream, Air& air)
{
  HalfSeries::VisitLattice(stream, air);
  stream.Values(air.Values);
}

/// What the first rank sends. Where there is no memory for it the process ends, and with it all: it
/// could not tell the first one in the middle of that.
void Receive(Communicator& ranks, HalfSeries& air) noexcept
{
  BroadcastStream stream(ranks);
  MoveAir(stream, air);
}

ToldRun ToldOf(const AirContext& run)
{
  ToldRun told;
  told.Problem.Scene = run.Input.Scene;
  told.Problem.Objects = run.Input.Objects;
  told.Problem.Constraints = run.Rows;
  told.Problem.Obstacles = run.Input.Obstacles;
  for (std::size_t o = 0; o < run.Plans.size(); ++o)
  {
    told.Problem.Tracks.emplace_back();
    told.Problem.Tracks.back().ObjectId = run.Input.Tracks[o].ObjectId;
    told.Problem.Tracks.back().Positions = run.Plans[o];
  }
  told.Options = run.Options;
  told.Formations = run.Formations;
  told.HasSolids = run.Search.HasSolids;
  return told;
}

AssimilationInput InputOf(MotionProblem problem)
{
  AssimilationInput input;
  static_cast<MotionProblem&>(input) = std::move(problem);
  return input;
}

} // namespace

BodyState StateOf(const BodyProblem& body, const std::vector<Vec3>& path)
{
  BodyState state;
  state.Path = path;
  const Constraint* free = body.FreeLanding(); // the last one
  for (std::size_t l = 0; l + (free != nullptr ? 1 : 0) < body.NumberOfLandings(); ++l)
  {
    state.TouchDowns.push_back(body.TouchDown(l));
    state.LiftOffs.push_back(body.LiftOff(l));
  }
  if (free != nullptr)
  {
    state.LandedFreely.push_back(*free);
  }
  return state;
}

void SetState(BodyState state, BodyProblem& body, std::vector<Vec3>& path)
{
  if (!state.LandedFreely.empty() && body.FreeLanding() == nullptr)
  {
    body.LandFreely(state.LandedFreely.front());
  }
  for (std::size_t l = 0; l < state.TouchDowns.size(); ++l)
  {
    body.SetTouchDown(l, state.TouchDowns[l]);
    body.SetLiftOff(l, state.LiftOffs[l]);
  }
  path = std::move(state.Path);
}

bool TellRun(const AirContext& run, const HalfSeries& air, const AirBodies& bodies,
             StateArchive& stream)
{
  const bool isNewRun = !run.IsTold;
  const std::uint64_t sum = SumOf(air, run.Parallel);
  const bool isNewAir = run.AirSent != sum;
  run.IsTold = true;
  run.AirSent = sum;
  stream.Values(isNewRun, isNewAir, sum);
  if (isNewRun)
  {
    const ToldRun told = ToldOf(run);
    MoveRun(stream, told);
  }
  std::vector<BodyState> states;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    states.push_back(StateOf(bodies.Problems[o], bodies.Paths[o]));
    if (!bodies.Poses.empty())
    {
      states.back().Slips = bodies.Poses[o].Slips;
    }
  }
  const std::vector<BodyState>& all = states;
  stream.Values(all, bodies.IsOld);
  return isNewAir;
}

void SendAir(const HalfSeries& air, Communicator& ranks)
{
  BroadcastStream stream(ranks);
  MoveAir(stream, air);
}

struct AirElsewhere::Heard
{
  Heard(ToldRun told, const ParallelFor& parallel) :
    Input(InputOf(std::move(told.Problem))), Options(told.Options), Parallel(parallel),
    Run(this->Input, this->Options, this->None, this->Parallel, this->Silent)
  {
    this->Run.Search.HasSolids = told.HasSolids;
    this->Run.Formations = std::move(told.Formations);
  }

  AssimilationInput Input;
  AssimilationOptions Options;
  SolidsOn None;
  ParallelFor Parallel;
  SilentMonitor Silent;
  AirContext Run;
  AirBodies Bodies;
};

AirElsewhere::AirElsewhere(Communicator& ranks) : Ranks(ranks) {}
AirElsewhere::~AirElsewhere() = default;

Result AirElsewhere::Hear(StateArchive& stream, const ParallelFor& parallel)
{
  bool isNewRun = false, isNewAir = false;
  std::uint64_t sum = 0;
  stream.Values(isNewRun, isNewAir, sum);
  if (isNewAir) // it comes before anything can be amiss here
  {
    this->Sum = sum;
    Receive(this->Ranks, this->Series);
  }
  if (isNewRun)
  {
    ToldRun told;
    MoveRun(stream, told);
    this->Now = std::make_unique<Heard>(std::move(told), parallel);
    Heard& now = *this->Now;
    WAFT_RETURN_IF_FAILED(now.Run.Obstacles.Build(now.Input.Obstacles));
    AssimilationOutput judged;
    WAFT_RETURN_IF_FAILED(SetUpBodies(now.Run, now.Bodies, judged));
  }
  std::vector<BodyState> states;
  std::vector<char> isOld;
  stream.Values(states, isOld);
  if (this->Now == nullptr || this->Sum != sum || states.size() != this->Now->Bodies.Size())
  {
    return Result::Error("a process has another run than the first one");
  }
  AirBodies& bodies = this->Now->Bodies;
  bodies.IsOld = std::move(isOld);
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (!states[o].Slips.empty())
    {
      bodies.Problems[o].SetSlips(states[o].Slips);
    }
    SetState(std::move(states[o]), bodies.Problems[o], bodies.Paths[o]);
  }
  return Result::Ok();
}

const AirContext& AirElsewhere::Run() const
{
  return this->Now->Run;
}

AirBodies& AirElsewhere::Bodies()
{
  return this->Now->Bodies;
}

} // namespace waft
