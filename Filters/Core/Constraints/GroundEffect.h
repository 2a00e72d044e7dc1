// SPDX-License-Identifier: BSD-3-Clause
// What a surface does to a body that drifts down to rest on it or is blown off it.
#pragma once

#include "Constraints/Rest.h"

#include <functional>
#include <vector>

namespace waft
{

/// The velocity of the air at a place [m] and frame [m/s].
using AirAt = std::function<Vec3(const Vec3& x, int frame)>;

/// Both are finer than any lattice, so they are laws, of the factor f of a body's slip
/// (Base/BodyLaw.h: downwards by f times its settling speed u) at the height h of its centre above
/// where it rests.
///
/// What comes down has to press the air from under it:
///   f = sqrt(2 r - r^2),  r = (h + c) / (b + c) from 0 to 1,  c = b / 50,
/// which is the slowing of a spring that takes the speed over the height b. In still air a body
/// passes b in LandingCushionTime, so that b = 2 / pi LandingCushionTime u. Shortly before its
/// touch-down f comes to that from 1, so that what is low already is not stopped at once.
///
/// What lies is lifted by air that flows over it, as a plate on a plane is: the force goes with the
/// square of the air's speed U a body's length above, as the weight does with that of u,
///   f = 1 - s (1 - 3 r^2 + 2 r^3),  r = h / l from 0 to 1,  s = LiftRatio (U / u)^2 up to
///   MostLift,
/// with the body's length l. The surface bears it at first: s begins with 1, for BearingTime.
/// What has left turns and loses the lift: s goes to 0 over LiftTime.
///
/// What nothing asks for any more is borne by any surface to lie on: there f goes to 0, at the
/// clearance, so that nothing else has to keep it above.
class GroundEffect
{
public:
  GroundEffect() = default; // there is none: the factor is 1
  /// obstacles must outlive it; air may be empty: then nothing is lifted.
  GroundEffect(const ObstacleSet& obstacles, const std::vector<LandingWindow>& landings,
               const MotionObject& body, double framesPerSecond, const AirAt& air);

  /// From this frame on it is borne.
  void BearFrom(double frame) { this->Borne = frame; }

  /// At a place [m] and frame, which may lie between two; gradient, unless null: by x [1/m].
  double Factor(const Vec3& x, double frame, Vec3* gradient = nullptr) const;

  /// What it takes up, beside the air and its slip, of the velocity [m/s] of a moving surface that
  /// it comes to or leaves: along it all at the height 0 (across it the air goes with it).
  /// gradient, unless null: has that by x [1/s] added to it.
  Vec3 Carried(const Vec3& x, double frame, Mat3* gradient = nullptr) const;

  /// Whether it lands there, low enough to be slowed.
  bool Brakes(const Vec3& x, double frame) const;

private:
  struct Near // the last of the way to a touch-down, or the first after a lift-off
  {
    int ObstacleId = -1;
    double First = 0.0, Last = 0.0; // frames
    double Growth = 0.0;            // of the cushion, from First on [frames]
    CarriedPlace Surface;
    std::vector<double> Lift; // s from First on, frame by frame; empty: it lands
  };
  const Near* NearAt(double frame) const;
  /// Over which x rests on the surface; 1e30 where it is too far to feel it.
  double HeightAbove(const Near& near, const Vec3& x, double frame, Vec3& normal) const;
  double Landing(const Near& near, double height, double frame, double& slope) const;
  double Lifting(const Near& near, double height, double frame, double& slope) const;
  double Bearing(const Vec3& x, double frame, Vec3* gradient) const;

  const ObstacleSet* Obstacles = nullptr;
  std::vector<Near> Times; // in order of Last
  double FramesPerSecond = 0.0;
  double RestHeight = 0.0;
  double Height = 0.0;  // b [m]
  double Length = 0.0;  // l [m]
  double Borne = 1e300; // frame
};

} // namespace waft
