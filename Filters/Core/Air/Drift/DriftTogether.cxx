// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftTogether.h"

#include "Air/Drift/DriftEquations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace waft
{
namespace
{

constexpr int MostGradients = 24;     // conjugate ones, of a step
constexpr double StepAccuracy = 5e-2; // of the right hand side's norm, in which a step is solved
constexpr double SamePlace = 1e-9;    // m: bodies nearer than this have no direction to part in

using Unknowns = std::vector<std::vector<double>>; // by moving body

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

// All equations of the bodies that move, and the contacts between them.
class TogetherEquations
{
public:
  TogetherEquations(const std::vector<TogetherBody>& bodies,
                    const std::vector<DriftContact>& contacts, const AirSampler& air, double weight,
                    const ParallelFor& parallel) :
    Contacts(contacts),
    Weight(weight), Parallel(parallel)
  {
    std::vector<std::size_t> place(bodies.size(), bodies.size());
    for (std::size_t o = 0; o < bodies.size(); ++o)
    {
      if (bodies[o].Problem)
      {
        place[o] = this->Moving.size();
        this->Moving.push_back(o);
        this->Own.emplace_back(*bodies[o].Problem, air, bodies[o].Weights);
      }
    }
    this->Touched.resize(this->Moving.size());
    for (std::size_t k = 0; k < contacts.size(); ++k)
    {
      for (const std::size_t o : { contacts[k].A, contacts[k].B })
      {
        if (place[o] < this->Moving.size())
        {
          const std::size_t other = place[o == contacts[k].A ? contacts[k].B : contacts[k].A];
          const bool isPair =
            other < this->Moving.size() && !this->Own[other].IsFixed(contacts[k].Frame);
          this->Touched[place[o]].push_back({ k, isPair ? other : Alone, o == contacts[k].A });
        }
      }
    }
    this->Pushes.resize(contacts.size());
  }

  std::size_t Size() const { return this->Moving.size(); }
  std::size_t BodyOf(std::size_t m) const { return this->Moving[m]; }

  double Cost(const std::vector<std::vector<Vec3>>& paths)
  {
    const double own =
      this->Sum([&](std::size_t m) { return this->Own[m].Cost(paths[this->Moving[m]]); });
    return own + this->FindPushes(paths);
  }

  /// How the contacts push about the paths; their cost.
  double FindPushes(const std::vector<std::vector<Vec3>>& paths)
  {
    this->Parallel(this->Contacts.size(),
                   [&](std::size_t begin, std::size_t end)
                   {
                     for (std::size_t k = begin; k < end; ++k)
                     {
                       this->Pushes[k] = PushOf(this->Contacts[k], paths);
                     }
                   });
    double cost = 0.0;
    for (const Push& push : this->Pushes)
    {
      cost += push.Depth > 0.0 ? 0.5 * this->Weight * push.Depth * push.Depth : 0.0;
    }
    return cost;
  }

  /// About the paths, whose pushes have been found last.
  void Linearise(const std::vector<std::vector<Vec3>>& paths)
  {
    this->Each(
      [&](std::size_t m)
      {
        (void)this->Own[m].Linearise(paths[this->Moving[m]]);
        for (const Touch& touch : this->Touched[m])
        {
          const Push& push = this->Pushes[touch.Contact];
          if (push.Depth > 0.0)
          {
            this->Own[m].AddPush(this->Contacts[touch.Contact].Frame,
                                 touch.IsA ? push.Normal : Vec3(-push.Normal), push.Depth,
                                 this->Weight);
          }
        }
      });
  }

  /// The step of Levenberg's method, and by how much it should lower the cost; false: the equations
  /// of a body cannot be solved.
  bool FindStep(double damping, Unknowns& step, double& promised)
  {
    std::vector<char> isFactored(this->Size());
    this->Each([&](std::size_t m) { isFactored[m] = this->Own[m].Factor(damping) ? 1 : 0; });
    if (std::find(isFactored.begin(), isFactored.end(), 0) != isFactored.end())
    {
      return false;
    }
    Unknowns descent(this->Size()), along, image(this->Size());
    step.resize(this->Size());
    this->Each(
      [&](std::size_t m)
      {
        descent[m] = this->Own[m].Descent();
        step[m].assign(descent[m].size(), 0.0);
      });
    Unknowns rest = descent;
    const double enough = StepAccuracy * StepAccuracy * this->Dot(rest, rest);
    Unknowns solved = this->Preconditioned(rest);
    along = solved;
    double size = this->Dot(rest, solved);
    for (int k = 0; k<MostGradients&& this->Dot(rest, rest)> enough; ++k)
    {
      this->Each([&](std::size_t m) { this->Multiply(along, m, image[m]); });
      const double length = size / this->Dot(along, image);
      this->Each(
        [&](std::size_t m)
        {
          for (std::size_t i = 0; i < step[m].size(); ++i)
          {
            step[m][i] += length * along[m][i];
            rest[m][i] -= length * image[m][i];
          }
        });
      solved = this->Preconditioned(rest);
      const double next = this->Dot(rest, solved);
      const double turn = next / size;
      size = next;
      this->Each(
        [&](std::size_t m)
        {
          for (std::size_t i = 0; i < along[m].size(); ++i)
          {
            along[m][i] = solved[m][i] + turn * along[m][i];
          }
        });
    }
    promised = this->Sum([&](std::size_t m) { return PromiseOf(step[m], descent[m], damping); });
    return true;
  }

private:
  static constexpr std::size_t Alone = ~std::size_t(0);
  struct Touch
  {
    std::size_t Contact, Other; // Other: among those that move; Alone: it gives way by itself
    bool IsA;
  };

  template <class Body>
  void Each(const Body& body)
  {
    this->Parallel(this->Size(),
                   [&](std::size_t begin, std::size_t end)
                   {
                     for (std::size_t m = begin; m < end; ++m)
                     {
                       body(m);
                     }
                   });
  }

  template <class Value>
  double Sum(const Value& value)
  {
    std::vector<double> parts(this->Size());
    this->Each([&](std::size_t m) { parts[m] = value(m); });
    return std::accumulate(parts.begin(), parts.end(), 0.0);
  }

  double Dot(const Unknowns& a, const Unknowns& b)
  {
    return this->Sum([&](std::size_t m)
                     { return std::inner_product(a[m].begin(), a[m].end(), b[m].begin(), 0.0); });
  }

  Unknowns Preconditioned(Unknowns values)
  {
    this->Each([&](std::size_t m) { this->Own[m].Solve(values[m]); });
    return values;
  }

  void Multiply(const Unknowns& x, std::size_t m, std::vector<double>& y)
  {
    this->Own[m].Multiply(x[m], y);
    for (const Touch& touch : this->Touched[m])
    {
      const Push& push = this->Pushes[touch.Contact];
      const std::size_t at = 3 * static_cast<std::size_t>(this->Contacts[touch.Contact].Frame);
      if (push.Depth > 0.0 && touch.Other != Alone &&
          !this->Own[m].IsFixed(this->Contacts[touch.Contact].Frame))
      {
        const std::vector<double>& other = x[touch.Other];
        const double along =
          this->Weight * push.Normal.dot(Vec3(other[at], other[at + 1], other[at + 2]));
        for (std::size_t c = 0; c < 3; ++c)
        {
          y[at + c] -= along * push.Normal[static_cast<int>(c)];
        }
      }
    }
  }

  const std::vector<DriftContact>& Contacts;
  double Weight;
  const ParallelFor& Parallel;
  std::vector<std::size_t> Moving; // bodies
  std::vector<DriftEquations> Own; // theirs
  std::vector<std::vector<Touch>> Touched;
  std::vector<Push> Pushes; // by contact
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
  Unknowns step;
  for (int iteration = 0; iteration < maximumIterations; ++iteration)
  {
    if (!monitor.Tick(-1.0, ""))
    {
      return false;
    }
    double next = 1e300;
    double promised = 0.0;
    if (equations.FindStep(damping.Value, step, promised))
    {
      for (std::size_t m = 0; m < equations.Size(); ++m)
      {
        const std::size_t o = equations.BodyOf(m);
        trial[o] = paths[o];
        MoveBy(step[m], trial[o]);
      }
      next = equations.Cost(trial);
    }
    if (!(next < cost))
    {
      if (!damping.Raise())
      {
        return true;
      }
      (void)equations.FindPushes(paths); // that the equations have
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
