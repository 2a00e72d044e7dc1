// SPDX-License-Identifier: BSD-3-Clause
// Frames of a time level, divided among ranks: a rank owns a range of them and holds those
// beside it too.
#pragma once

#include "Base/Communicator.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace waft
{

struct FrameRange
{
  std::size_t Begin = 0, End = 0;

  std::size_t Size() const { return this->End - this->Begin; }
  bool Contains(std::size_t j) const { return j >= this->Begin && j < this->End; }
};

/// Vectors of a partition have one block for each frame that is held, in order. What is said of all
/// ranks (Gather, FillHalo and whatever calls them) all must call.
class FramePartition
{
public:
  /// All frames, of the only rank.
  FramePartition(std::size_t frames);
  /// halo: frames held to either side of the own ones. More ranks than frames leave some without.
  /// The communicator must outlive the partition.
  FramePartition(std::size_t frames, std::size_t halo, Communicator& ranks);
  /// The same frames owned, all held.
  FramePartition HoldingAll() const;

  bool IsAlone() const { return this->Ranks == nullptr; }
  /// Of all ranks; not to be asked for where IsAlone.
  Communicator& Others() const { return *this->Ranks; }
  bool IsFirst() const { return this->IsAlone() || this->Ranks->IsFirst(); }
  std::size_t Frames() const { return this->Count; }
  const FrameRange& Own() const { return this->Owned; }
  const FrameRange& Held() const { return this->Kept; }
  /// Index of a frame's block in a vector.
  std::size_t Slot(std::size_t j) const { return j - this->Kept.Begin; }
  FrameRange OwnOf(int rank) const;
  FrameRange HeldOf(int rank) const;
  int OwnerOf(std::size_t j) const;
  /// Frames of the rank that has most.
  std::size_t MostOwned() const;

  /// A part of the block of each frame, in bytes.
  struct Part
  {
    void* Data = nullptr;       // block of the frame FirstFrame
    std::size_t FirstFrame = 0; //
    std::size_t BlockSize = 0, Offset = 0, Size = 0;
  };
  using RangeOf = std::function<FrameRange(int rank)>;
  /// Blocks of frames that one rank has and another wants go there. No frame is had by two.
  void Move(const Part& part, const RangeOf& has, const RangeOf& wants) const;
  /// all: `each` values a frame of all frames, those of the own ones as they should be.
  template <class T>
  void Gather(std::vector<T>& all, std::size_t each = 1) const
  {
    const std::size_t size = each * sizeof(T);
    this->Move(
      { all.data(), 0, size, 0, size }, [this](int r) { return this->OwnOf(r); },
      [this](int) {
        return FrameRange{ 0, this->Count };
      });
  }
  /// The frames held beside the own ones, as their owners have them. blockSize: floats.
  void FillHalo(std::vector<float>& held, std::size_t blockSize) const;
  /// The held frames out of all of them; all frames out of what the ranks hold.
  std::vector<float> Take(std::vector<float> all, std::size_t blockSize) const;
  std::vector<float> Whole(std::vector<float> held, std::size_t blockSize) const;
  /// Three values of each of some frames (as often as named), from the frames' owners to all.
  void GatherPoints(const std::vector<std::size_t>& frames, std::vector<float>& points) const;
  /// What a frame's owner has, to rank 0; nothing on the others.
  void BringToFirst(std::size_t j, Communicator::Bytes& bytes) const;
  /// Moves a vector as a list of the blocks of all frames, the same for any number of ranks.
  void Serialise(StateArchive& stream, std::vector<float>& held, std::size_t blockSize) const;

private:
  Communicator* Ranks = nullptr;
  std::size_t Count = 0, Halo = 0;
  FrameRange Owned, Kept;
};

} // namespace waft
