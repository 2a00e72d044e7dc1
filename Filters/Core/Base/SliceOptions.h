// SPDX-License-Identifier: BSD-3-Clause
// How much of its work a stage does at once.
#pragma once

#include "Base/OptionFields.h"

namespace waft
{

struct SliceOptions
{
  double Slice = 0.0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Slice",
                       { 0, 1e+09 },
                       "s",
                       "Seconds of work after which an update shows the motion so far, to go on "
                       "from there when it is asked to; 0: all at once. The motion comes to the "
                       "same bits." },
          of.Slice...);
  }
};

} // namespace waft
