// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PartingSearch.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace waft
{
namespace
{

constexpr double EaseTime = 0.4;           // s, in which a change comes and goes
constexpr double LongestMeeting = 3.0;     // s
constexpr double LeastFreedom = 0.1;       // below which nothing is tried
constexpr std::size_t MeetingsAhead = 256; // of which those apart are searched at once

double WidestOf(const PosedMotion& motion)
{
  double widest = 0.0;
  for (std::size_t i = 0; i < motion.Tracks->size(); ++i)
  {
    widest = std::max(widest, motion.MeshOf(i).Radius());
  }
  return widest;
}

} // namespace

PartingSearch::PartingSearch(const RotationInput& input, const std::vector<Constraint>& rows,
                             double most, const PosedMotion& motion, Monitor& monitor,
                             std::vector<Track>& tracks, std::vector<PoseTrack>& poses) :
  Rows(rows),
  Places(rows), Motion(motion), Caller(monitor), Tracks(tracks), Poses(poses), Boxes(tracks),
  Freedoms(tracks.size()), Scene{ input,
                                  this->Places,
                                  most,
                                  EaseTime * input.Scene.Time.FramesPerSecond,
                                  WidestOf(motion),
                                  motion,
                                  this->Boxes,
                                  this->Freedoms },
  Versions(tracks.size(), 0)
{
  this->Result.Turned.resize(tracks.size());
  this->Result.Shifts.resize(tracks.size());
}

int PartingSearch::EaseFrames() const
{
  return static_cast<int>(std::ceil(this->Scene.Ease));
}

const PartingFreedom& PartingSearch::TakeFreedom(std::size_t track)
{
  PartingFreedom& freedom = this->Freedoms[track];
  if (freedom.Turn.empty())
  {
    const MotionObject& object = *this->Motion.Objects[track];
    freedom =
      FreedomOf(object, this->Rows, this->Places.Of(object.ObjectId), this->Scene.Input.Scene.Time);
  }
  return freedom;
}

bool PartingSearch::IsFree(const MeshCut& cut)
{
  const auto f = static_cast<std::size_t>(cut.Frame);
  const auto isFree = [&](std::size_t track)
  {
    const PartingFreedom& freedom = this->TakeFreedom(track);
    return std::max(freedom.Turn[f], freedom.Shift[f]) > LeastFreedom;
  };
  return isFree(cut.A) || isFree(cut.B);
}

std::pair<int, int> PartingSearch::VersionsOf(const Meeting& meeting) const
{
  return { this->Versions[meeting.A], this->Versions[meeting.B] };
}

/// What did not help does not help again, unless a body has been changed since.
bool PartingSearch::IsInVain(const Meeting& meeting) const
{
  const auto tried =
    this->InVain.find({ meeting.A, meeting.B, static_cast<std::size_t>(meeting.First) });
  return tried != this->InVain.end() && tried->second == this->VersionsOf(meeting);
}

bool PartingSearch::Part(std::vector<Meeting> meetings, const ParallelFor& parallel)
{
  const double longest = LongestMeeting * this->Scene.Input.Scene.Time.FramesPerSecond;
  meetings.erase(std::remove_if(meetings.begin(), meetings.end(),
                                [&](const Meeting& meeting)
                                { return meeting.Last - meeting.First > longest; }),
                 meetings.end());
  for (const Meeting& meeting : meetings)
  {
    this->TakeFreedom(meeting.A);
    this->TakeFreedom(meeting.B);
  }
  PartMonitor monitor(this->Caller, 1.0, 1.0);
  bool isChanged = false;
  while (!meetings.empty())
  {
    const std::vector<std::size_t> now = this->ApartFrom(meetings);
    std::vector<std::unique_ptr<PartingAttempt>> attempts(now.size());
    std::vector<unsigned char> helps(now.size(), 0);
    parallel(now.size(),
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t k = begin; k < end; ++k)
               {
                 const Meeting& meeting = meetings[now[k]];
                 if (!this->IsInVain(meeting))
                 {
                   attempts[k] = std::make_unique<PartingAttempt>(this->Scene, meeting);
                   helps[k] = attempts[k]->Search(monitor) ? 1 : 0;
                 }
               }
             });
    if (!monitor.Tick(-1.0, "Keeping the meshes apart"))
    {
      this->Stopped = true;
      return isChanged;
    }
    for (std::size_t k = now.size(); k-- > 0;)
    {
      if (helps[k] != 0)
      {
        this->Make(*attempts[k]);
        isChanged = true;
      }
      else if (attempts[k] != nullptr)
      {
        const Meeting& meeting = attempts[k]->Of();
        this->InVain[{ meeting.A, meeting.B, static_cast<std::size_t>(meeting.First) }] =
          this->VersionsOf(meeting);
      }
      meetings.erase(meetings.begin() + static_cast<std::ptrdiff_t>(now[k]));
    }
  }
  return isChanged;
}

/// Which of the next meetings are out of the reach of all before them: nothing that is done to
/// those changes what is found for these.
std::vector<std::size_t> PartingSearch::ApartFrom(const std::vector<Meeting>& meetings) const
{
  std::vector<std::size_t> apart;
  std::vector<int> changes(this->Tracks.size(), 0); // that may come before, by track
  const std::size_t count = std::min(meetings.size(), MeetingsAhead);
  for (std::size_t k = 0; k < count; ++k)
  {
    const bool isApart = std::all_of(
      meetings.begin(), meetings.begin() + static_cast<std::ptrdiff_t>(k),
      [&](const Meeting& earlier) { return this->AreApart(earlier, meetings[k], changes); });
    if (isApart)
    {
      apart.push_back(k);
    }
    ++changes[meetings[k].A];
    ++changes[meetings[k].B];
  }
  return apart;
}

/// changes: of the earlier meeting's bodies, each by the farthest shift.
bool PartingSearch::AreApart(const Meeting& earlier, const Meeting& later,
                             const std::vector<int>& changes) const
{
  if (earlier.A == later.A || earlier.A == later.B || earlier.B == later.A || earlier.B == later.B)
  {
    return false;
  }
  const int gap = this->EaseFrames();
  const int first = std::max({ earlier.First - gap, later.First - gap, 0 });
  const int last = std::min(
    { earlier.Last + gap, later.Last + gap, static_cast<int>(this->Motion.NumberOfFrames()) - 1 });
  if (first > last)
  {
    return true;
  }
  const auto extent = [&](std::size_t track) { return this->Motion.MeshOf(track).Length(); };
  for (const std::size_t one : { earlier.A, earlier.B })
  {
    for (const std::size_t other : { later.A, later.B })
    {
      const double shifts =
        FarthestShift() * (extent(later.A) + extent(later.B) + changes[one] * extent(one));
      const double reach =
        1.001 * (this->Motion.MeshOf(one).Radius() + this->Motion.MeshOf(other).Radius() + shifts);
      if (!this->Boxes.MayMeet(one, other, first, last, reach))
      {
        continue;
      }
      for (auto f = static_cast<std::size_t>(first); f <= static_cast<std::size_t>(last); ++f)
      {
        if ((this->Motion.PlaceOf(one, f) - this->Motion.PlaceOf(other, f)).squaredNorm() <=
            reach * reach)
        {
          return false;
        }
      }
    }
  }
  return true;
}

void PartingSearch::Make(const PartingAttempt& attempt)
{
  const PartingChange& change = attempt.Best();
  const std::vector<std::size_t> frames = attempt.Frames();
  for (const bool isA : { true, false })
  {
    const std::size_t track = isA ? attempt.Of().A : attempt.Of().B;
    const bool turns = !(isA ? change.TurnA : change.TurnB).isZero();
    const bool shifts = !(isA ? change.ShiftA : change.ShiftB).isZero();
    this->Versions[track] += turns || shifts ? 1 : 0;
    if (turns)
    {
      this->Result.Turned[track].resize(this->Motion.NumberOfFrames(), 0);
    }
    if (shifts)
    {
      this->Result.Shifts[track].resize(this->Motion.NumberOfFrames(), Vec3::Zero());
    }
    for (std::size_t k = 0; k < frames.size(); ++k)
    {
      const std::size_t f = frames[k];
      const PosedMesh posed = attempt.Changed(isA, k);
      if (turns)
      {
        this->Poses[track].Orientations[f] = posed.Orientation;
        this->Result.Turned[track][f] = 1;
      }
      if (shifts)
      {
        this->Result.Shifts[track][f] += posed.Position - this->Tracks[track].Positions[f];
        this->Tracks[track].Positions[f] = posed.Position;
      }
    }
    if (shifts)
    {
      this->Boxes.Take(track);
    }
  }
}

} // namespace waft
