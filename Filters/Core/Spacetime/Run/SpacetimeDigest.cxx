// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeDigest.h"

#include "Particles/SphKernels.h"

#include <set>

namespace waft
{

namespace
{

// A digest changes nothing of what it reads.
template <class T>
T& Read(const T& value)
{
  return const_cast<T&>(value);
}

void AddScene(DigestStream& sum, const SceneInfo& scene)
{
  SceneInfo s = scene;
  sum.Values(s.Bounds.Min, s.Bounds.Max, s.Time.NumberOfFrames, s.Time.FramesPerSecond,
             s.AirDensity, s.Seed);
}

void AddSurroundings(DigestStream& sum, const SpacetimeInput& input)
{
  for (const ObstacleMesh& obstacle : input.Obstacles)
  {
    sum.Value(Read(obstacle.ObstacleId));
    sum.List(Read(obstacle.Mesh.Points));
    sum.List(Read(obstacle.Mesh.Triangles));
    sum.List(Read(obstacle.Offsets));
  }
  for (FieldSeries* field : { &Read(input.Wind), &Read(input.Air) })
  {
    sum.Values(field->Meaning, field->Dimensions[0], field->Dimensions[1], field->Dimensions[2],
               field->Origin, field->Spacing);
    sum.List(field->Times);
    sum.List(field->Values,
             [](StateArchive& s, std::vector<std::array<float, 3>>& values) { s.List(values); });
  }
}

void AddConstraint(DigestStream& sum, const Constraint& row)
{
  Constraint c = row;
  sum.Values(c.ObjectId, c.Frame, c.Kind, c.Value, c.Radius, c.Until, c.TouchDown, c.LiftOff, c.Row,
             c.Target, c.Status);
}

void AddObject(DigestStream& sum, const MotionObject& object)
{
  MotionObject o = object;
  sum.Values(o.ObjectId, o.SettlingSpeed, o.ClearanceRadius, o.RestHeight);
}

std::uint64_t DigestOfVortices(const std::vector<Vortex>& vortices, const std::set<int>& without)
{
  DigestStream sum;
  for (const Vortex& vortex : vortices)
  {
    if (without.count(vortex.VortexId) == 0)
    {
      Serialise(sum, Read(vortex));
    }
  }
  return sum.Sum();
}

std::vector<std::uint64_t> DigestOfRequests(const SpacetimeSetup& setup)
{
  const SpacetimeModel& model = setup.Model;
  const std::size_t no = model.NumberOfObjects;
  std::vector<DigestStream> sums(model.Flags.size());
  for (std::size_t index = 0; index < sums.size(); ++index)
  {
    DigestStream& sum = sums[index];
    sum.Values(Read(setup.Table.Planned[index]), Read(model.Flags[index]), Read(model.Reach[index]),
               Read(model.CoherenceFractions[index]), Read(model.NearestMarks[index]));
    if (model.Flags[index] & FixedPosition)
    {
      sum.Value(Read(setup.ExactPositions[index]));
    }
  }
  for (const PositionBall& ball : setup.Table.Balls)
  {
    sums[static_cast<std::size_t>(ball.Frame) * no + ball.Object].Values(Read(ball.Center),
                                                                         Read(ball.Radius));
  }
  for (const DifferenceRow& row : setup.Table.Rows)
  {
    for (const DifferenceRow::Term& term : row.Terms)
    {
      sums[static_cast<std::size_t>(term.Frame) * no + row.Object].Values(
        Read(term.Coefficient), Read(row.Value), Read(row.Radius));
    }
  }
  std::vector<std::uint64_t> requests;
  for (const DigestStream& sum : sums)
  {
    requests.push_back(sum.Sum());
  }
  return requests;
}

} // namespace

std::uint64_t DigestOfRun(const SpacetimeInput& input, const SpacetimeOptions& options)
{
  DigestStream sum;
  std::string kernels = FastestSphKernels().Name;
  sum.Text(kernels);
  AddScene(sum, input.Scene);
  AddSurroundings(sum, input);
  SpacetimeOptions::VisitPhysics(SerialiseFieldsWith(sum), Read(options));
  SpacetimeOptions::VisitSchedule(SerialiseFieldsWith(sum), Read(options));
  for (const Track& track : input.Tracks)
  {
    sum.Value(Read(track.ObjectId));
    sum.List(Read(track.Positions));
    sum.List(Read(track.VortexIds));
  }
  for (const MotionObject& object : input.Objects)
  {
    AddObject(sum, object);
    sum.Value(Read(object.Position));
  }
  for (const Constraint& row : input.Constraints)
  {
    AddConstraint(sum, row);
  }
  for (const Vortex& vortex : input.Vortices)
  {
    Serialise(sum, Read(vortex));
  }
  return sum.Sum();
}

ProblemDigest DigestOfProblem(const SpacetimeInput& input, const SpacetimeOptions& options,
                              const SpacetimeSetup& setup)
{
  ProblemDigest digest;
  DigestStream shape;
  shape.Values(Read(setup.Model.Size), Read(setup.Model.NumberOfFrames), Read(setup.Origin),
               Read(setup.Spacing), Read(setup.FrameStep));
  std::uint64_t counts[3] = { setup.Model.NumberOfGas, setup.Model.NumberOfObjects,
                              setup.Model.Offsets.size() };
  shape.Values(counts[0], counts[1], counts[2]);
  DigestStream physics;
  AddScene(physics, input.Scene);
  AddSurroundings(physics, input);
  SpacetimeOptions::VisitPhysics(SerialiseFieldsWith(physics), Read(options));
  for (const MotionObject& object : setup.Objects)
  {
    shape.Value(Read(object.ObjectId));
    AddObject(physics, object);
  }
  std::set<int> claimed;
  for (const Track& track : input.Tracks)
  {
    claimed.insert(track.VortexIds.begin(), track.VortexIds.end());
  }
  digest.Shape = shape.Sum();
  digest.Physics = physics.Sum();
  digest.Vortices = DigestOfVortices(input.Vortices, {});
  digest.SceneVortices = DigestOfVortices(input.Vortices, claimed);
  digest.Requests = DigestOfRequests(setup);
  return digest;
}

} // namespace waft
