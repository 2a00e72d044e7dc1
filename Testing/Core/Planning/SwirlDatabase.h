// SPDX-License-Identifier: BSD-3-Clause
// A motion database of a random swirling flow in a closed box, made by the project's own
// clustering.
#pragma once

#include "Base/Parallel.h"
#include "Base/Random.h"
#include "Trajectory/TrajectoryClusters.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace waft
{
namespace test
{

/// Velocity = curl of a random vector potential that vanishes at the walls: divergence-free and
/// never through a wall.
class SwirlingAir
{
public:
  SwirlingAir(std::uint64_t seed, double speed) : Speed(speed)
  {
    Random random(seed, 77);
    for (Mode& mode : this->Modes)
    {
      const double size = random.Uniform(1.2, 5.0); // 1/m
      mode.Wave = size * random.Direction();
      mode.Amplitude = random.Direction() / (size * std::sqrt(size));
      mode.Phase = random.Uniform(0.0, 2.0 * M_PI);
      mode.Rate = random.Uniform(-0.6, 0.6);
    }
  }
  Vec3 Velocity(const Vec3& x, double time) const
  {
    const double h = 1e-4;
    Vec3 d[3];
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 e = h * Vec3::Unit(i);
      d[i] = (this->Potential(x + e, time) - this->Potential(x - e, time)) / (2.0 * h);
    }
    return this->Speed * Vec3(d[1].z() - d[2].y(), d[2].x() - d[0].z(), d[0].y() - d[1].x());
  }

private:
  struct Mode
  {
    Vec3 Wave;
    Vec3 Amplitude;
    double Phase = 0.0;
    double Rate = 0.0;
  };
  Vec3 Potential(const Vec3& x, double time) const
  {
    Vec3 sum = Vec3::Zero();
    for (const Mode& mode : this->Modes)
    {
      sum += mode.Amplitude * std::cos(mode.Wave.dot(x) + mode.Phase + mode.Rate * time);
    }
    const auto wall = [](double d) { return d < 0.0 ? 0.0 : 1.0 - std::exp(-6.0 * d * d); };
    return sum * wall(x.x() + 2.0) * wall(2.0 - x.x()) * wall(x.y() + 2.0) * wall(2.0 - x.y()) *
           wall(x.z()) * wall(4.0 - x.z());
  }
  double Speed = 1.0;
  Mode Modes[14];
};

/// Paths of tracers, one sample a frame at 30 frames per second.
inline std::vector<Track> TraceSwirl(std::uint64_t seed, int tracers, int frames,
                                     double speed = 0.6)
{
  const SwirlingAir air(seed, speed);
  const double dt = 1.0 / 30.0;
  Random random(seed, 5);
  std::vector<Track> tracks;
  for (int i = 0; i < tracers; ++i)
  {
    Track track;
    track.ObjectId = i;
    Vec3 x = random.InBox(Box{ Vec3(-1.9, -1.9, 0.1), Vec3(1.9, 1.9, 3.9) });
    for (int k = 0; k < frames; ++k)
    {
      track.Positions.push_back(x);
      track.ForceTypes.push_back(k % 60 < 30 ? ForceType::Vortex : ForceType::Wind);
      track.VortexIds.push_back(k % 60 < 30 ? 0 : -1);
      const double t = k * dt;
      const Vec3 a = air.Velocity(x, t);
      const Vec3 b = air.Velocity(x + 0.5 * dt * a, t + 0.5 * dt);
      const Vec3 c = air.Velocity(x + 0.5 * dt * b, t + 0.5 * dt);
      const Vec3 d = air.Velocity(x + dt * c, t + dt);
      x += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    track.VortexAccelerations.assign(track.Positions.size(), Vec3(0.1, 0.0, 0.0));
    track.WindAccelerations.assign(track.Positions.size(), Vec3(0.0, 0.1, 0.0));
    tracks.push_back(std::move(track));
  }
  return tracks;
}

inline MotionDatabase MakeSwirlDatabase(int simulations = 3, int tracers = 60, int frames = 300)
{
  ClusterInput input;
  for (int s = 0; s < simulations; ++s)
  {
    TracedSimulation simulation;
    simulation.Tracks = TraceSwirl(static_cast<std::uint64_t>(s) + 1, tracers, frames);
    Vortex vortex;
    vortex.VortexId = 0;
    vortex.P1 = Vec3(0.0, 0.0, 1.0);
    vortex.P2 = Vec3(0.0, 0.0, 3.0);
    vortex.CenterTime = 4.0;
    simulation.Vortices.push_back(vortex);
    input.Simulations.push_back(std::move(simulation));
  }
  ClusterOptions options;
  SilentMonitor monitor;
  MotionDatabase database;
  if (!ClusterTrajectories(input, options, SerialFor(), monitor, database))
  {
    database = MotionDatabase();
  }
  return database;
}

/// The database that the tests share; made once.
inline const MotionDatabase& SwirlDatabase()
{
  static const MotionDatabase database = MakeSwirlDatabase();
  return database;
}

} // namespace test
} // namespace waft
