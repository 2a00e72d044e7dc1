// SPDX-License-Identifier: BSD-3-Clause
// Which paths come near to a path in some frames, without a look at each of their frames.
#pragma once

#include "Base/Motion.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace waft
{

/// The boxes of paths over blocks of frames, block by block.
class PathBoxes
{
public:
  explicit PathBoxes(const std::vector<Track>& tracks) :
    Tracks(tracks), Blocks(tracks.empty() ? 0 : tracks[0].Positions.size() / BlockFrames + 1)
  {
    this->Boxes.resize(this->Blocks * tracks.size());
    for (std::size_t i = 0; i < tracks.size(); ++i)
    {
      this->Take(i);
    }
  }

  /// Looks at a path anew.
  void Take(std::size_t track)
  {
    const std::vector<Vec3>& path = this->Tracks[track].Positions;
    for (std::size_t block = 0; block < this->Blocks; ++block)
    {
      Box box = Box::Nothing();
      const std::size_t end = std::min((block + 1) * BlockFrames, path.size());
      for (std::size_t f = block * BlockFrames; f < end; ++f)
      {
        box.Add(path[f]);
      }
      this->Boxes[block * this->Tracks.size() + track] = box;
    }
  }

  /// Adds to near, in the order of tracks, all that come nearer than reach [m] to a track at some
  /// frame from first to last, and some that do not.
  void AddNear(std::size_t track, int first, int last, double reach,
               std::vector<std::size_t>& near) const
  {
    std::vector<Box> own;
    for (std::size_t block = BlockOf(first); block <= BlockOf(last); ++block)
    {
      own.push_back(this->At(block, track));
    }
    for (std::size_t other = 0; other < this->Tracks.size(); ++other)
    {
      bool isNear = false;
      for (std::size_t k = 0; k < own.size() && other != track; ++k)
      {
        isNear = isNear || AreNear(own[k], this->At(BlockOf(first) + k, other), reach);
      }
      if (isNear)
      {
        near.push_back(other);
      }
    }
  }

  /// Whether two may be nearer than reach at some frame from first to last.
  bool MayMeet(std::size_t a, std::size_t b, int first, int last, double reach) const
  {
    for (std::size_t block = BlockOf(first); block <= BlockOf(last); ++block)
    {
      if (AreNear(this->At(block, a), this->At(block, b), reach))
      {
        return true;
      }
    }
    return false;
  }

private:
  static constexpr std::size_t BlockFrames = 16;

  static std::size_t BlockOf(int frame) { return static_cast<std::size_t>(frame) / BlockFrames; }
  const Box& At(std::size_t block, std::size_t track) const
  {
    return this->Boxes[block * this->Tracks.size() + track];
  }
  static bool AreNear(const Box& a, const Box& b, double reach)
  {
    return (a.Min.array() <= b.Max.array() + reach).all() &&
           (b.Min.array() <= a.Max.array() + reach).all();
  }

  const std::vector<Track>& Tracks;
  std::size_t Blocks;
  std::vector<Box> Boxes; // block by block
};

} // namespace waft
