// SPDX-License-Identifier: BSD-3-Clause
// The path of one body that drifts in a given air through its marks with the least control.
#pragma once

#include "Air/Field/AirSampler.h"
#include "Base/BodyLaw.h"
#include "Base/Motion.h"
#include "Base/Types.h"
#include "Constraints/GroundEffect.h"

#include <functional>
#include <utility>
#include <vector>

namespace waft
{

struct DriftWeights
{
  /// Of changes of the control, over that of the control itself [s^2].
  double Smoothness = 0.02;
  /// Of accelerations where the control is free, over that of the control in flight [s^2].
  double Braking = 0.01;
  /// Of what lies nearer to an obstacle or a wall than it may over that of the control [1/s^2],
  /// summed over frames.
  double Barrier = 400.0;
  /// Of how much nearer two bodies are than they keep over the control [1/s^2], summed over frames.
  double Contact = 200.0;
  /// Of missed balls, velocities and accelerations, summed over rows.
  double Row = 1e4;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Smoothness...);
    visit(of.Braking...);
    visit(of.Barrier...);
    visit(of.Contact...);
    visit(of.Row...);
  }
};

/// |sum of Weight x(Frame) - Value| <= Radius, per axis alike: a ball, a velocity or an
/// acceleration.
struct DriftRow
{
  std::vector<std::pair<int, double>> Terms; // frames within four of each other
  Vec3 Value = Vec3::Zero();
  double Radius = 0.0;
};

/// Something that a body is too near to: the way out and how far it is [m].
struct DriftDepth
{
  Vec3 Normal = Vec3::Zero();
  double Depth = 0.0;
};

/// Frames are those of the air's fields. A step k leads from frame k to the next.
struct DriftProblem
{
  Timeline Time;
  BodyLaw Law;
  std::vector<Vec3> Slips;            // by step [m/s], of the body in the air; empty: the law's
  double ResponseTime = 0.0;          // the law's [s]; 0: the body has no inertia
  std::vector<unsigned char> IsFixed; // by frame
  std::vector<Vec3> Fixed;            // [m], where IsFixed
  /// By step: 1 where it flies by the air alone, 0 where it lies still, between where it is taken
  /// up from a rest or handed over from and to frames that are given.
  std::vector<double> Flight;
  int First = 0; // frame at which it appears in flight: its path is none before
  GroundEffect Ground;
  std::vector<DriftRow> Rows;
  /// Adds all that a body at x is too near to at a frame; may be empty.
  std::function<void(int frame, const Vec3& x, std::vector<DriftDepth>& depths)> TooNear;
};

struct DriftOutcome
{
  double Cost = 0.0; // m^2/s
  int Iterations = 0;
};

/// The control of a step [m/s]: what moves the body beside the air,
///   c = x' - w,  w = u(x, t) - f Slip,
/// with the factor f of the ground effect: what the body's law leaves over, in units of velocity.
/// Of a body with inertia, after its first step, by the exact step of T v' = w - v for a w that is
/// linear between the middles of steps, so that a body let go goes the same way (T: ResponseTime):
///   (1 - e) c_k = v_k - e v_(k-1) - b_0 w_(k-1) - b_1 w_k,
///   e = exp(-dt / T),  b_1 = 1 - (T / dt) (1 - e),  b_0 = 1 - e - b_1.
std::vector<Vec3> DriftControls(const DriftProblem& problem, const AirSampler& air,
                                const std::vector<Vec3>& path);

/// Their root mean square over the steps in flight [m/s].
double ControlInFlight(const DriftProblem& problem, const AirSampler& air,
                       const std::vector<Vec3>& path);

/// Whether it flies in a step by the air alone, above what brakes its landing.
bool IsFreeStep(const DriftProblem& problem, const std::vector<Vec3>& path, int step);
/// Whether nothing but the air and its whole slip moves it in a step beside its control: no surface
/// brakes, lifts or bears it there either.
bool IsFreeOfGround(const DriftProblem& problem, const std::vector<Vec3>& path, int step);

/// Moves the path to a local minimum of 1/2 sum Flight |c|^2 dt + Smoothness / 2 sum |dc/dt|^2 dt
/// + barriers, over all frames that are not fixed at once: Levenberg's method, the Gauss-Newton
/// matrix being banded. Fixed frames take their values.
DriftOutcome SolveDrift(const DriftProblem& problem, const AirSampler& air,
                        const DriftWeights& weights, int maximumIterations,
                        std::vector<Vec3>& path);

} // namespace waft
