// SPDX-License-Identifier: BSD-3-Clause
#include "Export/PosesCsv.h"

#include "Base/FractionDone.h"

#include "Base/AtomicFile.h"

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
} // namespace

Result PosesCsv(const std::vector<Track>& tracks, const std::vector<PoseTrack>& poses,
                const Timeline& time, std::string& text, Monitor& monitor)
{
  if (tracks.size() != poses.size())
  {
    return Result::Error("expected poses for " + std::to_string(tracks.size()) + " tracks, found " +
                         std::to_string(poses.size()));
  }
  text = "object,frame,time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    if (!monitor.Tick(FractionDone(i, tracks.size()), "Writing poses"))
    {
      return Result::Stopped();
    }
    const Track& track = tracks[i];
    const PoseTrack& pose = poses[i];
    const std::size_t count = track.Positions.size();
    if (pose.ObjectId != track.ObjectId || pose.Orientations.size() != count ||
        pose.AngularVelocities.size() != count)
    {
      return Result::Error("the poses of object " + std::to_string(pose.ObjectId) +
                           " do not fit the track of object " + std::to_string(track.ObjectId));
    }
    const std::vector<Vec3> velocities = CentralVelocities(track.Positions, time.Step());
    for (std::size_t k = 0; k < count; ++k)
    {
      text += std::to_string(track.ObjectId) + "," + std::to_string(k);
      AppendNumber(time.Time(static_cast<double>(k)), text);
      AppendVector(track.Positions[k], text);
      AppendNumber(pose.Orientations[k].w(), text);
      AppendVector(pose.Orientations[k].vec(), text);
      AppendVector(velocities[k], text);
      AppendVector(pose.AngularVelocities[k], text);
      text += '\n';
    }
  }
  return Result::Ok();
}

Result WritePosesCsv(const std::string& path, const std::vector<Track>& tracks,
                     const std::vector<PoseTrack>& poses, const Timeline& time, Monitor& monitor)
{
  std::string text;
  const Result result = PosesCsv(tracks, poses, time, text, monitor);
  return result && !result.IsStopped() ? WriteWholeFile(path, text) : result;
}

} // namespace waft
