// SPDX-License-Identifier: BSD-3-Clause
// The rigid motion that best continues one window of samples with another (Shi et al. 2005, Eq. 1).
#pragma once

#include "Base/OptionFields.h"
#include "Base/Types.h"
#include "Trajectory/MotionDatabase.h"

#include <cmath>
#include <vector>

namespace waft
{

/// Which rotations may carry a segment to its place. Free ones turn many segments upside down.
enum class RotationFreedom
{
  Yaw = 0,        // about the vertical only
  YawAndTilt = 1, // the vertical may lean by at most the tilt limit
  Any = 2         // as printed in the paper
};

/// "Yaw", "YawAndTilt", "Any".
const char* ToString(RotationFreedom freedom);

/// Default tilt limit [rad]: 20 degrees.
constexpr double DefaultMaxTilt = 0.34906585039886591;

/// Which rotations a segment may take, as options of what lays or connects segments.
struct RotationRange
{
  waft::RotationFreedom RotationFreedom = waft::RotationFreedom::YawAndTilt;
  double MaxTilt = DefaultMaxTilt;

  template <class Visitor, class... Holder>
  static void VisitFreedom(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "RotationFreedom",
                       { 0, 2 },
                       "",
                       "How pieces of flight may be turned: Yaw about the vertical, Yaw and "
                       "tilt by up to Max Tilt as well, Any even upside down." },
          of.RotationFreedom...);
  }
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    VisitFreedom(visit, of...);
    visit(OptionField{ "MaxTilt",
                       { 0, M_PI },
                       "rad",
                       "Largest lean of the vertical under YawAndTilt, in radians." },
          of.MaxTilt...);
  }
};

/// The exact minimum of sum_j |tail_j - (R head_j + t)|^2 over translations t and the rotations R
/// allowed (Eq. 1, by Horn's quaternion form; the paper's principal axes only approximate it).
/// tail, head: the same number (at least two) of samples [m]. maxTilt [rad]: the largest angle
/// between R z and z, used by YawAndTilt. A window without bend (the deviation from its line is
/// under 2 % of its length) does not determine the rotation about its line: of all optimal
/// rotations the smallest is taken.
///
/// Cost is the residual rms over the mean chord of the two windows; IsConnectible is true when it
/// is finite: the caller compares Cost with a threshold of its own. Rotation has w >= 0.
Connection AlignWindows(const std::vector<Vec3>& tail, const std::vector<Vec3>& head,
                        RotationFreedom freedom, double maxTilt = DefaultMaxTilt);

/// The largest angle between the vertical and its image [rad].
double TiltOf(const Quat& rotation);

} // namespace waft
