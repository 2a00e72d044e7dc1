// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Types.h"

namespace waft
{

/// How an object goes out of the shot.
struct Leaving
{
  int From = -1;            // frame from which it goes; -1: it does not
  Vec3 Away = Vec3::Zero(); // unit, the way out of the volume; zero: it goes where it is
  int Fade = 0;             // frames in which it fades there

  bool operator==(const Leaving& other) const
  {
    return this->From == other.From && this->Away == other.Away && this->Fade == other.Fade;
  }
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.From...);
    visit(of.Away...);
    visit(of.Fade...);
  }
};

} // namespace waft
