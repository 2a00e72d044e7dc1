// SPDX-License-Identifier: BSD-3-Clause
#include "Air/AirStatistics.h"

#include "Air/AirSampler.h"
#include "Base/Random.h"

#include <algorithm>
#include <cmath>
#include <vector>

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
  Vec3 Position = Vec3::Zero();
  Vec3 Velocity = Vec3::Zero();
  Vec3 Acceleration = Vec3::Zero();
  bool IsFree = false;
};

struct Sums
{
  double Velocity = 0.0, Acceleration = 0.0;
  std::size_t Count = 0;
  std::array<double, AirStatistics::Bins> Differing{};
  std::array<std::size_t, AirStatistics::Bins> Pairs{};
};

Box VolumeOf(const FieldSeries& air)
{
  const Vec3 cells(air.Dimensions[0] - 1, air.Dimensions[1] - 1, air.Dimensions[2] - 1);
  return { air.Origin, air.Origin + cells.cwiseProduct(air.Spacing) };
}

// The flights of one body, one after another.
std::vector<Sample> Fly(const FieldSeries& air, int body, double rate, double settlingSpeed)
{
  const AirSampler sampler(air);
  const Box volume = VolumeOf(air);
  const Vec3 slip = settlingSpeed * Vec3::UnitZ();
  const double step = 1.0 / rate;
  const int frames = static_cast<int>(air.Values.size());
  const int unfree = static_cast<int>(std::ceil(Unfree * rate));
  Random random(static_cast<std::uint64_t>(body), Stream);
  std::vector<Sample> samples(air.Values.size());
  std::vector<Vec3> path;
  const auto finish = [&](int end)
  {
    const int begin = end - static_cast<int>(path.size());
    for (int f = std::max(1, unfree); f + std::max(1, unfree) < static_cast<int>(path.size()); ++f)
    {
      Sample& sample = samples[static_cast<std::size_t>(begin + f)];
      const Vec3& before = path[static_cast<std::size_t>(f) - 1];
      const Vec3& after = path[static_cast<std::size_t>(f) + 1];
      sample.Position = path[static_cast<std::size_t>(f)];
      sample.Velocity = 0.5 * rate * (after - before);
      sample.Acceleration = rate * rate * (after - 2.0 * sample.Position + before);
      sample.IsFree = true;
    }
    path.clear();
  };
  Vec3 x = random.InBox(volume);
  for (int f = 0; f < frames; ++f)
  {
    path.push_back(x);
    if (f + 1 == frames)
    {
      break;
    }
    Mat3 gradient;
    const Vec3 half = x + 0.5 * step * (sampler.At(f, x) - slip);
    x += step * (sampler.Between(f, half, gradient) - slip);
    if (((x - volume.Min).array() < 0.0).any() || ((volume.Max - x).array() < 0.0).any())
    {
      finish(f + 1);
      x = random.InBox(volume);
    }
  }
  finish(frames);
  return samples;
}

void AddFrame(const std::vector<std::vector<Sample>>& flights, std::size_t frame, double width,
              Sums& sums)
{
  std::vector<const Sample*> here;
  Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero();
  for (const std::vector<Sample>& flight : flights)
  {
    if (flight[frame].IsFree)
    {
      here.push_back(&flight[frame]);
      velocity += flight[frame].Velocity;
      acceleration += flight[frame].Acceleration;
    }
  }
  if (here.size() < 2)
  {
    return;
  }
  const auto count = static_cast<double>(here.size());
  velocity /= count;
  acceleration /= count;
  for (const Sample* sample : here)
  {
    sums.Velocity += (sample->Velocity - velocity).squaredNorm() * count / (count - 1.0);
    sums.Acceleration +=
      (sample->Acceleration - acceleration).squaredNorm() * count / (count - 1.0);
  }
  sums.Count += here.size();
  if (frame % PairFrames != 0)
  {
    return;
  }
  for (std::size_t i = 0; i < here.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const double distance = (here[i]->Position - here[j]->Position).norm() / width;
      const double bin = (distance - AirStatistics::FirstBin) / AirStatistics::BinWidth;
      if (bin >= 0.0 && bin < AirStatistics::Bins)
      {
        const auto at = static_cast<std::size_t>(bin);
        sums.Differing[at] += (here[i]->Velocity - here[j]->Velocity).squaredNorm();
        ++sums.Pairs[at];
      }
    }
  }
}

} // namespace

AirStatistics DriftStatistics(const FieldSeries& air, double framesPerSecond, double settlingSpeed,
                              const ParallelFor& parallel)
{
  std::vector<std::vector<Sample>> flights(Bodies);
  parallel(Bodies,
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t b = begin; b < end; ++b)
             {
               flights[b] = Fly(air, static_cast<int>(b), framesPerSecond, settlingSpeed);
             }
           });
  Sums sums;
  for (std::size_t f = 0; f < air.Values.size(); ++f)
  {
    AddFrame(flights, f, VolumeOf(air).Width(), sums);
  }
  AirStatistics found;
  const double count = std::max<double>(1.0, static_cast<double>(sums.Count));
  found.VelocityVariance = sums.Velocity / count;
  found.AccelerationVariance = sums.Acceleration / count;
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
