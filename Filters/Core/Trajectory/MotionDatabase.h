// SPDX-License-Identifier: BSD-3-Clause
// The motion database: compressed trajectory segments, the trees that order them, and which may
// follow which (Shi et al. 2005, section 3.2).
#pragma once

#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace waft
{

/// Segments of one length. A segment's samples are Mean + Basis * coefficients, as x0 y0 z0 x1 y1
/// z1 ...
struct SegmentGroup
{
  int NumberOfSamples = 0;    // one a frame, both ends included
  Eigen::VectorXd Mean;       // [3 NumberOfSamples], m
  Eigen::MatrixXd Basis;      // [3 NumberOfSamples x rank], orthonormal columns
  double RelativeError = 0.0; // rms of what the truncated basis leaves out over rms of the segments

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.NumberOfSamples...);
    visit(of.Mean...);
    visit(of.Basis...);
    visit(of.RelativeError...);
  }
};

/// One piece of a traced trajectory in a frame of its own: the first sample at the origin, the
/// initial horizontal velocity along +x, z up.
struct Segment
{
  int Group = 0;
  int Simulation = 0;                // which run it was traced in
  Eigen::VectorXd Coefficients;      // [rank of its group]
  std::vector<ForceType> ForceTypes; // one a sample
  std::vector<int> VortexIds;        // one a sample: index into MotionDatabase::Vortices, -1 none
  Vec3 MeanWind = Vec3::Zero();      // mean wind acceleration along it, in its frame [m/s^2]

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Group...);
    visit(of.Simulation...);
    visit(of.Coefficients...);
    visit(of.ForceTypes...);
    visit(of.VortexIds...);
    visit(of.MeanWind...);
  }
};

/// A node of a tree-structured vector quantiser. A leaf holds exactly one segment.
struct ClusterNode
{
  int Parent = -1; // -1: one of the initial clusters of its group (the top level)
  int Group = 0;
  int Medoid = 0;      // representative: index of the real segment nearest to the mean
  int FirstChild = -1; // -1: a leaf; children are consecutive
  int NumberOfChildren = 0;
  int NumberOfSegments = 1;
  double Radius = 0.0; // largest distance of a member to the medoid, in coefficients [m]

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Parent...);
    visit(of.Group...);
    visit(of.Medoid...);
    visit(of.FirstChild...);
    visit(of.NumberOfChildren...);
    visit(of.NumberOfSegments...);
    visit(of.Radius...);
  }
};

/// How well the head window of one top-level representative continues the tail window of another
/// (Eq. 1): the table is directional. The best rigid motion maps the second's frame into the
/// first's.
struct Connection
{
  double Cost = 0.0; // residual rms over window chord; larger than the threshold: not connectible
  Quat Rotation = Quat::Identity();
  Vec3 Translation = Vec3::Zero();
  bool IsConnectible = false;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Cost...);
    visit(of.Rotation...);
    visit(of.Translation...);
    visit(of.IsConnectible...);
  }
};

struct MotionDatabase
{
  double FramesPerSecond = 30.0;
  Box Volume;                 // of the simulations it was traced in
  int Window = 6;             // samples that consecutive segments overlap in
  double SettlingSpeed = 0.0; // with which the tracers fell [m/s]
  double TopSpeed = 0.0;      // fastest speed between two samples of any segment [m/s]
  std::vector<SegmentGroup> Groups;
  std::vector<Segment> Segments;
  std::vector<ClusterNode> Nodes; // top-level nodes come first
  std::vector<int> TopNodes; // indices of the nodes without a parent, in the order of the table
  std::vector<Connection> Connections; // [TopNodes x TopNodes], row: the one that comes first
  std::vector<Vortex> Vortices; // in the frame of their segment, CenterTime from its first sample
  std::map<std::string, std::string> Provenance; // seeds, grid, versions, parameters

  const Connection& At(std::size_t before, std::size_t after) const
  {
    return this->Connections[before * this->TopNodes.size() + after];
  }
  /// Positions of a segment in its own frame, NumberOfSamples of its group.
  std::vector<Vec3> Reconstruct(int segment) const;
  /// The same in a volume so many times as wide, in the same time: lengths, speeds and
  /// accelerations are so many times as large.
  MotionDatabase Scaled(double factor) const;
  /// Indices in range, sizes in agreement, every number finite, at least one segment.
  Result Validate() const;

  /// All that paths are planned with: every member but the Provenance.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.FramesPerSecond...);
    visit(of.Volume...);
    visit(of.Window...);
    visit(of.SettlingSpeed...);
    visit(of.TopSpeed...);
    visit(of.Groups...);
    visit(of.Segments...);
    visit(of.Nodes...);
    visit(of.TopNodes...);
    visit(of.Connections...);
    visit(of.Vortices...);
  }
};

} // namespace waft
