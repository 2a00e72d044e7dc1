// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Attitude.h"

#include "Base/BodyLaw.h"
#include "Base/NumberText.h"
#include "Base/SmoothStep.h"
#include "Rotation/FlightStart.h"
#include "Rotation/FloorContact.h"
#include "Rotation/KeepAbove.h"
#include "Rotation/Landing.h"
#include "Rotation/PoseRates.h"
#include "Rotation/RigidBody.h"

#include <cmath>
#include <optional>

namespace waft
{
namespace
{
constexpr double SamePose = 0.02;                   // rad, from where on flown poses go on
constexpr double FacingTime = 0.4;                  // s before its frame that a cone acts
constexpr std::uint64_t OfStarts = 0x57a2700000000; // streams of Random, one an object

std::string Short(double x)
{
  return NumberText(x, 3);
}

class AttitudeMotion
{
public:
  AttitudeMotion(const AttitudePlan& plan, const FlightBody& body, const FlightPath& path) :
    Plan(plan), Body(body), Path(path), Last(static_cast<int>(plan.Path->EndPresent()) - 1),
    Marks(plan.Path->Positions.size())
  {
    this->Out.Poses.ObjectId = plan.Object->ObjectId;
    for (const int frame : plan.Held)
    {
      this->Marks.Held[frame] = 1;
    }
    this->Out.Poses.Orientations.assign(this->Marks.Frames.size(), Quat::Identity());
    this->Out.Poses.AngularVelocities.assign(this->Marks.Frames.size(), Vec3::Zero());
    this->Out.Poses.Torques.assign(this->Marks.Frames.size(), Vec3::Zero());
    if (plan.Glides)
    {
      const Vec3 sinking = LawOf(*plan.Object).Velocity(Vec3::Zero());
      this->Out.Poses.Slips.assign(this->Marks.Frames.size(), sinking);
    }
    this->Out.Slowed.assign(this->Marks.Frames.size(), 0);
    this->Out.Swept.assign(this->Marks.Frames.size(), 0.0);
  }

  AttitudeOutcome Run()
  {
    this->Start();
    int frame = this->State.Frame;
    while (frame < this->Last)
    {
      frame = this->FlyToNextEvent(frame);
    }
    this->KeepPose(this->Last, this->Last + 1,
                   static_cast<int>(this->Marks.Frames.size())); // as seen last
    KeepAbove(this->Plan, this->Marks, this->Out);
    SetRatesWhereTurned(this->Marks.Changed, this->Plan.Time.Step(), this->Out.Poses);
    JoinSigns(this->Out.Poses.Orientations);
    return std::move(this->Out);
  }

private:
  struct Now
  {
    FlightState Flight;
    int Frame = 0;
  };

  /// Seconds of its turning in a second.
  double Pace() const { return this->Path.Step / this->Plan.Time.Step(); }

  const Constraint* KeyAt(int first, int last) const
  {
    for (const Constraint& key : this->Plan.Keys)
    {
      if (key.Frame >= first && key.Frame <= last)
      {
        return &key;
      }
    }
    return nullptr;
  }

  const PlannedRest* RestAfter(int frame) const
  {
    for (const PlannedRest& rest : this->Plan.Rests)
    {
      if (rest.Frame > frame)
      {
        return &rest;
      }
    }
    return nullptr;
  }

  /// The pose that the object begins with, made unit.
  Quat GivenStart()
  {
    Quat q = this->Plan.Object->Orientation;
    const double norm = q.norm();
    const std::string name = "object " + std::to_string(this->Plan.Object->ObjectId);
    if (!(norm > 1e-12) || !std::isfinite(norm))
    {
      this->Out.Warnings.push_back(name + ": its Orientation is no quaternion; it starts level");
      q = Quat::Identity();
    }
    else
    {
      if (std::abs(norm - 1.0) > 1e-6)
      {
        this->Out.Warnings.push_back(name + ": its Orientation had length " + Short(norm) +
                                     " and was made unit");
      }
      q.coeffs() /= norm;
    }
    return q;
  }

  void Start()
  {
    const MotionObject& object = *this->Plan.Object;
    const int first = std::min(object.FirstPresent(), this->Last);
    FlightState& state = this->State.Flight;
    if (object.OrientationGiven != 0 || this->HasFlown())
    {
      state.Orientation = this->GivenStart();
      state.SetVelocity(this->Body, this->Path.RelativeVelocities[first]);
    }
    else
    {
      const auto stream = OfStarts + static_cast<std::uint64_t>(object.ObjectId);
      Random random(this->Plan.Seed, stream);
      if (object.Hangs())
      {
        state.Orientation = HangingPose(random);
        state.SetVelocity(this->Body, this->Path.RelativeVelocities[0]);
      }
      else
      {
        state = StateInFlight(this->Body, this->Path, first, random);
      }
    }
    if (const Constraint* key = this->KeyAt(0, 0))
    {
      this->TurnState(this->Towards(state.Orientation, *key) * state.Orientation.conjugate());
      this->Marks.Frames[0].Freedom = PoseFreedom::Fixed;
    }
    if (!object.Hangs() && (object.OrientationGiven != 0 || !object.AngularVelocity.isZero()))
    {
      state.SetAngularVelocity(this->Body, object.AngularVelocity / this->Pace());
    }
    if (!this->Path.FastestTurning.empty())
    {
      this->Out.Slowed[first] =
        LimitTurning(this->Body, this->Path.FastestTurning[first], this->State.Flight);
    }
    if (this->HasFlown())
    {
      this->TakeFlown(first);
    }
    else
    {
      this->Record(first);
    }
    if (object.Hangs())
    {
      this->Hang(std::min(object.Release, this->Last));
    }
    else
    {
      this->State.Frame = first;
      this->KeepPose(first, 0, first); // before it is in the shot, as it begins
    }
    if (!this->Plan.Rests.empty() && this->Plan.Rests.front().Frame <= 0)
    {
      const PlannedRest& rest = this->Plan.Rests.front();
      this->Out.Rests.push_back({ rest.Row, rest.Target, 0, 0 });
      this->LieStill(rest, 0, this->LandingOn(rest).Lay(this->State.Flight.Orientation));
    }
  }

  /// The pose of one frame at others at which it is not in the shot.
  void KeepPose(int frame, int begin, int end)
  {
    for (int k = begin; k < end; ++k)
    {
      this->Marks.Frames[static_cast<std::size_t>(k)].Freedom = PoseFreedom::Fixed;
      this->Out.Poses.Orientations[k] = this->Out.Poses.Orientations[frame];
      if (!this->Out.Poses.Slips.empty())
      {
        this->Out.Poses.Slips[k] = this->Out.Poses.Slips[frame];
      }
    }
  }

  /// Still until it is released; then it turns as it is given to, and its own velocity in the air
  /// is what keeps it where it was.
  void Hang(int release)
  {
    const MotionObject& object = *this->Plan.Object;
    FlightState& state = this->State.Flight;
    for (int k = 0; k <= release; ++k)
    {
      this->State.Frame = k;
      this->Marks.Frames[static_cast<std::size_t>(k)].Freedom = PoseFreedom::Fixed;
      if (this->HasFlown())
      {
        this->TakeFlown(k);
        continue;
      }
      // Differences of the path at the release are half of its first step.
      const auto still = static_cast<std::size_t>(std::min(k, release - 1));
      state.SetVelocity(this->Body, this->Path.RelativeVelocities[still]);
      state.SetAngularVelocity(this->Body, k == release
                                             ? Vec3(object.AngularVelocity / this->Pace())
                                             : Vec3(Vec3::Zero()));
      this->Record(k);
    }
  }

  /// Where a row holds it, its own velocity in the air is what keeps it there; it turns on.
  void HoldStill(int frame)
  {
    for (const Constraint& stay : this->Plan.Stays)
    {
      if (frame > stay.Frame && frame <= LastFrame(stay))
      {
        // At the last frame differences of the path have half of the next step.
        const int still = std::min(frame, std::max(stay.Frame + 1, LastFrame(stay) - 1));
        this->State.Flight.SetVelocity(
          this->Body, this->Path.RelativeVelocities[static_cast<std::size_t>(still)]);
      }
    }
  }

  void Record(int frame)
  {
    const FlightState& state = this->State.Flight;
    this->Out.Poses.Orientations[frame] = state.Orientation;
    this->Out.Poses.AngularVelocities[frame] = this->Pace() * state.AngularVelocity(this->Body);
    this->Out.Poses.Torques[frame] = AirTorque(this->Body, this->Path, state, frame);
    if (this->Plan.Glides && this->Body.Slips)
    {
      this->Out.Poses.Slips[frame] = state.Velocity(this->Body);
    }
  }

  /// The pose that its path was found with.
  bool HasFlown() const { return !this->Plan.Path->Slips.empty(); }
  void TakeFlown(int frame)
  {
    const Track& track = *this->Plan.Path;
    const auto k = static_cast<std::size_t>(frame);
    FlightState& state = this->State.Flight;
    state.Orientation = track.Orientations[k].normalized();
    state.SetAngularVelocity(this->Body, track.AngularVelocities[k] / this->Pace());
    state.SetVelocity(this->Body, track.Slips[k]);
    this->Record(frame);
  }

  /// The least turn that brings the body's axis into the cone.
  static Quat TowardsCone(const Quat& q, const Constraint& key)
  {
    const Mat3 axes = q.toRotationMatrix();
    const Vec3 away = LogMap(LeastTurn(axes.col(2), key.Facing, axes.col(0)));
    const double angle = away.norm();
    const double within = key.FacingTolerance * (1.0 - 1e-9);
    return angle <= within ? q : (ExpMap(away * (1.0 - within / angle)) * q).normalized();
  }

  /// The pose nearest to q that a row allows.
  static Quat Towards(const Quat& q, const Constraint& key)
  {
    if (!IsAttitude(key.Kind))
    {
      return TowardsCone(q, key);
    }
    const Quat wanted = key.Orientation.normalized();
    if (key.Radius <= 0.0)
    {
      return wanted;
    }
    const Vec3 away = LogMap(q * wanted.conjugate());
    const double angle = away.norm();
    return angle <= key.Radius
             ? q
             : (ExpMap(away * (key.Radius * (1.0 - 1e-12) / angle)) * wanted).normalized();
  }

  int FlyToNextEvent(int from)
  {
    const PlannedRest* rest = this->RestAfter(from);
    const Constraint* key = this->KeyAt(from + 1, this->Last);
    if (key != nullptr && key->Frame >= (rest != nullptr ? rest->Frame : this->Last + 1))
    {
      key = nullptr;
    }
    std::optional<Landing> landing;
    if (rest != nullptr)
    {
      landing = this->LandingOn(*rest);
    }
    const int end = key != nullptr    ? key->Frame
                    : rest != nullptr ? std::min(landing->LastStirring(), this->Last)
                                      : this->Last;
    for (int k = from; k < end; ++k)
    {
      const Quat& now = this->State.Flight.Orientation;
      const Settling settling = landing ? landing->Draw(k, now) : Settling();
      const bool lands = landing && (settling.Weight > 0.0 || landing->IsNear(k));
      const bool keeps = k >= this->Plan.TurnsUntil || (!this->IsLive && k < this->Plan.TurnsFrom);
      if (this->HasFlown() && !lands && keeps)
      {
        this->IsLive = false;
        this->TakeFlown(k + 1);
        continue;
      }
      this->IsLive = true;
      Floor floor;
      const bool comesDown = landing && landing->IsNear(k);
      const bool near =
        FindFloor(this->Plan, k, this->Path.Step, comesDown ? nullptr : &now, floor);
      if (near && comesDown)
      {
        landing->Support(k, now, this->Path.Step, floor);
      }
      const FrameEvents events = AdvanceFrame(this->Body, this->Path, k, settling,
                                              near ? &floor : nullptr, this->State.Flight);
      this->Out.Slowed[k] = events.Slowed;
      this->Out.Swept[k] = events.Swept;
      if (events.Touched)
      {
        this->Marks.Changed[k + 1] = 1;
      }
      this->HoldStill(k + 1);
      this->Record(k + 1);
    }
    this->State.Frame = end;
    if (key != nullptr)
    {
      this->MeetKey(*key, from);
    }
    else if (rest != nullptr && rest->Frame <= this->Last)
    {
      this->Land(*rest, *landing, from);
      return this->State.Frame;
    }
    return end;
  }

  /// Turns the poses before a key by a fraction of what is missing there, more and more.
  void MeetKey(const Constraint& key, int from)
  {
    const int k = key.Frame;
    std::vector<Quat>& poses = this->Out.Poses.Orientations;
    const Quat target = this->WithinReach(poses[from], from, Towards(poses[k], key), key);
    const Quat missing = target * poses[k].conjugate();
    const Vec3 turn = LogMap(missing);
    const double time = IsAttitude(key.Kind) ? this->Plan.TurningTime : FacingTime;
    const double most = time * this->Plan.Time.FramesPerSecond;
    const double span = std::min<double>(k - from, std::max(most, 1.0));
    for (int i = std::max(from + 1, static_cast<int>(std::ceil(k - span))); i < k; ++i)
    {
      poses[i] = (ExpMap(SmoothStep(1.0 - (k - i) / span) * turn) * poses[i]).normalized();
      this->Marks.Changed[i] = turn.norm() > 1e-12;
    }
    poses[k] = target;
    this->Marks.Frames[k].Freedom = PoseFreedom::Fixed;
    this->Out.Poses.AngularVelocities[k] = missing * this->Out.Poses.AngularVelocities[k];
    this->TurnState(missing);
    this->State.Flight.Orientation = target;
  }

  /// The body turns on as it did before in its own axes, and flies on as it did.
  void TurnState(const Quat& turn)
  {
    FlightState& state = this->State.Flight;
    const Vec3 velocity = state.Velocity(this->Body);
    state.AngularMomentum = turn * state.AngularMomentum;
    state.Orientation = (turn * state.Orientation).normalized();
    state.SetVelocity(this->Body, velocity);
  }

  /// The wanted pose, or as much of the turn to it as the time since the pose `start` allows.
  Quat WithinReach(const Quat& start, int from, const Quat& wanted, const Constraint& key)
  {
    const Vec3 turn = LogMap(wanted * start.conjugate());
    const double time = (key.Frame - from) / this->Plan.Time.FramesPerSecond;
    const double fraction = this->Plan.TurningRate * time / std::max(turn.norm(), 1e-12);
    if (fraction >= 1.0)
    {
      return wanted;
    }
    this->Out.TooFast[{ key.Row, key.Target }] = "it asks for " + Short(turn.norm() / time) +
                                                 " rad/s since frame " + std::to_string(from) +
                                                 ", more than " + Short(this->Plan.TurningRate);
    return (ExpMap(fraction * turn) * start).normalized();
  }

  Landing LandingOn(const PlannedRest& rest) const
  {
    const int first = std::max(rest.Frame, 0);
    const int end = std::min(rest.Until, this->Last);
    const auto held = this->Marks.Held.begin();
    const bool isHeld = std::any_of(held + first, held + std::max(first, end) + 1,
                                    [](unsigned char frame) { return frame != 0; });
    const auto& keys = this->Plan.Keys;
    const auto heading = std::find_if(keys.begin(), keys.end(),
                                      [&](const Constraint& key) {
                                        return IsAttitude(key.Kind) && key.Frame >= rest.Frame &&
                                               key.Frame <= rest.Until;
                                      });
    return { this->Plan, rest, heading != keys.end() ? &*heading : nullptr, isHeld };
  }

  void Land(const PlannedRest& rest, const Landing& landing, int from)
  {
    RestTimes times;
    const RestingPose laid = landing.Settle(from, std::max(this->Lain + 1, landing.FirstNear()),
                                            this->Marks, this->Out, times);
    this->Out.Rests.push_back(times);
    this->LieStill(rest, times.Settled, laid);
  }

  /// The same pose from a frame to the end of the rest; then free flight begins anew.
  void LieStill(const PlannedRest& rest, int first, const RestingPose& laid)
  {
    const Quat lying = laid.Orientation;
    const int end = std::min(rest.Until, this->Last);
    for (int i = first; i <= end; ++i)
    {
      this->Out.Poses.Orientations[i] = lying;
      this->Out.Poses.AngularVelocities[i].setZero();
      this->Out.Poses.Torques[i].setZero();
      this->Marks.Frames[i].Freedom = PoseFreedom::Fixed;
      this->Marks.Changed[i] = 0;
      this->Marks.Shifts[i] = laid.Shift * Vec3::UnitZ();
    }
    const int second = static_cast<int>(std::ceil(this->Plan.Time.FramesPerSecond));
    for (int i = end + 1; i <= std::min(end + second, this->Last); ++i)
    {
      this->Marks.Frames[i] = { PoseFreedom::Leaving, lying };
    }
    this->State.Flight = FlightState();
    this->State.Flight.Orientation = lying;
    this->State.Flight.SetVelocity(this->Body, this->Path.RelativeVelocities[end]);
    this->State.Frame = this->Lain = end;
    this->IsLive =
      this->HasFlown() && this->Plan.Path->Orientations[end].angularDistance(lying) > SamePose;
  }

  const AttitudePlan& Plan;
  const FlightBody& Body;
  const FlightPath& Path;
  int Last;
  int Lain = -1;       // last frame of the rest before
  bool IsLive = false; // it turns here, though it came with poses: it lies otherwise than they do
  Now State;
  AttitudeOutcome Out;
  FrameMarks Marks;
};
} // namespace

AttitudeOutcome TurnObject(const AttitudePlan& plan, const FlightBody& body, const FlightPath& path)
{
  return AttitudeMotion(plan, body, path).Run();
}

} // namespace waft
