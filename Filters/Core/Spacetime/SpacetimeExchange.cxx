// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/SpacetimeExchange.h"

namespace waft
{

void Exchange(StateArchive& stream, Vortex& v)
{
  stream.Values(v.VortexId, v.P1, v.P2, v.Strength, v.CenterTime, v.Duration, v.CoreRadius,
                v.Confidence, v.ObjectCount);
}

void Exchange(StateArchive& stream, SplineWind& wind)
{
  stream.Values(wind.Dimensions[0], wind.Dimensions[1], wind.Dimensions[2], wind.Origin,
                wind.Spacing, wind.FramesPerKnot, wind.Drag);
  stream.List(wind.Knots, [](StateArchive& s, std::vector<float>& knot) { s.List(knot); });
}

void Exchange(StateArchive& stream, SpacetimeOptions& options)
{
  SpacetimeOptions::Visit(ExchangeFieldsWith(stream), options);
}

namespace
{

void ExchangeQuaternion(StateArchive& stream, Quat& q)
{
  stream.Values(q.w(), q.x(), q.y(), q.z());
}

void ExchangeTrack(StateArchive& stream, Track& track)
{
  stream.Value(track.ObjectId);
  for (auto* list : { &track.Positions, &track.SphVelocities, &track.VortexAccelerations,
                      &track.WindAccelerations, &track.Forces, &track.AirVelocities })
  {
    stream.List(*list);
  }
  stream.List(track.ForceTypes);
  stream.List(track.VortexIds);
}

void ExchangeObject(StateArchive& stream, MotionObject& o)
{
  stream.Values(o.ObjectId, o.ShapeId, o.ClassId, o.Mass, o.Position, o.Velocity, o.AngularVelocity,
                o.SettlingSpeed, o.ClearanceRadius, o.RestHeight);
  ExchangeQuaternion(stream, o.Orientation);
}

void ExchangeConstraint(StateArchive& stream, Constraint& c)
{
  stream.Values(c.ObjectId, c.Frame, c.Kind, c.Value, c.Radius, c.Until, c.Row, c.Target, c.Group,
                c.ClassId, c.Status);
  ExchangeQuaternion(stream, c.Orientation);
}

void ExchangeObstacle(StateArchive& stream, ObstacleMesh& obstacle)
{
  stream.Value(obstacle.ObstacleId);
  stream.List(obstacle.Mesh.Points);
  stream.List(obstacle.Mesh.Triangles);
  stream.List(obstacle.Offsets);
}

void ExchangeField(StateArchive& stream, FieldSeries& field)
{
  stream.Values(field.Meaning, field.Dimensions[0], field.Dimensions[1], field.Dimensions[2],
                field.Origin, field.Spacing);
  stream.List(field.Times);
  stream.List(field.Values,
              [](StateArchive& s, std::vector<std::array<float, 3>>& values) { s.List(values); });
}

void ExchangeDigest(StateArchive& stream, ProblemDigest& digest)
{
  stream.Values(digest.Shape, digest.Physics, digest.Vortices, digest.SceneVortices);
  stream.List(digest.Places);
}

} // namespace

void Exchange(StateArchive& stream, SpacetimeInput& input)
{
  SceneInfo& scene = input.Scene;
  stream.Values(scene.Bounds.Min, scene.Bounds.Max, scene.Time.NumberOfFrames,
                scene.Time.FramesPerSecond, scene.AirDensity, scene.Seed);
  stream.List(input.Tracks, ExchangeTrack);
  stream.List(input.Objects, ExchangeObject);
  stream.List(input.Constraints, ExchangeConstraint);
  stream.List(input.Obstacles, ExchangeObstacle);
  stream.List(input.Vortices, [](StateArchive& s, Vortex& v) { Exchange(s, v); });
  ExchangeField(stream, input.Wind);
  ExchangeField(stream, input.Air);
}

void Exchange(StateArchive& stream, SpacetimeMemory& memory)
{
  ExchangeDigest(stream, memory.Digest);
  stream.List(memory.State);
  stream.List(memory.Vortices, [](StateArchive& s, Vortex& v) { Exchange(s, v); });
  Exchange(stream, memory.Wind);
  stream.List(memory.Planned);
  stream.List(memory.Positions, [](StateArchive& s, std::vector<Vec3>& list) { s.List(list); });
  stream.Text(memory.Stage);
}

} // namespace waft
