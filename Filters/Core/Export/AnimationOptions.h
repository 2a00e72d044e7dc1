// SPDX-License-Identifier: BSD-3-Clause
// The file that an animation is written to.
#pragma once

#include "Base/OptionFields.h"

#include <string>

namespace waft
{

struct AnimationOptions
{
  std::string FileName;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField("FileName",
                    "The file to write, ending in .glb or .csv; nothing is written without one."),
          of.FileName...);
  }
};

} // namespace waft
