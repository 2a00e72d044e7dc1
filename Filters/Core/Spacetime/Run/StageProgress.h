// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Monitor.h"

#include <algorithm>

namespace waft
{

/// Progress of one stage as a part of the whole.
class StageProgress : public Monitor
{
public:
  StageProgress(Monitor& outer, double from, double to, int steps) :
    Outer(outer), From(std::min(1.0, from)), To(std::min(1.0, to)), Steps(std::max(1, steps))
  {
  }
  bool Tick(double fraction, const std::string&) override
  {
    const double done = std::min(1.0, (this->Done + fraction) / this->Steps);
    this->Going =
      this->Outer.Tick(this->From + (this->To - this->From) * done, this->Text) && this->Going;
    return this->Going;
  }
  int Done = 0;
  std::string Text;
  bool Going = true;

private:
  Monitor& Outer;
  double From, To;
  int Steps;
};

} // namespace waft
