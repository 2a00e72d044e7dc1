// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Scene/SpacetimeExport.h"

#include "Base/NumberText.h"
#include "Constraints/IntoBalls.h"
#include "Constraints/ResolveClearance.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double Rounding = 1e-5;       // [dx]: places that differ by less are the same
constexpr double ClearanceSlack = 5e-4; // of L, of the 1e-3 that clearance may miss

// One object's motion, made exact.
class ObjectExport
{
public:
  ObjectExport(const SpacetimeInput& input, const SpacetimeSetup& setup, std::size_t object,
               const std::vector<LinearCluster>& clusters) :
    Input(input),
    Setup(setup), Index(object), Slack(ClearanceSlack * input.Scene.Bounds.Width()),
    Weights(input.Tracks[object].Positions.size(), 1.0)
  {
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
        this->Balls.push_back(ball);
        this->Balls.back().Center = setup.ToWorld(ball.Center);
        this->Balls.back().Radius = ball.Radius * setup.Spacing;
      }
    }
  }

  bool IsFixed(std::size_t frame) const
  {
    return (this->Setup.Model.Flag(static_cast<int>(frame), this->Index) & FixedPosition) != 0;
  }

  /// x in metres, one a frame.
  void MakeExact(std::vector<Vec3>& x) const
  {
    const std::size_t no = this->Setup.Model.NumberOfObjects;
    for (std::size_t frame = 0; frame < x.size(); ++frame)
    {
      if (this->IsFixed(frame))
      {
        x[frame] = this->Setup.ExactPositions[frame * no + this->Index];
      }
    }
    this->KeepInside(x);
    MoveIntoBalls(
      this->Balls, [this](std::size_t frame) { return this->IsFixed(frame); },
      this->Setup.FrameStep, [this](std::vector<Vec3>& path) { this->KeepInside(path); }, x);
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
    const ClearanceRule rule = ClearanceRule(this->Setup.Objects[this->Index]).With(-this->Slack);
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
        const double least = low[c] + rule.From(lands);
        x[frame][c] = std::max(least, std::min(x[frame][c], high[c] - rule.Radius));
      }
    }
  }

  /// Where the optimised motion is not clear it is moved out of the way, or goes back to the plan.
  bool Clear(std::vector<Vec3>& x) const
  {
    const PathClearance clearance{ this->Setup.Obstacles, this->Input.Scene.Bounds,
                                   this->Setup.Exempts[this->Index],
                                   this->Setup.Objects[this->Index], this->Slack };
    const PathFreedom freedom{ this->Weights, this->Setup.FrameStep,
                               [this](std::vector<Vec3>& path) { this->MakeExact(path); } };
    return ResolveClearance(clearance, freedom, this->Input.Tracks[this->Index].Positions, x);
  }

private:
  const SpacetimeInput& Input;
  const SpacetimeSetup& Setup;
  std::size_t Index;
  double Slack; // m, that the clearance may miss
  std::vector<const LinearCluster*> Clusters;
  std::vector<PositionBall> Balls; // as in the world
  std::vector<double> Weights;     // of going back to the plan, by frame
};

} // namespace

std::vector<Vec3> ObjectPositions(const SpacetimeModel& model, std::size_t frames,
                                  const StateVector& state)
{
  std::vector<Vec3> positions;
  for (std::size_t j = 0; j < frames; ++j)
  {
    for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
    {
      positions.push_back(
        VectorAt(state.data() + j * model.FrameSize() + model.NumberOfGas + o, model.Stride()));
    }
  }
  return positions;
}

std::vector<std::vector<Vec3>> ExportPositions(const SpacetimeInput& input,
                                               const SpacetimeSetup& setup, StateVector& state,
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
      x[frame] = setup.ToWorld(VectorAt(p, stride));
    }
    const ObjectExport object(input, setup, o, clusters);
    object.MakeExact(x);
    if (!object.Clear(x))
    {
      warnings.push_back("object " + std::to_string(setup.Objects[o].ObjectId) +
                         ": the planned path leaves less than the clearance asked for, " +
                         NumberText(setup.Objects[o].ClearanceRadius) +
                         " m: give its marks more room beside what is in the way");
    }
    // Velocities go along with what has been moved, so that steps follow them as before.
    Vec3 before = Vec3::Zero();
    for (std::size_t frame = 0; frame < frames; ++frame)
    {
      float* p = state.data() + frame * model.FrameSize() + model.NumberOfGas + o;
      const Vec3 local = setup.FromWorld(x[frame]);
      Vec3 moved = local - VectorAt(p, stride);
      if (moved.norm() < Rounding)
      {
        moved.setZero();
      }
      const bool holds = model.Flag(static_cast<int>(frame), o) & FixedVelocity;
      for (int c = 0; c < 3; ++c)
      {
        p[c * stride] = static_cast<float>(local[c]);
        p[(3 + c) * stride] += holds ? 0.0f : static_cast<float>(moved[c] - before[c]);
      }
      before = moved;
    }
  }
  return positions;
}

} // namespace waft
