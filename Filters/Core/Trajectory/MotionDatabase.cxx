// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/MotionDatabase.h"

#include <cmath>

namespace waft
{

namespace
{

Result Wrong(const std::string& what)
{
  return Result::Error("motion database: " + what);
}

std::string Name(const char* kind, std::size_t index)
{
  return std::string(kind) + " " + std::to_string(index);
}

bool InRange(int index, std::size_t size)
{
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

Result CheckGroups(const MotionDatabase& database)
{
  for (std::size_t g = 0; g < database.Groups.size(); ++g)
  {
    const SegmentGroup& group = database.Groups[g];
    const Eigen::Index size = 3 * static_cast<Eigen::Index>(group.NumberOfSamples);
    if (group.NumberOfSamples < 2 || group.NumberOfSamples < database.Window)
    {
      return Wrong(Name("group", g) + " has fewer samples than the window");
    }
    if (group.Mean.size() != size || group.Basis.rows() != size)
    {
      return Wrong(Name("group", g) + ": mean and basis do not have 3 rows a sample");
    }
    if (!group.Mean.allFinite() || !group.Basis.allFinite() || !std::isfinite(group.RelativeError))
    {
      return Wrong(Name("group", g) + " holds a number that is not finite");
    }
  }
  return Result::Ok();
}

Result CheckSegments(const MotionDatabase& database)
{
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    const Segment& segment = database.Segments[s];
    if (!InRange(segment.Group, database.Groups.size()))
    {
      return Wrong(Name("segment", s) + " names a group that is not there");
    }
    const SegmentGroup& group = database.Groups[segment.Group];
    if (segment.Coefficients.size() != group.Basis.cols())
    {
      return Wrong(Name("segment", s) + ": coefficients do not match the basis of its group");
    }
    if (!segment.Coefficients.allFinite() || !segment.MeanWind.allFinite())
    {
      return Wrong(Name("segment", s) + " holds a number that is not finite");
    }
    const auto samples = static_cast<std::size_t>(group.NumberOfSamples);
    if (segment.ForceTypes.size() != samples || segment.VortexIds.size() != samples)
    {
      return Wrong(Name("segment", s) + ": annotation does not have one entry a sample");
    }
    for (const int id : segment.VortexIds)
    {
      if (id != -1 && !InRange(id, database.Vortices.size()))
      {
        return Wrong(Name("segment", s) + " names a vortex that is not there");
      }
    }
  }
  return Result::Ok();
}

Result CheckNode(const MotionDatabase& database, std::size_t n, std::vector<int>& leaves)
{
  const ClusterNode& node = database.Nodes[n];
  if (!InRange(node.Group, database.Groups.size()) ||
      !InRange(node.Medoid, database.Segments.size()) ||
      database.Segments[node.Medoid].Group != node.Group)
  {
    return Wrong(Name("node", n) + ": its group and its medoid do not agree");
  }
  if (node.Parent != -1 && !InRange(node.Parent, n))
  {
    return Wrong(Name("node", n) + " does not come after its parent");
  }
  if (!std::isfinite(node.Radius))
  {
    return Wrong(Name("node", n) + " holds a number that is not finite");
  }
  if (node.FirstChild == -1)
  {
    ++leaves[node.Medoid];
    return node.NumberOfSegments == 1 ? Result::Ok()
                                      : Wrong(Name("node", n) + " is a leaf of several segments");
  }
  if (node.NumberOfChildren < 1 || node.FirstChild <= static_cast<int>(n) ||
      static_cast<std::size_t>(node.FirstChild) + node.NumberOfChildren > database.Nodes.size())
  {
    return Wrong(Name("node", n) + ": its children are not there");
  }
  long long segments = 0; // of any numbers that a file may hold
  for (int c = 0; c < node.NumberOfChildren; ++c)
  {
    const ClusterNode& child = database.Nodes[node.FirstChild + c];
    segments += child.NumberOfSegments;
    if (child.Parent != static_cast<int>(n) || child.Group != node.Group)
    {
      return Wrong(Name("node", n) + ": a child has another parent or group");
    }
  }
  return segments == node.NumberOfSegments
           ? Result::Ok()
           : Wrong(Name("node", n) + ": its children do not hold its segments");
}

Result CheckNodes(const MotionDatabase& database)
{
  std::vector<int> leaves(database.Segments.size(), 0);
  std::size_t top = 0;
  for (std::size_t n = 0; n < database.Nodes.size(); ++n)
  {
    if (Result result = CheckNode(database, n, leaves); !result)
    {
      return result;
    }
    if (database.Nodes[n].Parent == -1)
    {
      if (top >= database.TopNodes.size() || database.TopNodes[top] != static_cast<int>(n))
      {
        return Wrong("the list of top nodes does not name " + Name("node", n));
      }
      ++top;
    }
  }
  if (top != database.TopNodes.size())
  {
    return Wrong("the list of top nodes names nodes that have a parent");
  }
  for (std::size_t s = 0; s < leaves.size(); ++s)
  {
    if (leaves[s] != 1)
    {
      return Wrong(Name("segment", s) + " is in " + std::to_string(leaves[s]) +
                   " leaves, expected one");
    }
  }
  return Result::Ok();
}

Result CheckRest(const MotionDatabase& database)
{
  if (database.Connections.size() != database.TopNodes.size() * database.TopNodes.size())
  {
    return Wrong("the connection table does not have one entry per pair of top nodes");
  }
  for (const Connection& connection : database.Connections)
  {
    if (!std::isfinite(connection.Cost) || !connection.Rotation.coeffs().allFinite() ||
        !connection.Translation.allFinite())
    {
      return Wrong("the connection table holds a number that is not finite");
    }
  }
  for (std::size_t v = 0; v < database.Vortices.size(); ++v)
  {
    const Vortex& vortex = database.Vortices[v];
    if (!vortex.P1.allFinite() || !vortex.P2.allFinite() || !std::isfinite(vortex.Strength) ||
        !std::isfinite(vortex.CenterTime) || !(vortex.Duration > 0.0) || !(vortex.CoreRadius > 0.0))
    {
      return Wrong(Name("vortex", v) + " has parameters out of range");
    }
  }
  return Result::Ok();
}

} // namespace

std::vector<Vec3> MotionDatabase::Reconstruct(int segment) const
{
  const Segment& source = this->Segments[segment];
  const SegmentGroup& group = this->Groups[source.Group];
  const Eigen::VectorXd samples = group.Mean + group.Basis * source.Coefficients;
  std::vector<Vec3> positions(group.NumberOfSamples);
  for (int i = 0; i < group.NumberOfSamples; ++i)
  {
    positions[i] = samples.segment<3>(3 * i);
  }
  return positions;
}

MotionDatabase MotionDatabase::Scaled(double factor) const
{
  MotionDatabase scaled = *this;
  scaled.Volume.Min *= factor;
  scaled.Volume.Max *= factor;
  scaled.SettlingSpeed *= factor;
  scaled.TopSpeed *= factor;
  for (SegmentGroup& group : scaled.Groups)
  {
    group.Mean *= factor;
  }
  for (Segment& segment : scaled.Segments)
  {
    segment.Coefficients *= factor;
    segment.MeanWind *= factor;
  }
  for (ClusterNode& node : scaled.Nodes)
  {
    node.Radius *= factor;
  }
  for (Connection& connection : scaled.Connections)
  {
    connection.Translation *= factor;
  }
  for (Vortex& vortex : scaled.Vortices)
  {
    vortex.P1 *= factor;
    vortex.P2 *= factor;
    vortex.CoreRadius *= factor;
    vortex.Strength *= factor * factor;
  }
  return scaled;
}

Result MotionDatabase::Validate() const
{
  if (this->Segments.empty())
  {
    return Wrong("there is no segment in it");
  }
  if (!(this->FramesPerSecond > 0.0) || !std::isfinite(this->FramesPerSecond) || this->Window < 2 ||
      !std::isfinite(this->TopSpeed) || !std::isfinite(this->SettlingSpeed) ||
      !this->Volume.Min.allFinite() || !this->Volume.Max.allFinite())
  {
    return Wrong("frame rate, window, volume or speeds are out of range");
  }
  for (const auto check : { CheckGroups, CheckSegments, CheckNodes, CheckRest })
  {
    if (Result result = check(*this); !result)
    {
      return result;
    }
  }
  return Result::Ok();
}

} // namespace waft
