// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TargetSampling.h"

#include "Base/Random.h"
#include "Scene/BlueNoise.h"
#include "Scene/PixelSites.h"
#include "Scene/StrokeThinning.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace waft
{

namespace
{

// The pixels of one class that want targets.
WeightedPixels PixelsOf(const TargetMask& mask, int ofClass)
{
  WeightedPixels pixels;
  for (int y = 0; y < mask.Height; ++y)
  {
    for (int x = 0; x < mask.Width; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * mask.Width + x;
      if (mask.Weights[i] > 0.f && (mask.Classes.empty() || mask.Classes[i] == ofClass))
      {
        pixels.Points.emplace_back(x + 0.5, y + 0.5, 0.0);
        pixels.Weights.push_back(mask.Weights[i]);
      }
    }
  }
  return pixels;
}

// The middle lines of what is more than half wanted.
std::vector<Vec3> MiddleLines(const TargetMask& mask, int ofClass)
{
  std::vector<char> raster(mask.Weights.size());
  for (std::size_t i = 0; i < raster.size(); ++i)
  {
    raster[i] = mask.Weights[i] > 0.5f && (mask.Classes.empty() || mask.Classes[i] == ofClass);
  }
  const std::vector<char> thin = ThinStrokes(std::move(raster), mask.Width, mask.Height);
  std::vector<Vec3> lines;
  for (std::size_t i = 0; i < thin.size(); ++i)
  {
    if (thin[i])
    {
      lines.emplace_back(static_cast<int>(i) % mask.Width + 0.5,
                         static_cast<int>(i) / mask.Width + 0.5, 0.0);
    }
  }
  return lines;
}

// Strokes that are thinner than the distance of targets along them, or than what lies on these,
// have no room for two abreast. area, length: of the strokes and of their middle lines [pixels].
bool AreStrokesThin(const TargetMask& mask, double area, double length, std::size_t count)
{
  const double distance = length / static_cast<double>(std::max<std::size_t>(count, 1));
  return length > 0.0 && area / length < std::max(distance, mask.BodyWidth);
}

std::vector<Vec3> SampleClass(const TargetMask& mask, int ofClass, std::size_t count,
                              Random& random)
{
  const WeightedPixels pixels = PixelsOf(mask, ofClass);
  if (count == 0 || pixels.Points.empty())
  {
    return {};
  }
  const double area = std::accumulate(pixels.Weights.begin(), pixels.Weights.end(), 0.0);
  const std::vector<Vec3> lines = MiddleLines(mask, ofClass);
  const double length = static_cast<double>(lines.size());
  const double distanceOnLines = length / static_cast<double>(count);
  if (AreStrokesThin(mask, area, length, count))
  {
    std::vector<Vec3> sites;
    for (const std::size_t i : EliminateSamples(lines, count, 2.0 * distanceOnLines))
    {
      sites.push_back(lines[i]);
    }
    if (sites.size() == count)
    {
      RelaxOnLines(lines, distanceOnLines, sites);
      return sites;
    }
  }
  std::vector<Vec3> sites = FirstSites(pixels, count, area, random);
  RelaxInArea(pixels, sites);
  return sites;
}

// Divides `count` by weight, nobody above its limit; the rest goes where most room is left.
std::vector<std::size_t> DivideByWeight(const std::vector<double>& weights, std::size_t count,
                                        const std::vector<std::size_t>& limits)
{
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<std::size_t> counts(weights.size(), 0);
  std::size_t given = 0;
  for (std::size_t c = 0; c < weights.size(); ++c)
  {
    const auto wanted = static_cast<std::size_t>(weights[c] / total * static_cast<double>(count));
    counts[c] = limits.empty() ? wanted : std::min(wanted, limits[c]);
    given += counts[c];
  }
  while (given < count)
  {
    std::size_t next = weights.size();
    double most = -1e300;
    for (std::size_t c = 0; c < weights.size(); ++c)
    {
      const double lack =
        weights[c] / total * static_cast<double>(count) - static_cast<double>(counts[c]);
      if (weights[c] > 0.0 && (limits.empty() || counts[c] < limits[c]) && lack > most)
      {
        most = lack;
        next = c;
      }
    }
    if (next == weights.size())
    {
      break;
    }
    ++counts[next];
    ++given;
  }
  return counts;
}

} // namespace

double TargetDistance(const TargetMask& mask, std::size_t count)
{
  const double area = std::accumulate(mask.Weights.begin(), mask.Weights.end(), 0.0);
  const double length = static_cast<double>(MiddleLines(mask, -1).size());
  return AreStrokesThin(mask, area, length, count)
           ? length / static_cast<double>(std::max<std::size_t>(count, 1))
           : PackingDistance(area, 2, count);
}

Result SampleMask(const TargetMask& mask, std::size_t count,
                  const std::vector<std::size_t>& classLimits, std::uint64_t seed,
                  std::uint64_t stream, std::vector<PlaneTarget>& targets)
{
  targets.clear();
  if (mask.IsEmpty())
  {
    return Result::Error("expected something drawn, found an empty picture");
  }
  int classes = 1;
  for (const int c : mask.Classes)
  {
    classes = std::max(classes, c + 1);
  }
  std::vector<double> weights(std::max<std::size_t>(classes, classLimits.size()), 0.0);
  for (std::size_t i = 0; i < mask.Weights.size(); ++i)
  {
    const int c = mask.Classes.empty() ? 0 : mask.Classes[i];
    if (c >= 0)
    {
      weights[c] += mask.Weights[i];
    }
  }
  const std::vector<std::size_t> counts = DivideByWeight(weights, count, classLimits);
  const std::size_t possible = std::accumulate(counts.begin(), counts.end(), std::size_t(0));
  if (possible < count)
  {
    return Result::Error("expected objects of the picture's classes for " + std::to_string(count) +
                         " targets, found " + std::to_string(possible));
  }
  Random random(seed, stream);
  for (std::size_t c = 0; c < counts.size(); ++c)
  {
    for (const Vec3& p : SampleClass(mask, static_cast<int>(c), counts[c], random))
    {
      targets.push_back({ p.x() / mask.Width - 0.5, (p.y() - 0.5 * mask.Height) / mask.Width,
                          mask.Classes.empty() ? -1 : static_cast<int>(c) });
    }
  }
  std::stable_sort(targets.begin(), targets.end(),
                   [](const PlaneTarget& a, const PlaneTarget& b)
                   { return a.X < b.X || (a.X == b.X && a.Y < b.Y); });
  return Result::Ok();
}

} // namespace waft
