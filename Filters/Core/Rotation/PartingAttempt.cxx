// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PartingAttempt.h"

#include "Base/SmoothStep.h"
#include "Rotation/RigidBody.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
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
  for (int f = first; f <= last; ++f)
  {
    const int away = std::max({ this->Now.First - f, f - this->Now.Last, 0 });
    const Moment moment{ f, SmoothStep(1.0 - away / this->Scene.Ease) };
    if (moment.Height * this->FreedomAt(this->Now.A, f) > 0.0 ||
        moment.Height * this->FreedomAt(this->Now.B, f) > 0.0)
    {
      this->Moments.push_back(moment);
    }
  }
  std::stable_sort(this->Moments.begin(), this->Moments.end(),
                   [](const Moment& a, const Moment& b) { return a.Height > b.Height; });
  this->A.Track = this->Now.A;
  this->B.Track = this->Now.B;
  for (Changing* body : { &this->A, &this->B })
  {
    std::vector<std::size_t> others;
    const double reach = motion.MeshOf(body->Track).Radius() + this->Scene.Widest + shift;
    this->Scene.Boxes.AddNear(body->Track, first, last, reach, others);
    for (std::size_t m = 0; m < this->Moments.size(); ++m)
    {
      const int frame = this->Moments[m].Frame;
      if (!(this->Moments[m].Height * this->FreedomAt(body->Track, frame) > 0.0))
      {
        continue;
      }
      for (const std::size_t other : others)
      {
        if (other != this->Now.A && other != this->Now.B &&
            this->AreNear(other, body->Track, frame, shift))
        {
          body->Near.push_back({ m, other });
        }
      }
    }
    body->Order.resize(body->Near.size());
    std::iota(body->Order.begin(), body->Order.end(), std::size_t(0));
  }
}

bool PartingAttempt::AreNear(std::size_t a, std::size_t b, int frame, double more) const
{
  const PosedMotion& motion = this->Scene.Motion;
  const auto f = static_cast<std::size_t>(frame);
  const double reach = motion.MeshOf(a).Radius() + motion.MeshOf(b).Radius() + more;
  return (*motion.Tracks)[a].IsPresent(f) && (*motion.Tracks)[b].IsPresent(f) &&
         (motion.PlaceOf(a, f) - motion.PlaceOf(b, f)).squaredNorm() < reach * reach;
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

/// How many others a body of the meeting is deep in, up to `enough`. The ladders change one body
/// after the other: what is known of it as it is, and as it was changed last, is kept. Whom one
/// change brings it into another one mostly does, too: those are looked at first.
int PartingAttempt::CountNeighbours(Changing& body, const Vec3& turn, const Vec3& shift, int enough)
{
  NeighboursMet& met = body.Met[turn.isZero() && shift.isZero() ? 0 : 1];
  if (met.Depths.empty() || met.Turn != turn || met.Shift != shift)
  {
    met = { turn, shift, std::vector<Depth>(body.Near.size(), Depth::Unknown) };
  }
  int count = 0;
  for (std::size_t k = 0; k < body.Order.size() && count < enough; ++k)
  {
    const std::size_t n = body.Order[k];
    if (met.Depths[n] == Depth::Unknown)
    {
      const auto& [m, other] = body.Near[n];
      const auto f = static_cast<std::size_t>(this->Moments[m].Frame);
      const bool isDeep =
        this->IsDeep(body.Track, body.Posed[m], other, this->Scene.Motion.At(other, f));
      met.Depths[n] = isDeep ? Depth::Deep : Depth::Shallow;
    }
    if (met.Depths[n] == Depth::Deep)
    {
      ++count;
      std::swap(body.Order[k], body.Order[k / 2]);
    }
  }
  return count;
}

/// How many pairs and frames are deep about the meeting after a change: the count stops at
/// `enough`, which also stands for a change that may not be.
int PartingAttempt::Count(const PartingChange& change, int enough)
{
  if (!this->IsCalm(this->Now.A, change.TurnA) || !this->IsCalm(this->Now.B, change.TurnB))
  {
    return enough;
  }
  this->A.Posed.clear();
  this->B.Posed.clear();
  int count = 0; // of the two first: others may be many
  for (const Moment& moment : this->Moments)
  {
    const PosedMesh a = this->Changed(this->Now.A, change.TurnA, change.ShiftA, moment);
    const PosedMesh b = this->Changed(this->Now.B, change.TurnB, change.ShiftB, moment);
    count += this->IsDeep(this->Now.A, a, this->Now.B, b) ? 1 : 0;
    if (count >= enough || !this->IsKept(this->Now.A, a, moment) ||
        !this->IsKept(this->Now.B, b, moment))
    {
      return enough;
    }
    this->A.Posed.push_back(a);
    this->B.Posed.push_back(b);
  }
  count += this->CountNeighbours(this->A, change.TurnA, change.ShiftA, enough - count);
  count += this->CountNeighbours(this->B, change.TurnB, change.ShiftB, enough - count);
  return count;
}

} // namespace waft
