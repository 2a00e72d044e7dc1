// SPDX-License-Identifier: BSD-3-Clause
// Parts of the air that no open face lets out, where the pressure is free by a constant. A cell
// that a solid shuts in is such a part by itself.
#pragma once

#include "Grid/MultigridKernels.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace waft
{

class ClosedAir
{
public:
  /// No air.
  ClosedAir() = default;
  /// weights[axis]: in the padded layout of `cells`, of the face towards the axis's lower end of
  /// each cell, 0 where no air passes. A weight above 0 at the end of an axis that is not periodic
  /// is an open face.
  ClosedAir(const PaddedCells& cells, const std::array<const float*, 3>& weights,
            const std::array<bool, 3>& periodic);

  /// Takes the mean of each closed part from its cells, so that a pressure can answer b [padded
  /// layout]: 0 in a cell that is shut in, whatever a moving solid does there.
  void MakeCompatible(std::vector<float>& b) const;

private:
  std::vector<std::int32_t> Part; // of each padded cell; -1: none
  std::vector<std::size_t> Sizes; // cells of each part
};

} // namespace waft
