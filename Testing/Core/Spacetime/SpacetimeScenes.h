// SPDX-License-Identifier: BSD-3-Clause
// Small scenes with planned paths, for tests and benchmarks.
#pragma once

#include "Base/Primitives.h"
#include "Base/Random.h"
#include "Constraints/Constraint.h"
#include "Constraints/Rest.h"
#include "Obstacles/ObstacleSet.h"
#include "Spacetime/Run/Spacetime.h"

#include <cmath>

namespace waft
{

struct SceneOptions
{
  int NumberOfObjects = 3;
  int NumberOfFrames = 60;
  bool Land = false; // rest on the ground for the last tenth
  std::uint64_t Seed = 1;
  double Wiggle = 0.12; // m
};

/// Objects on wiggling ways through a volume of 4 m, with a vortex; each exact at its ends.
inline SpacetimeInput MakeScene(const SceneOptions& options)
{
  SpacetimeInput input;
  input.Scene.Time.NumberOfFrames = options.NumberOfFrames;
  input.Scene.Seed = options.Seed;
  ObstacleMesh ground;
  ground.ObstacleId = 0;
  ground.Mesh = MakeBox({ Vec3(-3.0, -3.0, -1.0), Vec3(3.0, 3.0, 0.0) });
  input.Obstacles.push_back(ground);
  const int last = options.NumberOfFrames - 1;
  const int landing = options.Land ? last - options.NumberOfFrames / 10 : last;
  const double span = landing / input.Scene.Time.FramesPerSecond;
  for (int o = 0; o < options.NumberOfObjects; ++o)
  {
    Random random(options.Seed, static_cast<std::uint64_t>(o));
    MotionObject object;
    object.ObjectId = 10 + o;
    object.ClearanceRadius = 0.05;
    object.RestHeight = 0.01;
    object.Position = random.InBox({ Vec3(-1.2, -1.2, 1.8), Vec3(1.2, 1.2, 3.0) });
    // As far as a leaf goes in that time, so that short scenes are not wild ones.
    Vec3 end = random.InBox({ Vec3(-1.2, -1.2, 0.6), Vec3(1.2, 1.2, 1.6) });
    end = object.Position + (end - object.Position) * std::min(1.0, span / 4.0);
    end.z() = options.Land ? object.RestHeight : end.z();
    const Vec3 phase = random.InBox({ Vec3::Zero(), Vec3::Constant(2.0 * M_PI) });
    const double rate = random.Uniform(0.25, 0.5);
    Track track;
    track.ObjectId = object.ObjectId;
    for (int k = 0; k <= last; ++k)
    {
      const double s = std::min(1.0, static_cast<double>(k) / landing);
      const double t = s * span;
      const double window = std::sin(M_PI * s) * std::sin(M_PI * s);
      Vec3 wiggle;
      for (int c = 0; c < 3; ++c)
      {
        wiggle[c] = options.Wiggle * std::sin(2.0 * M_PI * (rate + 0.2 * c) * t + phase[c]);
      }
      track.Positions.push_back(object.Position + s * (end - object.Position) + window * wiggle);
    }
    Constraint row;
    row.ObjectId = object.ObjectId;
    row.Row = o;
    row.Frame = landing;
    row.Until = last;
    row.Kind = options.Land ? ConstraintKind::Rest : ConstraintKind::Position;
    row.Value = track.Positions[landing];
    input.Constraints.push_back(row);
    input.Objects.push_back(object);
    input.Tracks.push_back(track);
  }
  Vortex vortex;
  vortex.VortexId = 0;
  vortex.P1 = Vec3(0.2, -0.1, 0.4);
  vortex.P2 = Vec3(0.1, 0.2, 3.2);
  vortex.Strength = 1.5;
  vortex.CenterTime = 0.5 * span;
  vortex.Duration = 1.5;
  vortex.CoreRadius = 0.4;
  input.Vortices.push_back(vortex);
  if (options.Land)
  {
    ObstacleSet obstacles;
    (void)obstacles.Build(input.Obstacles);
    for (int o = 0; o < options.NumberOfObjects; ++o)
    {
      const auto windows = LandingWindows(input.Objects[o], input.Constraints, obstacles,
                                          input.Scene.Time.FramesPerSecond);
      for (int k = landing; k <= last && !windows.empty(); ++k)
      {
        input.Tracks[o].Positions[k] = windows.front().Centre.Place;
      }
    }
  }
  return input;
}

/// A box that stands on the ground among the obstacles [m].
inline void AddPillar(SpacetimeInput& input, const Vec3& low = Vec3(-0.4, -0.5, -0.1),
                      const Vec3& high = Vec3(0.5, 0.3, 2.5))
{
  ObstacleMesh pillar;
  pillar.ObstacleId = 1;
  pillar.Mesh = MakeBox({ low, high });
  input.Obstacles.push_back(pillar);
}

} // namespace waft
