// SPDX-License-Identifier: BSD-3-Clause
// One body as a problem of drift: its rows, its landings, what it keeps clear of.
#pragma once

#include "Air/Drift/Drift.h"
#include "Air/Drift/Formation.h"
#include "Base/Random.h"
#include "Constraints/Constraint.h"
#include "Constraints/KeptDistances.h"
#include "Constraints/LinearCluster.h"
#include "Constraints/ResolveClearance.h"
#include "Constraints/Rest.h"
#include "Obstacles/ObstacleSet.h"

#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// What all objects drift among.
struct DriftScene
{
  const SceneInfo& Scene;
  const ObstacleSet& Obstacles;
  bool Inertia = false;
  const std::vector<Formation>* Formations = nullptr; // of rows that drift; null: none yet
};

/// Of a path between two of its frames.
Vec3 PlaceAt(const std::vector<Vec3>& path, double frame);

class BodyProblem
{
public:
  /// planned: its path so far; rows: those that bind it.
  BodyProblem(const DriftScene& scene, const MotionObject& object, std::vector<Vec3> planned,
              std::vector<Constraint> rows);

  const MotionObject& Object() const { return this->Body; }
  const std::vector<Constraint>& Rows() const { return this->Wanted; }
  std::size_t NumberOfLandings() const { return this->Landings.size(); }

  /// The frame at which a landing lies there, of its own row's Frame and up to `most` frames
  /// before.
  void SetTouchDown(std::size_t landing, int frame);
  int TouchDown(std::size_t landing) const { return this->Landings[landing].Frame; }
  /// The row's own Frame, and the earliest frame at which it may lie there.
  int LandingFrame(std::size_t landing) const { return this->Latest[landing]; }
  int EarliestTouchDown(std::size_t landing, int most) const;
  /// It has a window of its own, and touches down just at its row's Frame.
  bool IsTimed(std::size_t landing) const { return this->Timed[landing] != 0; }
  /// First of the landing's window: one that has a window of its own comes near as late as it may.
  double NearFrom(std::size_t landing) const;

  /// The frame until which a landing lies there, of its row's own last one and up to `most` frames
  /// after.
  void SetLiftOff(std::size_t landing, int frame);
  int LiftOff(std::size_t landing) const { return this->Landings[landing].Until; }
  /// The row's own last frame, and the latest frame until which it may lie there: the same where it
  /// lies to the end.
  int LeavingFrame(std::size_t landing) const { return this->Leaving[landing]; }
  int LatestLiftOff(std::size_t landing, int most) const;

  /// The frame from which no row asks for anything any more; a lift-off is left alone for a second.
  int FreeFrom() const;
  /// The frame from which it is out of the volume by an open side on a path, by its clearance; -1:
  /// it stays.
  int GoneFrom(const std::vector<Vec3>& path) const;
  /// The row after which it is to go, or null.
  const Constraint* LeavingRow() const;
  /// It lies from a frame to the end on the surface straight below a place, though no row asks it
  /// to.
  void LandFreely(int frame, const Vec3& place);
  /// The same by the row that another one has of it.
  void LandFreely(const Constraint& landing);
  /// That as a row of no scene: Row and Target are -1. Null: it does not.
  const Constraint* FreeLanding() const;

  /// By frame: its own velocity relative to the air [m/s], in place of its sinking straight down.
  void SetSlips(const std::vector<Vec3>& slips);

  int NumberOfFrames() const { return static_cast<int>(this->Planned.size()); }
  /// Steps that it does not lie through, at least one.
  int NumberOfFlownSteps() const;
  /// Where it is held at a frame, or null.
  const Vec3* HeldAt(int frame) const
  {
    const auto f = static_cast<std::size_t>(frame);
    return this->IsFixed[f] ? &this->Fixed[f] : nullptr;
  }
  /// All that holds it to places: those frames, and its balls.
  std::vector<HeldMark> HeldMarks() const;

  /// As the touch-downs and lift-offs are set, in an air. Points into this one.
  DriftProblem In(const AirSampler& air) const;
  /// In a problem of its own, at the nearest place of each ball that a path misses, fixed: a drift
  /// then bends the path there by the air, where MakeExact would by a ramp. False: it misses none.
  bool HoldToBalls(const std::vector<Vec3>& path, DriftProblem& problem) const;

  /// Paths to begin with: the plan, brought to the touch-downs; straight from mark to mark; free
  /// drift from each mark, bent to the next; and some that are perturbed from these.
  std::vector<std::vector<Vec3>> Starts(const AirSampler& air, int perturbed) const;

  /// A path that touches down at a frame, brought to the landing's own, earlier one.
  std::vector<Vec3> Retimed(const std::vector<Vec3>& path, std::size_t landing,
                            int touchDown) const;
  /// A path that lifts off at a frame, brought to the landing's own, later one.
  std::vector<Vec3> Delayed(const std::vector<Vec3>& path, std::size_t landing, int liftOff) const;

  /// Whether the centre goes through an obstacle.
  bool PassesThrough(const std::vector<Vec3>& path) const;
  /// Meets fixed frames, balls, velocities and accelerations to the last bit and keeps clear. False
  /// where it is nearer to something than it may.
  bool MakeExact(std::vector<Vec3>& path) const;
  /// Whether nothing has to be moved for that.
  bool IsClear(std::vector<Vec3> path) const;

private:
  struct Stay
  {
    int First = 0, Last = 0; // frames
    CarriedPlace Place;
  };
  std::vector<int> Marks() const;                         // fixed frames
  std::vector<Vec3> TakenUp(const AirSampler& air) const; // slips, by step, of who is let go
  Constraint& RestOf(const LandingWindow& landing);
  /// The plan, brought to the touch-downs as they are set.
  std::vector<Vec3> RetimedPlan() const;
  std::vector<Vec3> Perturbed(std::vector<Vec3> path, const std::vector<int>& marks,
                              Random& random) const;
  void FixFrames();
  bool IsLetGoAt(int frame) const;
  void AddRows();
  void AddDifference(const Constraint& row);
  void AddFormation(const Constraint& row);
  void AddLeaving(const Constraint& row);
  Clearance AskedAt(int frame) const;
  void CloseBarrierGaps(std::vector<Vec3>& path) const;
  void MeetRows(std::vector<Vec3>& path) const;
  void TooNear(int frame, const Vec3& x, std::vector<DriftDepth>& depths) const;

  PathClearance Around() const;

  const DriftScene& World;
  MotionObject Body;
  std::vector<Vec3> Planned;
  std::vector<Constraint> Wanted;
  std::vector<LandingWindow> Landings;
  std::vector<LandingWindow> Hanging; // that in which it hangs at an obstacle, or none
  std::vector<LandingWindow> Exempts; // it, then the Landings
  std::vector<Vec3> Slips;            // by step [m/s], or empty
  std::vector<int> Latest;            // touch-downs, as the rows have them
  std::vector<int> Leaving;           // lift-offs likewise
  std::vector<char> Timed;
  std::vector<unsigned char> IsFixed;
  std::vector<Vec3> Fixed;
  std::vector<std::pair<int, Vec3>> Passed; // frames and places of exact positions
  std::vector<Stay> Stays;                  // where it hangs or is held, in no order
  FlightRoom Space;                         // where it may be
  int AtPlace = -1;                         // frame at which it is where it goes to, to be gone
  std::vector<DriftRow> DriftRows;
  std::vector<PositionBall> Balls;
  std::vector<DifferenceRow> Differences;
};

} // namespace waft
