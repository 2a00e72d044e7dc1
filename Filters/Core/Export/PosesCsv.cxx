// SPDX-License-Identifier: BSD-3-Clause
#include "Export/PosesCsv.h"

#include "Base/AtomicFile.h"
#include "Base/FractionDone.h"

#include <algorithm>
#include <charconv>

namespace waft
{
namespace
{
void AppendNumber(double value, std::string& text)
{
  // The same digits in every locale, unlike printf.
  char digits[40];
  const auto end =
    std::to_chars(digits, digits + sizeof(digits), value, std::chars_format::general, 17);
  text += ',';
  text.append(digits, end.ptr);
}

void AppendVector(const Vec3& v, std::string& text)
{
  AppendNumber(v.x(), text);
  AppendNumber(v.y(), text);
  AppendNumber(v.z(), text);
}

Result CheckFit(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses)
{
  if (tracks.size() != poses.size())
  {
    return Result::Error("expected poses for " + std::to_string(tracks.size()) + " tracks, found " +
                         std::to_string(poses.size()));
  }
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    const std::size_t count = tracks[i].Positions.size();
    if (poses[i].ObjectId != tracks[i].ObjectId || poses[i].Orientations.size() != count ||
        poses[i].AngularVelocities.size() != count)
    {
      return Result::Error("the poses of object " + std::to_string(poses[i].ObjectId) +
                           " do not fit the track of object " + std::to_string(tracks[i].ObjectId));
    }
  }
  return Result::Ok();
}
} // namespace

Result PosesCsv(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses,
                const Timeline& time, const std::function<bool(const std::string& text)>& write)
{
  WAFT_RETURN_IF_FAILED(CheckFit(tracks, poses));
  const bool comeAndGo = std::any_of(tracks.begin(), tracks.end(),
                                     [](const Track& track) { return track.ComesOrGoes(); });
  std::string text = PosesCsvHeader;
  text += comeAndGo ? PresentColumn : "";
  text += '\n';
  bool isWanted = write(text);
  for (std::size_t i = 0; i < tracks.size() && isWanted; ++i)
  {
    const Track& track = tracks[i];
    const PoseTrack& pose = poses[i];
    const std::vector<Vec3> velocities = CentralVelocities(track, time.Step());
    text.clear();
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      text += std::to_string(track.ObjectId) + "," + std::to_string(k);
      AppendNumber(time.Time(static_cast<double>(k)), text);
      AppendVector(track.Positions[k], text);
      AppendNumber(pose.Orientations[k].w(), text);
      AppendVector(pose.Orientations[k].vec(), text);
      AppendVector(velocities[k], text);
      AppendVector(pose.AngularVelocities[k], text);
      text += !comeAndGo ? "" : track.IsPresent(k) ? ",1" : ",0";
      text += '\n';
    }
    isWanted = write(text);
  }
  return Result::Ok();
}

Result WritePosesCsv(const std::string& path, const std::vector<Track>& tracks,
                     const std::vector<PoseTrack>& poses, const Timeline& time, Monitor& monitor)
{
  std::size_t parts = 0; // of which the first is the line of names
  const auto goesOn = [&]
  { return monitor.Tick(FractionDone(parts++, tracks.size() + 1), "Writing poses"); };
  if (!goesOn())
  {
    return Result::Stopped();
  }
  PartFile file(path);
  bool isStopped = false;
  if (file.Open())
  {
    WAFT_RETURN_IF_FAILED(PosesCsv(tracks, poses, time,
                                   [&](const std::string& text)
                                   {
                                     const bool isWritten = file.Write(text.data(), text.size());
                                     isStopped = !goesOn();
                                     return isWritten && !isStopped;
                                   }));
  }
  if (isStopped)
  {
    return Result::Stopped();
  }
  WAFT_RETURN_IF_FAILED(file.Close());
  return file.PutInPlace();
}

} // namespace waft
