// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Blending.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// Quintic step from 0 to 1, flat to second order at both ends.
double SmoothStep(double u)
{
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (u * (6.0 * u - 15.0) + 10.0);
}

/// Its integral from 0.
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

std::vector<Vec3> BlendChain(const SegmentLibrary& library, const PieceChain& chain)
{
  const int window = library.Window();
  const int count = chain.NumberOfSamples(window);
  const std::vector<int> beginnings = chain.Beginnings(window);
  std::vector<Vec3> steps(static_cast<std::size_t>(std::max(0, count - 1)), Vec3::Zero());
  for (std::size_t i = 0; i < chain.Pieces.size(); ++i)
  {
    const Piece& piece = chain.Pieces[i];
    const std::vector<Vec3>& samples = library.Samples(piece.Segment);
    const int length = piece.Last - piece.First;
    for (int k = 0; k < length; ++k)
    {
      // Step k of the piece lies in the overlap with the one before (k < window - 1) or after.
      double weight = 1.0;
      if (i > 0 && k < window - 1)
      {
        weight = SmoothStep((k + 0.5) / (window - 1));
      }
      if (i + 1 < chain.Pieces.size() && k >= length - (window - 1))
      {
        weight *= 1.0 - SmoothStep((k - (length - (window - 1)) + 0.5) / (window - 1));
      }
      const int sample = beginnings[i] + k;
      double turn = chain.JoinAngle * (sample + 0.5) / (count - 1);
      if (static_cast<int>(i) >= chain.JoinPlace)
      {
        turn -= chain.JoinAngle;
      }
      const Vec3 step =
        piece.Place.Rotation * (samples[piece.First + k + 1] - samples[piece.First + k]);
      steps[sample] += weight * (Eigen::AngleAxisd(turn, Vec3::UnitZ()) * step);
    }
  }
  std::vector<Vec3> path;
  path.reserve(static_cast<std::size_t>(count));
  const Piece& first = chain.Pieces.front();
  path.push_back(first.Place * library.Samples(first.Segment)[first.First]);
  for (const Vec3& step : steps)
  {
    path.push_back(path.back() + step);
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
