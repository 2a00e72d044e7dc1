// SPDX-License-Identifier: BSD-3-Clause
// Prints the cost of turning many leaves: processor seconds, all shapes rasterised anew.
#include "Base/Random.h"
#include "RotationFixtures.h"

#include <cstdio>
#include <ctime>

using namespace waft;
using namespace waft::fixtures;

namespace
{
RotationInput ManyLeaves(int count, int frames, const ObstacleSet& ground)
{
  RotationInput input = OneObject(CurledLeaf(), StraightPath(Vec3::Zero(), Vec3::Zero(), frames));
  input.Obstacles = &ground;
  const MotionObject leaf = input.Objects[0];
  input.Objects.clear();
  input.Tracks.clear();
  Random random(1);
  for (int i = 0; i < count; ++i)
  {
    MotionObject object = leaf;
    object.ObjectId = i;
    const Vec3 axis = random.Direction();
    object.Orientation = ExpMap(random.Uniform(0.0, 3.0) * axis);
    const Vec3 place(random.Uniform(-1.5, 1.5), random.Uniform(-1.5, 1.5), object.RestHeight);
    Track track;
    track.ObjectId = i;
    track.Positions = LandingPath(place, frames * 9 / 10, frames, 0.1 * i);
    input.Objects.push_back(object);
    input.Tracks.push_back(track);
    Constraint rest;
    rest.ObjectId = i;
    rest.Kind = ConstraintKind::Rest;
    rest.Frame = frames * 9 / 10;
    rest.Until = frames - 1;
    rest.Value = place;
    input.Constraints.push_back(rest);
  }
  return input;
}
} // namespace

int main()
{
  ObstacleMesh slab;
  slab.Mesh = MakeBox({ Vec3(-4.0, -4.0, -1.0), Vec3(4.0, 4.0, 0.0) });
  ObstacleSet ground;
  if (!ground.Build({ slab }))
  {
    return 1;
  }
  for (const int count : { 125, 1000 })
  {
    const RotationInput input = ManyLeaves(count, 300, ground);
    for (const AirModel model : { AirModel::Paper, AirModel::Plate })
    {
      RotationOptions options;
      options.Model = model;
      RotationOutput output;
      SilentMonitor silent;
      const std::clock_t begin = std::clock();
      const Result result = RunRotationRefine(input, options, SerialFor(), silent, output);
      const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      std::printf("%d objects x 300 frames, %s: %.2f s of processor time, %zu warnings%s\n", count,
                  model == AirModel::Paper ? "Paper" : "Plate", seconds, output.Warnings.size(),
                  result ? "" : result.Message().c_str());
    }
  }
  return 0;
}
