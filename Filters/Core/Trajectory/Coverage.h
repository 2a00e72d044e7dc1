// SPDX-License-Identifier: BSD-3-Clause
// How much a further simulation adds to a motion database: Shi et al. 2005 stop when no new shapes
// of trajectories are seen (end of section 3.1).
#pragma once

#include "Base/Motion.h"
#include "Base/Parallel.h"
#include "Trajectory/Segmentation.h"

#include <Eigen/Core>

#include <vector>

namespace waft
{

struct CoveragePoint
{
  int Simulations = 0;   // that were there when the next one came
  int NewSegments = 0;   // that the next one brought
  double NewShare = 0.0; // of these, farther from all before than the tolerance, 0..1
};

/// Takes simulations one after the other and tells of each what fraction of its segments is new:
/// their rms distance over the samples to every earlier segment of their length, both in the frames
/// of SegmentFrame.h, is above a tolerance times the rms chord of the segments of that length so
/// far, their own included. Every segment counts, also those that a database is thinned by. Memory:
/// four bytes a coordinate, less than 1 MB for a simulation of 512 tracers and 300 frames.
class Coverage
{
public:
  static constexpr double DefaultTolerance = 0.05;

  /// width: of the volume [m].
  Coverage(const SegmentationOptions& options, double framesPerSecond, double width,
           double tolerance = DefaultTolerance);

  /// The tracks of the next simulation. Results do not depend on the number of threads.
  void Add(const std::vector<Track>& tracks, const ParallelFor& parallelFor);

  /// One point per simulation but the first.
  const std::vector<CoveragePoint>& Curve() const { return this->Points; }

private:
  /// Segments of one simulation, one a column, sorted by their first coordinate.
  using Block = Eigen::MatrixXf;
  struct Group
  {
    int NumberOfSamples = 0;
    double SquaredChords = 0.0; // sum over the segments [m^2]
    int NumberOfSegments = 0;
    /// A rotation of the samples: principal directions of the first segments seen, widest first, so
    /// that the first coordinates tell most of a distance.
    Eigen::MatrixXd Directions;
    std::vector<Block> Blocks;
  };
  int CountNew(const Group& group, const Block& block, const ParallelFor& parallelFor) const;

  SegmentationOptions Options;
  double FramesPerSecond;
  double Width;
  double Tolerance;
  std::vector<Group> Groups;
  std::vector<CoveragePoint> Points;
  int Simulations = 0;
};

} // namespace waft
