// SPDX-License-Identifier: BSD-3-Clause
// A sampled air as the optimiser sees it: what bodies move beside it.
#pragma once

#include "Base/BodyLaw.h"
#include "Base/FieldSeries.h"
#include "Constraints/GroundEffect.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// A velocity field of all frames in dx and frames. In it E is that of the deviations
///   w = v - (U(x - s v / 2, t - s / 2) - f slip(t - s / 2))
/// of all bodies, where gas has no slip and f is the factor of the ground effect: a velocity v
/// belongs to the middle of the step s that leads to its frame. What drifts costs nothing, and no
/// viscosity damps what the air itself does.
class GivenAir
{
public:
  GivenAir() = default;
  /// series [m, s, m/s] must outlive the air; origin of the gas' box [m], dx [m], of a frame [s];
  /// laws: of the bodies behind the gas, in dx and frames; ground: of the same bodies.
  GivenAir(const FieldSeries& series, const Vec3& origin, double spacing, double frameStep,
           std::size_t numberOfGas, std::vector<BodyLaw> laws, std::vector<GroundEffect> ground);

  /// By object and frame: the bodies' own velocities relative to the air [m/s], between frames
  /// linear; an empty list leaves the law's.
  void SetSlips(const std::vector<std::vector<Vec3>>& slips);

  bool IsEmpty() const { return this->Series == nullptr; }
  /// The same for the objects alone.
  GivenAir WithoutGas() const
  {
    GivenAir air = *this;
    air.NumberOfGas = 0;
    return air;
  }
  /// At a place [dx] and frame.
  Vec3 Velocity(const Vec3& x, double frame) const;
  /// w of a body at x with velocity v at a frame, after a step s.
  Vec3 Deviation(std::size_t body, const Vec3& x, const Vec3& v, double frame, double step) const;
  /// The velocity, in the step s into a frame, of a body at x before it whose deviation is w then.
  Vec3 Carried(std::size_t body, const Vec3& x, const Vec3& w, double frame, double step) const;

  /// Rows have a stride. state: six rows of `bodies` at a frame; out: the same with w in the place
  /// of v, as Deviation gives it but for rounding (a frame at once takes a fifth less of a run's
  /// time than FieldSeries); jacobians (unless null): nine rows, row-major, of U where w is taken.
  void Deviations(const float* state, std::size_t bodies, std::size_t stride, double frame,
                  double step, float* out, float* jacobians) const;
  /// The way back: of six rows of a gradient by x and w (its last three rows) one by x and v.
  /// direct: what of the last three rows is by v itself, three rows.
  static void ToVelocities(const float* jacobians, const float* direct, std::size_t bodies,
                           std::size_t stride, double step, float* gradient);

private:
  /// The velocity with which a body at x drifts at a frame.
  Vec3 Drift(std::size_t body, const Vec3& x, double frame) const;
  /// The slip of an object [dx / frame] as its law or its pose has it.
  Vec3 SlipOf(std::size_t object, double frame) const;
  /// That at x, by the factor there; slopes unless null: by x.
  Vec3 Slips(std::size_t object, const Vec3& x, double frame, Mat3* slopes = nullptr) const;
  /// What the series says of a frame between two of its own.
  struct Instant
  {
    const std::array<float, 3>*Before, *After;
    float Low, High; // their weights
    /// (u, v, w, 0) of a node [dx / frame].
    void Value(std::size_t node, float u[4]) const
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        u[c] = this->Low * this->Before[node][c] + this->High * this->After[node][c];
      }
      u[3] = 0.0f;
    }
  };
  Instant At(double frame) const;
  /// The values of all nodes, four each.
  void Slice(const Instant& now, std::vector<float>& values) const;
  /// At x [dx], of the nodes' values node(number, u[4]); jacobian (unless null): [1 / frame].
  template <class Node>
  void Sample(const Node& node, const Vec3& x, float u[4], float jacobian[3][4]) const;

  const FieldSeries* Series = nullptr;
  Vec3 Origin = Vec3::Zero();
  double Spacing = 1.0, FrameStep = 1.0;
  std::size_t NumberOfGas = 0;
  std::vector<BodyLaw> Laws;                // by object, as Ground
  std::vector<std::vector<Vec3>> PoseSlips; // by object and frame [dx / frame]
  std::vector<GroundEffect> Ground;
};

} // namespace waft
