// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftTogether.h"

#include "Air/Drift/DriftEquations.h"
#include "Air/Drift/FourDrifts.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace waft
{
namespace
{

constexpr int MostGradients = 24;     // conjugate ones, of a step
constexpr double StepAccuracy = 5e-2; // of the right hand side's norm, in which a step is solved
constexpr double SamePlace = 1e-9;    // m: bodies nearer than this have no direction to part in

/// Two that are nearer to each other than they keep.
struct Push
{
  std::uint32_t Frame = 0, A = 0, B = 0; // bodies
  Vec3 Normal = Vec3::UnitZ();           // from B to A
  double Depth = 0.0;
};

/// False: they are not.
bool FindPush(const DriftContact& contact, const std::vector<std::vector<Vec3>>& paths, Push& push)
{
  const auto f = static_cast<std::size_t>(contact.Frame);
  const Vec3 apart = paths[contact.A][f] - paths[contact.B][f];
  const double distance = apart.norm();
  push = { static_cast<std::uint32_t>(contact.Frame), contact.A, contact.B };
  push.Depth = contact.Kept - distance;
  if (distance > SamePlace)
  {
    push.Normal = apart / distance;
  }
  return push.Depth > 0.0;
}

// All equations of the bodies that move, and what pushes them apart. Bodies are four side by side,
// sums over them in their order; each rank has the equations of its own.
class TogetherEquations
{
public:
  TogetherEquations(const std::vector<TogetherBody>& bodies,
                    const std::vector<DriftContact>& contacts, const AirSampler& air, double weight,
                    const ParallelFor& parallel, Communicator& ranks) :
    Bodies(bodies),
    Contacts(contacts), Air(air), Weight(weight), Parallel(parallel), Ranks(ranks),
    Places(bodies.size(), Nobody), Crossings(static_cast<std::size_t>(ranks.Size()))
  {
    for (std::size_t o = 0; o < bodies.size(); ++o)
    {
      if (bodies[o].Problem)
      {
        this->Places[o] = static_cast<std::uint32_t>(this->Size());
        this->Moving.push_back(o);
      }
    }
    const std::size_t fours = (this->Size() + FourDrifts::Count - 1) / FourDrifts::Count;
    for (const std::size_t g : BeginsOfRanks(fours, ranks.Size()))
    {
      this->RankBegins.push_back(std::min(FourDrifts::Count * g, this->Size()));
    }
    this->First = this->RankBegins[static_cast<std::size_t>(ranks.Rank())];
    this->End = this->RankBegins[static_cast<std::size_t>(ranks.Rank()) + 1];
    this->Begins.resize(this->OwnSize() + 1);
    for (std::size_t m = this->First; m < this->End; m += FourDrifts::Count)
    {
      std::size_t halfBand = 0;
      for (std::size_t k = m; k < std::min(m + FourDrifts::Count, this->End); ++k)
      {
        halfBand = std::max(halfBand, DriftEquations::HalfBandOf(this->ProblemOf(k)));
      }
      this->Fours.emplace_back(this->ProblemOf(m).IsFixed.size(), halfBand);
    }
    for (std::size_t c = 0; c < contacts.size(); ++c)
    {
      if (c == 0 || contacts[c].Frame != contacts[c - 1].Frame)
      {
        this->FrameBegins.push_back(c);
      }
    }
    this->FrameBegins.push_back(contacts.size());
  }

  /// About the paths; their cost.
  double Linearise(const std::vector<std::vector<Vec3>>& paths)
  {
    const double pushes = this->FindPushes(paths);
    this->ListPulls();
    std::vector<double> costs(this->Size());
    this->Each(this->OwnSize(), [&](std::size_t k)
               { costs[this->First + k] = this->Linearise(this->First + k, paths); });
    return this->SumOfRanks(costs) + pushes;
  }

  /// The step of Levenberg's method, and by how much it should lower the cost; false: the equations
  /// of a body cannot be solved. They are used up by it.
  bool FindStep(double damping, double& promised)
  {
    std::vector<char> isFactored(this->Fours.size());
    this->Each(this->Fours.size(),
               [&](std::size_t g) { isFactored[g] = this->Fours[g].Factor(damping) ? 1 : 0; });
    const bool fails = std::find(isFactored.begin(), isFactored.end(), 0) != isFactored.end();
    if (this->Ranks.Largest(fails ? 1.0 : 0.0) > 0.0)
    {
      return false;
    }
    double left = this->Sum([](FourDrifts& four) { return four.Begin(); });
    const double enough = StepAccuracy * StepAccuracy * left;
    double size = 0.0;
    for (int k = 0; k < MostGradients && left > enough; ++k)
    {
      const double next = this->Sum([](FourDrifts& four) { return four.Solve(); });
      const double part = k > 0 ? next / size : 0.0;
      size = next;
      this->Each(this->Fours.size(), [&](std::size_t g) { this->Fours[g].Turn(part); });
      this->SwapDirections();
      const double bend = this->Sum([this](FourDrifts& four) { return this->Multiply(four); });
      left = this->Sum([&](FourDrifts& four) { return four.Go(size / bend); });
    }
    promised = this->Sum([](const FourDrifts& four) { return four.Promises(); });
    return true;
  }

  /// That step of all that move.
  void Move(const std::vector<std::vector<Vec3>>& paths, std::vector<std::vector<Vec3>>& moved)
  {
    this->Each(this->OwnSize(),
               [&](std::size_t k)
               {
                 const std::size_t o = this->Moving[this->First + k];
                 moved[o] = paths[o];
                 this->Fours[k / FourDrifts::Count].Move(k % FourDrifts::Count, moved[o]);
               });
    for (std::size_t r = 0; r + 1 < this->RankBegins.size() && this->Ranks.Size() > 1; ++r)
    {
      this->SendPaths(static_cast<int>(r), moved);
    }
  }

private:
  static constexpr std::uint32_t Nobody = ~std::uint32_t(0);
  /// What pushes a body that moves at a frame.
  struct Pull
  {
    /// Other: among those that move; beyond these, where its direction is among Theirs; Nobody: it
    /// gives way by itself.
    std::uint32_t Frame, Other;
    Vec3 Normal; // the way that it is pushed
    double Depth;
  };
  /// A body of this rank, at a frame at which it is pushed from one of another rank.
  struct Crossing
  {
    std::uint32_t Own, Frame; // Own: among those that move
  };

  std::size_t Size() const { return this->Moving.size(); }
  std::size_t OwnSize() const { return this->End - this->First; }
  bool IsOwn(std::size_t m) const { return m >= this->First && m < this->End; }
  const DriftProblem& ProblemOf(std::size_t m) const
  {
    return *this->Bodies[this->Moving[m]].Problem;
  }
  /// A body among those that move, where it may do so at a frame.
  std::uint32_t PlaceAt(std::uint32_t body, std::uint32_t frame) const
  {
    const std::uint32_t m = this->Places[body];
    return m != Nobody && !this->ProblemOf(m).IsFixed[frame] ? m : Nobody;
  }
  std::size_t RankOf(std::size_t m) const
  {
    const auto after = std::upper_bound(this->RankBegins.begin(), this->RankBegins.end(), m);
    return static_cast<std::size_t>(after - this->RankBegins.begin()) - 1;
  }

  /// Of the paths, frame by frame, to who may move; what they cost.
  double FindPushes(const std::vector<std::vector<Vec3>>& paths)
  {
    const std::size_t frames = this->FrameBegins.size() - 1;
    this->Pushes.resize(frames);
    std::vector<double> costs(frames, 0.0);
    this->Each(frames,
               [&](std::size_t f)
               {
                 std::vector<Push>& pushes = this->Pushes[f];
                 pushes.clear();
                 Push push;
                 for (std::size_t c = this->FrameBegins[f]; c < this->FrameBegins[f + 1]; ++c)
                 {
                   if (FindPush(this->Contacts[c], paths, push) &&
                       (this->PlaceAt(push.A, push.Frame) != Nobody ||
                        this->PlaceAt(push.B, push.Frame) != Nobody))
                   {
                     costs[f] += 0.5 * this->Weight * push.Depth * push.Depth;
                     pushes.push_back(push);
                   }
                 }
               });
    return std::accumulate(costs.begin(), costs.end(), 0.0);
  }

  /// Those of each own body that the pushes make.
  void ListPulls()
  {
    const auto eachPull = [this](const auto& act)
    {
      for (const std::vector<Push>& pushes : this->Pushes)
      {
        for (const Push& push : pushes)
        {
          const std::uint32_t a = this->PlaceAt(push.A, push.Frame);
          const std::uint32_t b = this->PlaceAt(push.B, push.Frame);
          if (a != Nobody && this->IsOwn(a))
          {
            act(push, a, b, push.Normal);
          }
          if (b != Nobody && this->IsOwn(b))
          {
            act(push, b, a, Vec3(-push.Normal));
          }
        }
      }
    };
    // Counted, then written where they belong: of many no list grows.
    std::fill(this->Begins.begin(), this->Begins.end(), 0);
    for (std::vector<Crossing>& crossings : this->Crossings)
    {
      crossings.clear();
    }
    eachPull(
      [this](const Push& push, std::uint32_t own, std::uint32_t other, const Vec3&)
      {
        ++this->Begins[own - this->First + 1];
        if (other != Nobody && !this->IsOwn(other))
        {
          this->Crossings[this->RankOf(other)].push_back({ own, push.Frame });
        }
      });
    std::partial_sum(this->Begins.begin(), this->Begins.end(), this->Begins.begin());
    std::vector<std::size_t> theirs; // by rank: the next of its directions
    std::size_t crossing = 0;
    for (const std::vector<Crossing>& crossings : this->Crossings)
    {
      theirs.push_back(this->Size() + crossing);
      crossing += crossings.size();
    }
    this->Theirs.resize(crossing);
    this->Pulls.resize(this->Begins.back());
    std::vector<std::size_t> next = this->Begins;
    eachPull(
      [&](const Push& push, std::uint32_t own, std::uint32_t other, const Vec3& normal)
      {
        if (other != Nobody && !this->IsOwn(other))
        {
          other = static_cast<std::uint32_t>(theirs[this->RankOf(other)]++);
        }
        this->Pulls[next[own - this->First]++] = { push.Frame, other, normal, push.Depth };
      });
  }

  template <class Work>
  void Each(std::size_t count, const Work& work)
  {
    this->Parallel(count,
                   [&](std::size_t begin, std::size_t end)
                   {
                     for (std::size_t k = begin; k < end; ++k)
                     {
                       work(k);
                     }
                   });
  }

  template <class Work>
  double Sum(const Work& work)
  {
    std::vector<FourDrifts::Sums> parts(this->Fours.size());
    this->Each(this->Fours.size(), [&](std::size_t g) { parts[g] = work(this->Fours[g]); });
    std::vector<double> sums(this->Size());
    for (std::size_t k = 0; k < this->OwnSize(); ++k)
    {
      sums[this->First + k] = parts[k / FourDrifts::Count][k % FourDrifts::Count];
    }
    return this->SumOfRanks(sums);
  }

  /// One a body that moves, of which this rank has its own.
  double SumOfRanks(std::vector<double>& sums)
  {
    this->Ranks.Gather(sums.data(), sizeof(double), this->RankBegins);
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  /// The directions of bodies that are pushed from those of another rank: both have them in the
  /// order of the pushes.
  void SwapDirections()
  {
    Vec3* theirs = this->Theirs.data();
    for (int r = 0; r < this->Ranks.Size(); ++r)
    {
      const std::vector<Crossing>& crossings = this->Crossings[static_cast<std::size_t>(r)];
      if (crossings.empty())
      {
        continue; // on both
      }
      std::vector<Vec3> own;
      for (const Crossing& crossing : crossings)
      {
        own.push_back(this->DirectionOf(crossing.Own, crossing.Frame));
      }
      const std::size_t size = sizeof(Vec3) * own.size();
      this->Ranks.SendReceive(r, own.data(), size, theirs, size);
      theirs += own.size();
    }
  }

  /// Those of the bodies of a rank, from there.
  void SendPaths(int rank, std::vector<std::vector<Vec3>>& paths)
  {
    const std::size_t first = this->RankBegins[static_cast<std::size_t>(rank)];
    const std::size_t end = this->RankBegins[static_cast<std::size_t>(rank) + 1];
    std::vector<Vec3> all;
    for (std::size_t m = first; m < end; ++m)
    {
      const std::vector<Vec3>& path = paths[this->Moving[m]];
      all.insert(all.end(), path.begin(), path.end());
    }
    this->Ranks.Broadcast(all.data(), sizeof(Vec3) * all.size(), rank);
    auto next = all.begin();
    for (std::size_t m = first; m < end && rank != this->Ranks.Rank(); ++m)
    {
      std::vector<Vec3>& path = paths[this->Moving[m]];
      std::copy_n(next, path.size(), path.begin());
      next += static_cast<std::ptrdiff_t>(path.size());
    }
  }

  double Linearise(std::size_t m, const std::vector<std::vector<Vec3>>& paths)
  {
    const std::size_t o = this->Moving[m];
    const std::size_t own = m - this->First;
    DriftEquations equations(this->ProblemOf(m), this->Air, this->Bodies[o].Weights);
    equations.LookAt(paths[o]);
    const double cost = equations.Linearise();
    for (std::size_t p = this->Begins[own]; p < this->Begins[own + 1]; ++p)
    {
      const Pull& pull = this->Pulls[p];
      equations.AddPush(static_cast<int>(pull.Frame), pull.Normal, pull.Depth, this->Weight);
    }
    this->Fours[own / FourDrifts::Count].Set(own % FourDrifts::Count, equations);
    return cost;
  }

  /// Of an own body.
  Vec3 DirectionOf(std::size_t m, std::size_t frame) const
  {
    const std::size_t own = m - this->First;
    return this->Fours[own / FourDrifts::Count].Direction(own % FourDrifts::Count, frame);
  }

  FourDrifts::Sums Multiply(FourDrifts& four)
  {
    four.Multiply();
    const auto first = FourDrifts::Count * static_cast<std::size_t>(&four - this->Fours.data());
    for (std::size_t own = first; own < std::min(first + FourDrifts::Count, this->OwnSize()); ++own)
    {
      for (std::size_t p = this->Begins[own]; p < this->Begins[own + 1]; ++p)
      {
        const Pull& pull = this->Pulls[p];
        if (pull.Other == Nobody)
        {
          continue;
        }
        const Vec3 along = pull.Other < this->Size() ? this->DirectionOf(pull.Other, pull.Frame)
                                                     : this->Theirs[pull.Other - this->Size()];
        four.Subtract(own % FourDrifts::Count, pull.Frame, pull.Normal,
                      this->Weight * pull.Normal.dot(along));
      }
    }
    return four.Bend();
  }

  const std::vector<TogetherBody>& Bodies;
  const std::vector<DriftContact>& Contacts; // frame by frame
  const AirSampler& Air;
  double Weight;
  const ParallelFor& Parallel;
  Communicator& Ranks;
  std::vector<std::size_t> Moving;      // bodies
  std::vector<std::uint32_t> Places;    // of each body among these
  std::vector<std::size_t> RankBegins;  // among these, of each rank, and the end
  std::size_t First = 0, End = 0;       // this rank's own
  std::vector<FourDrifts> Fours;        // the equations of these
  std::vector<std::size_t> FrameBegins; // of the contacts of a frame, and the end
  // About the paths of the equations:
  std::vector<std::vector<Push>> Pushes;        // by frame that has contacts
  std::vector<std::size_t> Begins;              // of the pulls of each own body, and the end
  std::vector<Pull> Pulls;                      // of these
  std::vector<std::vector<Crossing>> Crossings; // by rank
  std::vector<Vec3> Theirs;                     // the directions there, rank by rank
};

} // namespace

bool SolveTogether(const std::vector<TogetherBody>& bodies,
                   const std::vector<DriftContact>& contacts, const AirSampler& air, double weight,
                   int maximumIterations, const ParallelFor& parallel, Communicator& ranks,
                   Monitor& monitor, std::vector<std::vector<Vec3>>& paths)
{
  const Timeline* time = nullptr;
  for (std::size_t o = 0; o < bodies.size(); ++o)
  {
    const DriftProblem* problem = bodies[o].Problem.get();
    for (std::size_t f = 0; problem && f < paths[o].size(); ++f)
    {
      paths[o][f] = problem->IsFixed[f] ? problem->Fixed[f] : paths[o][f];
    }
    time = problem ? &problem->Time : time;
  }
  if (time == nullptr)
  {
    return true;
  }
  TogetherEquations equations(bodies, contacts, air, weight, parallel, ranks);
  DriftDamping damping(*time);
  double cost = equations.Linearise(paths);
  std::vector<std::vector<Vec3>> trial = paths;
  for (int iteration = 0; iteration < maximumIterations; ++iteration)
  {
    if (!GoesOn(ranks, monitor, -1.0))
    {
      return false;
    }
    double next = 1e300;
    double promised = 0.0;
    if (equations.FindStep(damping.Value, promised))
    {
      equations.Move(paths, trial);
      next = equations.Linearise(trial);
    }
    if (!(next < cost))
    {
      if (!damping.Raise())
      {
        return true;
      }
      (void)equations.Linearise(paths);
      continue;
    }
    const bool isConverged = DriftDamping::IsConverged(cost, next);
    damping.Lower(cost - next, promised);
    cost = next;
    std::swap(paths, trial);
    if (isConverged)
    {
      return true;
    }
  }
  return true;
}

std::vector<std::vector<double>> ContactResidue(const std::vector<DriftContact>& contacts,
                                                const std::vector<std::vector<Vec3>>& paths)
{
  std::vector<std::vector<double>> residue;
  for (const std::vector<Vec3>& path : paths)
  {
    residue.emplace_back(path.size(), 0.0);
  }
  Push push;
  for (const DriftContact& contact : contacts)
  {
    if (FindPush(contact, paths, push))
    {
      for (const std::size_t o : { push.A, push.B })
      {
        double& most = residue[o][push.Frame];
        most = std::max(most, push.Depth);
      }
    }
  }
  return residue;
}

} // namespace waft
