// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Types.h"

namespace waft
{

/// By what side an object may go out, seen from the front, -y: its axis and sign.
struct SideOut
{
  const char* Name;
  int Axis;
  double Sign;

  Vec3 Direction() const { return this->Sign * Vec3::Unit(this->Axis); }
};
inline constexpr SideOut SidesOut[] = { { "left", 0, -1.0 },
                                        { "right", 0, 1.0 },
                                        { "front", 1, -1.0 },
                                        { "back", 1, 1.0 },
                                        { "top", 2, 1.0 } };

/// How an object goes out of the shot.
struct Leaving
{
  int From = -1;            // frame from which it goes; -1: it does not
  Vec3 Away = Vec3::Zero(); // unit, the way out of the volume; zero: it goes where it is
  int Fade = 0;             // frames in which it fades there
  int HasPlace = 0;         // 1: it goes to a place, where it is gone
  Vec3 Place = Vec3::Zero();

  bool IsUnderway() const { return this->HasPlace != 0 || !this->Away.isZero(); }
  bool operator==(const Leaving& other) const
  {
    return this->From == other.From && this->Away == other.Away && this->Fade == other.Fade &&
           this->HasPlace == other.HasPlace && this->Place == other.Place;
  }
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.From...);
    visit(of.Away...);
    visit(of.Fade...);
    visit(of.HasPlace...);
    visit(of.Place...);
  }
};

} // namespace waft
