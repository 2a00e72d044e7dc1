// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/DrawnAir.h"

#include "Store/StateFile.h"

namespace waft
{
namespace
{

constexpr StateKind DrawnKind = { "drawn air", 2 };

} // namespace

std::uint64_t KeyOfDrawnAir(const AirContext& run, const AirScene& scene, const BodyLaw& law)
{
  DigestStream of;
  Vec3 slip = law.Slip;
  const MotionProblem around = SurroundingsOf(run.Input, run.Options);
  of.Values(around, scene.Smoke.Resolution, scene.LatticeDimensions, slip);
  return of.Sum();
}

bool FindDrawnAir(const AirContext& run, std::uint64_t key, DrawnAir& drawn)
{
  const std::string path = run.Input.Drawn.Found ? run.Input.Drawn.Found(key) : std::string();
  const auto content = [&](StateArchive& file)
  {
    file.Values(drawn);
    ReadSeries(file, drawn.Air);
    return static_cast<int>(drawn.Air.Values.size()) == run.Input.Scene.Time.NumberOfFrames;
  };
  if (path.empty() || ReadStateFile(path, DrawnKind, key, content) != StateLack::None)
  {
    drawn = DrawnAir();
    return false;
  }
  return true;
}

void KeepDrawnAir(const AirContext& run, std::uint64_t key, const DrawnAir& drawn)
{
  if (!run.Input.Drawn.Make)
  {
    return;
  }
  run.Input.Drawn.Make(key,
                       [&](const std::string& path)
                       {
                         StateFileWriter file(path, DrawnKind, key);
                         file.Values(drawn);
                         WriteSeries(file, drawn.Air, run.Parallel);
                         return file.Commit();
                       });
}

} // namespace waft
