// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/TrajectoryClusters.h"

#include "Base/FractionDone.h"
#include "Base/Random.h"
#include "Trajectory/Compression.h"
#include "Trajectory/ParameterText.h"
#include "Trajectory/SegmentFrame.h"
#include "Trajectory/TrackPieces.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{

namespace
{

struct Piece : TrackPiece
{
  int Simulation = 0;
};

Result CheckTrack(const Track& track, std::size_t simulation)
{
  const std::string location = "track of object " + std::to_string(track.ObjectId) +
                               " of simulation " + std::to_string(simulation) + ": ";
  const std::size_t count = track.Positions.size();
  for (const Vec3& position : track.Positions)
  {
    if (!position.allFinite())
    {
      return Result::Error(location + "a position is not finite");
    }
  }
  for (const std::size_t size :
       { track.ForceTypes.size(), track.VortexIds.size(), track.WindAccelerations.size() })
  {
    if (size != 0 && size != count)
    {
      return Result::Error(location + "the annotation does not have one entry a sample");
    }
  }
  return Result::Ok();
}

/// Keeps `count` of the pieces, each with equal chance, in their order.
void Thin(std::vector<Piece>& pieces, int count, std::uint64_t seed)
{
  if (count <= 0 || pieces.size() <= static_cast<std::size_t>(count))
  {
    return;
  }
  Random random(seed, 0x7417);
  std::vector<std::size_t> order(pieces.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  for (int i = 0; i < count; ++i)
  {
    std::swap(order[i], order[i + random.Index(static_cast<std::uint32_t>(order.size() - i))]);
  }
  order.resize(count);
  std::sort(order.begin(), order.end());
  std::vector<Piece> kept;
  for (const std::size_t i : order)
  {
    kept.push_back(pieces[i]);
  }
  pieces = std::move(kept);
}

/// The segment of a piece, but for its group and coefficients; its vortices are added to the list.
Segment Annotated(const ClusterInput& input, const Piece& piece, const SegmentFrame& frame,
                  std::vector<Vortex>& vortices)
{
  const TracedSimulation& simulation = input.Simulations[piece.Simulation];
  const Track& track = simulation.Tracks[piece.Track];
  Segment segment;
  segment.Simulation = piece.Simulation;
  segment.ForceTypes.assign(piece.Range.Count, ForceType::None);
  segment.VortexIds.assign(piece.Range.Count, -1);
  std::map<int, int> stored; // VortexId of the run -> index in the list
  for (int i = 0; i < piece.Range.Count; ++i)
  {
    const int sample = piece.Range.First + i;
    if (!track.WindAccelerations.empty())
    {
      segment.MeanWind += track.WindAccelerations[sample] / piece.Range.Count;
    }
    if (!track.ForceTypes.empty())
    {
      segment.ForceTypes[i] = track.ForceTypes[sample];
    }
    if (track.VortexIds.empty() || segment.ForceTypes[i] != ForceType::Vortex)
    {
      continue;
    }
    const int id = track.VortexIds[sample];
    const auto found = stored.find(id);
    if (found != stored.end())
    {
      segment.VortexIds[i] = found->second;
      continue;
    }
    const auto vortex = std::find_if(simulation.Vortices.begin(), simulation.Vortices.end(),
                                     [id](const Vortex& v) { return v.VortexId == id; });
    if (id < 0 || vortex == simulation.Vortices.end())
    {
      continue;
    }
    segment.VortexIds[i] = stored[id] = static_cast<int>(vortices.size());
    vortices.push_back(LocalVortex(*vortex, frame, piece.Range.First / input.FramesPerSecond));
    vortices.back().VortexId = segment.VortexIds[i];
  }
  segment.MeanWind = frame.Rotation.conjugate() * segment.MeanWind;
  return segment;
}

/// Fills groups, segments and vortices; the trees read the coefficients. Ends early when asked to
/// stop.
std::vector<TreeInput> Compress(const ClusterInput& input, const std::vector<Piece>& pieces,
                                const std::vector<int>& lengths, double relativeError,
                                Monitor& monitor, MotionDatabase& database)
{
  std::vector<TreeInput> trees;
  for (std::size_t length = 0; length < lengths.size(); ++length)
  {
    if (!monitor.Tick(FractionDone(length, lengths.size()), "Compressing segments"))
    {
      return {};
    }
    std::vector<const Piece*> members;
    for (const Piece& piece : pieces)
    {
      if (piece.Length == static_cast<int>(length))
      {
        members.push_back(&piece);
      }
    }
    if (members.empty())
    {
      continue;
    }
    TreeInput tree;
    Eigen::MatrixXd samples(3 * lengths[length], static_cast<Eigen::Index>(members.size()));
    for (std::size_t m = 0; m < members.size(); ++m)
    {
      const Piece& piece = *members[m];
      const std::vector<Vec3> part = PositionsOf(input.Simulations[piece.Simulation].Tracks, piece);
      const SegmentFrame frame = FrameOf(part);
      samples.col(static_cast<Eigen::Index>(m)) = LocalSamples(part, frame);
      tree.Segments.push_back(static_cast<int>(database.Segments.size()));
      database.Segments.push_back(Annotated(input, piece, frame, database.Vortices));
      database.Segments.back().Group = static_cast<int>(database.Groups.size());
    }
    SegmentGroup group;
    tree.Coefficients = CompressSegments(samples, relativeError, group);
    for (std::size_t m = 0; m < members.size(); ++m)
    {
      database.Segments[tree.Segments[m]].Coefficients =
        tree.Coefficients.col(static_cast<Eigen::Index>(m));
    }
    database.Groups.push_back(std::move(group));
    trees.push_back(std::move(tree));
  }
  return trees;
}

double TopSpeedOf(const MotionDatabase& database)
{
  double longest = 0.0;
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    const std::vector<Vec3> positions = database.Reconstruct(static_cast<int>(s));
    for (std::size_t i = 0; i + 1 < positions.size(); ++i)
    {
      longest = std::max(longest, (positions[i + 1] - positions[i]).norm());
    }
  }
  return longest * database.FramesPerSecond;
}

} // namespace

Result ClusterOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(ValidateFields<ClusterOptions>(*this));
  if (this->Window > this->Segmentation.ShortestSegment)
  {
    return Result::Error("Window: expected 3 samples to those of the shortest segment");
  }
  for (const Result& result :
       { this->Segmentation.Validate(), this->Trees.Validate(), this->Connections.Validate() })
  {
    if (!result)
    {
      return result;
    }
  }
  return Result::Ok();
}

std::map<std::string, std::string> ParametersOf(const ClusterOptions& options)
{
  std::map<std::string, std::string> p;
  const auto add = [&p](const OptionField& field, const auto& value)
  {
    if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
    {
      p[field.Name] = ToString(value);
    }
    else
    {
      p[field.Name] = ParameterText(value);
    }
  };
  const SegmentationOptions& cuts = options.Segmentation;
  SegmentationOptions::Visit(add, cuts);
  p.erase("ShortestSegment");
  p.erase("LongestSegment");
  p["SegmentLengths"] = ParameterText(cuts.ShortestSegment, cuts.LongestSegment);
  ClusterOptions::Visit(add, options);
  ClusterTreeOptions::Visit(add, options.Trees);
  ConnectionOptions::Visit(add, options.Connections);
  return p;
}

Result ClusterTrajectories(const ClusterInput& input, const ClusterOptions& options,
                           const ParallelFor& parallelFor, Monitor& monitor,
                           MotionDatabase& database)
{
  if (Result result = options.Validate(); !result)
  {
    return result;
  }
  if (!(input.FramesPerSecond > 0.0))
  {
    return Result::Error("FramesPerSecond: expected a positive number");
  }
  const std::vector<int> lengths = GroupLengths(options.Segmentation);
  std::vector<Piece> pieces;
  for (std::size_t s = 0; s < input.Simulations.size(); ++s)
  {
    if (!monitor.Tick(0.3 * FractionDone(s, input.Simulations.size()), "Cutting trajectories"))
    {
      return Result::Stopped();
    }
    for (const Track& track : input.Simulations[s].Tracks)
    {
      if (Result result = CheckTrack(track, s); !result)
      {
        return result;
      }
    }
    for (const TrackPiece& piece : CutTracks(input.Simulations[s].Tracks, input.FramesPerSecond,
                                             input.Volume.Width(), options.Segmentation, lengths))
    {
      pieces.push_back({ piece, static_cast<int>(s) });
    }
  }
  if (pieces.empty())
  {
    return Result::Error("tracks: none has " + std::to_string(lengths.front()) +
                         " samples that move, the shortest segment (ShortestSegment): give each "
                         "simulation more frames (NumberOfFrames) or a finer grid (Resolution)");
  }
  Thin(pieces, options.MaximumSegments, options.Trees.Seed);

  MotionDatabase result;
  result.FramesPerSecond = input.FramesPerSecond;
  result.Volume = input.Volume;
  result.Window = options.Window;
  result.SettlingSpeed = input.SettlingSpeed;
  PartMonitor compressing(monitor, 0.3, 0.4);
  const std::vector<TreeInput> trees =
    Compress(input, pieces, lengths, options.RelativeError, compressing, result);
  if (trees.empty())
  {
    return Result::Stopped();
  }
  result.TopSpeed = TopSpeedOf(result);

  PartMonitor clustering(monitor, 0.4, 0.8);
  Result done =
    BuildClusterTrees(trees, options.Trees, parallelFor, clustering, result.Nodes, result.TopNodes);
  if (!done || done.IsStopped())
  {
    return done;
  }
  PartMonitor connecting(monitor, 0.8, 1.0);
  done = BuildConnectionTable(options.Connections, parallelFor, connecting, result);
  if (!done || done.IsStopped())
  {
    return done;
  }
  result.Provenance = ParametersOf(options);
  database = std::move(result);
  return Result::Ok();
}

} // namespace waft
