// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AssimilationState.h"

#include "Air/Field/PackedSeries.h"
#include "Constraints/RowsOfObjects.h"

#include <algorithm>
#include <unordered_map>

namespace waft
{

void WriteSeries(StateArchive& stream, const HalfSeries& series, const ParallelFor& parallel)
{
  HalfSeries::VisitLattice(stream, series);
  WritePacked(stream, series.Values, parallel);
}

void ReadSeries(StateArchive& stream, HalfSeries& series)
{
  HalfSeries::VisitLattice(stream, series);
  ReadPacked(stream, series.Values);
}

MotionProblem SurroundingsOf(const AssimilationInput& input, const AssimilationOptions& options)
{
  MotionProblem around;
  around.Scene = input.Scene;
  around.Scene.Seed = SeedOfAir(input, options);
  around.Obstacles = input.Obstacles;
  around.Vortices = input.Vortices;
  around.Wind = input.Wind;
  return around;
}

AssimilationKey KeyOf(const AssimilationInput& input, const AssimilationOptions& options,
                      const std::vector<Constraint>& rows)
{
  AssimilationKey key;
  DigestStream around;
  const MotionProblem scene = SurroundingsOf(input, options);
  around.Values(scene);
  if (GlidesIn(input, options))
  {
    around.Values(input.Shapes);
    RotationOptions turning = input.Turning;
    turning.Seed = 0;
    around.Values(turning);
  }
  AssimilationOptions seedless = options; // whoever named the seed
  seedless.Seed = -1;
  AssimilationOptions::VisitAir(around, seedless);
  key.Surroundings = around.Sum();
  const RowsOfObjects places(rows);
  std::unordered_map<int, const MotionObject*> objects;
  for (const MotionObject& object : input.Objects)
  {
    objects[object.ObjectId] = &object;
  }
  for (const Track& track : input.Tracks)
  {
    DigestStream wanted;
    if (const auto object = objects.find(track.ObjectId); object != objects.end())
    {
      wanted.Values(*object->second);
    }
    for (const std::size_t place : places.Of(track.ObjectId))
    {
      wanted.Values(rows[place]);
    }
    key.Ids.push_back(track.ObjectId);
    key.Wanted.push_back(wanted.Sum());
    key.Planned.push_back(DigestOf(track.Positions));
  }
  return key;
}

void WriteState(StateArchive& file, const AssimilationState& state, const ParallelFor& parallel)
{
  file.Values(state);
  WriteSeries(file, state.Air->Velocity, parallel);
  WriteSeries(file, state.Air->Wind, parallel);
  WriteSeries(file, *state.Plain, parallel);
}

void ReadState(StateArchive& file, AssimilationState& state)
{
  const auto air = std::make_shared<SampledAir>();
  file.Values(state);
  ReadSeries(file, air->Velocity);
  ReadSeries(file, air->Wind);
  const auto plain = std::make_shared<HalfSeries>();
  ReadSeries(file, *plain);
  state.Air = air;
  state.Plain = plain;
}

Result WriteState(const std::string& path, const AssimilationState& state,
                  const ParallelFor& parallel)
{
  StateFileWriter file(path, AssimilationKind, DigestOf(state.Key));
  WriteState(file, state, parallel);
  return file.Commit();
}

std::string ReadState(const std::string& path, AssimilationState& state)
{
  state = AssimilationState();
  const auto content = [&state](StateArchive& file)
  {
    ReadState(file, state);
    return true;
  };
  const StateLack lack = ReadStateFile(path, AssimilationKind, {}, content);
  if (lack != StateLack::None)
  {
    state = AssimilationState();
  }
  return lack != StateLack::NoFile ? ToString(lack, AssimilationKind) : "";
}

} // namespace waft
