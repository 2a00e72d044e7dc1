// SPDX-License-Identifier: BSD-3-Clause
// What a number may be at all, whoever gives it: a scene, an array of a pipeline, a property. The
// limits keep nonsense out (overflow in single precision, sizes that no machine holds); they bound
// no size of scene that somebody could want.
#pragma once

#include "Base/NumberText.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace waft::limits
{

/// From Low to High, both allowed unless said otherwise.
struct Range
{
  double Low = 0;
  double High = 0;
  bool IsAboveLow = false; ///< Low itself is out.

  /// NaN is in no range.
  constexpr bool Holds(double x) const
  {
    return (this->IsAboveLow ? x > this->Low : x >= this->Low) && x <= this->High;
  }
  /// Whether all of `values`, any container of numbers, are in the range.
  template <class Values>
  bool HoldsAll(const Values& values) const
  {
    return std::all_of(std::begin(values), std::end(values),
                       [this](double x) { return this->Holds(x); });
  }
  /// "a number from LOW to HIGH", as messages say what was expected.
  std::string Text() const
  {
    return std::string("a number from ") + (this->IsAboveLow ? "above " : "") +
           NumberText(this->Low, 10) + " to " + NumberText(this->High, 10);
  }
};

constexpr Range UpTo(double high)
{
  return { 0, high };
}
constexpr Range Above(double low, double high)
{
  return { low, high, true };
}
constexpr Range Around0(double reach)
{
  return { -reach, reach };
}

inline constexpr double Nonsense = 1e6; ///< An end from here on bounds nothing that is wanted.
inline constexpr Range Finite = Around0(std::numeric_limits<double>::max());
inline constexpr double MostInt = std::numeric_limits<int>::max();
inline constexpr Range Coordinate = Around0(1e6);   ///< Of a point [m].
inline constexpr Range Length = { 1e-9, 1e6 };      ///< Of what has an extent [m].
inline constexpr Range Distance = UpTo(1e6);        ///< Of what may have none [m].
inline constexpr Range Velocity = Around0(1e6);     ///< A component of one [m/s].
inline constexpr Range Speed = { 1e-9, 1e6 };       ///< Of what falls at all [m/s].
inline constexpr Range Spin = Around0(1e6);         ///< A component of an angular velocity [rad/s].
inline constexpr Range Acceleration = Around0(1e6); ///< A component of one [m/s^2].
inline constexpr Range VortexStrength = Around0(1e6); ///< [m^2/s^2]
inline constexpr Range Direction = Around0(1e6);      ///< A component of one that is made unit.
inline constexpr Range Density = { 1e-6, 1e6 };       ///< Of air or of a body [kg/m^3].
inline constexpr Range AreaDensity = { 1e-6, 1e6 };   ///< Of a body's surface [kg/m^2].
inline constexpr Range Mass = { 1e-15, 1e9 };         ///< Of a body [kg].
inline constexpr Range Coefficient = { 1e-9, 1e9 };   ///< A factor that is not 0.
inline constexpr Range Factor = UpTo(1e9);            ///< A weight or factor that may be 0.
inline constexpr Range FramesPerSecond = { 1e-3, 1e6 };
inline constexpr Range Frames = { 2, 1e6 };            ///< How many there are.
inline constexpr Range Frame = { 0, 1e6 - 1 };         ///< Which one.
inline constexpr Range Time = Around0(1e9);            ///< [s]
inline constexpr Range Duration = { 1e-9, 1e9 };       ///< [s]
inline constexpr Range Count = { 1, 1e5 };             ///< Of objects or targets asked for at once.
inline constexpr Range Objects = { 0, 1e6 };           ///< Of a scene.
inline constexpr Range Id = { 0, 1e9 };                ///< Of an object or obstacle.
inline constexpr Range Seed = { 0, 9007199254740991 }; ///< 2^53 - 1: exact in any JSON reader.

} // namespace waft::limits
