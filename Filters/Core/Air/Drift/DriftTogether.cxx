// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftTogether.h"

#include "Air/Drift/DriftEquations.h"
#include "Air/Drift/FourDrifts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace waft
{
namespace
{

constexpr std::size_t MostFactors = 2048; // that are kept, of bodies: 130 MB at 300 frames
constexpr int MostGradients = 24;         // conjugate ones, of a step
constexpr double StepAccuracy = 5e-2; // of the right hand side's norm, in which a step is solved
constexpr double SamePlace = 1e-9;    // m: bodies nearer than this have no direction to part in

struct Push
{
  Vec3 Normal = Vec3::UnitZ(); // from B to A
  double Depth = 0.0;
};

Push PushOf(const DriftContact& contact, const std::vector<std::vector<Vec3>>& paths)
{
  const auto f = static_cast<std::size_t>(contact.Frame);
  const Vec3 apart = paths[contact.A][f] - paths[contact.B][f];
  const double distance = apart.norm();
  Push push;
  push.Depth = contact.Kept - distance;
  if (distance > SamePlace)
  {
    push.Normal = apart / distance;
  }
  return push;
}

/// A contact of one of a rank's own bodies with one of another rank.
struct Crossing
{
  std::uint32_t Contact, Own; // Own: among those that move
  std::uint32_t Rank;         // the other's
};

// All equations of the bodies that move, and the contacts between them. Bodies are four side by
// side, sums over them in their order; each rank has the equations of its own.
class TogetherEquations
{
public:
  TogetherEquations(const std::vector<TogetherBody>& bodies,
                    const std::vector<DriftContact>& contacts, const AirSampler& air, double weight,
                    const ParallelFor& parallel, Communicator& ranks) :
    Bodies(bodies),
    Contacts(contacts), Air(air), Weight(weight), Parallel(parallel), Ranks(ranks),
    Pushing(static_cast<std::size_t>(ranks.Size()))
  {
    std::vector<std::size_t> place(bodies.size(), Nobody);
    for (std::size_t o = 0; o < bodies.size(); ++o)
    {
      if (bodies[o].Problem)
      {
        place[o] = this->Moving.size();
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
    this->ListTouches(place);
    this->Pulls.resize(this->OwnSize());
    this->Depths.resize(contacts.size());
    for (std::size_t m = this->First; m < this->End; m += FourDrifts::Count)
    {
      std::size_t halfBand = 0;
      for (std::size_t k = m; k < std::min(m + FourDrifts::Count, this->End); ++k)
      {
        halfBand = std::max(halfBand, DriftEquations::HalfBandOf(this->ProblemOf(k)));
      }
      this->Fours.emplace_back(this->ProblemOf(m).IsFixed.size(), halfBand,
                               this->Size() <= MostFactors);
    }
  }

  double Cost(const std::vector<std::vector<Vec3>>& paths)
  {
    std::vector<double> costs(this->Size());
    this->Each(this->OwnSize(),
               [&](std::size_t k)
               {
                 const TogetherBody& body = this->Bodies[this->Moving[this->First + k]];
                 DriftResiduals residuals(*body.Problem, this->Air, body.Weights);
                 costs[this->First + k] = residuals.Cost(paths[this->Moving[this->First + k]]);
               });
    return this->SumOfRanks(costs) + this->PushesCost(paths);
  }

  /// About the paths.
  void Linearise(const std::vector<std::vector<Vec3>>& paths)
  {
    this->Each(this->OwnSize(), [&](std::size_t k) { this->Linearise(this->First + k, paths); });
    for (std::vector<std::uint32_t>& pushing : this->Pushing)
    {
      pushing.clear();
    }
    for (std::size_t c = 0; c < this->Crossings.size(); ++c)
    {
      if (PushOf(this->Contacts[this->Crossings[c].Contact], paths).Depth > 0.0)
      {
        this->Pushing[this->Crossings[c].Rank].push_back(static_cast<std::uint32_t>(c));
      }
    }
  }

  /// The step of Levenberg's method, and by how much it should lower the cost; false: the equations
  /// of a body cannot be solved.
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
  struct Touch // of a body at a frame at which it may move
  {
    /// Other: among those that move; beyond these, the crossing to it; Nobody: it gives way by
    /// itself.
    std::uint32_t Contact, Other;
  };
  struct Pull // of another that moves
  {
    std::uint32_t Frame, Other;
    Vec3 Normal;
  };

  std::size_t Size() const { return this->Moving.size(); }
  std::size_t OwnSize() const { return this->End - this->First; }
  bool IsOwn(std::size_t m) const { return m >= this->First && m < this->End; }
  const DriftProblem& ProblemOf(std::size_t m) const
  {
    return *this->Bodies[this->Moving[m]].Problem;
  }
  bool IsFixed(std::size_t m, int frame) const
  {
    return this->ProblemOf(m).IsFixed[static_cast<std::size_t>(frame)] != 0;
  }
  std::size_t RankOf(std::size_t m) const
  {
    const auto after = std::upper_bound(this->RankBegins.begin(), this->RankBegins.end(), m);
    return static_cast<std::size_t>(after - this->RankBegins.begin()) - 1;
  }

  /// place: of each body among those that move.
  void ListTouches(const std::vector<std::size_t>& place)
  {
    // Counted, then written where they belong: of millions no list grows.
    this->Begins.assign(this->OwnSize() + 1, 0);
    const auto eachTouch = [&](const auto& act)
    {
      for (std::size_t k = 0; k < this->Contacts.size(); ++k)
      {
        const DriftContact& contact = this->Contacts[k];
        for (const std::size_t o : { contact.A, contact.B })
        {
          const std::size_t m = place[o];
          if (m != Nobody && this->IsOwn(m) && !this->IsFixed(m, contact.Frame))
          {
            const std::size_t other = place[o == contact.A ? contact.B : contact.A];
            const bool isPair = other != Nobody && !this->IsFixed(other, contact.Frame);
            act(k, m, isPair ? other : Nobody);
          }
        }
      }
    };
    eachTouch([this](std::size_t, std::size_t m, std::size_t)
              { ++this->Begins[m - this->First + 1]; });
    std::partial_sum(this->Begins.begin(), this->Begins.end(), this->Begins.begin());
    this->Touches.resize(this->Begins.back());
    std::vector<std::size_t> next = this->Begins;
    eachTouch(
      [&](std::size_t k, std::size_t m, std::size_t other)
      {
        Touch touch{ static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(other) };
        if (other != Nobody && !this->IsOwn(other))
        {
          touch.Other = static_cast<std::uint32_t>(this->Size() + this->Crossings.size());
          this->Crossings.push_back({ touch.Contact, static_cast<std::uint32_t>(m),
                                      static_cast<std::uint32_t>(this->RankOf(other)) });
        }
        this->Touches[next[m - this->First]++] = touch;
      });
    this->Theirs.resize(this->Crossings.size());
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

  /// The directions of bodies whose contacts with another rank's push: both have them in the order
  /// of contacts.
  void SwapDirections()
  {
    for (int r = 0; r < this->Ranks.Size(); ++r)
    {
      const std::vector<std::uint32_t>& pushing = this->Pushing[static_cast<std::size_t>(r)];
      if (pushing.empty())
      {
        continue; // on both
      }
      std::vector<Vec3> own, theirs(pushing.size());
      for (const std::uint32_t c : pushing)
      {
        const int frame = this->Contacts[this->Crossings[c].Contact].Frame;
        own.push_back(this->DirectionOf(this->Crossings[c].Own, static_cast<std::size_t>(frame)));
      }
      const std::size_t size = sizeof(Vec3) * own.size();
      this->Ranks.SendReceive(r, own.data(), size, theirs.data(), size);
      for (std::size_t k = 0; k < theirs.size(); ++k)
      {
        this->Theirs[pushing[k]] = theirs[k];
      }
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

  /// Of the contacts.
  double PushesCost(const std::vector<std::vector<Vec3>>& paths)
  {
    this->Each(this->Contacts.size(),
               [&](std::size_t k) { this->Depths[k] = PushOf(this->Contacts[k], paths).Depth; });
    double cost = 0.0;
    for (const double depth : this->Depths)
    {
      cost += depth > 0.0 ? 0.5 * this->Weight * depth * depth : 0.0;
    }
    return cost;
  }

  void Linearise(std::size_t m, const std::vector<std::vector<Vec3>>& paths)
  {
    const std::size_t o = this->Moving[m];
    const std::size_t own = m - this->First;
    DriftEquations equations(this->ProblemOf(m), this->Air, this->Bodies[o].Weights);
    equations.LookAt(paths[o]);
    (void)equations.Linearise();
    this->Pulls[own].clear();
    for (std::size_t t = this->Begins[own]; t < this->Begins[own + 1]; ++t)
    {
      const Touch& touch = this->Touches[t];
      const DriftContact& contact = this->Contacts[touch.Contact];
      const Push push = PushOf(contact, paths);
      if (push.Depth > 0.0)
      {
        equations.AddPush(contact.Frame, contact.A == o ? push.Normal : Vec3(-push.Normal),
                          push.Depth, this->Weight);
        if (touch.Other != Nobody)
        {
          this->Pulls[own].push_back(
            { static_cast<std::uint32_t>(contact.Frame), touch.Other, push.Normal });
        }
      }
    }
    this->Fours[own / FourDrifts::Count].Set(own % FourDrifts::Count, equations);
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
      for (const Pull& pull : this->Pulls[own])
      {
        const Vec3 along = pull.Other < this->Size() ? this->DirectionOf(pull.Other, pull.Frame)
                                                     : this->Theirs[pull.Other - this->Size()];
        four.Subtract(own % FourDrifts::Count, pull.Frame, pull.Normal,
                      this->Weight * pull.Normal.dot(along));
      }
    }
    return four.Bend();
  }

  const std::vector<TogetherBody>& Bodies;
  const std::vector<DriftContact>& Contacts;
  const AirSampler& Air;
  double Weight;
  const ParallelFor& Parallel;
  Communicator& Ranks;
  std::vector<std::size_t> Moving;     // bodies
  std::vector<std::size_t> RankBegins; // among these, of each rank, and the end
  std::size_t First = 0, End = 0;      // this rank's own
  std::vector<FourDrifts> Fours;       // the equations of these
  std::vector<std::size_t> Begins;     // of the touches of each, and the end
  std::vector<Touch> Touches;
  std::vector<Crossing> Crossings;
  std::vector<std::vector<std::uint32_t>>
    Pushing;                            // crossings about the paths of the equations, by rank
  std::vector<Vec3> Theirs;             // by crossing: the direction there
  std::vector<std::vector<Pull>> Pulls; // of each, about the paths of the equations
  std::vector<double> Depths;           // by contact
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
  double cost = equations.Cost(paths);
  equations.Linearise(paths);
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
      next = equations.Cost(trial);
    }
    if (!(next < cost))
    {
      if (!damping.Raise())
      {
        return true;
      }
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
    equations.Linearise(paths);
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
  for (const DriftContact& contact : contacts)
  {
    const double depth = PushOf(contact, paths).Depth;
    for (const std::size_t o : { contact.A, contact.B })
    {
      double& most = residue[o][static_cast<std::size_t>(contact.Frame)];
      most = std::max(most, depth);
    }
  }
  return residue;
}

} // namespace waft
