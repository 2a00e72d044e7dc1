// SPDX-License-Identifier: BSD-3-Clause
// The equations of up to four bodies side by side, and what conjugate gradients hold of them.
#pragma once

#include "Air/Drift/BandedMatrix.h"
#include "Air/Drift/DriftEquations.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// What is done to one is done to all four at once, to each in the order in which it would be done
/// to it alone. A place that no body has keeps zeros.
class FourDrifts
{
public:
  static constexpr std::size_t Count = 4;
  using Sums = std::array<double, Count>; // one a body

  /// Of bodies of as many frames; halfBand: the widest of theirs.
  FourDrifts(std::size_t frames, std::size_t halfBand);

  /// The equations of one as they are now; those of others may be set by other threads meanwhile.
  void Set(std::size_t body, const DriftEquations& equations);
  /// The matrices with a damping on their diagonals, in place: they are set anew before the next
  /// time. False where one is not positive definite.
  bool Factor(double damping);

  /// From a step of zero; the squares of what is left.
  Sums Begin();
  /// What is left, solved for by the factors; the products of both.
  Sums Solve();
  /// The direction: what was solved for, and a part of the last direction.
  void Turn(double part);
  /// The matrices that were factored, times the direction. It is made of what was solved for, of
  /// which the products are known, so no matrix is needed.
  void Multiply() { this->Image = this->Product; }
  /// That of one, less along times the normal at a frame.
  void Subtract(std::size_t body, std::size_t frame, const Vec3& normal, double along);
  /// The products of the direction and what it was multiplied to.
  Sums Bend() const;
  /// Along the direction; the squares of what is left.
  Sums Go(double length);

  /// The direction of one at a frame.
  Vec3 Direction(std::size_t body, std::size_t frame) const { return At(this->Along, body, frame); }
  /// A path of one, moved by the step.
  void Move(std::size_t body, std::vector<Vec3>& path) const;
  /// By how much the steps should lower the costs.
  Sums Promises() const;

private:
  using Values = std::vector<FourDoubles>; // three a frame
  static Vec3 At(const Values& values, std::size_t body, std::size_t frame)
  {
    return { values[3 * frame].Of[body], values[3 * frame + 1].Of[body],
             values[3 * frame + 2].Of[body] };
  }

  Banded<FourDoubles> Matrix;                  // or its factors
  std::vector<std::array<bool, Count>> IsFree; // by frame
  Values Descent, Step, Rest, Along;
  Values Product; // of the matrices and the direction
  Values Image;   // of the direction, or what was solved for: they are never needed at once
  double Damping = 0.0;
};

} // namespace waft
