// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeExchange.h"

namespace waft
{

void Exchange(StateArchive& stream, SpacetimeOptions& options)
{
  SpacetimeOptions::Visit(ExchangeFieldsWith(stream), options);
}

namespace
{

void ExchangeDigest(StateArchive& stream, ProblemDigest& digest)
{
  stream.Values(digest.Shape, digest.Physics, digest.Vortices, digest.SceneVortices);
  stream.List(digest.Requests);
}

} // namespace

void Exchange(StateArchive& stream, SpacetimeInput& input)
{
  Exchange(stream, static_cast<MotionProblem&>(input));
  Exchange(stream, input.Air);
}

void Exchange(StateArchive& stream, SpacetimeWarmStart& memory)
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
