// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PartingSearch.h"

#include "Base/SmoothStep.h"
#include "Rotation/PartingFreedom.h"
#include "Rotation/PartingLadder.h"
#include "Rotation/RigidBody.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace waft
{
namespace
{

constexpr double EaseTime = 0.4;       // s, in which a change comes and goes
constexpr double LongestMeeting = 3.0; // s
constexpr double LeastFreedom = 0.1;   // below which nothing is tried

} // namespace

class PartingSearch::Internals
{
public:
  Internals(const RotationInput& input, const std::vector<Constraint>& rows, double most,
            const PosedMotion& motion, Monitor& monitor, std::vector<Track>& tracks,
            std::vector<PoseTrack>& poses) :
    Input(input),
    Rows(rows), Most(most), Motion(motion), Caller(monitor), Tracks(tracks), Poses(poses),
    Ease(EaseTime * input.Scene.Time.FramesPerSecond)
  {
    this->Result.Turned.resize(tracks.size());
    this->Result.Shifts.resize(tracks.size());
    this->Freedoms.resize(tracks.size());
    this->Versions.resize(tracks.size(), 0);
  }

  bool IsStopped() const { return this->Stopped; }
  int Gap() const { return static_cast<int>(std::ceil(this->Ease)); }
  PartedMotion Take() { return std::move(this->Result); }

  /// Whether a body may be changed where the two are in each other.
  bool IsFree(const MeshCut& cut)
  {
    return std::max(this->FreedomAt(cut.A, cut.Frame), this->FreedomAt(cut.B, cut.Frame)) >
           LeastFreedom;
  }

  /// Whether anything could be done.
  bool Part(const Meeting& meeting)
  {
    if (meeting.Last - meeting.First > LongestMeeting * this->Input.Scene.Time.FramesPerSecond)
    {
      return false;
    }
    // What did not help does not help again, unless a body has been changed since.
    const std::pair<int, int> versions(this->Versions[meeting.A], this->Versions[meeting.B]);
    const std::array<std::size_t, 3> key = { meeting.A, meeting.B,
                                             static_cast<std::size_t>(meeting.First) };
    const auto tried = this->InVain.find(key);
    if (tried != this->InVain.end() && tried->second == versions)
    {
      return false;
    }
    this->LookAround(meeting);
    const PartingChange none;
    const int worst = this->Count(none, std::numeric_limits<int>::max());
    int least = worst;
    PartingChange best;
    const auto attempt = [&](const PartingChange& change)
    {
      this->Stopped = this->Stopped || !this->Caller.Tick(-1.0, "Keeping the meshes apart");
      const int count = least > 0 && !this->Stopped ? this->Count(change, least) : least;
      if (count < least)
      {
        least = count;
        best = change;
      }
    };
    const auto middle = static_cast<std::size_t>((meeting.First + meeting.Last) / 2);
    const PosedMesh a = this->Motion.At(meeting.A, middle);
    const PosedMesh b = this->Motion.At(meeting.B, middle);
    for (const PartingChange& change : TurnLadder(a, b))
    {
      attempt(change);
    }
    for (const PartingChange& change : ShiftLadder(a, b, best))
    {
      attempt(change);
    }
    if (least < worst)
    {
      this->Make(best);
      return true;
    }
    this->InVain[key] = versions;
    return false;
  }

private:
  struct Moment
  {
    int Frame;
    double Height;                         // of the change, 0..1
    std::vector<std::size_t> NearA, NearB; // others, of bodies that may be changed
  };

  const Vec3& PlaceOf(std::size_t track, int frame) const
  {
    return this->Tracks[track].Positions[static_cast<std::size_t>(frame)];
  }
  const Quat& PoseOf(std::size_t track, int frame) const
  {
    return this->Poses[track].Orientations[static_cast<std::size_t>(frame)];
  }

  double FreedomAt(std::size_t track, int frame)
  {
    const auto f = static_cast<std::size_t>(frame);
    PartingFreedom& freedom = this->Freedoms[track];
    if (freedom.Turn.empty())
    {
      freedom = FreedomOf(*this->Motion.Objects[track], this->Rows, this->Input.Scene.Time);
    }
    return std::max(freedom.Turn[f], freedom.Shift[f]);
  }

  /// The frames about a meeting, those of its height first, and who else is near.
  void LookAround(const Meeting& meeting)
  {
    this->Now = meeting;
    this->Moments.clear();
    const int first = std::max(meeting.First - this->Gap(), 0);
    const int last = std::min(meeting.Last + this->Gap(), this->LastFrame());
    const double shift = FarthestShift() * (this->Motion.MeshOf(meeting.A).Length() +
                                            this->Motion.MeshOf(meeting.B).Length());
    for (int f = first; f <= last; ++f)
    {
      const int away = std::max({ meeting.First - f, f - meeting.Last, 0 });
      Moment moment{ f, SmoothStep(1.0 - away / this->Ease), {}, {} };
      const bool isFreeA = moment.Height * this->FreedomAt(meeting.A, f) > 0.0;
      const bool isFreeB = moment.Height * this->FreedomAt(meeting.B, f) > 0.0;
      if (!isFreeA && !isFreeB)
      {
        continue;
      }
      for (std::size_t o = 0; o < this->Tracks.size(); ++o)
      {
        if (o == meeting.A || o == meeting.B)
        {
          continue;
        }
        if (isFreeA && this->AreNear(o, meeting.A, f, shift))
        {
          moment.NearA.push_back(o);
        }
        if (isFreeB && this->AreNear(o, meeting.B, f, shift))
        {
          moment.NearB.push_back(o);
        }
      }
      this->Moments.push_back(std::move(moment));
    }
    std::stable_sort(this->Moments.begin(), this->Moments.end(),
                     [](const Moment& a, const Moment& b) { return a.Height > b.Height; });
  }

  int LastFrame() const { return static_cast<int>(this->Motion.NumberOfFrames()) - 1; }

  bool AreNear(std::size_t a, std::size_t b, int frame, double more) const
  {
    const double reach = this->Motion.MeshOf(a).Radius() + this->Motion.MeshOf(b).Radius() + more;
    return (this->PlaceOf(a, frame) - this->PlaceOf(b, frame)).squaredNorm() < reach * reach;
  }

  PosedMesh Changed(std::size_t track, const Vec3& turn, const Vec3& shift,
                    const Moment& moment) const
  {
    const auto f = static_cast<std::size_t>(moment.Frame);
    PosedMesh posed = this->Motion.At(track, f);
    const PartingFreedom& freedom = this->Freedoms[track];
    if (!turn.isZero())
    {
      posed.Orientation =
        (ExpMap(moment.Height * freedom.Turn[f] * turn) * posed.Orientation).normalized();
    }
    posed.Position += moment.Height * freedom.Shift[f] * shift;
    return posed;
  }

  bool IsKept(std::size_t track, const PosedMesh& posed, const Moment& moment) const
  {
    const auto f = static_cast<std::size_t>(moment.Frame);
    const PosedMesh before = this->Motion.At(track, f);
    if (posed.Position == before.Position &&
        posed.Orientation.coeffs() == before.Orientation.coeffs())
    {
      return true;
    }
    ChangedBody changed;
    changed.Object = this->Motion.Objects[track];
    changed.Body = &this->Input.Shapes[static_cast<std::size_t>(changed.Object->ShapeId)];
    changed.Radius = posed.Shape->Radius();
    changed.Frame = moment.Frame;
    changed.Before = before.Position;
    changed.After = posed.Position;
    changed.Pose = posed.Orientation;
    return IsAllowed(this->Input, changed);
  }

  /// Whether a turn goes by no more than the limit, or than it does already, from frame to frame.
  bool IsCalm(std::size_t track, const Vec3& turn) const
  {
    if (turn.isZero())
    {
      return true;
    }
    std::map<int, Quat> poses;
    for (const Moment& moment : this->Moments)
    {
      poses[moment.Frame] = this->Changed(track, turn, Vec3::Zero(), moment).Orientation;
    }
    for (auto now = poses.begin(), next = std::next(now); next != poses.end(); ++now, ++next)
    {
      const double before =
        this->PoseOf(track, now->first).angularDistance(this->PoseOf(track, next->first));
      const bool isNext = next->first == now->first + 1;
      if (isNext && now->second.angularDistance(next->second) > std::max(before + 1e-9, this->Most))
      {
        return false;
      }
    }
    return true;
  }

  bool IsDeep(std::size_t a, const PosedMesh& one, std::size_t b, const PosedMesh& other)
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

  /// How many pairs and frames are deep about the meeting after a change: the count stops at
  /// `enough`, which also stands for a change that may not be.
  int Count(const PartingChange& change, int enough)
  {
    if (!this->IsCalm(this->Now.A, change.TurnA) || !this->IsCalm(this->Now.B, change.TurnB))
    {
      return enough;
    }
    int count = 0;
    for (const Moment& moment : this->Moments)
    {
      const PosedMesh a = this->Changed(this->Now.A, change.TurnA, change.ShiftA, moment);
      const PosedMesh b = this->Changed(this->Now.B, change.TurnB, change.ShiftB, moment);
      count += this->IsDeep(this->Now.A, a, this->Now.B, b) ? 1 : 0;
      const auto others =
        [&](std::size_t own, const PosedMesh& posed, const std::vector<std::size_t>& near)
      {
        for (std::size_t k = 0; k < near.size() && count < enough; ++k)
        {
          const auto f = static_cast<std::size_t>(moment.Frame);
          count += this->IsDeep(own, posed, near[k], this->Motion.At(near[k], f)) ? 1 : 0;
        }
      };
      others(this->Now.A, a, moment.NearA);
      others(this->Now.B, b, moment.NearB);
      if (count >= enough || !this->IsKept(this->Now.A, a, moment) ||
          !this->IsKept(this->Now.B, b, moment))
      {
        return enough;
      }
    }
    return count;
  }

  void Make(const PartingChange& change)
  {
    for (const bool isA : { true, false })
    {
      const std::size_t track = isA ? this->Now.A : this->Now.B;
      const Vec3& turn = isA ? change.TurnA : change.TurnB;
      const Vec3& shift = isA ? change.ShiftA : change.ShiftB;
      const std::size_t frames = this->Motion.NumberOfFrames();
      this->Versions[track] += turn.isZero() && shift.isZero() ? 0 : 1;
      if (!turn.isZero())
      {
        this->Result.Turned[track].resize(frames, 0);
      }
      if (!shift.isZero())
      {
        this->Result.Shifts[track].resize(frames, Vec3::Zero());
      }
      for (const Moment& moment : this->Moments)
      {
        const auto f = static_cast<std::size_t>(moment.Frame);
        const PosedMesh posed = this->Changed(track, turn, shift, moment);
        if (!turn.isZero())
        {
          this->Poses[track].Orientations[f] = posed.Orientation;
          this->Result.Turned[track][f] = 1;
        }
        if (!shift.isZero())
        {
          this->Result.Shifts[track][f] += posed.Position - this->PlaceOf(track, moment.Frame);
          this->Tracks[track].Positions[f] = posed.Position;
        }
      }
    }
  }

  const RotationInput& Input;
  const std::vector<Constraint>& Rows;
  double Most;
  const PosedMotion& Motion;
  Monitor& Caller;
  std::vector<Track>& Tracks;
  std::vector<PoseTrack>& Poses;
  double Ease; // frames
  bool Stopped = false;
  std::vector<PartingFreedom> Freedoms;
  std::vector<int> Versions;                                        // changes so far, by track
  std::map<std::array<std::size_t, 3>, std::pair<int, int>> InVain; // meetings, with versions
  PartedMotion Result;
  MeshPair Pair;
  Meeting Now;
  std::vector<Moment> Moments;
};

PartingSearch::PartingSearch(const RotationInput& input, const std::vector<Constraint>& rows,
                             double most, const PosedMotion& motion, Monitor& monitor,
                             std::vector<Track>& tracks, std::vector<PoseTrack>& poses) :
  Impl(std::make_unique<Internals>(input, rows, most, motion, monitor, tracks, poses))
{
}

PartingSearch::~PartingSearch() = default;

int PartingSearch::EaseFrames() const
{
  return this->Impl->Gap();
}

bool PartingSearch::IsFree(const MeshCut& cut)
{
  return this->Impl->IsFree(cut);
}

bool PartingSearch::Part(const Meeting& meeting)
{
  return this->Impl->Part(meeting);
}

bool PartingSearch::IsStopped() const
{
  return this->Impl->IsStopped();
}

PartedMotion PartingSearch::Take()
{
  return this->Impl->Take();
}

} // namespace waft
