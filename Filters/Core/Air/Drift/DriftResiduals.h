// SPDX-License-Identifier: BSD-3-Clause
// What a drifting body's path is judged by, residual by residual.
#pragma once

#include "Air/Drift/Drift.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace waft
{

/// A residual that is linear about the path: value + sum of Blocks (x - path) over its frames.
struct DriftResidual
{
  static constexpr int Reach = 4; // frames that one may span, less one

  int First = 0; // frame of the first block
  int Count = 0;
  Vec3 Value = Vec3::Zero();
  std::array<Mat3, Reach + 1> Blocks;
};

/// What a path is too near to at a frame.
struct DriftDepthAt
{
  int Frame = 0;
  DriftDepth Of;
};

/// All residuals of a problem with their weights: add(residual, weight) is called for each that is
/// not 0 throughout, in a fixed order; its Blocks are set where `derivatives`.
class DriftResiduals
{
public:
  DriftResiduals(const DriftProblem& problem, const AirSampler& air, const DriftWeights& weights);

  /// Frames that a residual of the problem spans, less one.
  static int ReachOf(const DriftProblem& problem);
  /// The control of a step; with its derivatives where `linear`.
  Vec3 Control(const std::vector<Vec3>& x, int k, DriftResidual* linear) const;
  BodyLaw LawIn(int k) const;
  /// The velocity that the air, settling and the ground effect give at x in a step.
  Vec3 Drifting(int k, const Vec3& x, Mat3* gradient) const;

  /// Controls and their changes. controlAt(k, linear): that of a step, as Control has it.
  template <class ControlAt, class Add>
  void VisitFlight(const ControlAt& controlAt, bool derivatives, const Add& add) const
  {
    const std::vector<double>& flight = this->Problem.Flight;
    DriftResidual now, before, change;
    for (int k = 0; k + 1 < this->Frames; ++k)
    {
      const double fraction = flight[static_cast<std::size_t>(k)];
      if (fraction <= 0.0)
      {
        continue;
      }
      now.Value = controlAt(k, derivatives ? &now : nullptr);
      add(now, fraction * this->Step);
      if (k > 0 && flight[static_cast<std::size_t>(k) - 1] > 0.0)
      {
        const double both = std::min(fraction, flight[static_cast<std::size_t>(k) - 1]);
        change.Value = (now.Value - before.Value) / this->Step;
        if (derivatives)
        {
          change.First = before.First;
          change.Count = now.First + now.Count - before.First;
          std::fill_n(change.Blocks.begin(), change.Count, Mat3::Zero());
          for (int i = 0; i < before.Count; ++i)
          {
            change.Blocks[i] -= before.Blocks[i] / this->Step;
          }
          for (int i = 0; i < now.Count; ++i)
          {
            change.Blocks[now.First - before.First + i] += now.Blocks[i] / this->Step;
          }
        }
        add(change, both * this->Weights.Smoothness * this->Step);
      }
      std::swap(now, before);
    }
  }

  /// Accelerations where the control is free, rows and barriers. depths: what FindDepths found.
  template <class Add>
  void VisitOthers(const std::vector<Vec3>& x, const std::vector<DriftDepthAt>& depths,
                   bool derivatives, const Add& add) const
  {
    this->VisitBraking(x, derivatives, add);
    this->VisitRows(x, derivatives, add);
    this->VisitBarriers(depths, derivatives, add);
  }
  /// All that the path is too near to, frame by frame.
  void FindDepths(const std::vector<Vec3>& x, std::vector<DriftDepthAt>& depths);

private:
  template <class Add>
  void VisitBraking(const std::vector<Vec3>& x, bool derivatives, const Add& add) const
  {
    const double scale = 1.0 / (this->Step * this->Step);
    DriftResidual bend;
    for (int f = 1; f + 1 < this->Frames; ++f)
    {
      const auto at = static_cast<std::size_t>(f);
      const double free = 1.0 - std::min(this->Problem.Flight[at - 1], this->Problem.Flight[at]);
      const bool appears = f == this->Problem.First;
      if (free <= 0.0 || appears ||
          (this->IsFixed(f - 1) && this->IsFixed(f) && this->IsFixed(f + 1)))
      {
        continue;
      }
      bend.Value = scale * (x[at - 1] - 2.0 * x[at] + x[at + 1]);
      if (derivatives)
      {
        bend.First = f - 1;
        bend.Count = 3;
        bend.Blocks[0] = bend.Blocks[2] = scale * Mat3::Identity();
        bend.Blocks[1] = -2.0 * scale * Mat3::Identity();
      }
      add(bend, free * this->Weights.Braking * this->Step);
    }
  }

  template <class Add>
  void VisitRows(const std::vector<Vec3>& x, bool derivatives, const Add& add) const
  {
    DriftResidual linear;
    for (const DriftRow& row : this->Problem.Rows)
    {
      Vec3 missed = -row.Value;
      for (const auto& [frame, weight] : row.Terms)
      {
        missed += weight * x[static_cast<std::size_t>(frame)];
      }
      const double size = missed.norm();
      if (size <= row.Radius)
      {
        continue;
      }
      const Vec3 normal = missed / size;
      const Mat3 along = row.Radius > 0.0 ? Mat3(normal * normal.transpose()) : Mat3::Identity();
      linear.Value = (1.0 - row.Radius / size) * missed;
      if (derivatives)
      {
        linear.First = row.Terms.front().first;
        linear.Count = row.Terms.back().first - linear.First + 1;
        std::fill_n(linear.Blocks.begin(), linear.Count, Mat3::Zero());
        for (const auto& [frame, weight] : row.Terms)
        {
          linear.Blocks[frame - linear.First] = weight * along;
        }
      }
      add(linear, this->Weights.Row);
    }
  }

  template <class Add>
  void VisitBarriers(const std::vector<DriftDepthAt>& depths, bool derivatives,
                     const Add& add) const
  {
    DriftResidual linear;
    for (const DriftDepthAt& at : depths)
    {
      linear.Value = at.Of.Depth * at.Of.Normal;
      if (derivatives)
      {
        linear.First = at.Frame;
        linear.Count = 1;
        linear.Blocks[0] = -at.Of.Normal * at.Of.Normal.transpose();
      }
      add(linear, this->Weights.Barrier);
    }
  }

  bool IsFixed(int frame) const
  {
    return this->Problem.IsFixed[static_cast<std::size_t>(frame)] != 0;
  }

  const DriftProblem& Problem;
  const AirSampler& Air;
  const DriftWeights& Weights;
  int Frames;
  double Step;
  double Decay = 0.0;            // of an inert body's velocity in a step; 0: it has no inertia
  double Before = 0.0;           // what of the step before is in it
  std::vector<DriftDepth> Found; // at a frame
};

} // namespace waft
