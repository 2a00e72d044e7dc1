// SPDX-License-Identifier: BSD-3-Clause
// What a local edit may move.
#pragma once

#include <cstddef>
#include <vector>

namespace waft
{

/// Frames and bodies about the objects that changed.
struct EditRegion
{
  int First = 0, Last = -1;  // frames
  std::vector<char> Movable; // by body

  bool IsEmpty() const { return this->Last < this->First; }
  bool Moves(int frame, std::size_t body) const
  {
    return frame >= this->First && frame <= this->Last && this->Movable[body];
  }
};

} // namespace waft
