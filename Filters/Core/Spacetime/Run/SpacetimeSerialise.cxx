// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeSerialise.h"

namespace waft
{

void Serialise(StateArchive& stream, SpacetimeOptions& options)
{
  SpacetimeOptions::Visit(SerialiseFieldsWith(stream), options);
}

namespace
{

void Serialise(StateArchive& stream, ProblemDigest& digest)
{
  stream.Values(digest.Shape, digest.Physics, digest.Vortices, digest.SceneVortices);
  stream.List(digest.Requests);
}

} // namespace

void Serialise(StateArchive& stream, SpacetimeInput& input)
{
  Serialise(stream, static_cast<MotionProblem&>(input));
  Serialise(stream, input.Air);
}

void Serialise(StateArchive& stream, SpacetimeWarmStart& memory)
{
  Serialise(stream, memory.Digest);
  Serialise(stream, memory.State, 0, [] { return FramePartition(0); });
  stream.List(memory.Planned);
  stream.List(memory.Positions, [](StateArchive& s, std::vector<Vec3>& list) { s.List(list); });
}

} // namespace waft
