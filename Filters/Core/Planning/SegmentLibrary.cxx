// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SegmentLibrary.h"

#include "Base/NumberText.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// Catmull-Rom value of samples at a fractional index.
Vec3 Interpolate(const std::vector<Vec3>& samples, double index)
{
  const auto last = static_cast<int>(samples.size()) - 1;
  const int i = std::clamp(static_cast<int>(index), 0, std::max(0, last - 1));
  const double u = index - i;
  const auto at = [&](int k) -> Vec3
  {
    if (k < 0)
    {
      return 2.0 * samples[0] - samples[1];
    }
    return k > last ? Vec3(2.0 * samples[last] - samples[last - 1]) : samples[k];
  };
  const Vec3 a = at(i - 1);
  const Vec3 b = at(i);
  const Vec3 c = at(i + 1);
  const Vec3 d = at(i + 2);
  return b + 0.5 * u *
               ((c - a) + u * ((2.0 * a - 5.0 * b + 4.0 * c - d) + u * (3.0 * (b - c) + d - a)));
}

std::vector<Vec3> Resample(const std::vector<Vec3>& samples, double ratio)
{
  const auto count = static_cast<std::size_t>(
                       std::floor((static_cast<double>(samples.size()) - 1.0) / ratio + 1e-9)) +
                     1;
  std::vector<Vec3> result(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    result[k] = Interpolate(samples, static_cast<double>(k) * ratio);
  }
  return result;
}

} // namespace

Vec3 CentralStep(const std::vector<Vec3>& samples, int k)
{
  const auto last = static_cast<int>(samples.size()) - 1;
  const int a = std::max(0, k - 1);
  const int b = std::min(last, k + 1);
  return (samples[b] - samples[a]) / static_cast<double>(b - a);
}

namespace
{

Result TooFewFrames(const MotionDatabase& database, double found)
{
  std::size_t shortest = ~std::size_t(0);
  for (const int node : database.TopNodes)
  {
    shortest = std::min(shortest, database.Segments[database.Nodes[node].Medoid].ForceTypes.size());
  }
  const double steps = std::max(static_cast<double>(shortest) - 1.0, 1.0);
  return Result::Error(
    "FramesPerSecond: expected at least " + NumberText(4.0 * database.FramesPerSecond / steps) +
    ", at which the shortest way of the motion database has 5 frames, found " + NumberText(found));
}

} // namespace

Result SegmentLibrary::Build(const MotionDatabase& database, const SegmentLibraryOptions& options,
                             const ParallelFor& parallelFor)
{
  if (Result valid = database.Validate(); !valid)
  {
    return valid;
  }
  if (database.TopNodes.empty())
  {
    return Result::Error("motion database: no top-level clusters, at least one expected");
  }
  this->Source = &database;
  this->Settings = options;
  const double ratio = database.FramesPerSecond / options.FramesPerSecond;
  this->WindowSamples =
    std::max(3, static_cast<int>(std::lround((database.Window - 1) / ratio)) + 1);

  this->AllSamples.assign(database.Segments.size(), {});
  parallelFor(database.Segments.size(),
              [&](std::size_t begin, std::size_t end)
              {
                for (std::size_t s = begin; s < end; ++s)
                {
                  std::vector<Vec3> samples = database.Reconstruct(static_cast<int>(s));
                  this->AllSamples[s] =
                    std::abs(ratio - 1.0) < 1e-12 ? std::move(samples) : Resample(samples, ratio);
                }
              });
  this->Tops.clear();
  std::vector<double> steps;
  this->Longest = 0;
  for (int node : database.TopNodes)
  {
    const int segment = database.Nodes[node].Medoid;
    const std::vector<Vec3>& samples = this->AllSamples[segment];
    if (samples.size() < 5)
    {
      return TooFewFrames(database, options.FramesPerSecond);
    }
    // The overlaps with the segment before and the one after must not meet.
    this->WindowSamples = std::min(this->WindowSamples, (static_cast<int>(samples.size()) + 1) / 2);
    this->Tops.push_back(segment);
    this->Longest = std::max(this->Longest, static_cast<int>(samples.size()) - 1);
    for (std::size_t k = 1; k < samples.size(); ++k)
    {
      steps.push_back((samples[k] - samples[k - 1]).norm());
    }
  }
  std::nth_element(steps.begin(), steps.begin() + static_cast<long>(steps.size() / 2), steps.end());
  this->MedianStep = steps[steps.size() / 2];
  this->LargestStep = database.TopSpeed / options.FramesPerSecond;
  if (!(this->MedianStep > 0.0) || !(this->LargestStep > 0.0))
  {
    return Result::Error("motion database: its segments do not move");
  }
  this->LargestJerk = 0.0;
  for (const std::vector<Vec3>& samples : this->AllSamples)
  {
    for (std::size_t k = 3; k < samples.size(); ++k)
    {
      const Vec3 jerk = samples[k] - 3.0 * samples[k - 1] + 3.0 * samples[k - 2] - samples[k - 3];
      this->LargestJerk = std::max(this->LargestJerk, jerk.norm());
    }
  }
  this->ConnectTops(parallelFor);
  return Result::Ok();
}

void SegmentLibrary::ConnectTops(const ParallelFor& parallelFor)
{
  const MotionDatabase& database = *this->Source;
  const std::size_t count = this->Tops.size();
  const std::size_t window = static_cast<std::size_t>(this->WindowSamples);
  const double limit =
    this->Settings.Freedom == RotationFreedom::Any ? 4.0 : this->Settings.MaximumTilt + 1e-9;
  // The database's own table serves when it was made with rotations that are allowed here.
  bool reuse = std::abs(database.FramesPerSecond - this->Settings.FramesPerSecond) < 1e-9 &&
               database.Connections.size() == count * count &&
               this->Settings.Freedom != RotationFreedom::Yaw;
  for (std::size_t i = 0; reuse && i < database.Connections.size(); ++i)
  {
    const waft::Connection& entry = database.Connections[i];
    reuse = std::isfinite(entry.Cost) && (!entry.IsConnectible || TiltOf(entry.Rotation) <= limit);
  }

  this->After.assign(count, {});
  this->Before.assign(count, {});
  this->Lookup.assign(count * count, -1);
  parallelFor(
    count,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t a = begin; a < end; ++a)
      {
        const std::vector<Vec3>& first = this->AllSamples[this->Tops[a]];
        const std::vector<Vec3> tail(first.end() - static_cast<long>(window), first.end());
        std::vector<Neighbour>& after = this->After[a];
        for (std::size_t b = 0; b < count; ++b)
        {
          const std::vector<Vec3>& second = this->AllSamples[this->Tops[b]];
          const waft::Connection entry =
            reuse ? database.At(a, b)
                  : AlignWindows(
                      tail,
                      std::vector<Vec3>(second.begin(), second.begin() + static_cast<long>(window)),
                      this->Settings.Freedom, this->Settings.MaximumTilt);
          Neighbour next;
          next.Top = static_cast<int>(b);
          next.Cost = std::isfinite(entry.Cost) ? entry.Cost : 1e9;
          next.Transform = { entry.Rotation.toRotationMatrix(), entry.Translation };
          next.FreeEnd = next.Transform * second.back();
          after.push_back(next);
        }
        std::stable_sort(after.begin(), after.end(),
                         [](const Neighbour& x, const Neighbour& y) { return x.Cost < y.Cost; });
        const double smooth = this->Settings.MaximumConnectionCost;
        std::size_t kept = 0;
        while (kept < after.size())
        {
          after[kept].IsSmooth = after[kept].Cost <= smooth ||
                                 static_cast<int>(kept) < this->Settings.MinimumNumberOfNeighbours;
          if (!after[kept].IsSmooth &&
              after[kept].Cost > this->Settings.RoughConnectionFactor * smooth)
          {
            break;
          }
          ++kept;
        }
        after.resize(kept);
        for (std::size_t i = 0; i < kept; ++i)
        {
          this->Lookup[a * count + static_cast<std::size_t>(after[i].Top)] = static_cast<int>(i);
        }
      }
    });
  for (std::size_t a = 0; a < count; ++a)
  {
    for (const Neighbour& next : this->After[a])
    {
      // The table is directional: the tail of the one before meets the head of the one after.
      Neighbour previous;
      previous.Top = static_cast<int>(a);
      previous.Cost = next.Cost;
      previous.IsSmooth = next.IsSmooth;
      previous.Transform = next.Transform.Inverse();
      previous.FreeEnd = previous.Transform * this->AllSamples[this->Tops[a]].front();
      this->Before[static_cast<std::size_t>(next.Top)].push_back(previous);
    }
  }
}

const Neighbour* SegmentLibrary::Connection(int before, int after) const
{
  const int index = this->Lookup[static_cast<std::size_t>(before) * this->Tops.size() +
                                 static_cast<std::size_t>(after)];
  return index < 0 ? nullptr : &this->After[before][index];
}

void SegmentLibrary::LimitTilt(Mat3& rotation) const
{
  if (this->Settings.Freedom == RotationFreedom::Any)
  {
    return;
  }
  const Vec3 up = rotation.col(2);
  const double limit =
    this->Settings.Freedom == RotationFreedom::Yaw ? 0.0 : this->Settings.MaximumTilt;
  const double sine = std::hypot(up.x(), up.y());
  const double tilt = std::atan2(sine, up.z());
  if (tilt <= limit || sine < 1e-12)
  {
    return;
  }
  // About the horizontal axis that brings the image of z back towards z.
  const Vec3 axis = Vec3(up.y(), -up.x(), 0.0) / sine;
  rotation = Eigen::AngleAxisd(tilt - limit, axis).toRotationMatrix() * rotation;
}

int SegmentLibrary::DatabaseSample(int segment, int sample) const
{
  const double ratio = this->Source->FramesPerSecond / this->Settings.FramesPerSecond;
  const auto count = static_cast<int>(this->Source->Segments[segment].ForceTypes.size());
  return std::clamp(static_cast<int>(std::lround(sample * ratio)), 0, std::max(0, count - 1));
}

} // namespace waft
