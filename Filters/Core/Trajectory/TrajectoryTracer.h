// SPDX-License-Identifier: BSD-3-Clause
// Follows massless tracers through a sampled flow, fed frame by frame (Shi et al. 2005, end of
// section 3.1).
#pragma once

#include "Base/BodyLaw.h"
#include "Base/ForceFields.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/OptionFields.h"
#include "Base/Parallel.h"
#include "Base/PointLattice.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Trajectory/Annotation.h"

#include <array>
#include <functional>
#include <vector>

namespace waft
{

/// The flow at one time. The two force lists may be empty: then the closed forms of the vortices
/// serve for the first, and there is no wind.
struct FlowFrame
{
  double Time = 0.0;                             // s
  std::vector<std::array<float, 3>> Velocity;    // m/s
  std::vector<std::array<float, 3>> VortexForce; // m/s^2
  std::vector<std::array<float, 3>> WindForce;   // m/s^2
};

struct TraceOptions
{
  /// Tracers start at every SeedStride-th lattice point along each axis, centred; at least 1.
  int SeedStride = 8;
  /// Samples of the trajectories per second.
  double FramesPerSecond = 30.0;
  /// Tracers end where they leave it.
  Box Volume;
  /// Tracers sink through the air at this speed [m/s]; 0: they follow it.
  double SettlingSpeed = 0.0;
  AnnotationOptions Annotation;

  Result Validate() const;

  template <class Visitor, class... Holder>
  static void VisitSeeds(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "SeedStride",
                       { 1, limits::MostInt },
                       "",
                       "Tracers start at every SeedStride-th point of the grid along each axis." },
          of.SeedStride...);
  }

  /// What a user sets, the annotation apart.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    VisitSeeds(visit, of...);
    visit(
      OptionField{
        "SettlingSpeed", limits::UpTo(limits::Speed.High), "m/s",
        "Tracers sink through the air at this speed, in metres per second; 0: they follow it." },
      of.SettlingSpeed...);
  }
};

/// True where a tracer cannot be; from many threads at once.
using SolidTest = std::function<bool(const Vec3& x, double time)>;

/// Classical Runge-Kutta steps of fourth order in a velocity that is trilinear in space and linear
/// in time between the last two frames fed; only these are kept. One sample per frame of
/// FramesPerSecond from the time of the first flow frame on, whatever the times of the others; a
/// trajectory ends with the last sample inside the volume and outside what is solid.
class TrajectoryTracer
{
public:
  /// vortices: of the flow, for the annotation; isSolid may be empty.
  Result Begin(const PointLattice& lattice, const TraceOptions& options,
               std::vector<Vortex> vortices = {}, SolidTest isSolid = {});
  /// Frames come in increasing order of time.
  Result Feed(FlowFrame frame, const ParallelFor& parallelFor);
  /// Annotated trajectories, one per seed in the order of the lattice (ObjectId counts them).
  std::vector<Track> Finish();

private:
  struct Tracer
  {
    Vec3 Position = Vec3::Zero();
    bool IsLiving = true;
    Track Path;
  };

  void SpreadSeeds();
  Result CheckFrame(const FlowFrame& frame) const;
  void Advance(Tracer& tracer) const;
  void Record(Tracer& tracer, double time) const;
  bool CanBeAt(const Vec3& x, double time) const;
  Vec3 VelocityAt(const Vec3& x, double time) const;
  Vec3 Step(const Vec3& x, double time, double step) const;

  PointLattice Lattice;
  TraceOptions Options;
  BodyLaw Law; // of all tracers
  std::vector<Vortex> Vortices;
  SolidTest IsSolid;
  FlowFrame Before;
  FlowFrame Now;
  double StartTime = 0.0;
  bool HasFrame = false;
  int NextSample = 0;
  std::vector<Tracer> Tracers;
};

} // namespace waft
