// SPDX-License-Identifier: BSD-3-Clause
// Cuts trajectories into motion units at samples of least curvature (Shi et al. 2005, section 3.2).
#pragma once

#include "Base/OptionFields.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <vector>

namespace waft
{

struct SegmentationOptions
{
  /// Lengths of segments, in samples, both ends included.
  int ShortestSegment = 12;
  int LongestSegment = 60;
  /// Lengths of the groups grow by about this ratio from the shortest to the longest; above 1.
  double LengthRatio = 1.5;
  /// A bend whose curvature peaks below this is no feature [1/m]; 0: four over the width of the
  /// volume.
  double FeatureCurvature = 0.0;
  /// Two bends are two features when the curvature between them falls to their lower peak over
  /// this; above 1.
  double FeatureContrast = 2.0;
  /// Slower segments are dead air and are left out: mean speed [m/s].
  double LeastSpeed = 0.02;

  Result Validate() const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "ShortestSegment", { 4, limits::Frames.High }, "frames", "Shortest segments, in frames." },
      of.ShortestSegment...);
    visit(OptionField{ "LongestSegment",
                       { 8, limits::Frames.High },
                       "frames",
                       "Longest segments, in frames; at least twice the shortest." },
          of.LongestSegment...);
    visit(OptionField{ "LengthRatio", limits::Above(1, 1e9), "",
                       "Lengths of the groups of segments grow by this ratio." },
          of.LengthRatio...);
    visit(OptionField{ "FeatureCurvature", limits::Factor, "1/m",
                       "Bends that peak below this curvature are no features, in 1/m; 0: four over "
                       "the width of the volume." },
          of.FeatureCurvature...);
    visit(
      OptionField{
        "FeatureContrast", limits::Above(1, 1e9), "",
        "Two bends part where the curvature between them falls to the lower peak over this." },
      of.FeatureContrast...);
    visit(
      OptionField{
        "LeastSpeed", limits::Factor, "m/s",
        "Segments of a lower mean speed are dead air and are left out, in metres per second." },
      of.LeastSpeed...);
  }
};

/// Curvature at each sample [1/m], with a floor on the speed so that a tracer at rest has none, and
/// smoothed over neighbouring samples with weights 1 2 3 2 1.
std::vector<double> CurvatureAlong(const std::vector<Vec3>& positions, double step);

/// The samples at which bends part: one between each two consecutive features, at the least
/// curvature, in increasing order; the ends of the path are not among them.
std::vector<int> CutsBetweenFeatures(const std::vector<double>& curvature, double featureCurvature,
                                     double featureContrast);

/// Part of a path: Count samples from First.
struct SampleRange
{
  int First = 0;
  int Count = 0;
};

/// Cuts a path between its features, joins what is shorter than the shortest segment over the cut
/// of higher curvature, and splits what is longer than the longest at the least curvature of
/// its middle third (a feature only when it alone is longer). Consecutive ranges share a sample;
/// together they cover the path. Empty when the path is shorter than the shortest segment.
std::vector<SampleRange> CutPath(const std::vector<double>& curvature,
                                 const SegmentationOptions& options, double featureCurvature);

/// The lengths of the groups [samples], increasing.
std::vector<int> GroupLengths(const SegmentationOptions& options);

/// Truncates a range to `count` samples where the least curvature is lost.
SampleRange Truncate(const SampleRange& range, int count, const std::vector<double>& curvature);

} // namespace waft
