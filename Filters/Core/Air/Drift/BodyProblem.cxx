// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/BodyProblem.h"

#include "Base/Random.h"
#include "Base/SmoothStep.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double BarrierMargin = 0.01;     // m, that the penalty asks for besides, at most
constexpr double HandOverTime = 0.1;       // s, beside what is given
constexpr double TakingTime = 0.3;         // s, in which it takes up what is let go, or stops
constexpr double LargestBarrierGap = 0.02; // m
constexpr int PerturbationWaves = 3;
constexpr double PerturbationSize = 0.15; // of L, of the slowest wave
constexpr double ClearanceSlack = 5e-4;   // of L, of the 1e-3 that clearance may miss

} // namespace

BodyProblem::BodyProblem(const DriftScene& scene, const MotionObject& object,
                         std::vector<Vec3> planned, std::vector<Constraint> rows) :
  World(scene),
  Body(object), Planned(std::move(planned)), Wanted(std::move(rows)),
  Landings(LandingWindows(object, this->Wanted, scene.Obstacles, scene.Scene.Time.FramesPerSecond)),
  Space(scene.Scene, 0)
{
  for (std::size_t l = 0; l < this->Landings.size(); ++l)
  {
    LandingWindow& landing = this->Landings[l];
    this->Latest.push_back(landing.Frame);
    this->Leaving.push_back(landing.Until);
    this->Timed.push_back(this->RestOf(landing).FrameFrom >= 0 ? 1 : 0);
    landing.First = this->NearFrom(l);
  }
  if (object.Hangs())
  {
    this->Stays.push_back({ 0, object.Release, StartPlace(object, scene.Obstacles) });
  }
  LandingWindow hanging;
  if (HangingWindow(object, scene.Obstacles, scene.Scene.Time.FramesPerSecond, hanging))
  {
    this->Hanging.push_back(hanging);
  }
  this->AddRows();
  this->FixFrames();
}

void BodyProblem::SetSlips(const std::vector<Vec3>& slips)
{
  this->Slips.clear();
  for (std::size_t k = 0; k + 1 < slips.size(); ++k)
  {
    this->Slips.push_back(0.5 * (slips[k] + slips[k + 1]));
  }
}

// From rest, as the air goes by what hangs, to sinking in it.
std::vector<Vec3> BodyProblem::TakenUp(const AirSampler& air) const
{
  const double rate = this->World.Scene.Time.FramesPerSecond;
  const Vec3 sinking = LawOf(this->Body).Velocity(Vec3::Zero());
  std::vector<Vec3> slips(static_cast<std::size_t>(this->NumberOfFrames() - 1), sinking);
  for (const Stay& stay : this->Stays)
  {
    const int last = std::min(stay.Last, this->NumberOfFrames() - 1);
    const Vec3 still = stay.Place.Velocity(last, rate) - air.At(last, stay.Place.At(last));
    for (int k = stay.Last; k + 1 < this->NumberOfFrames(); ++k)
    {
      const double taken = SmoothStep((k + 0.5 - stay.Last) / (TakingTime * rate));
      if (taken >= 1.0)
      {
        break;
      }
      slips[static_cast<std::size_t>(k)] = (1.0 - taken) * still + taken * sinking;
    }
  }
  return slips;
}

DriftProblem BodyProblem::In(const AirSampler& air) const
{
  const Timeline& time = this->World.Scene.Time;
  DriftProblem problem;
  problem.Time = time;
  problem.Law = LawOf(this->Body);
  problem.Slips = this->Slips.empty() && !this->Stays.empty() ? this->TakenUp(air) : this->Slips;
  problem.ResponseTime = this->World.Inertia ? problem.Law.ResponseTime(StandardGravity) : 0.0;
  problem.IsFixed = this->IsFixed;
  problem.Fixed = this->Fixed;
  problem.First = this->Body.FirstPresent();
  problem.Rows = this->DriftRows;
  const int last = this->NumberOfFrames() - 1;
  problem.Ground =
    GroundEffect(this->World.Obstacles, this->Landings, this->Body, time.FramesPerSecond,
                 [&](const Vec3& x, int frame) { return air.At(std::min(frame, last), x); });
  if (this->FreeLanding() == nullptr)
  {
    problem.Ground.BearFrom(this->FreeFrom());
  }
  // Steps between fixed frames are given; beside them a body is taken up or handed over. To a rest
  // it comes by the ground effect.
  const std::size_t steps = this->IsFixed.size() - 1;
  const double reach = HandOverTime * time.FramesPerSecond;
  std::vector<double> away(steps, 2.0 * reach);
  const auto isGiven = [&](std::size_t k) { return this->IsFixed[k] && this->IsFixed[k + 1]; };
  for (std::size_t k = 0; k < steps; ++k)
  {
    const bool isLetGo = this->IsLetGoAt(static_cast<int>(k));
    away[k] = isGiven(k) ? 0.0 : k > 0 && !isLetGo ? std::min(away[k], away[k - 1] + 1.0) : away[k];
  }
  const auto isLanding = [&](std::size_t frame)
  {
    return std::any_of(this->Landings.begin(), this->Landings.end(),
                       [&](const LandingWindow& l) { return l.Frame == static_cast<int>(frame); });
  };
  for (std::size_t k = steps; k-- > 0;)
  {
    away[k] = k + 1 < steps && !isLanding(k + 1) ? std::min(away[k], away[k + 1] + 1.0) : away[k];
  }
  for (const Stay& stay : this->Stays) // it comes to a stop there by and by
  {
    for (int k = std::min(stay.First, static_cast<int>(steps)) - 1; k >= 0; --k)
    {
      double& own = away[static_cast<std::size_t>(k)];
      own = std::min(own, (stay.First - k) * HandOverTime / TakingTime);
    }
  }
  for (std::size_t k = 0; k < steps; ++k)
  {
    problem.Flight.push_back(SmoothStep(away[k] / reach));
  }
  problem.TooNear = [this](int frame, const Vec3& x, std::vector<DriftDepth>& depths)
  { this->TooNear(frame, x, depths); };
  return problem;
}

/// From where it appears, hung or was held, by the air alone.
bool BodyProblem::IsLetGoAt(int frame) const
{
  const bool appears = frame > 0 && frame == this->Body.FirstPresent();
  return appears ||
         std::any_of(this->Stays.begin(), this->Stays.end(),
                     [&](const Stay& stay)
                     {
                       const bool isStart = stay.First == 0 && this->Body.Hangs();
                       return stay.Last == frame && !(isStart && this->Body.VelocityGiven != 0);
                     });
}

// On the steps to a frame and from it: while it comes into a landing's window or leaves it, all of
// the radius.
Clearance BodyProblem::AskedAt(int frame) const
{
  for (const double beside : { frame - 0.5, frame + 0.5 })
  {
    const Clearance asked = RequiredClearance(this->Body, this->Exempts, beside);
    if (asked.Exempt < 0)
    {
      return asked;
    }
  }
  return RequiredClearance(this->Body, this->Exempts, frame);
}

void BodyProblem::TooNear(int frame, const Vec3& x, std::vector<DriftDepth>& depths) const
{
  const Clearance asked = this->AskedAt(frame);
  const double radius = asked.Radius + std::min(BarrierMargin, this->Body.ClearanceRadius);
  const Box& volume = this->Space.At(frame);
  const auto push = [&](const Vec3& normal, double depth)
  {
    if (depth > 0.0)
    {
      depths.push_back({ normal, depth });
    }
  };
  for (int c = 0; c < 3; ++c)
  {
    const bool floor = c == 2 && asked.Exempt >= 0;
    push(Vec3::Unit(c), volume.Min[c] + (floor ? asked.LandingDistance : radius) - x[c]);
    push(-Vec3::Unit(c), x[c] - volume.Max[c] + radius);
  }
  const ObstacleSet& obstacles = this->World.Obstacles;
  SurfaceHit hit;
  const double distance = obstacles.SignedDistance(x, frame, radius, hit, asked.Exempt);
  push(hit.Normal, radius - distance);
  if (asked.Exempt >= 0)
  {
    const double limit = asked.LandingDistance;
    push(hit.Normal, limit - obstacles.SignedDistanceTo(asked.Exempt, x, frame, limit, hit));
  }
}

// Bent between its marks by slow waves.
std::vector<Vec3> BodyProblem::Perturbed(std::vector<Vec3> path, const std::vector<int>& marks,
                                         Random& random) const
{
  const int frames = static_cast<int>(path.size());
  for (std::size_t m = 0; m < marks.size(); ++m)
  {
    const int from = marks[m];
    const bool isLast = m + 1 == marks.size();
    const int to = isLast ? frames - 1 : marks[m + 1];
    if (to - from < 2)
    {
      continue;
    }
    Vec3 waves[PerturbationWaves];
    for (Vec3& wave : waves)
    {
      wave =
        PerturbationSize * this->World.Scene.Bounds.Width() * random.Normal() * random.Direction();
    }
    for (int f = from + 1; f < to + (isLast ? 1 : 0); ++f)
    {
      const double s = static_cast<double>(f - from) / (to - from) * (isLast ? 0.5 : 1.0);
      for (int w = 0; w < PerturbationWaves; ++w)
      {
        path[static_cast<std::size_t>(f)] += std::sin(M_PI * (w + 1) * s) / (w + 1) * waves[w];
      }
      path[static_cast<std::size_t>(f)] =
        path[static_cast<std::size_t>(f)]
          .cwiseMax(this->World.Scene.Bounds.Min + Vec3::Constant(this->Body.ClearanceRadius))
          .cwiseMin(this->World.Scene.Bounds.Max - Vec3::Constant(this->Body.ClearanceRadius));
    }
  }
  return path;
}

std::vector<int> BodyProblem::Marks() const
{
  std::vector<int> marks;
  for (std::size_t f = 0; f < this->IsFixed.size(); ++f)
  {
    if (this->IsFixed[f])
    {
      marks.push_back(static_cast<int>(f));
    }
  }
  return marks;
}

std::vector<std::vector<Vec3>> BodyProblem::Starts(const AirSampler& air, int perturbed) const
{
  const std::size_t frames = this->Planned.size();
  const std::vector<int> marks = this->Marks();
  const std::vector<Vec3> planned = this->RetimedPlan();
  std::vector<Vec3> straight = planned;
  std::vector<Vec3> drifting = planned;
  const double step = this->World.Scene.Time.Step();
  const BodyLaw law = LawOf(this->Body);
  const Box& volume = this->World.Scene.Bounds;
  for (std::size_t m = 0; m < marks.size(); ++m)
  {
    const int from = marks[m];
    const bool hasNext = m + 1 < marks.size();
    const int to = hasNext ? marks[m + 1] : static_cast<int>(frames) - 1;
    Vec3 x = this->Fixed[static_cast<std::size_t>(from)];
    straight[static_cast<std::size_t>(from)] = drifting[static_cast<std::size_t>(from)] = x;
    for (int f = from; f < to; ++f)
    {
      const Vec3 half = x + 0.5 * step * law.Velocity(air.At(f, x));
      x += step * law.Velocity(air.Between(f, half));
      x = x.cwiseMax(volume.Min + Vec3::Constant(this->Body.RestHeight))
            .cwiseMin(volume.Max - Vec3::Constant(this->Body.ClearanceRadius));
      drifting[static_cast<std::size_t>(f) + 1] = x;
    }
    if (!hasNext)
    {
      for (int f = from; f <= to; ++f)
      {
        straight[static_cast<std::size_t>(f)] = drifting[static_cast<std::size_t>(f)];
      }
      continue;
    }
    const Vec3& end = this->Fixed[static_cast<std::size_t>(to)];
    const Vec3 missed = end - x;
    const Vec3 begin = this->Fixed[static_cast<std::size_t>(from)];
    for (int f = from; f <= to; ++f)
    {
      const double s = static_cast<double>(f - from) / (to - from);
      straight[static_cast<std::size_t>(f)] = begin + s * (end - begin);
      drifting[static_cast<std::size_t>(f)] += s * s * missed;
    }
  }
  std::vector<std::vector<Vec3>> starts{ planned, straight, drifting };
  Random random(this->World.Scene.Seed, static_cast<std::uint64_t>(this->Body.ObjectId) + 1);
  for (int k = 0; k < perturbed; ++k)
  {
    starts.push_back(this->Perturbed(k % 2 == 0 ? drifting : planned, marks, random));
  }
  return starts;
}

// Of walls and of surfaces that are landed on barriers leave a small gap, that a shift takes
// away.
void BodyProblem::CloseBarrierGaps(std::vector<Vec3>& path) const
{
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    if (this->IsFixed[f])
    {
      continue;
    }
    const auto frame = static_cast<double>(f);
    const Box& volume = this->Space.At(frame);
    const Clearance asked = this->AskedAt(static_cast<int>(f));
    const bool lands = asked.Exempt >= 0;
    const Vec3 low = Vec3::Constant(asked.Radius);
    path[f] =
      path[f]
        .cwiseMax(volume.Min + (lands ? Vec3(low.x(), low.y(), asked.LandingDistance) : low))
        .cwiseMin(volume.Max - low);
    SurfaceHit hit;
    const double distance =
      lands ? this->World.Obstacles.SignedDistanceTo(asked.Exempt, path[f], frame, hit) : 0.0;
    if (lands && distance < asked.LandingDistance &&
        asked.LandingDistance - distance < LargestBarrierGap)
    {
      path[f] += (asked.LandingDistance - distance) * hit.Normal;
    }
  }
}

PathClearance BodyProblem::Around() const
{
  return { this->World.Obstacles, this->Space, this->Exempts, this->Body,
           ClearanceSlack * this->World.Scene.Bounds.Width() };
}

bool BodyProblem::PassesThrough(const std::vector<Vec3>& path) const
{
  for (std::size_t f = 0; f + 1 < path.size(); ++f)
  {
    const auto frame = static_cast<double>(f);
    const int landedOn = RequiredClearance(this->Body, this->Exempts, frame + 0.5).Exempt;
    if (!this->World.Obstacles.IsClear(path[f], frame, path[f + 1], frame + 1.0, 0.0, landedOn))
    {
      return true;
    }
  }
  return false;
}

bool BodyProblem::IsClear(std::vector<Vec3> path) const
{
  this->MeetRows(path);
  return this->Around().BlockedSteps(path).empty();
}

bool BodyProblem::MakeExact(std::vector<Vec3>& path) const
{
  this->MeetRows(path);
  std::vector<double> weights;
  for (const unsigned char fixed : this->IsFixed)
  {
    weights.push_back(fixed ? 0.0 : 1.0);
  }
  const PathFreedom freedom{ weights, this->World.Scene.Time.Step(),
                             [this](std::vector<Vec3>& x) { this->MeetRows(x); } };
  return ResolveClearance(this->Around(), freedom, this->RetimedPlan(), path);
}

} // namespace waft
