// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Blending.h"

#include "Base/SmoothStep.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// The integral of SmoothStep from 0.
double SmoothStepIntegral(double u)
{
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * u * (u * (u - 3.0) + 2.5);
}

} // namespace

int PieceChain::NumberOfSamples(int window) const
{
  int count = 0;
  for (const Piece& piece : this->Pieces)
  {
    count += piece.Last - piece.First + 1;
  }
  return count - window * (static_cast<int>(this->Pieces.size()) - 1);
}

std::vector<int> PieceChain::Beginnings(int window) const
{
  std::vector<int> result;
  int at = 0;
  for (const Piece& piece : this->Pieces)
  {
    result.push_back(at);
    at += piece.Last - piece.First + 1 - window;
  }
  return result;
}

Vec3 Handover::Correction(double index, bool isAfter) const
{
  const double u = (index - this->Centre) / this->Reach;
  if (isAfter ? u >= 1.0 : u <= -1.0)
  {
    return Vec3::Zero();
  }
  // The offset rises along a smooth step, the slope along its integral, less what the pieces after
  // the overlap bring themselves.
  const double fraction = SmoothStep(0.5 * (u + 1.0)) - (isAfter ? 1.0 : 0.0);
  const double ramp =
    2.0 * SmoothStepIntegral(0.5 * (u + 1.0)) + std::max(u - 1.0, 0.0) - (isAfter ? u : 0.0);
  return fraction * this->Offset + ramp * this->Reach * this->Slope;
}

namespace
{

using Steps = std::vector<Vec3>;

/// The steps of each piece [m], those after the join turned back by its angle: as the table has
/// them.
std::vector<Steps> UnturnedSteps(const SegmentLibrary& library, const PieceChain& chain)
{
  const Mat3 back = Eigen::AngleAxisd(-chain.JoinAngle, Vec3::UnitZ()).toRotationMatrix();
  std::vector<Steps> result;
  for (std::size_t i = 0; i < chain.Pieces.size(); ++i)
  {
    const Piece& piece = chain.Pieces[i];
    const std::vector<Vec3>& samples = library.Samples(piece.Segment);
    const Mat3 rotation = static_cast<int>(i) >= chain.JoinIndex ? back * piece.Transform.Rotation
                                                                 : piece.Transform.Rotation;
    Steps steps;
    for (int k = piece.First; k < piece.Last; ++k)
    {
      steps.push_back(rotation * (samples[k + 1] - samples[k]));
    }
    result.push_back(std::move(steps));
  }
  return result;
}

/// The line through what the steps of neighbours differ by in their overlap.
std::vector<Handover> Handovers(const std::vector<Steps>& steps, int overlap, double reach)
{
  std::vector<Handover> result;
  double beginning = 0.0;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
  {
    const Steps& before = steps[i];
    const Steps& after = steps[i + 1];
    const std::size_t first = before.size() - static_cast<std::size_t>(overlap);
    beginning += static_cast<double>(first);
    Handover handover;
    handover.Centre = beginning + 0.5 * overlap;
    handover.Reach = std::max(reach, 0.5 * overlap);
    double squares = 0.0;
    for (int k = 0; k < overlap; ++k)
    {
      const Vec3 difference = after[k] - before[first + k];
      const double time = k + 0.5 - 0.5 * overlap;
      handover.Offset += difference / overlap;
      handover.Slope += time * difference;
      squares += time * time;
    }
    handover.Slope /= squares; // an overlap has two steps at least
    result.push_back(handover);
  }
  return result;
}

/// Adds what all handovers do at an index of the chain to a step of a piece, in their order. Each
/// is zero beyond its reach: of those of a long chain nearly all are, and are not looked at.
void AddCorrections(const std::vector<Handover>& handovers, double index, std::size_t piece,
                    Vec3& step)
{
  constexpr double slack = 1e-6; // more than rounding
  auto handover =
    std::partition_point(handovers.begin(), handovers.end(),
                         [&](const Handover& h) { return index > h.Centre + h.Reach + slack; });
  for (; handover != handovers.end() && index > handover->Centre - handover->Reach - slack;
       ++handover)
  {
    step +=
      handover->Correction(index, piece > static_cast<std::size_t>(handover - handovers.begin()));
  }
}

} // namespace

std::vector<Handover> HandOver(const SegmentLibrary& library, const PieceChain& chain)
{
  return Handovers(UnturnedSteps(library, chain), library.Window() - 1,
                   PlannerNumbers::HandoverTime * library.Options().FramesPerSecond);
}

std::vector<Vec3> BlendChain(const SegmentLibrary& library, const PieceChain& chain)
{
  const int overlap = library.Window() - 1;
  const std::vector<int> beginnings = chain.Beginnings(library.Window());
  const std::vector<Steps> own = UnturnedSteps(library, chain);
  const std::vector<Handover> handovers =
    Handovers(own, overlap, PlannerNumbers::HandoverTime * library.Options().FramesPerSecond);
  Steps steps(static_cast<std::size_t>(std::max(0, chain.NumberOfSamples(library.Window()) - 1)),
              Vec3::Zero());
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    const auto length = static_cast<int>(own[i].size());
    for (int k = 0; k < length; ++k)
    {
      Vec3 step = own[i][k];
      AddCorrections(handovers, beginnings[i] + k + 0.5, i, step);
      // Step k of the piece lies in the overlap with the one before (k < overlap) or after.
      double weight = 1.0;
      if (i > 0)
      {
        weight = SmoothStep((k + 0.5) / overlap);
      }
      if (i + 1 < own.size())
      {
        weight *= 1.0 - SmoothStep((k - (length - overlap) + 0.5) / overlap);
      }
      steps[beginnings[i] + k] += weight * step;
    }
  }
  std::vector<Vec3> path;
  path.reserve(steps.size() + 1);
  const Piece& first = chain.Pieces.front();
  path.push_back(first.Transform * library.Samples(first.Segment)[first.First]);
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const double turn =
      chain.JoinAngle * (static_cast<double>(k) + 0.5) / static_cast<double>(steps.size());
    path.push_back(path.back() + Eigen::AngleAxisd(turn, Vec3::UnitZ()) * steps[k]);
  }
  return path;
}

double SpanClock::Flown(double frame) const
{
  double flown = frame;
  if (this->LaunchFrames > 0)
  {
    // Rate smoothstep(u): what is lost is the integral of (1 - smoothstep).
    const double u = frame / this->LaunchFrames;
    flown -= this->LaunchFrames * (std::min(u, 1.0) - SmoothStepIntegral(u));
  }
  if (this->BrakeFrames > 0)
  {
    const double u = (frame - (this->Frames - this->BrakeFrames)) / this->BrakeFrames;
    flown -= this->BrakeFrames * SmoothStepIntegral(u);
  }
  return flown;
}

std::vector<double> SpanClock::FramesOfFlight() const
{
  std::vector<double> frames;
  double before = 0.0;
  for (int k = 0; k <= this->Frames; ++k)
  {
    const double flown = this->Flown(k);
    while (static_cast<double>(frames.size()) <= flown)
    {
      const double missing = flown - static_cast<double>(frames.size());
      frames.push_back(flown > before ? k - missing / (flown - before) : k);
    }
    before = flown;
  }
  if (this->FlightFrames() > static_cast<double>(frames.size()) - 1.0)
  {
    frames.push_back(this->Frames);
  }
  return frames;
}

std::vector<Vec3> RetimePath(const std::vector<Vec3>& samples, const SpanClock& clock)
{
  const auto count = static_cast<int>(samples.size());
  // Second derivatives of the natural cubic spline through the samples (Thomas algorithm).
  std::vector<Vec3> bend(samples.size(), Vec3::Zero());
  std::vector<double> factor(samples.size(), 0.0);
  for (int k = 1; k + 1 < count; ++k)
  {
    const double pivot = 4.0 - factor[k - 1];
    factor[k] = 1.0 / pivot;
    bend[k] = (6.0 * (samples[k - 1] - 2.0 * samples[k] + samples[k + 1]) - bend[k - 1]) / pivot;
  }
  for (int k = count - 2; k >= 1; --k)
  {
    bend[k] -= factor[k] * bend[k + 1];
  }
  const double scale = (count - 1) / clock.FlightFrames();
  std::vector<Vec3> path(static_cast<std::size_t>(clock.Frames) + 1);
  for (int frame = 0; frame <= clock.Frames; ++frame)
  {
    const double index = std::clamp(clock.Flown(frame) * scale, 0.0, count - 1.0);
    const int k = std::min(static_cast<int>(index), std::max(0, count - 2));
    const double b = index - k;
    const double a = 1.0 - b;
    path[frame] =
      a * samples[k] + b * samples[std::min(k + 1, count - 1)] +
      ((a * a * a - a) * bend[k] + (b * b * b - b) * bend[std::min(k + 1, count - 1)]) / 6.0;
  }
  return path;
}

} // namespace waft
