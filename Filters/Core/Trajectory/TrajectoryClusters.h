// SPDX-License-Identifier: BSD-3-Clause
// From traced trajectories to the motion database (Shi et al. 2005, section 3.2): cut, group,
// compress, cluster, connect.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/OptionFields.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Trajectory/ClusterTree.h"
#include "Trajectory/ConnectionTable.h"
#include "Trajectory/MotionDatabase.h"
#include "Trajectory/Segmentation.h"

#include <map>
#include <string>
#include <vector>

namespace waft
{

/// One run whose air was traced.
struct TracedSimulation
{
  /// Annotated; one sample a frame from frame 0. Tracks without annotation count as undriven.
  std::vector<Track> Tracks;
  /// Those that the VortexIds of the tracks name.
  std::vector<Vortex> Vortices;
};

struct ClusterInput
{
  std::vector<TracedSimulation> Simulations;
  double FramesPerSecond = 30.0;
  Box Volume;
  double SettlingSpeed = 0.0; // with which the tracers fell [m/s]
};

struct ClusterOptions
{
  SegmentationOptions Segmentation;
  /// Samples that consecutive segments overlap in; at most the shortest segment.
  int Window = 6;
  /// Of the compression: rms left out over rms of the segments of a group, 1e-6 to 1.
  double RelativeError = 0.002;
  /// More segments than this are thinned at random; 0: all are kept.
  int MaximumSegments = 6000;
  ClusterTreeOptions Trees; // its Seed serves the thinning, too
  ConnectionOptions Connections;

  Result Validate() const;

  template <class Visitor, class... Holder>
  static void VisitSize(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "RelativeError",
                       { 1e-6, 1 },
                       "",
                       "Error of the compression: rms left out over rms of the segments." },
          of.RelativeError...);
    visit(OptionField{ "MaximumSegments",
                       { 0, limits::MostInt },
                       "",
                       "More segments than this are thinned at random; 0: all are kept." },
          of.MaximumSegments...);
  }

  /// What a user sets, the parts apart.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Window",
                       { 3, limits::MostInt },
                       "frames",
                       "Frames that consecutive segments of a path overlap in." },
          of.Window...);
    VisitSize(visit, of...);
  }
};

/// Keys and values, as they come into the database's Provenance.
std::map<std::string, std::string> ParametersOf(const ClusterOptions& options);

/// Fails when no track is long enough for a segment. Groups without segments are left out.
Result ClusterTrajectories(const ClusterInput& input, const ClusterOptions& options,
                           const ParallelFor& parallelFor, Monitor& monitor,
                           MotionDatabase& database);

} // namespace waft
