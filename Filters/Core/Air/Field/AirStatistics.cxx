// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirStatistics.h"

#include "Air/Field/AirSampler.h"
#include "Base/Random.h"
#include "Grid/SmokeEnsemble.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr int Bodies = 200;
constexpr int PairFrames = 10; // frames between those whose pairs are counted
constexpr double Unfree = 0.5; // s after a body is let go and before it leaves, not counted
constexpr std::uint64_t Stream = 0x627573; // of random numbers

struct Sample
{
  Vec3 Position, Velocity, Acceleration;
};

// Sums of squares about means, and of how many.
struct Spread
{
  double Velocity = 0.0, Acceleration = 0.0;
  std::size_t Count = 0;
};

struct Sums
{
  Spread Frames, Own;
  std::array<double, AirStatistics::Bins> Differing{};
  std::array<std::size_t, AirStatistics::Bins> Pairs{};
};

Box VolumeOf(const HalfSeries& air)
{
  const Vec3 cells(air.Dimensions[0] - 1, air.Dimensions[1] - 1, air.Dimensions[2] - 1);
  return { air.Origin, air.Origin + cells.cwiseProduct(air.Spacing) };
}

// The flights of one body, one after another.
void Fly(const HalfSeries& air, int body, double rate, const BodyLaw& law, std::vector<Vec3>& path,
         std::vector<char>& isFree)
{
  const AirSampler sampler(air);
  const Box volume = VolumeOf(air);
  const double step = 1.0 / rate;
  const int frames = static_cast<int>(air.Values.size());
  const int unfree = std::max(1, static_cast<int>(std::ceil(Unfree * rate)));
  Random random(static_cast<std::uint64_t>(body), Stream);
  isFree.assign(air.Values.size(), 0);
  Vec3 x = random.InBox(volume);
  for (int f = 0, begun = 0; f < frames; ++f)
  {
    path.push_back(x);
    Vec3 next = x;
    if (f + 1 < frames)
    {
      const Vec3 half = x + 0.5 * step * law.Velocity(sampler.At(f, x));
      next += step * law.Velocity(sampler.Between(f, half));
    }
    const bool leaves =
      ((next - volume.Min).array() < 0.0).any() || ((volume.Max - next).array() < 0.0).any();
    if (leaves || f + 1 == frames)
    {
      for (int k = begun + unfree; k + unfree <= f; ++k)
      {
        isFree[static_cast<std::size_t>(k)] = 1;
      }
      begun = f + 1;
      next = random.InBox(volume);
    }
    x = next;
  }
}

void AddPairs(const std::vector<Sample>& here, double width, Sums& sums)
{
  for (std::size_t i = 0; i < here.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const double distance = (here[i].Position - here[j].Position).norm() / width;
      const double bin = (distance - AirStatistics::FirstBin) / AirStatistics::BinWidth;
      if (bin >= 0.0 && bin < AirStatistics::Bins)
      {
        const auto at = static_cast<std::size_t>(bin);
        sums.Differing[at] += (here[i].Velocity - here[j].Velocity).squaredNorm();
        ++sums.Pairs[at];
      }
    }
  }
}

void AddAboutMean(const std::vector<Sample>& here, Spread& sums)
{
  Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero();
  const auto count = static_cast<double>(here.size());
  for (const Sample& sample : here)
  {
    velocity += sample.Velocity / count;
    acceleration += sample.Acceleration / count;
  }
  const double unbiased = count / (count - 1.0);
  for (const Sample& sample : here)
  {
    sums.Velocity += unbiased * (sample.Velocity - velocity).squaredNorm();
    sums.Acceleration += unbiased * (sample.Acceleration - acceleration).squaredNorm();
  }
  sums.Count += here.size();
}

Sample SampleAt(const std::vector<Vec3>& path, std::size_t f, double rate)
{
  return { path[f], 0.5 * rate * (path[f + 1] - path[f - 1]),
           rate * rate * (path[f + 1] - 2.0 * path[f] + path[f - 1]) };
}

// Windows of a path that is free all the time, each half over the one before.
void AddOwn(const std::vector<Vec3>& path, const std::vector<char>& isFree, double rate,
            double seconds, Sums& sums)
{
  const auto length = static_cast<std::size_t>(std::lround(seconds * rate));
  std::vector<Sample> window(length);
  for (std::size_t begin = 1; length > 1 && begin + length < path.size(); begin += length / 2)
  {
    const auto first = isFree.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = first + static_cast<std::ptrdiff_t>(length);
    if (std::find(first, last, 0) != last)
    {
      continue;
    }
    for (std::size_t k = 0; k < length; ++k)
    {
      window[k] = SampleAt(path, begin + k, rate);
    }
    AddAboutMean(window, sums.Own);
  }
}

} // namespace

AirStatistics StatisticsOf(const FreeFlights& flights, double framesPerSecond, double width)
{
  Sums sums;
  std::vector<Sample> here;
  const std::size_t frames = flights.Paths.empty() ? 0 : flights.Paths.front().size();
  for (std::size_t f = 1; f + 1 < frames; ++f)
  {
    here.clear();
    for (std::size_t b = 0; b < flights.Paths.size(); ++b)
    {
      if (flights.IsFree[b][f])
      {
        here.push_back(SampleAt(flights.Paths[b], f, framesPerSecond));
      }
    }
    if (here.size() < 2)
    {
      continue;
    }
    AddAboutMean(here, sums.Frames);
    if (f % PairFrames == 0)
    {
      AddPairs(here, width, sums);
    }
  }
  for (std::size_t b = 0; b < flights.Paths.size(); ++b)
  {
    AddOwn(flights.Paths[b], flights.IsFree[b], framesPerSecond,
           AirStatistics::OwnSeconds * TimeScaleOf(width), sums);
  }
  AirStatistics found;
  const double count = std::max<double>(1.0, static_cast<double>(sums.Frames.Count));
  found.VelocityVariance = sums.Frames.Velocity / count;
  found.AccelerationVariance = sums.Frames.Acceleration / count;
  const double own = std::max<double>(1.0, static_cast<double>(sums.Own.Count));
  found.OwnVelocityVariance = sums.Own.Velocity / own;
  found.OwnAccelerationVariance = sums.Own.Acceleration / own;
  for (std::size_t bin = 0; bin < sums.Pairs.size(); ++bin)
  {
    if (sums.Pairs[bin] > 0 && found.VelocityVariance > 0.0)
    {
      found.Structure[bin] =
        sums.Differing[bin] / (2.0 * found.VelocityVariance * static_cast<double>(sums.Pairs[bin]));
    }
  }
  return found;
}

AirStatistics DriftStatistics(const HalfSeries& air, double framesPerSecond, const BodyLaw& law,
                              const ParallelFor& parallel)
{
  FreeFlights flights;
  flights.Paths.resize(Bodies);
  flights.IsFree.resize(Bodies);
  parallel(Bodies,
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t b = begin; b < end; ++b)
             {
               Fly(air, static_cast<int>(b), framesPerSecond, law, flights.Paths[b],
                   flights.IsFree[b]);
             }
           });
  return StatisticsOf(flights, framesPerSecond, VolumeOf(air).Width());
}

double StructureDistance(const AirStatistics& one, const AirStatistics& other)
{
  double sum = 0.0;
  int count = 0;
  for (std::size_t bin = 0; bin < one.Structure.size(); ++bin)
  {
    if (one.Structure[bin] > 0.0 && other.Structure[bin] > 0.0)
    {
      sum += std::abs(std::log(one.Structure[bin] / other.Structure[bin]));
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

} // namespace waft
