// SPDX-License-Identifier: BSD-3-Clause
// What is wanted of objects, a row each, and what is reported about it. All that sets one kind of
// constraint apart from another is in one table, TraitsOf(kind), and in the switches over the kind,
// which name every kind: the compiler says where a new one has to be decided about.
#pragma once

#include "Base/Leaving.h"
#include "Base/Types.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace waft
{

/// Values of the array `Kind`.
enum class ConstraintKind : unsigned char
{
  Position = 0,
  Velocity = 1,
  Acceleration = 2,
  Orientation = 3,
  Rest = 4
};
inline constexpr int NumberOfConstraintKinds = 5;

struct ConstraintTraits
{
  ConstraintKind Kind;
  const char* Name; // in files and messages
  const char* Unit; // of Value and Radius
  /// Value is a position that the path passes through. Any object (-1) may be asked for positions
  /// alone.
  bool IsPositional;
  /// From Frame to Until, and exact whatever the Radius; else at Frame alone.
  bool Lasts;
  /// Which derivative of the path by time is wanted: 0, 1 or 2; -1: none, but the attitude.
  int Derivative;
  /// By how much a row may be missed beyond its Radius and count as met: of the volume's width for
  /// derivative 0, of the top speed for 1, of the top speed times frames per second for 2, else in
  /// its Unit.
  double Tolerance;
};

const ConstraintTraits& TraitsOf(ConstraintKind kind);

/// The kind of this name among `TraitsOf`, or null.
const ConstraintTraits* FindConstraintKind(const std::string& name);

inline const char* ToString(ConstraintKind kind)
{
  return TraitsOf(kind).Name;
}
inline bool IsPositional(ConstraintKind kind)
{
  return TraitsOf(kind).IsPositional;
}
/// The object lies still from Frame to Until, and lands before that. Another kind that lasts need
/// not.
inline bool IsRest(ConstraintKind kind)
{
  return kind == ConstraintKind::Rest;
}
/// Its value is a position that is passed, at Frame alone.
inline bool IsPassing(ConstraintKind kind)
{
  return IsPositional(kind) && !TraitsOf(kind).Lasts;
}
/// Its value is an orientation, in Constraint::Orientation.
inline bool IsAttitude(ConstraintKind kind)
{
  return TraitsOf(kind).Derivative < 0;
}

/// Weights, by frame, of the positions in a derivative of the path at a frame [1/s^derivative]:
/// CentralDifferences applied no times, once or twice. Empty where the time line is too short.
/// first: where the path begins.
std::map<int, double> DerivativeStencil(int derivative, int frame, const Timeline& time,
                                        int first = 0);

/// What ConstraintTraits::Tolerance is relative to.
struct MotionScales
{
  double Width = 1.0;           // of the volume [m]
  double TopSpeed = 1.0;        // of all tracks [m/s]
  double FramesPerSecond = 1.0; // 1/s
};
/// In the kind's unit.
double ToleranceOf(ConstraintKind kind, const MotionScales& scales);

enum class ConstraintStatus
{
  Met,
  Infeasible, // by itself: inside an obstacle or outside the volume
  Conflict,   // with another row, named
  Unreachable // no path found in the limits; the path comes as near as it could
};

/// "met", "infeasible", "conflict", "unreachable".
const char* ToString(ConstraintStatus status);

/// Row and Target of what binds an object though no row of the scene asks for it; no report has a
/// line of it.
inline constexpr int OfNoRow = -1;

/// Which side of a body that lies still looks up: that of its z axis, or the other.
enum class FaceUp : unsigned char
{
  Any, // as it comes down
  Up,
  Down
};

/// "any", "up", "down".
const char* ToString(FaceUp side);
/// The side of this name, or null.
const FaceUp* FindFaceUp(const std::string& name);

/// How a row came by its object. Those that were chosen may get another one, by the flow.
enum class ObjectChoice : unsigned char
{
  Given,      // by who asks
  AmongAll,   // by the shortest legs, among all objects that may
  AmongListed // among those of a list, which its group's rows have all together
};

/// What is wanted of one object at one frame.
struct Constraint
{
  int ObjectId = -1; // -1: any object, assigned by the planner
  int Frame = 0;
  ConstraintKind Kind = ConstraintKind::Position;
  Vec3 Value = Vec3::Zero();           // m, m/s or m/s^2; for rest the point above the surface
  Quat Orientation = Quat::Identity(); // of an orientation row
  double Radius = 0.0;                 // same unit as Value (orientation: rad); 0: exact
  int Release = -1;                    // of its object; -1: it flies from the first frame
  int Leave = -1;                      // of its object: gone from this frame on; -1: it stays
  int Until = 0;                       // rest or hold lasts from Frame to this frame
  /// Of a position: frames for which it stays there once all of its Row have come (SetHolds).
  int Hold = 0;
  int Drifts = 0;          // 1: what is held goes along with its form as that drifts
  double HoldRadius = 0.0; // m, in which it is then of its place in the form; 0: its length
  Leaving Goes;            // of a position or rest: how its object goes after it
  int On = -1;             // the obstacle with which a position or rest goes along; -1: none
  int FrameFrom = -1;      // where a window was asked for, its first frame
  /// It is met at one of the frames from FrameFrom to Frame, of which the air has chosen none yet.
  bool IsOpenWindow = false;
  int TouchDown = -1;        // of a rest: comes to its surface at this frame; -1: at Frame
  int Settled = -1;          // of a rest: still from this frame on; -1: from TouchDown on
  int LiftOff = -1;          // of a rest: lies there until this frame; -1: until Until
  int Row = 0;               // index in the scene's list
  int Target = 0;            // index in that row's list of targets
  int Group = -1;            // rows of one group go to distinct objects
  int ClassId = -1;          // -1: any
  FaceUp Side = FaceUp::Any; // of a rest
  /// Of a position: the body's z axis is within FacingTolerance of it at Frame; zero: none is
  /// asked.
  Vec3 Facing = Vec3::Zero();
  double FacingTolerance = 0.35; // rad
  ObjectChoice Choice = ObjectChoice::Given;
  ConstraintStatus Status =
    ConstraintStatus::Met; // what an earlier stage found: only met rows bind

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObjectId...);
    visit(of.Frame...);
    visit(of.Kind...);
    visit(of.Value...);
    visit(of.Orientation...);
    visit(of.Radius...);
    visit(of.Release...);
    visit(of.Leave...);
    visit(of.Until...);
    visit(of.Hold...);
    visit(of.Drifts...);
    visit(of.HoldRadius...);
    visit(of.Goes...);
    visit(of.On...);
    visit(of.FrameFrom...);
    visit(of.IsOpenWindow...);
    visit(of.TouchDown...);
    visit(of.Settled...);
    visit(of.LiftOff...);
    visit(of.Row...);
    visit(of.Target...);
    visit(of.Group...);
    visit(of.ClassId...);
    visit(of.Side...);
    visit(of.Facing...);
    visit(of.FacingTolerance...);
    visit(of.Choice...);
    visit(of.Status...);
  }
};

/// It is there for a while, rather than at one frame.
inline bool IsLasting(const Constraint& row)
{
  return TraitsOf(row.Kind).Lasts || row.Hold > 0;
}

/// The frame until which a row holds, or a rest goes on.
inline int LastFrame(const Constraint& row)
{
  return IsLasting(row) ? std::max({ row.Frame, row.Until, row.LiftOff }) : row.Frame;
}

/// How far from what it asks for a row counts as met, in the unit of Value.
inline double RadiusOf(const Constraint& row)
{
  return TraitsOf(row.Kind).Lasts ? 0.0 : row.Radius;
}

/// The frame at which the object is there; -1: not chosen yet.
inline int ArrivalOf(const Constraint& row)
{
  return row.IsOpenWindow ? -1 : row.Frame;
}

/// It is met at this frame of its window; place: its Value there.
inline void SetArrival(int frame, const Vec3& place, Constraint& row)
{
  row.Value = place;
  row.Frame = frame;
  row.IsOpenWindow = false;
  row.Until = IsLasting(row) ? row.Until : frame;
}

/// What tells the rows of one entry from others: those of a keyframe have a Group, others their
/// Row.
inline std::pair<bool, int> EntryOf(const Constraint& row)
{
  return { row.Group >= 0, row.Group >= 0 ? row.Group : row.Row };
}

/// The Until of all that stay for a while: from the frame at which the last of their Row comes, or
/// may come, at most to the last frame; of who leaves, the frame at which it goes. Of those whose
/// form drifts, the frame from which it does.
void SetHolds(int lastFrame, std::vector<Constraint>& rows);
/// The last frame at which the form of a row that Drifts holds it.
inline int FormEnd(const Constraint& row, int lastFrame)
{
  const int begin = std::max(row.Frame, row.Until);
  return row.Goes.From >= 0 ? std::max(begin, row.Goes.From)
                            : std::min(begin + row.Hold, lastFrame);
}

/// The earliest frame at which a row may be met.
inline int EarliestFrame(const Constraint& row)
{
  return row.IsOpenWindow ? row.FrameFrom : row.Frame;
}

/// The frame from which a row holds or, as a rest may, is met already.
inline int FirstFrame(const Constraint& row)
{
  const int still = row.Settled >= 0 ? row.Settled : row.TouchDown;
  return still >= 0 ? std::min(still, row.Frame) : row.Frame;
}

/// One line of the Report, one per (Row, Target).
struct ReportRow
{
  int Row = 0;
  int Target = 0;
  int ObjectId = -1;
  int Frame = 0;
  ConstraintKind Kind = ConstraintKind::Position;
  double Residual = 0.0; // distance beyond Radius, in the unit of Value
  ConstraintStatus Status = ConstraintStatus::Met;
  std::string Message;
  int TouchDown = -1; // as those of the Constraint, in lines of a stage that knows them
  int Settled = -1;
  int Arrival = -1; // of the row by which it is judged (ArrivalOf)
  int Release = -1; // of its object
  int Leave = -1;   // likewise

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Row...);
    visit(of.Target...);
    visit(of.ObjectId...);
    visit(of.Frame...);
    visit(of.Kind...);
    visit(of.Residual...);
    visit(of.Status...);
    visit(of.Message...);
    visit(of.TouchDown...);
    visit(of.Settled...);
    visit(of.Arrival...);
    visit(of.Release...);
    visit(of.Leave...);
  }
};

} // namespace waft
