// SPDX-License-Identifier: BSD-3-Clause
// A chain blended the plain way: every handover is asked about every step. For comparison.
#pragma once

#include "Base/SmoothStep.h"
#include "Planning/Blending.h"

namespace waft
{
namespace test
{

inline std::vector<Vec3> PlainBlend(const SegmentLibrary& library, const PieceChain& chain)
{
  const int overlap = library.Window() - 1;
  const std::vector<int> beginnings = chain.Beginnings(library.Window());
  const std::vector<Handover> handovers = HandOver(library, chain);
  const Mat3 back = Eigen::AngleAxisd(-chain.JoinAngle, Vec3::UnitZ()).toRotationMatrix();
  const std::size_t count = chain.Pieces.size();
  std::vector<Vec3> steps(static_cast<std::size_t>(chain.NumberOfSamples(library.Window())) - 1,
                          Vec3::Zero());
  for (std::size_t i = 0; i < count; ++i)
  {
    const Piece& piece = chain.Pieces[i];
    const std::vector<Vec3>& samples = library.Samples(piece.Segment);
    const Mat3 rotation = static_cast<int>(i) >= chain.JoinIndex ? back * piece.Transform.Rotation
                                                                 : piece.Transform.Rotation;
    const int length = piece.Last - piece.First;
    for (int k = 0; k < length; ++k)
    {
      Vec3 step = rotation * (samples[piece.First + k + 1] - samples[piece.First + k]);
      for (std::size_t j = 0; j < handovers.size(); ++j)
      {
        step += handovers[j].Correction(beginnings[i] + k + 0.5, i > j);
      }
      double weight = i > 0 ? SmoothStep((k + 0.5) / overlap) : 1.0;
      weight *= i + 1 < count ? 1.0 - SmoothStep((k - (length - overlap) + 0.5) / overlap) : 1.0;
      steps[static_cast<std::size_t>(beginnings[i] + k)] += weight * step;
    }
  }
  const Piece& first = chain.Pieces.front();
  std::vector<Vec3> path{ first.Transform * library.Samples(first.Segment)[first.First] };
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const double turn =
      chain.JoinAngle * (static_cast<double>(k) + 0.5) / static_cast<double>(steps.size());
    path.push_back(path.back() + Eigen::AngleAxisd(turn, Vec3::UnitZ()) * steps[k]);
  }
  return path;
}

} // namespace test
} // namespace waft
