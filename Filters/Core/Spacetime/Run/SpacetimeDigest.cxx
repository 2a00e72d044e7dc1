// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeDigest.h"

#include "Particles/SphKernels.h"

#include <set>

namespace waft
{

namespace
{

void AddSurroundings(DigestStream& sum, const SpacetimeInput& input)
{
  sum.Values(input.Scene, input.Obstacles, input.Wind, input.Air);
}

// What a row asks of a path; attitudes, groups and classes are others' concern.
void AddConstraint(DigestStream& sum, const Constraint& c)
{
  sum.Values(c.ObjectId, c.Frame, c.Kind, c.Value, c.Radius, c.Until, c.TouchDown, c.Settled,
             c.LiftOff, c.Row, c.Target, c.Status);
}

void AddObject(DigestStream& sum, const MotionObject& o)
{
  sum.Values(o.ObjectId, o.SettlingSpeed, o.ClearanceRadius, o.RestHeight);
}

std::uint64_t DigestOfVortices(const std::vector<Vortex>& vortices, const std::set<int>& without)
{
  DigestStream sum;
  for (const Vortex& vortex : vortices)
  {
    if (without.count(vortex.VortexId) == 0)
    {
      sum.Values(vortex);
    }
  }
  return sum.Sum();
}

std::vector<std::uint64_t> DigestOfRequests(const SpacetimeInput& input,
                                            const SpacetimeSetup& setup)
{
  const SpacetimeModel& model = setup.Model;
  const std::size_t no = model.NumberOfObjects;
  std::vector<DigestStream> sums(model.Flags.size());
  for (std::size_t index = 0; index < sums.size(); ++index)
  {
    DigestStream& sum = sums[index];
    sum.Values(setup.Table.Planned[index], model.Flags[index], model.Reach[index],
               model.CoherenceFractions[index]);
    const std::vector<Vec3>& slips = input.Tracks[index % no].Slips;
    if (!slips.empty())
    {
      sum.Values(slips[index / no]);
    }
    const auto marks = model.Kept.MarkFrames(static_cast<int>(index / no), index % no);
    sum.Values(marks[0], marks[1]);
    if (model.Flags[index] & FixedPosition)
    {
      sum.Values(setup.ExactPositions[index]);
    }
  }
  for (const PositionBall& ball : setup.Table.Balls)
  {
    sums[static_cast<std::size_t>(ball.Frame) * no + ball.Object].Values(ball.Center, ball.Radius);
  }
  for (const DifferenceRow& row : setup.Table.Rows)
  {
    for (const DifferenceRow::Term& term : row.Terms)
    {
      sums[static_cast<std::size_t>(term.Frame) * no + row.Object].Values(term.Coefficient,
                                                                          row.Value, row.Radius);
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
  const std::string kernels = FastestSphKernels().Name;
  sum.Values(kernels);
  AddSurroundings(sum, input);
  SpacetimeOptions::VisitPhysics(sum, options);
  SpacetimeOptions::VisitSchedule(sum, options);
  for (const Track& track : input.Tracks)
  {
    sum.Values(track.ObjectId, track.Positions, track.VortexIds, track.Slips);
  }
  for (const MotionObject& object : input.Objects)
  {
    AddObject(sum, object);
    sum.Values(object.Position);
  }
  for (const Constraint& row : input.Constraints)
  {
    AddConstraint(sum, row);
  }
  sum.Values(input.Vortices);
  return sum.Sum();
}

ProblemDigest DigestOfProblem(const SpacetimeInput& input, const SpacetimeOptions& options,
                              const SpacetimeSetup& setup)
{
  ProblemDigest digest;
  DigestStream shape;
  const std::size_t particles = setup.Model.Offsets.size();
  shape.Values(setup.Model.Size, setup.Model.NumberOfFrames, setup.Origin, setup.Spacing,
               setup.FrameStep, setup.Model.NumberOfGas, setup.Model.NumberOfObjects, particles,
               setup.Model.WindNodes);
  DigestStream physics;
  AddSurroundings(physics, input);
  SpacetimeOptions::VisitPhysics(physics, options);
  for (const MotionObject& object : setup.Objects)
  {
    shape.Values(object.ObjectId);
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
  digest.Requests = DigestOfRequests(input, setup);
  return digest;
}

} // namespace waft
