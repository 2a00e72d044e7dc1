// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AssimilationState.h"

#include "Air/Field/PackedSeries.h"

#include <algorithm>

namespace waft
{
namespace
{

constexpr const char* Format = "Waft assimilation 3";

// A digest changes nothing of what it reads.
template <class T>
T& Read(const T& value)
{
  return const_cast<T&>(value);
}

void SerialiseSeries(StateArchive& stream, HalfSeries& series, const ParallelFor& parallel)
{
  stream.Values(series.Meaning, series.Dimensions[0], series.Dimensions[1], series.Dimensions[2],
                series.Origin, series.Spacing);
  stream.List(series.Times);
  SerialisePacked(stream, series.Values, parallel);
}

// What is written is only read of, what is read is made anew: the air may be another's, too.
void SerialiseAir(StateArchive& stream, std::shared_ptr<const DrawnAir>& air,
                  const ParallelFor& parallel)
{
  const auto moved =
    stream.IsReading() ? std::make_shared<DrawnAir>() : std::const_pointer_cast<DrawnAir>(air);
  SerialiseSeries(stream, moved->Velocity, parallel);
  SerialiseSeries(stream, moved->Wind, parallel);
  air = moved;
}

void SerialiseRound(StateArchive& stream, AssimilationRound& row)
{
  stream.Text(row.Stage);
  stream.Text(row.Candidate);
  stream.Values(row.Control, row.MedianControl, row.Flow, row.Wind, row.Seconds);
}

void Serialise(StateArchive& stream, AssimilationState& state, const ParallelFor& parallel)
{
  stream.Value(state.Key.Surroundings);
  stream.List(state.Key.Ids);
  stream.List(state.Key.Wanted);
  stream.List(state.Key.Planned);
  stream.Values(state.Rounds, state.IsFinished);
  stream.Text(state.Candidate);
  stream.List(state.Forces.Vortices, [](StateArchive& s, Vortex& v) { Serialise(s, v); });
  stream.List(state.Forces.Winds, [](StateArchive& s, AnalyticWind& w) { Serialise(s, w); });
  SerialiseAir(stream, state.Air, parallel);
  stream.List(state.Paths, [](StateArchive& s, std::vector<Vec3>& path) { s.List(path); });
  const auto frames = [](StateArchive& s, std::vector<int>& list) { s.List(list); };
  stream.List(state.TouchDowns, frames);
  stream.List(state.LiftOffs, frames);
  stream.List(state.Table, SerialiseRound);
}

} // namespace

AssimilationKey KeyOf(const AssimilationInput& input, const AssimilationOptions& options)
{
  AssimilationKey key;
  DigestStream around;
  AssimilationInput scene; // without objects and rows
  scene.Scene = input.Scene;
  scene.Scene.Seed = SeedOfAir(input, options);
  scene.Obstacles = input.Obstacles;
  scene.Vortices = input.Vortices;
  scene.Wind = input.Wind;
  Serialise(around, scene);
  AssimilationOptions seedless = options; // whoever named the seed
  seedless.Seed = -1;
  AssimilationOptions::VisitAir(SerialiseFieldsWith(around), seedless);
  key.Surroundings = around.Sum();
  for (const Track& track : input.Tracks)
  {
    DigestStream wanted, planned;
    for (const MotionObject& object : input.Objects)
    {
      if (object.ObjectId == track.ObjectId)
      {
        Serialise(wanted, Read(object));
      }
    }
    for (const Constraint& row : input.Constraints)
    {
      if (row.ObjectId == track.ObjectId)
      {
        Serialise(wanted, Read(row));
      }
    }
    planned.List(Read(track.Positions));
    key.Ids.push_back(track.ObjectId);
    key.Wanted.push_back(wanted.Sum());
    key.Planned.push_back(planned.Sum());
  }
  return key;
}

Result WriteState(const std::string& path, AssimilationState& state, const ParallelFor& parallel)
{
  StateFileWriter file(path);
  std::string format = Format;
  file.Text(format);
  Serialise(file, state, parallel);
  return file.Commit();
}

std::string ReadState(const std::string& path, AssimilationState& state)
{
  state = AssimilationState();
  if (!StateFileReader(path).IsGood())
  {
    return "";
  }
  if (!IsWholeStateFile(path))
  {
    return "is damaged";
  }
  StateFileReader file(path);
  std::string format;
  file.Text(format);
  if (format != Format)
  {
    return "is no assimilation of this version";
  }
  Serialise(file, state, SerialFor());
  if (!file.IsAtEnd())
  {
    state = AssimilationState();
    return "is incomplete";
  }
  return "";
}

} // namespace waft
