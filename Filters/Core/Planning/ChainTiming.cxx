// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/ChainTiming.h"

#include <algorithm>
#include <cmath>

namespace waft
{

ChainTiming::ChainTiming(const SegmentLibrary& library, const PieceChain& chain,
                         const SpanClock& clock) :
  Library(library),
  Chain(chain), Clock(clock), Beginnings(chain.Beginnings(library.Window())),
  Scale((chain.NumberOfSamples(library.Window()) - 1.0) / clock.FlightFrames()),
  HalfOverlap(0.5 * (library.Window() - 1))
{
}

std::vector<ChainTiming::ChainSample> ChainTiming::ChainSamples() const
{
  std::vector<ChainSample> samples;
  std::size_t piece = 0;
  for (int frame = 0; frame <= this->Clock.Frames; ++frame)
  {
    const double index = this->Clock.Flown(frame) * this->Scale;
    while (piece + 1 < this->Beginnings.size() &&
           index >= this->Beginnings[piece + 1] + this->HalfOverlap)
    {
      ++piece;
    }
    samples.push_back({ static_cast<int>(piece), index });
  }
  return samples;
}

std::vector<int> ChainTiming::PieceFrames() const
{
  std::vector<int> frames;
  for (std::size_t i = 0; i < this->Chain.Pieces.size(); ++i)
  {
    frames.push_back(static_cast<int>(
      std::lround((this->Beginnings[i] - this->Chain.Pieces[i].First) / this->Scale)));
  }
  return frames;
}

std::vector<FrameSource> ChainTiming::Sources() const
{
  std::vector<FrameSource> sources;
  for (const ChainSample& at : this->ChainSamples())
  {
    const Piece& body = this->Chain.Pieces[at.Piece];
    const int sample =
      body.First + static_cast<int>(std::lround(at.Index - this->Beginnings[at.Piece]));
    sources.push_back({ at.Piece, std::clamp(sample, body.First, body.Last) });
  }
  return sources;
}

std::vector<Vec3> ChainTiming::TreePositions() const
{
  std::vector<Vec3> positions;
  for (const ChainSample& at : this->ChainSamples())
  {
    const Piece& body = this->Chain.Pieces[at.Piece];
    const std::vector<Vec3>& samples = this->Library.Samples(body.Segment);
    const double own = std::clamp(body.First + at.Index - this->Beginnings[at.Piece],
                                  static_cast<double>(body.First), static_cast<double>(body.Last));
    const int low = std::min(static_cast<int>(own), std::max(body.First, body.Last - 1));
    const Vec3& a = samples[low];
    const Vec3& b = samples[std::min(low + 1, body.Last)];
    positions.push_back(body.Transform * Vec3(a + (own - low) * (b - a)));
  }
  return positions;
}

} // namespace waft
