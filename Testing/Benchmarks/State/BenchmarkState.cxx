// SPDX-License-Identifier: BSD-3-Clause
// WaftBenchmarkState [points along a side] [frames] [megabytes] [folder]: how small and how quickly
// an air is packed for edits, beside its plain bytes; what writing a checkpoint takes on this disk.
#include "Air/Field/PackedSeries.h"
#include "Store/StateFile.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace waft;

namespace
{

HalfSeries Waves(int side, int frames)
{
  HalfSeries series;
  series.Dimensions = { side, side, side };
  const auto points = static_cast<std::size_t>(side) * side * side;
  series.Values.assign(frames, std::vector<Half3>(points));
  HalfSeries::Field field(points);
  for (int k = 0; k < frames; ++k)
  {
    series.Times.push_back(k / 30.0);
    for (std::size_t i = 0; i < points; ++i)
    {
      const double x = 6.0 * static_cast<double>(i % side) / side;
      const double y = 6.0 * static_cast<double>(i / side % side) / side;
      const double z = 6.0 * static_cast<double>(i / side / side) / side;
      const double t = k / 30.0;
      field[i] = { static_cast<float>(std::sin(y + z + t) + 0.5 * std::sin(3.0 * x - 2.0 * t)),
                   static_cast<float>(std::cos(z - x + t) + 0.5 * std::sin(3.0 * y + 2.0 * t)),
                   static_cast<float>(std::sin(x + y - t) + 0.5 * std::cos(3.0 * z + 2.0 * t)) };
    }
    series.Set(static_cast<std::size_t>(k), field);
  }
  return series;
}

double CpuSeconds(const std::function<void()>& work)
{
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void Pack(int side, int frames)
{
  const HalfSeries series = Waves(side, frames);
  MemoryStream plain, packed;
  const double asItIs = CpuSeconds([&] { plain.Values(series.Values); });
  const double seconds = CpuSeconds([&] { WritePacked(packed, series.Values); });
  std::printf("air of %d^3 points, %d frames, 1 thread: plain %.1f MB %.2f CPU-s, packed %.1f MB "
              "%.2f CPU-s\n",
              side, frames, static_cast<double>(plain.Content.size()) / 1e6, asItIs,
              static_cast<double>(packed.Content.size()) / 1e6, seconds);
}

/// Seconds by the clock.
double WriteOnce(const std::string& path, const std::vector<char>& bytes)
{
  const auto begin = std::chrono::steady_clock::now();
  StateFileWriter file(path, { "benchmark", 1 });
  file.Raw(bytes.data(), bytes.size());
  const Result result = file.Commit();
  if (!result)
  {
    std::printf("%s\n", result.Message().c_str());
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

int main(int argc, char** argv)
{
  const int side = argc > 1 ? std::max(2, std::atoi(argv[1])) : 37;
  const int frames = argc > 2 ? std::max(1, std::atoi(argv[2])) : 60;
  const double megabytes = argc > 3 ? std::max(1.0, std::atof(argv[3])) : 200.0;
  const std::string folder = argc > 4 ? argv[4] : ".";
  Pack(side, frames);
  std::vector<char> bytes(static_cast<std::size_t>(1e6 * megabytes));
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    bytes[i] = static_cast<char>((i * 2654435761U) >> 13U);
  }
  const std::string path = folder + "/WaftBenchmarkState.state";
  std::vector<double> seconds;
  for (int i = 0; i < 5; ++i)
  {
    seconds.push_back(WriteOnce(path, bytes));
  }
  (void)std::remove(path.c_str());
  std::sort(seconds.begin(), seconds.end());
  std::printf("a checkpoint of %.0f MB here: %.2f s by the clock (median of 5, %.2f to %.2f)\n",
              megabytes, seconds[2], seconds.front(), seconds.back());
  return 0;
}
