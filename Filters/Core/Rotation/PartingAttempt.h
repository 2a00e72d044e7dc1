// SPDX-License-Identifier: BSD-3-Clause
// What of a ladder of turns and shifts parts two bodies that are in each other best.
#pragma once

#include "Constraints/RowsOfObjects.h"
#include "Rotation/MeshCuts.h"
#include "Rotation/PartingFreedom.h"
#include "Rotation/PartingLadder.h"
#include "Rotation/PathBoxes.h"
#include "Rotation/RotationRefine.h"

#include <array>
#include <vector>

namespace waft
{

/// That pairs are parted to, in lengths of the shorter body.
inline constexpr double PartedDepth = 0.5 * TouchedDepth;

/// Two bodies over the frames at which they are in each other, with few frames between.
struct Meeting
{
  std::size_t A = 0, B = 0;
  int First = 0, Last = 0;
};

/// A motion that bodies are parted in, and what binds it. Refers to what it is made of.
struct PartedScene
{
  const RotationInput& Input;
  const RowsOfObjects& Places; // of the input's constraints
  double Most;                 // rad from a frame to the next, that turns keep to
  double Ease;                 // frames, in which a change comes and goes
  double Widest;               // m, the largest radius of a mesh
  const PosedMotion& Motion;
  const PathBoxes& Boxes;                      // of the motion
  const std::vector<PartingFreedom>& Freedoms; // by track; of those that meet
};

/// One meeting in a motion that nobody changes while the search lasts.
class PartingAttempt
{
public:
  PartingAttempt(const PartedScene& scene, const Meeting& meeting);

  /// Tries turns, then shifts with the best of them, the least first; whether one of them leaves
  /// fewer frames and pairs deep in each other. Not where the monitor, asked from this thread,
  /// wants to stop.
  bool Search(Monitor& monitor);

  const Meeting& Of() const { return this->Now; }
  /// What helps most.
  const PartingChange& Best() const { return this->Found; }
  /// The frames that the change reaches.
  std::vector<std::size_t> Frames() const;
  /// A body of the meeting at one of these as the best change has it.
  PosedMesh Changed(bool isA, std::size_t k) const;

private:
  struct Moment
  {
    int Frame;
    double Height; // of the change, 0..1
  };

  /// Another body that one of the meeting is near to while it may be changed.
  struct Neighbour
  {
    std::size_t Moment, Track;
  };

  enum class Depth : unsigned char
  {
    Unknown,
    Shallow,
    Deep
  };

  /// Of a change of a body.
  struct NeighboursMet
  {
    Vec3 Turn, Shift;
    std::vector<Depth> Depths; // by neighbour
  };

  /// One of the meeting.
  struct Changing
  {
    std::size_t Track;
    std::vector<Neighbour> Near;
    std::vector<std::size_t> Order;   // of these: first those that were deep of late
    std::array<NeighboursMet, 2> Met; // as it is, as changed last
    std::vector<PosedMesh> Posed;     // by moment, as the change that is counted has it
  };

  double FreedomAt(std::size_t track, int frame) const;
  void LookAround();
  bool AreNear(std::size_t a, std::size_t b, int frame, double more) const;
  PosedMesh Changed(std::size_t track, const Vec3& turn, const Vec3& shift,
                    const Moment& moment) const;
  bool IsKept(std::size_t track, const PosedMesh& posed, const Moment& moment) const;
  bool IsCalm(std::size_t track, const Vec3& turn) const;
  bool IsDeep(std::size_t a, const PosedMesh& one, std::size_t b, const PosedMesh& other);
  int CountNeighbours(Changing& body, const Vec3& turn, const Vec3& shift, int enough);
  int Count(const PartingChange& change, int enough);

  const PartedScene& Scene;
  Meeting Now;
  std::vector<Moment> Moments; // those of its height first
  PartingChange Found;
  Changing A, B;
  MeshPair Pair;
};

} // namespace waft
