// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PartMeshes.h"

#include "Base/NumberText.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace waft
{
namespace
{

constexpr int MostPasses = 3;
constexpr std::size_t NamedPairs = 5; // pairs of which the same is said
constexpr std::size_t Crowd = 8;      // others beside whose marks there is no room: it stays there

std::vector<Meeting> MeetingsOf(const std::vector<MeshCut>& cuts, int gap)
{
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> last; // meeting of a pair
  std::vector<Meeting> meetings;
  for (const MeshCut& cut : cuts)
  {
    const auto found = last.find({ cut.A, cut.B });
    if (found != last.end() && cut.Frame - meetings[found->second].Last <= gap)
    {
      meetings[found->second].Last = cut.Frame;
      continue;
    }
    last[{ cut.A, cut.B }] = meetings.size();
    meetings.push_back({ cut.A, cut.B, cut.Frame, cut.Frame });
  }
  return meetings;
}

// Takes out those at marks of two bodies that are each in a crowd there, whom nothing small parts.
void LeaveCrowds(std::size_t bodies, std::vector<MeshCut>& cuts)
{
  std::vector<std::set<std::size_t>> others(bodies);
  for (const MeshCut& cut : cuts)
  {
    if (cut.NearMarks)
    {
      others[cut.A].insert(cut.B);
      others[cut.B].insert(cut.A);
    }
  }
  cuts.erase(std::remove_if(cuts.begin(), cuts.end(),
                            [&](const MeshCut& cut) {
                              return cut.NearMarks && others[cut.A].size() > Crowd &&
                                     others[cut.B].size() > Crowd;
                            }),
             cuts.end());
}

/// "objects 3 and 7 at frames 10 to 14".
std::string Named(const Meeting& meeting, const std::vector<Track>& tracks)
{
  return "objects " + std::to_string(tracks[meeting.A].ObjectId) + " and " +
         std::to_string(tracks[meeting.B].ObjectId) + " " + FramesText(meeting.First, meeting.Last);
}

} // namespace

std::vector<std::string> WarningsOfCuts(const std::vector<MeshCut>& left,
                                        const std::vector<Track>& tracks)
{
  std::vector<std::string> warnings;
  for (const bool nearMarks : { false, true })
  {
    std::vector<MeshCut> cuts;
    std::copy_if(left.begin(), left.end(), std::back_inserter(cuts),
                 [&](const MeshCut& cut) { return cut.NearMarks == nearMarks; });
    const std::vector<Meeting> meetings =
      MeetingsOf(cuts, static_cast<int>(tracks.front().Positions.size()));
    if (meetings.empty())
    {
      continue;
    }
    std::string text;
    for (std::size_t k = 0; k < std::min(meetings.size(), NamedPairs); ++k)
    {
      text += (k > 0 ? "; " : "") + Named(meetings[k], tracks);
    }
    const std::size_t more = meetings.size() - std::min(meetings.size(), NamedPairs);
    text += more > 0 ? "; and " + std::to_string(more) + " more pairs" : "";
    warnings.push_back(text + (nearMarks ? ": their meshes are in each other, as their marks are "
                                           "nearer to each other than they are wide: put marks "
                                           "farther apart, or take smaller bodies"
                                         : ": their meshes are in each other in flight, and no "
                                           "small turn or shift parts them: give one of them "
                                           "another mark, or more time"));
  }
  return warnings;
}

bool PartMeshes(const RotationInput& input, const std::vector<Constraint>& rows, double most,
                const ParallelFor& parallel, Monitor& monitor, std::vector<Track>& tracks,
                std::vector<PoseTrack>& poses, PartedMotion& parted)
{
  std::map<int, const MotionObject*> objectOf;
  for (const MotionObject& object : input.Objects)
  {
    objectOf[object.ObjectId] = &object;
  }
  const std::vector<ContactMesh> meshes = ContactMeshesOf(input.Shapes);
  PosedMotion motion;
  motion.Tracks = &tracks;
  motion.Poses = &poses;
  motion.Meshes = &meshes;
  for (const Track& track : tracks)
  {
    motion.Objects.push_back(objectOf[track.ObjectId]);
  }
  TakeRests(rows, motion);
  const KeptDistances kept = KeptOf(motion, rows, input.Scene.Time.FramesPerSecond);
  PartingSearch parting(input, rows, most, motion, monitor, tracks, poses);
  bool isChanged = true;
  for (int pass = 0; pass < MostPasses && isChanged; ++pass)
  {
    std::vector<MeshCut> cuts = FindMeshCuts(motion, kept, PartedDepth, parallel);
    cuts.erase(std::remove_if(cuts.begin(), cuts.end(),
                              [&](const MeshCut& cut) { return !parting.IsFree(cut); }),
               cuts.end());
    LeaveCrowds(tracks.size(), cuts);
    isChanged = parting.Part(MeetingsOf(cuts, parting.EaseFrames()), parallel);
    if (parting.IsStopped())
    {
      return false;
    }
  }
  parted = parting.Take();
  parted.Left = FindMeshCuts(motion, kept, TouchedDepth, parallel);
  return true;
}

} // namespace waft
