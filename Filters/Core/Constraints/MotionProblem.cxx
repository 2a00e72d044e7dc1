// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/MotionProblem.h"

#include <string>

namespace waft
{
namespace
{

void SerialiseQuaternion(StateArchive& stream, Quat& q)
{
  stream.Values(q.w(), q.x(), q.y(), q.z());
}

template <class T>
void SerialiseList(StateArchive& stream, std::vector<T>& list)
{
  stream.List(list, [](StateArchive& s, T& element) { Serialise(s, element); });
}

} // namespace

Result CheckTracks(const MotionProblem& problem, int leastFrames)
{
  if (problem.Tracks.empty())
  {
    return Result::Error("Tracks: no track, at least one expected");
  }
  const int frames = problem.Scene.Time.NumberOfFrames;
  if (frames < leastFrames)
  {
    return Result::Error("NumberOfFrames: at least " + std::to_string(leastFrames) +
                         " expected, found " + std::to_string(frames));
  }
  for (const Track& track : problem.Tracks)
  {
    const std::string name = "Tracks, object " + std::to_string(track.ObjectId);
    if (track.Positions.size() != static_cast<std::size_t>(frames))
    {
      return Result::Error(name + ": " + std::to_string(track.Positions.size()) +
                           " points, one a frame (" + std::to_string(frames) + ") expected");
    }
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      if (!track.Positions[k].allFinite())
      {
        return Result::Error(name + ": not a finite position at frame " + std::to_string(k));
      }
    }
  }
  return Result::Ok();
}

void Serialise(StateArchive& stream, Track& track)
{
  stream.Value(track.ObjectId);
  for (auto* list :
       { &track.Positions, &track.SphVelocities, &track.VortexAccelerations,
         &track.WindAccelerations, &track.Forces, &track.AirVelocities, &track.Residuals })
  {
    stream.List(*list);
  }
  stream.List(track.ForceTypes);
  stream.List(track.VortexIds);
}

void Serialise(StateArchive& stream, ReportRow& line)
{
  stream.Values(line.Row, line.Target, line.ObjectId, line.Frame, line.Kind, line.Residual,
                line.Status);
  stream.Text(line.Message);
}

void Serialise(StateArchive& stream, Vortex& v)
{
  stream.Values(v.VortexId, v.P1, v.P2, v.Strength, v.CenterTime, v.Duration, v.CoreRadius,
                v.Confidence, v.ObjectCount);
}

void Serialise(StateArchive& stream, AnalyticWind& w)
{
  stream.Values(w.Direction, w.Strength, w.Center, w.Radius, w.CenterTime, w.Duration);
}

void Serialise(StateArchive& stream, FieldSeries& field)
{
  stream.Values(field.Meaning, field.Dimensions[0], field.Dimensions[1], field.Dimensions[2],
                field.Origin, field.Spacing);
  stream.List(field.Times);
  stream.List(field.Values,
              [](StateArchive& s, std::vector<std::array<float, 3>>& values) { s.List(values); });
}

void Serialise(StateArchive& stream, Constraint& c)
{
  stream.Values(c.ObjectId, c.Frame, c.Kind, c.Value, c.Radius, c.Until, c.TouchDown, c.LiftOff,
                c.Row, c.Target, c.Group, c.ClassId, c.Status);
  SerialiseQuaternion(stream, c.Orientation);
}

void Serialise(StateArchive& stream, MotionObject& o)
{
  stream.Values(o.ObjectId, o.ShapeId, o.ClassId, o.Mass, o.Position, o.Velocity, o.VelocityGiven,
                o.AngularVelocity, o.SettlingSpeed, o.ClearanceRadius, o.RestHeight);
  SerialiseQuaternion(stream, o.Orientation);
}

void Serialise(StateArchive& stream, ObstacleMesh& obstacle)
{
  stream.Value(obstacle.ObstacleId);
  stream.List(obstacle.Mesh.Points);
  stream.List(obstacle.Mesh.Triangles);
  stream.List(obstacle.Offsets);
}

void Serialise(StateArchive& stream, MotionProblem& problem)
{
  SceneInfo& scene = problem.Scene;
  stream.Values(scene.Bounds.Min, scene.Bounds.Max, scene.Time.NumberOfFrames,
                scene.Time.FramesPerSecond, scene.AirDensity, scene.Seed);
  SerialiseList(stream, problem.Tracks);
  SerialiseList(stream, problem.Objects);
  SerialiseList(stream, problem.Constraints);
  SerialiseList(stream, problem.Obstacles);
  SerialiseList(stream, problem.Vortices);
  Serialise(stream, problem.Wind);
}

} // namespace waft
