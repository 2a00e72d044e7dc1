// SPDX-License-Identifier: BSD-3-Clause
// Chains of pieces of the shared database, flown freely.
#pragma once

#include "Planning/Blending.h"
#include "Planning/FreeFlight.h"
#include "SwirlDatabase.h"

#include <stdexcept>

namespace waft
{
namespace test
{

inline const SegmentLibrary& Library()
{
  static const SegmentLibrary library = []
  {
    SegmentLibrary built;
    if (!built.Build(SwirlDatabase(), SegmentLibraryOptions(), SerialFor()))
    {
      throw std::runtime_error("the database of the tests is none");
    }
    return built;
  }();
  return library;
}

inline SpanTask FreeTask(int frames)
{
  SpanTask task;
  task.Start.Position = Vec3(0.2, -0.3, 2.1);
  task.Frames = frames;
  return task;
}

inline PieceChain RandomChain(std::uint64_t seed, int frames = 240)
{
  static const ObstacleSet obstacles;
  ClearanceField field;
  field.Obstacles = &obstacles;
  PieceChain chain;
  chain.Pieces = FlyFree(Library(), field, FreeTask(frames), 0.01, 2000, Random(seed));
  chain.JoinIndex = static_cast<int>(chain.Pieces.size());
  return chain;
}

} // namespace test
} // namespace waft
