// SPDX-License-Identifier: BSD-3-Clause
// What samples ask of the coefficients of a wind's splines.
#pragma once

#include "Air/Field/WindSplines.h"
#include "Base/Parallel.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace waft
{

/// What the wind is wanted to be, at one frame (half frames, too).
struct WindSamples
{
  double Frame = 0.0;
  std::vector<Vec3> Positions; // m
  std::vector<Vec3> Values;    // m/s
};

/// The equations M' w (M a - values) + a = 0 of the coefficients a that samples touch: the others
/// are 0 in the most probable wind. Those of a frame have its four knots in common: these are
/// summed before its samples are visited, and get their shares after it. The same on any number of
/// threads.
class WindEquations
{
public:
  /// Of a sample of a frame, at a scale.
  using HoldOf = std::function<WindHold(std::size_t scale, std::size_t frame, std::size_t sample)>;

  /// Scales, samples and loops are kept by reference. samples: in the order of their frames;
  /// weight: of all.
  WindEquations(const std::vector<WindSplines>& scales, const std::vector<WindSamples>& samples,
                HoldOf holdOf, double weight, const ParallelFor& parallel);

  std::size_t Size() const { return this->Unknowns; }
  /// result = M' w (M a - values) + a, or without the values.
  void Apply(const std::vector<double>& a, bool lessValues, std::vector<double>& result);
  /// About the matrix's own.
  std::vector<double> Diagonal();

  /// act(in the list of all coefficients, scale after scale; among the unknowns): of each of these.
  template <class Act>
  void Each(const Act& act) const
  {
    for (std::size_t l = 0; l < this->Scales.size(); ++l)
    {
      for (const Knot& knot : this->Knots[l])
      {
        std::size_t at = knot.Begin;
        for (std::size_t c = 0; c < 3; ++c)
        {
          for (const std::uint32_t node : knot.Nodes)
          {
            act(knot.All + c * this->Scales[l].Nodes() + node, at++);
          }
        }
      }
    }
  }

  struct Run // of nodes side by side
  {
    std::uint32_t Node = 0, Place = 0, Length = 0; // Place: in the slice
    std::uint32_t AtKnots[4] = {};                 // and in the lists of its knots
  };

private:
  struct Knot
  {
    std::size_t All = 0;   // where its own begin among all coefficients
    std::size_t Begin = 0; // and among the unknowns
    std::vector<std::uint32_t> Nodes;
  };
  /// What the samples of one frame touch of a scale.
  struct Slice
  {
    WindSplines::Instant At;
    std::vector<std::uint32_t> PlaceOf; // by node
    std::vector<Run> Runs;
    std::size_t Size = 0; // nodes
  };
  /// Some frames, and what they add to the knots that they touch, which lie one after the other.
  struct Part
  {
    std::size_t First = 0, Last = 0;          // of samples
    std::vector<std::size_t> Begin, End, Own; // by scale, the last in Sums
    std::vector<double> Sums;
  };

  Slice SliceOf(const WindSplines& scale, const WindSamples& samples) const;
  void ListKnots();
  Part PartOf(std::size_t first, std::size_t last) const;
  /// Where the nodes of a slice's four knots begin, of a component.
  std::array<std::size_t, 4> BeginsOf(std::size_t scale, const Slice& slice, std::size_t c) const;
  std::vector<double> SumOfKnots(std::size_t scale, const Slice& slice, const double* a) const;
  void Share(std::size_t scale, const Slice& slice, const double* weights,
             const std::vector<double>& sums, Part& part) const;
  WindSplines::Place PlaceOf(std::size_t scale, std::size_t frame, std::size_t sample) const;
  WindSplines::Rows RowsOf(std::size_t scale, std::size_t frame,
                           const WindSplines::Place& place) const;
  void AddFrame(std::size_t frame, const double* a, bool lessValues, Part& part) const;
  void AddSquares(std::size_t frame, Part& part) const;
  /// To result, what all frames add: add(frame, part).
  template <class Add>
  void SumUp(const Add& add, std::vector<double>& result);

  const std::vector<WindSplines>& Scales;
  const std::vector<WindSamples>& Samples;
  HoldOf Hold;
  double Weight;
  const ParallelFor& Parallel;
  std::vector<std::vector<Slice>> Slices; // by scale and frame
  std::vector<std::vector<Knot>> Knots;   // by scale
  std::size_t Unknowns = 0;
  std::vector<Part> Parts;
};

} // namespace waft
