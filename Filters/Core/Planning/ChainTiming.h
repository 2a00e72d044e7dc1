// SPDX-License-Identifier: BSD-3-Clause
// Which piece of a chain flies at each frame of its span.
#pragma once

#include "Planning/Span.h"

#include <vector>

namespace waft
{

/// Pieces hand over at the middles of their overlaps. Library, chain and clock must outlive it.
class ChainTiming
{
public:
  ChainTiming(const SegmentLibrary& library, const PieceChain& chain, const SpanClock& clock);

  /// Samples of the chain over frames of flight.
  double RetimingFactor() const { return this->Scale; }
  /// The frame of the span at which the first sample of each piece's segment would fly: may be
  /// negative, since a piece need not begin with its segment.
  std::vector<int> PieceFrames() const;
  /// What flies at the frames 0..Frames of the clock.
  std::vector<FrameSource> Sources() const;
  /// Where the trees have the chain at these frames: clear of everything, but with a gap at the
  /// join.
  std::vector<Vec3> TreePositions() const;

private:
  struct ChainSample
  {
    int Piece;
    double Index; // sample of the chain
  };
  std::vector<ChainSample> ChainSamples() const; // one a frame

  const SegmentLibrary& Library;
  const PieceChain& Chain;
  const SpanClock& Clock;
  std::vector<int> Beginnings;
  double Scale;       // samples a frame of flight
  double HalfOverlap; // samples
};

} // namespace waft
