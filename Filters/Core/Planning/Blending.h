// SPDX-License-Identifier: BSD-3-Clause
// From a chain of placed pieces to one smooth path: the join's turn spread over the whole chain,
// overlaps blended, time uniformly scaled, landing and lift-off braked.
#pragma once

#include "Planning/SpanSearch.h"

#include <vector>

namespace waft
{

/// A chain of pieces, each overlapping the next in the library's window.
struct PieceChain
{
  std::vector<Piece> Pieces;
  int JoinPlace = 0;      // the first piece that stands where the goal's tree put it
  double JoinAngle = 0.0; // about the vertical [rad]

  /// Samples the whole chain covers.
  int NumberOfSamples(int window) const;
  /// Sample of the chain at which each piece begins.
  std::vector<int> Beginnings(int window) const;
};

/// Positions of the chain, one a sample, from the first piece's first sample. Steps, not positions,
/// are blended (quintic weights over the window), so a gap in place between two pieces never
/// becomes a kink; the turn of the join is spread evenly over all samples, none at the ends.
std::vector<Vec3> BlendChain(const SegmentLibrary& library, const PieceChain& chain);

/// The time line of a span in frames of flight.
struct SpanClock
{
  int Frames = 0;       // from mark to mark
  int BrakeFrames = 0;  // before the goal, over which the speed falls to zero
  int LaunchFrames = 0; // after the start, over which it rises from zero

  /// Frames of flight at full speed.
  double FlightFrames() const
  {
    return this->Frames - 0.5 * (this->BrakeFrames + this->LaunchFrames);
  }
  /// Frames of flight done at a frame (0..Frames), of continuous second derivative.
  double Flown(double frame) const;
};

/// The path at the frames 0..clock.Frames: the samples run through uniformly (natural cubic
/// spline), apart from braking.
std::vector<Vec3> RetimePath(const std::vector<Vec3>& samples, const SpanClock& clock);

} // namespace waft
