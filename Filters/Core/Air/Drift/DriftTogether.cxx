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

// All equations of the bodies that move, and the contacts between them. Bodies are four side by
// side, sums over them in their order.
class TogetherEquations
{
public:
  TogetherEquations(const std::vector<TogetherBody>& bodies,
                    const std::vector<DriftContact>& contacts, const AirSampler& air, double weight,
                    const ParallelFor& parallel) :
    Bodies(bodies),
    Contacts(contacts), Air(air), Weight(weight), Parallel(parallel)
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
    // Counted, then written where they belong: of millions no list grows.
    this->Begins.assign(this->Size() + 1, 0);
    const auto eachTouch = [&](const auto& act)
    {
      for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        for (const std::size_t o : { contacts[k].A, contacts[k].B })
        {
          if (place[o] != Nobody && !this->IsFixed(place[o], contacts[k].Frame))
          {
            act(k, place[o], place[o == contacts[k].A ? contacts[k].B : contacts[k].A]);
          }
        }
      }
    };
    eachTouch([this](std::size_t, std::size_t m, std::size_t) { ++this->Begins[m + 1]; });
    std::partial_sum(this->Begins.begin(), this->Begins.end(), this->Begins.begin());
    this->Touches.resize(this->Begins.back());
    std::vector<std::size_t> next = this->Begins;
    eachTouch(
      [&](std::size_t k, std::size_t m, std::size_t other)
      {
        const bool isPair = other != Nobody && !this->IsFixed(other, contacts[k].Frame);
        this->Touches[next[m]++] = { static_cast<std::uint32_t>(k),
                                     static_cast<std::uint32_t>(isPair ? other : Nobody) };
      });
    this->Pulls.resize(this->Size());
    this->Depths.resize(contacts.size());
    for (std::size_t first = 0; first < this->Size(); first += FourDrifts::Count)
    {
      std::size_t halfBand = 0;
      for (std::size_t m = first; m < this->EndOf(first / FourDrifts::Count); ++m)
      {
        halfBand = std::max(halfBand, DriftEquations::HalfBandOf(this->ProblemOf(m)));
      }
      this->Fours.emplace_back(this->ProblemOf(first).IsFixed.size(), halfBand,
                               this->Size() <= MostFactors);
    }
  }

  double Cost(const std::vector<std::vector<Vec3>>& paths)
  {
    std::vector<double> costs(this->Size());
    this->Each(this->Size(),
               [&](std::size_t m)
               {
                 const TogetherBody& body = this->Bodies[this->Moving[m]];
                 DriftResiduals residuals(*body.Problem, this->Air, body.Weights);
                 costs[m] = residuals.Cost(paths[this->Moving[m]]);
               });
    return std::accumulate(costs.begin(), costs.end(), 0.0) + this->PushesCost(paths);
  }

  /// About the paths.
  void Linearise(const std::vector<std::vector<Vec3>>& paths)
  {
    this->Each(this->Size(), [&](std::size_t m) { this->Linearise(m, paths); });
  }

  /// The step of Levenberg's method, and by how much it should lower the cost; false: the equations
  /// of a body cannot be solved.
  bool FindStep(double damping, double& promised)
  {
    std::vector<char> isFactored(this->Fours.size());
    this->Each(this->Fours.size(),
               [&](std::size_t g) { isFactored[g] = this->Fours[g].Factor(damping) ? 1 : 0; });
    if (std::find(isFactored.begin(), isFactored.end(), 0) != isFactored.end())
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
      const double bend = this->Sum([this](FourDrifts& four) { return this->Multiply(four); });
      left = this->Sum([&](FourDrifts& four) { return four.Go(size / bend); });
    }
    promised = this->Sum([](const FourDrifts& four) { return four.Promises(); });
    return true;
  }

  /// That step of all that move.
  void Move(const std::vector<std::vector<Vec3>>& paths, std::vector<std::vector<Vec3>>& moved)
  {
    this->Each(this->Size(),
               [&](std::size_t m)
               {
                 const std::size_t o = this->Moving[m];
                 moved[o] = paths[o];
                 this->Fours[m / FourDrifts::Count].Move(m % FourDrifts::Count, moved[o]);
               });
  }

private:
  static constexpr std::uint32_t Nobody = ~std::uint32_t(0);
  struct Touch // of a body at a frame at which it may move
  {
    std::uint32_t Contact, Other; // Other: among those that move; Nobody: it gives way by itself
  };
  struct Pull // of another that moves
  {
    std::uint32_t Frame, Other;
    Vec3 Normal;
  };

  std::size_t Size() const { return this->Moving.size(); }
  /// After the last of the bodies of the g-th four.
  std::size_t EndOf(std::size_t g) const
  {
    return std::min(FourDrifts::Count * (g + 1), this->Size());
  }
  const DriftProblem& ProblemOf(std::size_t m) const
  {
    return *this->Bodies[this->Moving[m]].Problem;
  }
  bool IsFixed(std::size_t m, int frame) const
  {
    return this->ProblemOf(m).IsFixed[static_cast<std::size_t>(frame)] != 0;
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
    double sum = 0.0;
    for (std::size_t m = 0; m < this->Size(); ++m)
    {
      sum += parts[m / FourDrifts::Count][m % FourDrifts::Count];
    }
    return sum;
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
    DriftEquations equations(this->ProblemOf(m), this->Air, this->Bodies[o].Weights);
    equations.LookAt(paths[o]);
    (void)equations.Linearise();
    this->Pulls[m].clear();
    for (std::size_t t = this->Begins[m]; t < this->Begins[m + 1]; ++t)
    {
      const DriftContact& contact = this->Contacts[this->Touches[t].Contact];
      const Push push = PushOf(contact, paths);
      if (push.Depth > 0.0)
      {
        equations.AddPush(contact.Frame, contact.A == o ? push.Normal : Vec3(-push.Normal),
                          push.Depth, this->Weight);
        if (this->Touches[t].Other != Nobody)
        {
          this->Pulls[m].push_back(
            { static_cast<std::uint32_t>(contact.Frame), this->Touches[t].Other, push.Normal });
        }
      }
    }
    this->Fours[m / FourDrifts::Count].Set(m % FourDrifts::Count, equations);
  }

  FourDrifts::Sums Multiply(FourDrifts& four)
  {
    four.Multiply();
    const auto g = static_cast<std::size_t>(&four - this->Fours.data());
    for (std::size_t m = FourDrifts::Count * g; m < this->EndOf(g); ++m)
    {
      for (const Pull& pull : this->Pulls[m])
      {
        const FourDrifts& with = this->Fours[pull.Other / FourDrifts::Count];
        const Vec3 along = with.Direction(pull.Other % FourDrifts::Count, pull.Frame);
        four.Subtract(m % FourDrifts::Count, pull.Frame, pull.Normal,
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
  std::vector<std::size_t> Moving; // bodies
  std::vector<FourDrifts> Fours;   // their equations
  std::vector<std::size_t> Begins; // of the touches of each, and the end
  std::vector<Touch> Touches;
  std::vector<std::vector<Pull>> Pulls; // of each, about the paths of the equations
  std::vector<double> Depths;           // by contact
};

} // namespace

bool SolveTogether(const std::vector<TogetherBody>& bodies,
                   const std::vector<DriftContact>& contacts, const AirSampler& air, double weight,
                   int maximumIterations, const ParallelFor& parallel, Monitor& monitor,
                   std::vector<std::vector<Vec3>>& paths)
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
  TogetherEquations equations(bodies, contacts, air, weight, parallel);
  DriftDamping damping(*time);
  double cost = equations.Cost(paths);
  equations.Linearise(paths);
  std::vector<std::vector<Vec3>> trial = paths;
  for (int iteration = 0; iteration < maximumIterations; ++iteration)
  {
    if (!monitor.Tick(-1.0, ""))
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
