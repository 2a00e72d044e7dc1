// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/SpacetimeExport.h"

#include "Base/SpreadPushes.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double Rounding = 1e-5; // [dx]: places that differ by less are the same
constexpr int PushRounds = 8;
constexpr int PushReach = 15;           // frames to either side over which a push comes and goes
constexpr int SmallestRamp = 6;         // frames over which the fallback blends in
constexpr double FallbackSpeed = 0.3;   // of going back to the plan, at most [m/s]
constexpr int FallbackRounds = 5;       // the ramp doubles each time
constexpr double ClearanceSlack = 5e-4; // of L, of the 1e-3 that clearance may miss

// One object's motion, made exact.
class ObjectExport
{
public:
  ObjectExport(const SpacetimeInput& input, const SpacetimeSetup& setup, std::size_t object,
               const std::vector<LinearCluster>& clusters, const KeptMotion& kept) :
    Input(input),
    Setup(setup), Index(object), Object(setup.Objects[object]),
    Weights(input.Tracks[object].Positions.size(), 1.0)
  {
    this->Object.ClearanceRadius =
      std::max(0.0, this->Object.ClearanceRadius - ClearanceSlack * input.Scene.Bounds.Width());
    for (const LinearCluster& cluster : clusters)
    {
      if (cluster.Object() == object)
      {
        this->Clusters.push_back(&cluster);
      }
    }
    for (const PositionBall& ball : setup.Table.Balls)
    {
      if (ball.Object == object)
      {
        this->Balls.push_back(&ball);
      }
    }
    if (kept.Region != nullptr)
    {
      this->Before = &(*kept.Positions)[object];
      this->FindKept(*kept.Region);
    }
  }

  bool IsKept(std::size_t frame) const { return this->Weights[frame] <= 0.0; }

  /// x in metres, one a frame.
  void MakeExact(std::vector<Vec3>& x) const
  {
    this->MeetRows(x);
    for (std::size_t frame = 0; frame < x.size(); ++frame)
    {
      if (this->IsKept(frame))
      {
        x[frame] = (*this->Before)[frame];
      }
    }
  }

  void MeetRows(std::vector<Vec3>& x) const
  {
    const std::size_t no = this->Setup.Model.NumberOfObjects;
    for (std::size_t frame = 0; frame < x.size(); ++frame)
    {
      if (this->Setup.Model.Flag(static_cast<int>(frame), this->Index) & FixedPosition)
      {
        x[frame] = this->Setup.ExactPositions[frame * no + this->Index];
      }
    }
    this->KeepInside(x);
    for (const PositionBall* ball : this->Balls)
    {
      if (this->Setup.Model.Flag(ball->Frame, this->Index) & FixedPosition)
      {
        continue;
      }
      const Vec3 centre = this->Setup.ToWorld(ball->Center);
      const double radius = ball->Radius * this->Setup.Spacing;
      const Vec3 d = x[ball->Frame] - centre;
      if (d.norm() > radius)
      {
        x[ball->Frame] = centre + (radius / d.norm()) * d;
      }
    }
    for (const LinearCluster* cluster : this->Clusters)
    {
      const std::vector<int>& frames = cluster->Frames();
      Eigen::MatrixX3d positions(frames.size(), 3);
      for (std::size_t k = 0; k < frames.size(); ++k)
      {
        positions.row(k) = this->Setup.FromWorld(x[frames[k]]).transpose();
      }
      cluster->Project(positions);
      for (std::size_t k = 0; k < frames.size(); ++k)
      {
        x[frames[k]] = this->Setup.ToWorld(positions.row(k).transpose());
      }
    }
  }

  // Walls and floor: the penalty in E leaves a hair's breadth, that a shift takes away.
  void KeepInside(std::vector<Vec3>& x) const
  {
    const Vec3& low = this->Setup.Origin;
    const Vec3 high = this->Setup.ToWorld(this->Setup.Model.Size);
    const double radius = this->Object.ClearanceRadius;
    for (std::size_t frame = 0; frame < x.size(); ++frame)
    {
      const int flags = this->Setup.Model.Flag(static_cast<int>(frame), this->Index);
      if (flags & FixedPosition)
      {
        continue;
      }
      for (int c = 0; c < 3; ++c)
      {
        const bool lands = c == 2 && (flags & LandsOnFloor);
        const double least = low[c] + (lands ? this->Object.RestHeight : radius);
        x[frame][c] = std::max(least, std::min(x[frame][c], high[c] - radius));
      }
    }
  }

  /// Frames after which the step is not clear.
  std::vector<std::size_t> Blocked(const std::vector<Vec3>& x) const
  {
    const auto& windows = this->Setup.Landings[this->Index];
    std::vector<std::size_t> blocked;
    for (std::size_t k = 0; k + 1 < x.size(); ++k)
    {
      const double frame = static_cast<double>(k);
      const bool clear =
        KeepsInside(this->Input.Scene.Bounds, RequiredClearance(this->Object, windows, frame),
                    x[k]) &&
        KeepsInside(this->Input.Scene.Bounds, RequiredClearance(this->Object, windows, frame + 1.0),
                    x[k + 1]) &&
        IsMotionClear(this->Setup.Obstacles, this->Object, windows, x[k], frame, x[k + 1],
                      frame + 1.0);
      if (!clear)
      {
        blocked.push_back(k);
      }
    }
    return blocked;
  }

  /// Where the optimised motion is not clear it is moved out of the way, and where that is not
  /// enough it goes back to the planned one, with soft ends.
  bool Clear(std::vector<Vec3>& x) const
  {
    const std::vector<Vec3> found = x;
    if (this->PushOut(x))
    {
      return true;
    }
    x = found;
    return this->GoBack(x);
  }

private:
  /// Away from obstacles by what is lacking there, smoothly in time.
  bool PushOut(std::vector<Vec3>& x) const
  {
    std::vector<std::size_t> blocked = this->Blocked(x);
    for (int round = 0; round < PushRounds && !blocked.empty(); ++round)
    {
      const std::vector<Vec3> pushes = SpreadPushes(this->Pushes(x, blocked), PushReach);
      for (std::size_t f = 0; f < x.size(); ++f)
      {
        x[f] += this->Weights[f] * pushes[f];
      }
      this->MakeExact(x);
      blocked = this->Blocked(x);
    }
    return blocked.empty();
  }

  /// By frame, the farthest that the steps after `blocked` frames have to move at it [m].
  std::vector<Vec3> Pushes(const std::vector<Vec3>& x,
                           const std::vector<std::size_t>& blocked) const
  {
    std::vector<Vec3> pushes(x.size(), Vec3::Zero());
    for (const std::size_t k : blocked)
    {
      Vec3 push = Vec3::Zero();
      for (const double part : { 0.0, 0.5, 1.0 })
      {
        const Vec3 here =
          this->Lacking(x[k] + part * (x[k + 1] - x[k]), static_cast<double>(k) + part);
        push = here.norm() > push.norm() ? here : push;
      }
      for (const std::size_t f : { k, k + 1 })
      {
        pushes[f] = push.norm() > pushes[f].norm() ? push : pushes[f];
      }
    }
    return pushes;
  }

  /// The way out to the clearance asked for, with the slack given back [m].
  Vec3 Lacking(const Vec3& x, double frame) const
  {
    const Clearance asked =
      RequiredClearance(this->Object, this->Setup.Landings[this->Index], frame);
    SurfaceHit hit;
    const double distance = this->Setup.Obstacles.SignedDistance(x, frame, hit, asked.Exempt);
    const double wanted = asked.Radius + ClearanceSlack * this->Input.Scene.Bounds.Width();
    return std::max(0.0, wanted - distance) * hit.Normal;
  }

  bool GoBack(std::vector<Vec3>& x) const
  {
    const std::vector<Vec3>& planned = this->Input.Tracks[this->Index].Positions;
    const std::vector<Vec3> free = x;
    std::vector<double> share(x.size(), 0.0); // of the plan, by frame
    std::vector<std::size_t> blocked = this->Blocked(x);
    long shortest = SmallestRamp;
    for (int round = 0; round < FallbackRounds && !blocked.empty(); ++round, shortest *= 2)
    {
      for (const std::size_t k : blocked)
      {
        // As long as it takes to change over without a jump of speed.
        const double away = (planned[k] - free[k]).norm();
        const long ramp = std::max<long>(
          shortest, std::lround(1.5 * away / (FallbackSpeed * this->Setup.FrameStep)));
        const long first = static_cast<long>(k) - ramp;
        const long last = static_cast<long>(k) + 1 + ramp;
        for (long f = std::max(0L, first); f <= std::min<long>(last, long(x.size()) - 1); ++f)
        {
          const double outside =
            std::max({ 0.0, double(k) - double(f) - 1.0, double(f) - double(k) - 2.0 });
          const double s = std::clamp(1.0 - outside / static_cast<double>(ramp), 0.0, 1.0);
          share[f] = std::max(share[f], this->Weights[f] * s * s * (3.0 - 2.0 * s));
        }
      }
      for (std::size_t f = 0; f < x.size(); ++f)
      {
        x[f] = free[f] + share[f] * (planned[f] - free[f]);
      }
      this->MakeExact(x);
      blocked = this->Blocked(x);
    }
    return blocked.empty();
  }

  // Rows that bind a frame that is kept are kept whole, as in the solver.
  void FindKept(const EditRegion& region)
  {
    const std::size_t body = this->Setup.Model.NumberOfGas + this->Index;
    const auto frames = static_cast<int>(this->Weights.size());
    const auto isKept = [&](int frame) { return !region.Moves(frame, body); };
    for (int frame = 0; frame < frames; ++frame)
    {
      const int inside = std::min(region.First > 0 ? frame - region.First + 1 : frames,
                                  region.Last + 1 < frames ? region.Last - frame + 1 : frames);
      this->Weights[frame] = isKept(frame) ? 0.0 : std::min(1.0, inside / (SmallestRamp + 1.0));
    }
    for (const LinearCluster* cluster : this->Clusters)
    {
      if (std::any_of(cluster->Frames().begin(), cluster->Frames().end(), isKept))
      {
        for (const int frame : cluster->Frames())
        {
          this->Weights[frame] = 0.0;
        }
      }
    }
  }

  const SpacetimeInput& Input;
  const SpacetimeSetup& Setup;
  std::size_t Index;
  MotionObject Object;
  std::vector<const LinearCluster*> Clusters;
  std::vector<const PositionBall*> Balls;
  std::vector<double> Weights; // of going back to the plan, by frame; 0: kept as it was
  const std::vector<Vec3>* Before = nullptr;
};

} // namespace

std::vector<std::vector<Vec3>> ExportPositions(const SpacetimeInput& input,
                                               const SpacetimeSetup& setup, const KeptMotion& kept,
                                               StateVector& state,
                                               std::vector<std::string>& warnings)
{
  const SpacetimeModel& model = setup.Model;
  const std::size_t stride = model.Stride();
  const auto frames = static_cast<std::size_t>(model.NumberOfFrames);
  const std::vector<LinearCluster> clusters =
    MakeClusters(model, setup.Table, std::vector<bool>(frames, true));
  std::vector<std::vector<Vec3>> positions(model.NumberOfObjects);
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    std::vector<Vec3>& x = positions[o];
    x.resize(frames);
    for (std::size_t frame = 0; frame < frames; ++frame)
    {
      const float* p = state.data() + frame * model.FrameSize() + model.NumberOfGas + o;
      x[frame] = setup.ToWorld(Vec3(p[0], p[stride], p[2 * stride]));
    }
    const ObjectExport object(input, setup, o, clusters, kept);
    object.MakeExact(x);
    if (!object.Clear(x))
    {
      warnings.push_back("object " + std::to_string(setup.Objects[o].ObjectId) +
                         ": the planned path leaves less than the clearance asked for");
    }
    // Velocities go along with what has been moved, so that steps follow them as before.
    Vec3 before = Vec3::Zero();
    for (std::size_t frame = 0; frame < frames; ++frame)
    {
      float* p = state.data() + frame * model.FrameSize() + model.NumberOfGas + o;
      const bool kept = object.IsKept(frame);
      const Vec3 local = setup.FromWorld(x[frame]);
      Vec3 moved = local - Vec3(p[0], p[stride], p[2 * stride]);
      if (kept || moved.norm() < Rounding)
      {
        moved.setZero();
      }
      const bool holds = kept || model.Flag(static_cast<int>(frame), o) & FixedVelocity;
      for (int c = 0; c < 3; ++c)
      {
        p[c * stride] = kept ? p[c * stride] : static_cast<float>(local[c]);
        p[(3 + c) * stride] += holds ? 0.0f : static_cast<float>(moved[c] - before[c]);
      }
      before = moved;
    }
  }
  return positions;
}

} // namespace waft
