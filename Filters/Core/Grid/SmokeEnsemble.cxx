// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SmokeEnsemble.h"

#include "Base/Primitives.h"
#include "Base/Random.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace waft
{
namespace
{

// One stream of random numbers for each kind of thing: the number of winds does not move the
// vortices.
enum Stream : std::uint64_t
{
  VortexStream = 101,
  WindStream = 102,
  ObstacleStream = 103,
  EmitterStream = 104
};

// Stirring goes on by the rate of the defaults: ten vortices and six winds in 13 s, in blocks of
// time that each have random numbers of their own.
constexpr double UsualWidth = 4.0; // m, of the volume whose times are the defaults
constexpr double BlockSeconds = 6.5;
constexpr int VorticesOfBlock = 5;
constexpr int WindsOfBlock = 3;
constexpr std::uint64_t StreamsOfBlock = 1000;

/// Time of the last frame [s].
double LastTime(const EnsembleOptions& options)
{
  return Timeline{ options.NumberOfFrames, options.FramesPerSecond }.Time(options.NumberOfFrames -
                                                                          1);
}

double In(Random& random, const Range& range)
{
  return random.Uniform(range.front(), range.back());
}

// The volume less a margin, a fraction of each side.
Box Inner(const Box& bounds, double fraction)
{
  const Vec3 margin = fraction * bounds.Size();
  return Box{ bounds.Min + margin, bounds.Max - margin };
}

// Distance from the middle of a vortex where its acceleration is largest.
double PeakDistance(double length, double coreRadius)
{
  // The sign of the profile's derivative; it changes once, below the core radius.
  const auto slope = [&](double rho)
  {
    const double s = rho * rho;
    const double c2 = coreRadius * coreRadius;
    const double q2 = 0.25 * length * length;
    return (s + c2) * (s + q2) - 2.0 * s * (s + q2) - s * (s + c2);
  };
  double low = 0.0;
  double high = coreRadius;
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double DiameterOf(double length, double coreRadius)
{
  const double peak = PeakDistance(length, coreRadius);
  const double half = 0.5 * VortexProfile(length, coreRadius, peak);
  double low = peak;
  double high = 8.0 * coreRadius;
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (low + high);
    (VortexProfile(length, coreRadius, middle) > half ? low : high) = middle;
  }
  return low + high;
}

// In a stretch of time.
Vortex MakeVortex(const EnsembleOptions& options, Random& random, int id, double from, double to)
{
  const double width = options.Bounds.Width();
  Vortex vortex;
  vortex.VortexId = id;
  const Vec3 center = random.InBox(Inner(options.Bounds, 0.15));
  const Vec3 direction = random.Direction();
  double length = width * In(random, options.VortexLength);
  // Both poles lie in the volume.
  for (int attempt = 0; attempt < 20; ++attempt)
  {
    const Vec3 half = 0.5 * length * direction;
    if (options.Bounds.Contains(center - half) && options.Bounds.Contains(center + half))
    {
      break;
    }
    length *= 0.85;
  }
  vortex.P1 = center - 0.5 * length * direction;
  vortex.P2 = center + 0.5 * length * direction;
  vortex.CoreRadius = CoreRadiusForDiameter(length, width * In(random, options.VortexDiameter));
  const double turn = random.Uniform() < 0.5 ? -1.0 : 1.0;
  vortex.Strength =
    turn * In(random, options.VortexAcceleration) / LargestVortexProfile(length, vortex.CoreRadius);
  vortex.Duration = In(random, options.VortexDuration);
  vortex.CenterTime = random.Uniform(from, to);
  return vortex;
}

AnalyticWind MakeWind(const EnsembleOptions& options, Random& random, double from, double to)
{
  AnalyticWind wind;
  wind.Center = random.InBox(Inner(options.Bounds, 0.1));
  wind.Direction = random.Direction();
  wind.Strength = In(random, options.WindAcceleration);
  wind.Radius = options.Bounds.Width() * In(random, options.WindRadius);
  wind.Duration = In(random, options.WindDuration);
  wind.CenterTime = random.Uniform(from, to);
  return wind;
}

// Whether it is ever felt between two times.
template <class Force>
bool IsFelt(const Force& force, double from, double to)
{
  const double reach = StirringReach * force.Duration;
  return force.CenterTime + reach > from && force.CenterTime - reach < to;
}

TriangleMesh MakeObstacle(const EnsembleOptions& options, Random& random)
{
  const double width = options.Bounds.Width();
  const std::uint32_t kind = random.Index(3);
  const Vec3 size(width * In(random, options.ObstacleSize),
                  width * In(random, options.ObstacleSize),
                  width * In(random, options.ObstacleSize));
  Vec3 center = random.InBox(Inner(options.Bounds, 0.2));
  const double floor = options.Bounds.Min.z();
  const bool stands = random.Uniform() < 0.5;
  if (kind == 0)
  {
    Box box{ center - 0.5 * size, center + 0.5 * size };
    box.Min.z() = stands ? floor : box.Min.z();
    return MakeBox(box);
  }
  if (kind == 1)
  {
    const Vec3 half = std::max(size.y(), size.z()) * Vec3::UnitZ();
    Vec3 base = center - half;
    base.z() = stands ? floor : std::max(base.z(), floor);
    return MakeCylinder(base, center + half, 0.5 * size.x());
  }
  return MakeSphere(center, 0.5 * size.x());
}

} // namespace

double VortexProfile(double length, double coreRadius, double distance)
{
  const double s = distance * distance;
  return length * distance /
         (4.0 * M_PI * (s + coreRadius * coreRadius) * std::sqrt(s + 0.25 * length * length));
}

double LargestVortexProfile(double length, double coreRadius)
{
  return VortexProfile(length, coreRadius, PeakDistance(length, coreRadius));
}

double CoreRadiusForDiameter(double length, double diameter)
{
  double low = 0.0;
  double high = diameter;
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (low + high);
    (DiameterOf(length, middle) < diameter ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Result EnsembleOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(this->ValidateRun());
  Result result = ValidateFields<EnsembleOptions>(*this);
  const auto checkOrder = [&result](const OptionField& field, const auto& value)
  {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Range>)
    {
      if (result && value.back() < value.front())
      {
        result = Result::Error(std::string(field.Name) +
                               ": expected a lower end that is not above the upper end");
      }
    }
  };
  VisitAir(checkOrder, *this);
  const OptionField emitters{ "EmitterRadius", limits::Above(0, 1e6), "widths", "" };
  for (const double radius : this->EmitterRadius)
  {
    result = result ? emitters.Check(radius) : result;
  }
  checkOrder(emitters, this->EmitterRadius);
  return result;
}

double TimeScaleOf(double width)
{
  return std::sqrt(width / UsualWidth);
}

SmokeForces StirringForces(const Box& volume, std::uint64_t seed, double from, double to)
{
  const double scale = TimeScaleOf(volume.Width());
  EnsembleOptions options;
  options.Bounds = volume;
  for (Range* durations : { &options.VortexDuration, &options.WindDuration })
  {
    for (double& seconds : *durations)
    {
      seconds *= scale;
    }
  }
  const double reach = StirringReach * options.VortexDuration.back(); // the longest
  const double block = scale * BlockSeconds;
  SmokeForces forces;
  int id = 0;
  for (std::uint64_t b = 0; - reach + static_cast<double>(b) * block < to + reach; ++b)
  {
    const double begin = -reach + static_cast<double>(b) * block;
    Random vortices(seed, VortexStream + StreamsOfBlock * (b + 1));
    for (int v = 0; v < VorticesOfBlock; ++v)
    {
      const Vortex vortex = MakeVortex(options, vortices, id++, begin, begin + block);
      if (IsFelt(vortex, from, to))
      {
        forces.Vortices.push_back(vortex);
      }
    }
    Random winds(seed, WindStream + StreamsOfBlock * (b + 1));
    for (int w = 0; w < WindsOfBlock; ++w)
    {
      const AnalyticWind wind = MakeWind(options, winds, begin, begin + block);
      if (IsFelt(wind, from, to))
      {
        forces.Winds.push_back(wind);
      }
    }
  }
  return forces;
}

Result MakeEnsemble(const EnsembleOptions& options, Ensemble& ensemble)
{
  if (Result valid = options.Validate(); !valid)
  {
    return valid;
  }
  ensemble = Ensemble();
  const double first = -options.WarmUpSeconds;
  const double last = LastTime(options);
  Random vortices(options.Seed, VortexStream);
  for (int v = 0; v < options.NumberOfVortices; ++v)
  {
    ensemble.Forces.Vortices.push_back(MakeVortex(options, vortices, v, first, last));
  }
  Random winds(options.Seed, WindStream);
  for (int w = 0; w < options.NumberOfWinds; ++w)
  {
    ensemble.Forces.Winds.push_back(MakeWind(options, winds, first, last));
  }
  Random obstacles(options.Seed, ObstacleStream);
  for (int o = 0; o < options.NumberOfObstacles; ++o)
  {
    ObstacleMesh obstacle;
    obstacle.ObstacleId = o;
    obstacle.Mesh = MakeObstacle(options, obstacles);
    ensemble.Obstacles.push_back(std::move(obstacle));
  }
  Random emitters(options.Seed, EmitterStream);
  for (int e = 0; e < options.NumberOfEmitters; ++e)
  {
    SmokeEmitter emitter;
    emitter.Center = emitters.InBox(Inner(options.Bounds, 0.15));
    emitter.Radius = options.Bounds.Width() * In(emitters, options.EmitterRadius);
    emitter.Temperature = options.EmitterTemperature;
    ensemble.Forces.Emitters.push_back(emitter);
  }
  return Result::Ok();
}

} // namespace waft
