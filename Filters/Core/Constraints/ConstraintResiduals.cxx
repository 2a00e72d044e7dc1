// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintCheck.h"

#include "Base/NumberText.h"
#include "Constraints/Rest.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

namespace waft
{

namespace
{

using Key = std::pair<int, int>; // (Row, Target)

/// How far something is that has no distance.
constexpr double Nowhere = std::numeric_limits<double>::infinity();

/// The worst that was found about one line.
struct Finding
{
  double Residual = 0.0; // of constraints of the line's own kind
  double Excess = 0.0;   // residual over tolerance, of any kind
  std::string Message;
  int ObjectId = -1;
  int Release = -1;
  int Leave = -1;
};

/// A distance that is no number is as far as can be.
double BeyondRadius(const Constraint& row, double distance)
{
  return std::isfinite(distance) ? std::max(0.0, distance - RadiusOf(row)) : Nowhere;
}

void Record(const Constraint& row, ConstraintKind kindOfLine, double distance, double tolerance,
            Finding& finding)
{
  const double residual = BeyondRadius(row, distance);
  finding.ObjectId = row.ObjectId;
  finding.Release = row.Release;
  finding.Leave = row.Leave;
  if (row.Kind == kindOfLine)
  {
    finding.Residual = std::max(finding.Residual, residual);
  }
  if (residual > tolerance && residual / tolerance > finding.Excess)
  {
    char text[160];
    std::snprintf(text, sizeof(text), "%s at frame %d: missed by %.4g %s, expected at most %.2g %s",
                  ToString(row.Kind), row.Frame, residual, TraitsOf(row.Kind).Unit, tolerance,
                  TraitsOf(row.Kind).Unit);
    finding.Excess = residual / tolerance;
    finding.Message = text;
  }
}

void AddMessage(ReportRow& line, const std::string& message)
{
  line.Message += (line.Message.empty() ? "" : "; ") + message;
}

void Apply(const std::map<Key, Finding>& findings, std::vector<ReportRow>& report)
{
  for (ReportRow& line : report)
  {
    const auto found = findings.find({ line.Row, line.Target });
    if (found == findings.end())
    {
      continue;
    }
    line.Residual = std::max(line.Residual, found->second.Residual);
    line.ObjectId = found->second.ObjectId;
    line.Release = found->second.Release;
    line.Leave = found->second.Leave;
    if (line.Status == ConstraintStatus::Met && !found->second.Message.empty())
    {
      line.Status = ConstraintStatus::Unreachable;
      AddMessage(line, found->second.Message);
    }
    else if (line.Status == ConstraintStatus::Unreachable && IsPositional(line.Kind))
    {
      AddMessage(line, "it comes within " + NumberText(line.Residual, 3) + " m");
    }
  }
}

std::map<Key, ConstraintKind> KindsOf(const std::vector<ReportRow>& report)
{
  std::map<Key, ConstraintKind> kinds;
  for (const ReportRow& line : report)
  {
    kinds[{ line.Row, line.Target }] = line.Kind;
  }
  return kinds;
}

struct Motion
{
  const Track* Path = nullptr;
  const MotionObject* Object = nullptr;
  std::vector<Vec3> Velocities, Accelerations;

  bool Has(int frame) const
  {
    return frame >= 0 && frame < static_cast<int>(this->Path->Positions.size());
  }
};

/// The largest at the frames of a row of a positional kind.
double DistanceToPositions(const Constraint& row, const Motion& motion,
                           const ObstacleSet& obstacles)
{
  const std::vector<Vec3>& path = motion.Path->Positions;
  double worst = 0.0;
  const int last = std::min(LastFrame(row), static_cast<int>(path.size()) - 1);
  const double restHeight = motion.Object ? motion.Object->RestHeight : 0.0;
  CarriedPlace wanted;
  if (!WantedPlace(row, restHeight, obstacles, wanted))
  {
    return Nowhere;
  }
  for (int f = row.Frame; f <= last; ++f)
  {
    const double distance = (path[f] - wanted.At(f)).norm();
    worst = distance <= worst ? worst : distance; // keeps NaN
  }
  return worst;
}

/// From what is wanted of the path at the row's frames, in the kind's unit.
double Distance(const Constraint& row, const Motion& motion, const ObstacleSet& obstacles)
{
  if (!motion.Has(row.Frame))
  {
    return Nowhere;
  }
  switch (row.Kind)
  {
    case ConstraintKind::Position:
    case ConstraintKind::Rest:
      return DistanceToPositions(row, motion, obstacles);
    case ConstraintKind::Velocity:
      return (motion.Velocities[row.Frame] - row.Value).norm();
    case ConstraintKind::Acceleration:
      return (motion.Accelerations[row.Frame] - row.Value).norm();
    case ConstraintKind::Orientation:
      break; // of poses
  }
  return Nowhere;
}

} // namespace

void MeasureResiduals(const std::vector<Constraint>& constraints, const std::vector<Track>& tracks,
                      const std::vector<MotionObject>& objects, const ObstacleSet& obstacles,
                      const SceneInfo& scene, std::vector<ReportRow>& report)
{
  const double step = scene.Time.Step();
  std::map<int, Motion> motions;
  MotionScales scales{ scene.Bounds.Width(), 0.0, scene.Time.FramesPerSecond };
  for (const Track& track : tracks)
  {
    Motion motion{ &track, nullptr, CentralVelocities(track, step), {} };
    motion.Accelerations = CentralDifferences(
      motion.Velocities, step, static_cast<std::size_t>(track.FirstPresent), track.EndPresent());
    for (const Vec3& v : motion.Velocities)
    {
      scales.TopSpeed = std::max(scales.TopSpeed, v.norm());
    }
    motions[track.ObjectId] = std::move(motion);
  }
  for (const MotionObject& object : objects)
  {
    const auto motion = motions.find(object.ObjectId);
    if (motion != motions.end())
    {
      motion->second.Object = &object;
    }
  }
  const std::map<Key, ConstraintKind> kinds = KindsOf(report);
  std::map<Key, Finding> findings;
  for (const Constraint& row : constraints)
  {
    const auto kind = kinds.find({ row.Row, row.Target });
    if (IsAttitude(row.Kind) || kind == kinds.end())
    {
      continue;
    }
    Finding& finding = findings[kind->first];
    finding.ObjectId = row.ObjectId;
    finding.Release = row.Release;
    finding.Leave = row.Leave;
    if (row.ObjectId < 0)
    {
      finding.Message = "no object was assigned to it";
      finding.Excess = Nowhere;
      double nearest = Nowhere;
      for (const auto& [objectId, motion] : motions)
      {
        nearest =
          IsPositional(row.Kind) ? std::min(nearest, Distance(row, motion, obstacles)) : nearest;
      }
      if (nearest < Nowhere && row.Kind == kind->second)
      {
        finding.Residual = std::max(finding.Residual, BeyondRadius(row, nearest));
        finding.Message += ", the nearest comes within " + NumberText(finding.Residual, 3) + " m";
      }
      continue;
    }
    const auto motion = motions.find(row.ObjectId);
    if (motion == motions.end() || !motion->second.Has(row.Frame))
    {
      finding.Message = "object " + std::to_string(row.ObjectId) + " has no position at frame " +
                        std::to_string(row.Frame);
      finding.Excess = Nowhere;
      continue;
    }
    Record(row, kind->second, Distance(row, motion->second, obstacles),
           ToleranceOf(row.Kind, scales), finding);
  }
  Apply(findings, report);
}

void MeasureOrientationResiduals(const std::vector<Constraint>& constraints,
                                 const std::vector<PoseTrack>& poses,
                                 std::vector<ReportRow>& report)
{
  const std::map<Key, ConstraintKind> kinds = KindsOf(report);
  std::map<Key, Finding> findings;
  for (const Constraint& row : constraints)
  {
    const auto kind = kinds.find({ row.Row, row.Target });
    if (!IsAttitude(row.Kind) || kind == kinds.end())
    {
      continue;
    }
    Finding& finding = findings[kind->first];
    double angle = Nowhere;
    for (const PoseTrack& pose : poses)
    {
      if (pose.ObjectId == row.ObjectId && row.Frame >= 0 &&
          row.Frame < static_cast<int>(pose.Orientations.size()))
      {
        angle = pose.Orientations[row.Frame].angularDistance(row.Orientation);
      }
    }
    Record(row, kind->second, angle, ToleranceOf(row.Kind, {}), finding);
  }
  Apply(findings, report);
}

} // namespace waft
