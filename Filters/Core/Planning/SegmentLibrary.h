// SPDX-License-Identifier: BSD-3-Clause
// The motion database as the planner uses it: samples at the scene's frame rate, and for each
// top-level representative which others may follow or precede it, with their end points in closed
// form.
#pragma once

#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Trajectory/Alignment.h"
#include "Trajectory/MotionDatabase.h"

#include <vector>

namespace waft
{

/// How much faster than the database a step may be, of the 1.5 times that are promised.
constexpr double SpeedAllowance = 1.4;

/// Where a segment's frame stands: world = Rotation * local + Translation.
struct Placement
{
  Mat3 Rotation = Mat3::Identity();
  Vec3 Translation = Vec3::Zero();

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Rotation...);
    visit(of.Translation...);
  }

  Vec3 operator*(const Vec3& x) const { return this->Rotation * x + this->Translation; }
  Placement operator*(const Placement& other) const
  {
    return { this->Rotation * other.Rotation,
             this->Rotation * other.Translation + this->Translation };
  }
  Placement Inverse() const
  {
    return { this->Rotation.transpose(), -(this->Rotation.transpose() * this->Translation) };
  }
};

/// A neighbour that fits at one end of a segment, placed in that segment's frame.
struct Neighbour
{
  int Top = 0;          // index in MotionDatabase::TopNodes
  double Cost = 0.0;    // residual rms over window chord (Eq. 1)
  bool IsSmooth = true; // within the threshold; the others serve where no smooth way is found
  Placement Transform;
  Vec3 FreeEnd = Vec3::Zero(); // its other end, in the frame of the segment it is attached to
};

struct SegmentLibraryOptions
{
  double FramesPerSecond = 30.0; // of the scene
  double Scale = 1.0;            // of the database's lengths
  RotationFreedom Freedom = RotationFreedom::YawAndTilt;
  double MaximumTilt = DefaultMaxTilt; // rad
  double MaximumConnectionCost = 0.06; // above it two representatives do not connect smoothly
  int MinimumNumberOfNeighbours = 10;  // the best ones count as smooth even above that cost
  double RoughConnectionFactor = 2.5;  // up to this times that cost they connect roughly
};

/// Mean step to and from a sample (one-sided at the ends) [m per frame].
Vec3 CentralStep(const std::vector<Vec3>& samples, int k);

class SegmentLibrary
{
public:
  Result Build(const MotionDatabase& database, const SegmentLibraryOptions& options,
               const ParallelFor& parallelFor);

  const MotionDatabase& Database() const { return *this->Source; }
  const SegmentLibraryOptions& Options() const { return this->Settings; }
  /// Samples that consecutive segments have in common, at the scene's frame rate (at least 3).
  int Window() const { return this->WindowSamples; }
  /// Flights of fewer frames are drawn, not searched.
  int ShortestSpan() const { return this->WindowSamples + 2; }
  /// Positions of a segment in its own frame, one a frame of the scene [m].
  const std::vector<Vec3>& Samples(int segment) const { return this->AllSamples[segment]; }
  int NumberOfTops() const { return static_cast<int>(this->Tops.size()); }
  int SegmentOfTop(int top) const { return this->Tops[top]; }
  const std::vector<Neighbour>& Successors(int top) const { return this->After[top]; }
  const std::vector<Neighbour>& Predecessors(int top) const { return this->Before[top]; }
  /// The entry of Successors(before) for `after`, or null.
  const Neighbour* Connection(int before, int after) const;
  /// Median distance from frame to frame over the representatives [m].
  double TypicalStep() const { return this->MedianStep; }
  /// Largest distance from frame to frame in the database [m].
  double TopStep() const { return this->LargestStep; }
  /// Largest third difference from sample to sample in the database: what the acceleration of air
  /// changes by [m per frame^3].
  double TopJerk() const { return this->LargestJerk; }
  int LongestSegment() const { return this->Longest; }
  /// Turns a rotation that leans beyond the limit of the options back to the limit.
  void LimitTilt(Mat3& rotation) const;
  /// Annotation of a sample (nearest sample of the database).
  int DatabaseSample(int segment, int sample) const;

private:
  void ConnectTops(const ParallelFor& parallelFor);

  const MotionDatabase* Source = nullptr;
  SegmentLibraryOptions Settings;
  int WindowSamples = 6;
  double MedianStep = 0.0;
  double LargestStep = 0.0;
  double LargestJerk = 0.0;
  int Longest = 0;
  std::vector<std::vector<Vec3>> AllSamples;
  std::vector<int> Tops; // segment of each top-level node
  std::vector<std::vector<Neighbour>> After;
  std::vector<std::vector<Neighbour>> Before;
  std::vector<int> Lookup; // [before * tops + after]: index in After[before], or -1
};

} // namespace waft
