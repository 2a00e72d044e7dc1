// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PartingAttempt.h"

#include "Base/SmoothStep.h"
#include "Rotation/RigidBody.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace waft
{

PartingAttempt::PartingAttempt(const PartedScene& scene, const Meeting& meeting) :
  Scene(scene), Now(meeting)
{
  this->LookAround();
}

bool PartingAttempt::Search(Monitor& monitor)
{
  const PartingChange none;
  const int worst = this->Count(none, std::numeric_limits<int>::max());
  int least = worst;
  bool isStopped = false;
  const auto attempt = [&](const PartingChange& change)
  {
    isStopped = isStopped || !monitor.Tick(-1.0, "Keeping the meshes apart");
    const int count = least > 0 && !isStopped ? this->Count(change, least) : least;
    if (count < least)
    {
      least = count;
      this->Found = change;
    }
  };
  const auto middle = static_cast<std::size_t>((this->Now.First + this->Now.Last) / 2);
  const PosedMesh a = this->Scene.Motion.At(this->Now.A, middle);
  const PosedMesh b = this->Scene.Motion.At(this->Now.B, middle);
  for (const PartingChange& change : TurnLadder(a, b))
  {
    attempt(change);
  }
  for (const PartingChange& change : ShiftLadder(a, b, this->Found))
  {
    attempt(change);
  }
  return least < worst && !isStopped;
}

std::vector<std::size_t> PartingAttempt::Frames() const
{
  std::vector<std::size_t> frames;
  for (const Moment& moment : this->Moments)
  {
    frames.push_back(static_cast<std::size_t>(moment.Frame));
  }
  return frames;
}

PosedMesh PartingAttempt::Changed(bool isA, std::size_t k) const
{
  return isA ? this->Changed(this->Now.A, this->Found.TurnA, this->Found.ShiftA, this->Moments[k])
             : this->Changed(this->Now.B, this->Found.TurnB, this->Found.ShiftB, this->Moments[k]);
}

double PartingAttempt::FreedomAt(std::size_t track, int frame) const
{
  const auto f = static_cast<std::size_t>(frame);
  const PartingFreedom& freedom = this->Scene.Freedoms[track];
  return std::max(freedom.Turn[f], freedom.Shift[f]);
}

/// The frames about the meeting, those of its height first, and who else is near.
void PartingAttempt::LookAround()
{
  const PosedMotion& motion = this->Scene.Motion;
  const int gap = static_cast<int>(std::ceil(this->Scene.Ease));
  const int first = std::max(this->Now.First - gap, 0);
  const int last = std::min(this->Now.Last + gap, static_cast<int>(motion.NumberOfFrames()) - 1);
  const double shift =
    FarthestShift() * (motion.MeshOf(this->Now.A).Length() + motion.MeshOf(this->Now.B).Length());
  const auto others = [&](std::size_t track)
  {
    std::vector<std::size_t> near;
    const double reach = motion.MeshOf(track).Radius() + this->Scene.Widest + shift;
    this->Scene.Boxes.AddNear(track, first, last, reach, near);
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](std::size_t o) { return o == this->Now.A || o == this->Now.B; }),
               near.end());
    return near;
  };
  const auto nearAt = [&](std::size_t track, const std::vector<std::size_t>& some, int frame)
  {
    std::vector<std::size_t> near;
    std::copy_if(some.begin(), some.end(), std::back_inserter(near),
                 [&](std::size_t o) { return this->AreNear(o, track, frame, shift); });
    return near;
  };
  const std::vector<std::size_t> aboutA = others(this->Now.A);
  const std::vector<std::size_t> aboutB = others(this->Now.B);
  for (int f = first; f <= last; ++f)
  {
    const int away = std::max({ this->Now.First - f, f - this->Now.Last, 0 });
    Moment moment{ f, SmoothStep(1.0 - away / this->Scene.Ease), {}, {} };
    const bool isFreeA = moment.Height * this->FreedomAt(this->Now.A, f) > 0.0;
    const bool isFreeB = moment.Height * this->FreedomAt(this->Now.B, f) > 0.0;
    if (isFreeA)
    {
      moment.NearA = nearAt(this->Now.A, aboutA, f);
    }
    if (isFreeB)
    {
      moment.NearB = nearAt(this->Now.B, aboutB, f);
    }
    if (isFreeA || isFreeB)
    {
      this->Moments.push_back(std::move(moment));
    }
  }
  std::stable_sort(this->Moments.begin(), this->Moments.end(),
                   [](const Moment& a, const Moment& b) { return a.Height > b.Height; });
}

bool PartingAttempt::AreNear(std::size_t a, std::size_t b, int frame, double more) const
{
  const PosedMotion& motion = this->Scene.Motion;
  const auto f = static_cast<std::size_t>(frame);
  const double reach = motion.MeshOf(a).Radius() + motion.MeshOf(b).Radius() + more;
  return (motion.PlaceOf(a, f) - motion.PlaceOf(b, f)).squaredNorm() < reach * reach;
}

PosedMesh PartingAttempt::Changed(std::size_t track, const Vec3& turn, const Vec3& shift,
                                  const Moment& moment) const
{
  const auto f = static_cast<std::size_t>(moment.Frame);
  PosedMesh posed = this->Scene.Motion.At(track, f);
  const PartingFreedom& freedom = this->Scene.Freedoms[track];
  if (!turn.isZero())
  {
    posed.Orientation =
      (ExpMap(moment.Height * freedom.Turn[f] * turn) * posed.Orientation).normalized();
  }
  posed.Position += moment.Height * freedom.Shift[f] * shift;
  return posed;
}

bool PartingAttempt::IsKept(std::size_t track, const PosedMesh& posed, const Moment& moment) const
{
  const auto f = static_cast<std::size_t>(moment.Frame);
  const PosedMesh before = this->Scene.Motion.At(track, f);
  if (posed.Position == before.Position &&
      posed.Orientation.coeffs() == before.Orientation.coeffs())
  {
    return true;
  }
  ChangedBody changed;
  changed.Object = this->Scene.Motion.Objects[track];
  changed.Body = &this->Scene.Input.Shapes[static_cast<std::size_t>(changed.Object->ShapeId)];
  changed.Radius = posed.Shape->Radius();
  changed.Frame = moment.Frame;
  changed.Before = before.Position;
  changed.After = posed.Position;
  changed.Pose = posed.Orientation;
  return IsAllowed(this->Scene.Input, this->Scene.Places.Of(changed.Object->ObjectId), changed);
}

/// Whether a turn goes by no more than the limit, or than it does already, from frame to frame.
bool PartingAttempt::IsCalm(std::size_t track, const Vec3& turn) const
{
  if (turn.isZero())
  {
    return true;
  }
  std::map<std::size_t, Quat> poses;
  for (const Moment& moment : this->Moments)
  {
    poses[static_cast<std::size_t>(moment.Frame)] =
      this->Changed(track, turn, Vec3::Zero(), moment).Orientation;
  }
  const PosedMotion& motion = this->Scene.Motion;
  for (auto now = poses.begin(), next = std::next(now); next != poses.end(); ++now, ++next)
  {
    const double before =
      motion.PoseOf(track, now->first).angularDistance(motion.PoseOf(track, next->first));
    const bool isNext = next->first == now->first + 1;
    if (isNext &&
        now->second.angularDistance(next->second) > std::max(before + 1e-9, this->Scene.Most))
    {
      return false;
    }
  }
  return true;
}

bool PartingAttempt::IsDeep(std::size_t a, const PosedMesh& one, std::size_t b,
                            const PosedMesh& other)
{
  const double reach = one.Shape->Radius() + other.Shape->Radius();
  if ((one.Position - other.Position).squaredNorm() > reach * reach)
  {
    return false;
  }
  const double depth = PartedDepth * std::min(one.Shape->Length(), other.Shape->Length());
  if (a < b)
  {
    this->Pair.Place(one, other, depth);
  }
  else
  {
    this->Pair.Place(other, one, depth);
  }
  return this->Pair.IsDeeper(depth);
}

/// How many others a body of the meeting is deep in. The ladders change one body after the other:
/// what is known of it as it is, and as it was changed last, is kept.
int PartingAttempt::CountOthers(bool isA, const Vec3& turn, const Vec3& shift, std::size_t m)
{
  OthersMet& met = this->Met[isA ? 0 : 1][turn.isZero() && shift.isZero() ? 0 : 1];
  if (met.Deep.empty() || met.Turn != turn || met.Shift != shift)
  {
    met = { turn, shift, std::vector<int>(this->Moments.size(), -1) };
  }
  if (met.Deep[m] < 0)
  {
    const Moment& moment = this->Moments[m];
    const std::size_t own = isA ? this->Now.A : this->Now.B;
    const PosedMesh posed = this->Changed(own, turn, shift, moment);
    const std::vector<std::size_t>& near = isA ? moment.NearA : moment.NearB;
    met.Deep[m] = static_cast<int>(
      std::count_if(near.begin(), near.end(),
                    [&](std::size_t other)
                    {
                      const auto f = static_cast<std::size_t>(moment.Frame);
                      return this->IsDeep(own, posed, other, this->Scene.Motion.At(other, f));
                    }));
  }
  return met.Deep[m];
}

/// How many pairs and frames are deep about the meeting after a change: the count stops at
/// `enough`, which also stands for a change that may not be.
int PartingAttempt::Count(const PartingChange& change, int enough)
{
  if (!this->IsCalm(this->Now.A, change.TurnA) || !this->IsCalm(this->Now.B, change.TurnB))
  {
    return enough;
  }
  int count = 0;
  for (std::size_t m = 0; m < this->Moments.size(); ++m)
  {
    const Moment& moment = this->Moments[m];
    const PosedMesh a = this->Changed(this->Now.A, change.TurnA, change.ShiftA, moment);
    const PosedMesh b = this->Changed(this->Now.B, change.TurnB, change.ShiftB, moment);
    count += this->IsDeep(this->Now.A, a, this->Now.B, b) ? 1 : 0;
    count += this->CountOthers(true, change.TurnA, change.ShiftA, m);
    count += this->CountOthers(false, change.TurnB, change.ShiftB, m);
    if (count >= enough || !this->IsKept(this->Now.A, a, moment) ||
        !this->IsKept(this->Now.B, b, moment))
    {
      return enough;
    }
  }
  return count;
}

} // namespace waft
