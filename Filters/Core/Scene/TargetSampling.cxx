// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TargetSampling.h"

#include "Base/Random.h"
#include "Base/ShapeMeasures.h"
#include "Scene/BlueNoise.h"
#include "Scene/StrokeThinning.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace waft
{

namespace
{

// The pixels of one class, in units of pixels, z = 0.
struct WeightedPixels
{
  std::vector<Vec3> Points;
  std::vector<double> Weights;
};

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
WeightedPixels MiddleLines(const TargetMask& mask, int ofClass)
{
  std::vector<char> raster(mask.Weights.size());
  for (std::size_t i = 0; i < raster.size(); ++i)
  {
    raster[i] = mask.Weights[i] > 0.5f && (mask.Classes.empty() || mask.Classes[i] == ofClass);
  }
  const std::vector<char> thin = ThinStrokes(std::move(raster), mask.Width, mask.Height);
  WeightedPixels pixels;
  for (std::size_t i = 0; i < thin.size(); ++i)
  {
    if (thin[i])
    {
      pixels.Points.emplace_back(static_cast<int>(i) % mask.Width + 0.5,
                                 static_cast<int>(i) / mask.Width + 0.5, 0.0);
      pixels.Weights.push_back(1.0);
    }
  }
  return pixels;
}

// Strokes that are thinner than the distance of targets along them, or than what lies on these,
// have no room for two abreast. area, length: of the strokes and of their middle lines [pixels].
bool AreStrokesThin(const TargetMask& mask, double area, double length, std::size_t count)
{
  const double distance = length / static_cast<double>(std::max<std::size_t>(count, 1));
  return length > 0.0 && area / length < std::max(distance, mask.BodyWidth);
}

// The bits of two coordinates in turn: neighbours in this order are neighbours in the plane.
std::uint64_t MortonCode(const Vec3& p)
{
  const auto x = static_cast<std::uint64_t>(p.x());
  const auto y = static_cast<std::uint64_t>(p.y());
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 24; ++bit)
  {
    code |= ((x >> bit & 1u) << (2 * bit)) | ((y >> bit & 1u) << (2 * bit + 1));
  }
  return code;
}

// One site from each of `count` runs of pixels of equal weight, so that the sites have the density
// of the weights from the start (the relaxation moves them only a little).
std::vector<Vec3> FirstSites(const WeightedPixels& pixels, std::size_t count, double area,
                             Random& random)
{
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < pixels.Points.size(); ++i)
  {
    order.emplace_back(MortonCode(pixels.Points[i]), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Vec3> sites;
  double sum = 0.0;
  double next = area / static_cast<double>(count) * random.Uniform();
  for (const auto& [code, i] : order)
  {
    sum += pixels.Weights[i];
    while (sum > next && sites.size() < count)
    {
      sites.push_back(pixels.Points[i] +
                      Vec3(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), 0.0));
      next += area / static_cast<double>(count);
    }
  }
  while (sites.size() < count) // rounding of the last sum
  {
    sites.push_back(pixels.Points[order.back().second]);
  }
  return sites;
}

// Lloyd's relaxation: each site goes to the weighted mean of the pixels that are nearest to it. In
// the plane a centroidal tessellation of density w has sites of density w^(1/2), so the weights are
// squared.
void RelaxInArea(const WeightedPixels& pixels, std::vector<Vec3>& sites)
{
  const double work = static_cast<double>(pixels.Points.size()) * sites.size();
  const int iterations = static_cast<int>(std::clamp(1e9 / work, 8.0, 60.0));
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    std::vector<Vec3> moments(sites.size(), Vec3::Zero());
    std::vector<double> weights(sites.size(), 0.0);
    for (std::size_t i = 0; i < pixels.Points.size(); ++i)
    {
      std::size_t nearest = 0;
      double least = 1e300;
      for (std::size_t s = 0; s < sites.size(); ++s)
      {
        const double d = (sites[s] - pixels.Points[i]).squaredNorm();
        if (d < least)
        {
          least = d;
          nearest = s;
        }
      }
      const double weight = pixels.Weights[i] * pixels.Weights[i];
      moments[nearest] += weight * pixels.Points[i];
      weights[nearest] += weight;
    }
    for (std::size_t s = 0; s < sites.size(); ++s)
    {
      if (weights[s] > 0.0)
      {
        sites[s] = moments[s] / weights[s];
      }
    }
  }
}

// On lines a mean would leave the line and shrink its ends. Each site in turn moves along the lines
// to where the repulsion of the others, (spacing / d)^4, is least: even distances, ends taken.
void RelaxOnLines(const WeightedPixels& lines, double spacing, std::vector<Vec3>& sites)
{
  constexpr int sweeps = 40;
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    bool moved = false;
    for (std::size_t s = 0; s < sites.size(); ++s)
    {
      const auto energyAt = [&](const Vec3& x)
      {
        double energy = 0.0;
        for (std::size_t o = 0; o < sites.size(); ++o)
        {
          if (o != s)
          {
            const double d2 = std::max((sites[o] - x).squaredNorm() / (spacing * spacing), 1e-6);
            energy += 1.0 / (d2 * d2);
          }
        }
        return energy;
      };
      Vec3 best = sites[s];
      double least = energyAt(best);
      for (const Vec3& x : lines.Points)
      {
        if ((x - sites[s]).squaredNorm() < 0.3 * spacing * spacing)
        {
          const double energy = energyAt(x);
          if (energy < least * (1.0 - 1e-9))
          {
            least = energy;
            best = x;
          }
        }
      }
      moved = moved || best != sites[s];
      sites[s] = best;
    }
    if (!moved)
    {
      return;
    }
  }
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
  const WeightedPixels lines = MiddleLines(mask, ofClass);
  const double length = static_cast<double>(lines.Points.size());
  const double distanceOnLines = length / static_cast<double>(count);
  if (AreStrokesThin(mask, area, length, count))
  {
    std::vector<Vec3> sites;
    for (const std::size_t i : EliminateSamples(lines.Points, count, 2.0 * distanceOnLines))
    {
      sites.push_back(lines.Points[i]);
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

// Shares `count` by weight, nobody above its limit; the rest goes where most room is left.
std::vector<std::size_t> Share(const std::vector<double>& weights, std::size_t count,
                               const std::vector<std::size_t>& limits)
{
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<std::size_t> shares(weights.size(), 0);
  std::size_t given = 0;
  for (std::size_t c = 0; c < weights.size(); ++c)
  {
    const auto wanted = static_cast<std::size_t>(weights[c] / total * static_cast<double>(count));
    shares[c] = limits.empty() ? wanted : std::min(wanted, limits[c]);
    given += shares[c];
  }
  while (given < count)
  {
    std::size_t next = weights.size();
    double most = -1e300;
    for (std::size_t c = 0; c < weights.size(); ++c)
    {
      const double lack = weights[c] / total * static_cast<double>(count) - shares[c];
      if (weights[c] > 0.0 && (limits.empty() || shares[c] < limits[c]) && lack > most)
      {
        most = lack;
        next = c;
      }
    }
    if (next == weights.size())
    {
      break;
    }
    ++shares[next];
    ++given;
  }
  return shares;
}

double ColorDistance(const std::array<double, 3>& a, const std::array<float, 4>& b)
{
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    sum += (a[c] - b[c]) * (a[c] - b[c]);
  }
  return std::sqrt(sum);
}

// The commonest colour of the border, of 16 shades a channel.
std::array<double, 3> BackgroundColor(const Picture& picture)
{
  std::map<std::array<int, 3>, std::pair<int, std::array<double, 3>>> counts;
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      if (x == 0 || y == 0 || x == picture.Width - 1 || y == picture.Height - 1)
      {
        const auto& p = picture.Pixels[static_cast<std::size_t>(y) * picture.Width + x];
        auto& entry = counts[{ int(p[0] * 15.9f), int(p[1] * 15.9f), int(p[2] * 15.9f) }];
        ++entry.first;
        entry.second = { p[0], p[1], p[2] };
      }
    }
  }
  std::pair<int, std::array<double, 3>> best{ 0, { 1.0, 1.0, 1.0 } };
  for (const auto& [shade, entry] : counts)
  {
    if (entry.first > best.first)
    {
      best = entry;
    }
  }
  return best.second;
}

} // namespace

bool TargetMask::IsEmpty() const
{
  return std::none_of(this->Weights.begin(), this->Weights.end(), [](float w) { return w > 0.f; });
}

TargetMask MaskFromPicture(const Picture& picture,
                           const std::vector<std::array<double, 3>>& classColors)
{
  TargetMask mask;
  mask.Width = picture.Width;
  mask.Height = picture.Height;
  const bool isTransparent = std::any_of(picture.Pixels.begin(), picture.Pixels.end(),
                                         [](const auto& p) { return p[3] < 0.99f; });
  const std::array<double, 3> background = BackgroundColor(picture);
  const std::array<float, 4> backgroundPixel = { float(background[0]), float(background[1]),
                                                 float(background[2]), 1.f };
  constexpr double sameColor = 0.1;
  bool backgroundIsClass = false;
  for (const auto& color : classColors)
  {
    backgroundIsClass = backgroundIsClass || ColorDistance(color, backgroundPixel) < sameColor;
  }
  const bool hasBackground = !isTransparent && !backgroundIsClass;
  for (const auto& pixel : picture.Pixels)
  {
    const double contrast = ColorDistance(background, pixel);
    int nearest = -1;
    double least = hasBackground ? contrast : 1e300;
    for (std::size_t c = 0; c < classColors.size(); ++c)
    {
      const double d = ColorDistance(classColors[c], pixel);
      if (d < least)
      {
        least = d;
        nearest = static_cast<int>(c);
      }
    }
    double weight = isTransparent ? pixel[3] : std::min(1.0, contrast / std::sqrt(3.0));
    if (!classColors.empty())
    {
      weight = nearest >= 0 ? (isTransparent ? pixel[3] : 1.0) : 0.0;
      mask.Classes.push_back(nearest);
    }
    mask.Weights.push_back(weight < 0.02 ? 0.f : static_cast<float>(weight));
  }
  // The strongest pixel counts as fully wanted.
  const float strongest =
    mask.Weights.empty() ? 0.f : *std::max_element(mask.Weights.begin(), mask.Weights.end());
  for (float& w : mask.Weights)
  {
    w = strongest > 0.f ? w / strongest : 0.f;
  }
  return mask;
}

double TargetDistance(const TargetMask& mask, std::size_t count)
{
  const double area = std::accumulate(mask.Weights.begin(), mask.Weights.end(), 0.0);
  const double length = static_cast<double>(MiddleLines(mask, -1).Points.size());
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
  const std::vector<std::size_t> shares = Share(weights, count, classLimits);
  const std::size_t possible = std::accumulate(shares.begin(), shares.end(), std::size_t(0));
  if (possible < count)
  {
    return Result::Error("expected objects of the picture's classes for " + std::to_string(count) +
                         " targets, found " + std::to_string(possible));
  }
  Random random(seed, stream);
  for (std::size_t c = 0; c < shares.size(); ++c)
  {
    for (const Vec3& p : SampleClass(mask, static_cast<int>(c), shares[c], random))
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

Result SampleSurface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed,
                     std::uint64_t stream, std::vector<Vec3>& points)
{
  points.clear();
  std::vector<double> sums;
  double area = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    const Vec3& a = mesh.Points[t[0]];
    area += 0.5 * (mesh.Points[t[1]] - a).cross(mesh.Points[t[2]] - a).norm();
    sums.push_back(area);
  }
  if (!(area > 0.0))
  {
    return Result::Error("expected a surface with an area, found none");
  }
  constexpr std::size_t candidatesPerPoint = 20;
  Random random(seed, stream);
  std::vector<Vec3> candidates;
  for (std::size_t n = 0; n < candidatesPerPoint * count; ++n)
  {
    const double at = area * random.Uniform();
    const auto triangle = static_cast<std::size_t>(
      std::min<std::ptrdiff_t>(std::upper_bound(sums.begin(), sums.end(), at) - sums.begin(),
                               static_cast<std::ptrdiff_t>(sums.size()) - 1));
    const auto& t = mesh.Triangles[triangle];
    const double r = std::sqrt(random.Uniform());
    const double s = random.Uniform();
    candidates.push_back((1.0 - r) * mesh.Points[t[0]] + r * (1.0 - s) * mesh.Points[t[1]] +
                         r * s * mesh.Points[t[2]]);
  }
  for (const std::size_t i : EliminateSamples(candidates, count, PackingDistance(area, 2, count)))
  {
    points.push_back(candidates[i]);
  }
  return Result::Ok();
}

} // namespace waft
