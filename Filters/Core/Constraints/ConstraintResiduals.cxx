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

/// The worst that was found about one line.
struct Finding
{
  double Residual = 0.0; // of constraints of the line's own kind
  double Excess = 0.0;   // residual over tolerance, of any kind
  std::string Message;
  int ObjectId = -1;
};

const char* UnitOf(ConstraintKind kind)
{
  switch (kind)
  {
    case ConstraintKind::Velocity:
      return "m/s";
    case ConstraintKind::Acceleration:
      return "m/s^2";
    case ConstraintKind::Orientation:
      return "rad";
    default:
      return "m";
  }
}

/// A distance that is no number is as far as can be.
double BeyondRadius(const Constraint& row, double distance)
{
  return std::isfinite(distance)
           ? std::max(0.0, distance - (row.Kind == ConstraintKind::Rest ? 0.0 : row.Radius))
           : std::numeric_limits<double>::infinity();
}

void Note(const Constraint& row, ConstraintKind kindOfLine, double distance, double tolerance,
          Finding& finding)
{
  const double residual = BeyondRadius(row, distance);
  finding.ObjectId = row.ObjectId;
  if (row.Kind == kindOfLine)
  {
    finding.Residual = std::max(finding.Residual, residual);
  }
  if (residual > tolerance && residual / tolerance > finding.Excess)
  {
    char text[160];
    std::snprintf(text, sizeof(text), "%s at frame %d: missed by %.4g %s, expected at most %.2g %s",
                  ToString(row.Kind), row.Frame, residual, UnitOf(row.Kind), tolerance,
                  UnitOf(row.Kind));
    finding.Excess = residual / tolerance;
    finding.Message = text;
  }
}

void Tell(ReportRow& line, const std::string& message)
{
  line.Message += (line.Message.empty() ? "" : "; ") + message;
}

bool IsPlace(ConstraintKind kind)
{
  return kind == ConstraintKind::Position || kind == ConstraintKind::Rest;
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
    if (line.Status == ConstraintStatus::Met && !found->second.Message.empty())
    {
      line.Status = ConstraintStatus::Unreachable;
      Tell(line, found->second.Message);
    }
    else if (line.Status == ConstraintStatus::Unreachable && IsPlace(line.Kind))
    {
      Tell(line, "it comes within " + NumberText(line.Residual, 3) + " m");
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

double DistanceToRest(const Constraint& row, const Track& track, const MotionObject* object,
                      const ObstacleSet& obstacles)
{
  Vec3 place;
  SurfaceHit hit;
  if (!RestingPlace(obstacles, row.Value, row.Frame, object ? object->RestHeight : 0.0, place, hit))
  {
    return std::numeric_limits<double>::infinity();
  }
  double worst = 0.0;
  const int last = std::min(row.Until, static_cast<int>(track.Positions.size()) - 1);
  for (int f = row.Frame; f <= last; ++f)
  {
    const double distance = (track.Positions[f] - place).norm();
    worst = distance <= worst ? worst : distance; // keeps NaN
  }
  return worst;
}

} // namespace

void MeasureResiduals(const std::vector<Constraint>& constraints, const std::vector<Track>& tracks,
                      const std::vector<MotionObject>& objects, const ObstacleSet& obstacles,
                      const SceneInfo& scene, std::vector<ReportRow>& report)
{
  struct Motion
  {
    const Track* Path = nullptr;
    std::vector<Vec3> Velocities, Accelerations;

    bool Has(int frame) const
    {
      return frame >= 0 && frame < static_cast<int>(this->Path->Positions.size());
    }
  };
  const double step = scene.Time.Step();
  std::map<int, Motion> motions;
  std::map<int, const MotionObject*> objectOf;
  for (const MotionObject& object : objects)
  {
    objectOf[object.ObjectId] = &object;
  }
  double topSpeed = 0.0;
  for (const Track& track : tracks)
  {
    Motion motion{ &track, CentralVelocities(track.Positions, step), {} };
    motion.Accelerations = CentralVelocities(motion.Velocities, step);
    for (const Vec3& v : motion.Velocities)
    {
      topSpeed = std::max(topSpeed, v.norm());
    }
    motions[track.ObjectId] = std::move(motion);
  }
  const auto distance = [&](const Constraint& row, const Motion& m, int objectId)
  {
    if (!m.Has(row.Frame))
    {
      return std::numeric_limits<double>::infinity();
    }
    return row.Kind == ConstraintKind::Position
             ? (m.Path->Positions[row.Frame] - row.Value).norm()
             : DistanceToRest(row, *m.Path, objectOf.count(objectId) ? objectOf[objectId] : nullptr,
                              obstacles);
  };
  const double nearness = 1e-9 * scene.Bounds.Width();
  const double slowness = std::max(1e-6 * topSpeed, 1e-12);
  const std::map<Key, ConstraintKind> kinds = KindsOf(report);
  std::map<Key, Finding> findings;
  for (const Constraint& row : constraints)
  {
    const auto kind = kinds.find({ row.Row, row.Target });
    if (row.Kind == ConstraintKind::Orientation || kind == kinds.end())
    {
      continue;
    }
    Finding& finding = findings[kind->first];
    finding.ObjectId = row.ObjectId;
    if (row.ObjectId < 0)
    {
      finding.Message = "no object was assigned to it";
      finding.Excess = std::numeric_limits<double>::infinity();
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& [objectId, m] : motions)
      {
        nearest = IsPlace(row.Kind) ? std::min(nearest, distance(row, m, objectId)) : nearest;
      }
      if (nearest < std::numeric_limits<double>::infinity() && row.Kind == kind->second)
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
      finding.Excess = std::numeric_limits<double>::infinity();
      continue;
    }
    const Motion& m = motion->second;
    switch (row.Kind)
    {
      case ConstraintKind::Velocity:
        Note(row, kind->second, (m.Velocities[row.Frame] - row.Value).norm(), slowness, finding);
        break;
      case ConstraintKind::Acceleration:
        Note(row, kind->second, (m.Accelerations[row.Frame] - row.Value).norm(), slowness / step,
             finding);
        break;
      default:
        Note(row, kind->second, distance(row, m, row.ObjectId), nearness, finding);
    }
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
    if (row.Kind != ConstraintKind::Orientation || kind == kinds.end())
    {
      continue;
    }
    Finding& finding = findings[kind->first];
    double angle = std::numeric_limits<double>::infinity();
    for (const PoseTrack& pose : poses)
    {
      if (pose.ObjectId == row.ObjectId && row.Frame >= 0 &&
          row.Frame < static_cast<int>(pose.Orientations.size()))
      {
        angle = pose.Orientations[row.Frame].angularDistance(row.Orientation);
      }
    }
    Note(row, kind->second, angle, 1e-6, finding);
  }
  Apply(findings, report);
}

} // namespace waft
