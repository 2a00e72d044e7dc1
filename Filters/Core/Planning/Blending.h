// SPDX-License-Identifier: BSD-3-Clause
// From a chain of placed pieces to one smooth path: the join's turn spread over the whole chain,
// pieces handed over into each other, time uniformly scaled, landing and lift-off braked.
#pragma once

#include "Planning/SpanSearch.h"

#include <algorithm>
#include <vector>

namespace waft
{

/// A chain of pieces, each overlapping the next in the library's window.
struct PieceChain
{
  std::vector<Piece> Pieces;
  int JoinIndex = 0;      // the first piece that stands where the goal's tree put it
  double JoinAngle = 0.0; // about the vertical [rad]

  /// Samples the whole chain covers.
  int NumberOfSamples(int window) const;
  /// Sample of the chain at which each piece begins.
  std::vector<int> Beginnings(int window) const;
};

/// How one piece goes over into the next. In the overlap their steps differ by about a line in
/// time; that is handed over smoothly within 1.25 s to either side, so that velocity and
/// acceleration are continuous and no turn is sharper than the air's. Neighbouring handovers may
/// overlap.
struct Handover
{
  double Centre = 0.0;        // of the overlap, in steps of the chain
  double Reach = 1.0;         // steps to either side
  Vec3 Offset = Vec3::Zero(); // step after less step before, at the centre [m per frame]
  Vec3 Slope = Vec3::Zero();  // what it grows by from step to step [m per frame^2]

  /// What is added at an index of the chain [steps] to the steps of the pieces before the overlap,
  /// or of those after it, as they are before the turn of the join is spread: zero beyond the reach
  /// on their own side.
  Vec3 Correction(double index, bool isAfter) const;
};

/// One a connection of the chain.
std::vector<Handover> HandOver(const SegmentLibrary& library, const PieceChain& chain);

/// Positions of the chain, one a sample, from the first piece's first sample. Steps, not positions,
/// are blended (handed over as above; what is left, with quintic weights over the overlap), so a
/// gap between two pieces never becomes a jump of the second difference; the turn of the join is
/// spread evenly over all samples, none at the ends.
std::vector<Vec3> BlendChain(const SegmentLibrary& library, const PieceChain& chain);

/// The time line of a span in frames of flight.
struct SpanClock
{
  int Frames = 0;       // from mark to mark
  int BrakeFrames = 0;  // before the goal, over which the speed falls to zero
  int LaunchFrames = 0; // after the start, over which it rises from zero

  /// It launches and brakes for a second each, or for what there is. second: in frames.
  static SpanClock Of(int frames, bool launches, bool brakes, int second)
  {
    const int most = std::min(second, frames / (launches && brakes ? 2 : 1));
    return { frames, brakes ? most : 0, launches ? most : 0 };
  }
  /// Frames of flight at full speed.
  double FlightFrames() const
  {
    return this->Frames - 0.5 * (this->BrakeFrames + this->LaunchFrames);
  }
  /// Frames of flight done at a frame (0..Frames), of continuous second derivative.
  double Flown(double frame) const;
  /// By frames of flight from 0 on, the frames at which they are done.
  std::vector<double> FramesOfFlight() const;
};

/// The path at the frames 0..clock.Frames: the samples run through uniformly (natural cubic
/// spline), apart from braking.
std::vector<Vec3> RetimePath(const std::vector<Vec3>& samples, const SpanClock& clock);

} // namespace waft
