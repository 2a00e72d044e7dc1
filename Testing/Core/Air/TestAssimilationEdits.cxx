// SPDX-License-Identifier: BSD-3-Clause
// How bodies move in an air, what an edit leaves alone, and what objects keep to besides rows.
#include "Air/Field/AirStatistics.h"
#include "Air/Run/AssimilationState.h"
#include "Base/Primitives.h"
#include "Constraints/ConstraintCheck.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <cstdio>

using namespace waft;

namespace
{

constexpr int Frames = 46;

// Bodies whose ways cross half way.
AssimilationInput Crossing()
{
  AssimilationInput input;
  input.Scene.Time = { Frames, 30.0 };
  ObstacleMesh ground;
  ground.Mesh = MakeBox({ Vec3(-3.0, -3.0, -1.0), Vec3(3.0, 3.0, 0.0) });
  input.Obstacles.push_back(ground);
  for (int o = 0; o < 3; ++o)
  {
    const double angle = 2.0 * M_PI * o / 3.0;
    const Vec3 side(0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.0);
    MotionObject object;
    object.ObjectId = o;
    object.Position = Vec3(0.0, 0.0, 2.0) + side;
    object.SettlingSpeed = 0.5;
    input.Objects.push_back(object);
    Constraint row;
    row.ObjectId = o;
    row.Row = o;
    row.Frame = 40;
    row.Value = Vec3(0.0, 0.0, 1.5) - side;
    input.Constraints.push_back(row);
    Track track;
    track.ObjectId = o;
    for (int f = 0; f < Frames; ++f)
    {
      const double s = std::min(1.0, f / 40.0);
      track.Positions.push_back((1.0 - s) * object.Position + s * row.Value);
    }
    input.Tracks.push_back(track);
  }
  return input;
}

AssimilationOptions Small()
{
  AssimilationOptions options;
  options.Resolution = 16;
  options.LatticeResolution = 16;
  options.Rounds = 1;
  options.Starts = 0;
  options.Candidates = 1;
  return options;
}

AssimilationOutput Assimilated(const AssimilationInput& input, const AssimilationOptions& options,
                               AssimilationState* memory = nullptr)
{
  SilentMonitor monitor;
  AssimilationOutput output;
  const Result result = AssimilateAir(input, options, {}, SerialFor(), monitor, output, memory);
  EXPECT_TRUE(static_cast<bool>(result)) << result.Message();
  return output;
}

// Of the first drift.
double DriftControl(const AssimilationOutput& output)
{
  const auto row = std::find_if(output.Rounds.begin(), output.Rounds.end(),
                                [](const AssimilationRound& r) { return r.Stage == "drift"; });
  return row->Control;
}

} // namespace

TEST(AirStatistics, AreThoseOfASolidRotation)
{
  // About the upright axis of a box: v = w x r, so that <v^2> about its mean is w^2 <x^2 + y^2>,
  // and |v - v'|^2 = w^2 |r - r'|^2 in the plane.
  const double spin = 0.2;
  FieldSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { 9, 9, 9 };
  air.Origin = Vec3(-2.0, -2.0, 0.0);
  air.Spacing = Vec3::Constant(0.5);
  for (int frame = 0; frame < 61; ++frame)
  {
    air.Times.push_back(frame / 30.0);
    air.Values.emplace_back();
    for (std::size_t p = 0; p < air.NumberOfPoints(); ++p)
    {
      const double x = -2.0 + 0.5 * static_cast<double>(p % 9);
      const double y = -2.0 + 0.5 * static_cast<double>(p / 9 % 9);
      air.Values.back().push_back(
        { static_cast<float>(-spin * y), static_cast<float>(spin * x), 0.0f });
    }
  }
  const AirStatistics found = DriftStatistics(HalfSeries(air), 30.0, BodyLaw(), SerialFor());
  const double expected = spin * spin * 2.0 * 16.0 / 12.0; // of places all over the box
  EXPECT_NEAR(found.VelocityVariance, expected, 0.2 * expected);
  EXPECT_NEAR(found.AccelerationVariance, spin * spin * expected, 0.25 * spin * spin * expected);
  for (std::size_t bin = 1; bin < found.Structure.size(); ++bin)
  {
    EXPECT_GT(found.Structure[bin], found.Structure[bin - 1]);
  }
  EXPECT_EQ(StructureDistance(found, found), 0.0);
}

TEST(AirStatistics, OfOneBodyAreAboutItsOwnMean)
{
  // Once round in two seconds, carried and sinking evenly: |v - mean| = w r, |a| = w^2 r.
  const double rate = 30.0, radius = 0.3, spin = M_PI;
  FreeFlights flights;
  flights.Paths.emplace_back();
  for (int f = 0; f < 122; ++f)
  {
    const double t = f / rate;
    flights.Paths[0].emplace_back(radius * std::cos(spin * t) + 0.4 * t,
                                  radius * std::sin(spin * t), 3.0 - 0.5 * t);
  }
  flights.IsFree.emplace_back(122, 1);
  AirStatistics found = StatisticsOf(flights, rate, 4.0);
  const double velocity = std::pow(spin * radius, 2), acceleration = std::pow(spin, 2) * velocity;
  EXPECT_NEAR(found.OwnVelocityVariance, velocity * 60.0 / 59.0, 0.01 * velocity);
  EXPECT_NEAR(found.OwnAccelerationVariance, acceleration * 60.0 / 59.0, 0.01 * acceleration);
  EXPECT_EQ(found.VelocityVariance, 0.0);

  flights.IsFree[0].assign(122, 0); // no window is free all the time
  std::fill_n(flights.IsFree[0].begin() + 20, 59, 1);
  found = StatisticsOf(flights, rate, 4.0);
  EXPECT_EQ(found.OwnVelocityVariance, 0.0);
}

TEST(AssimilationContacts, BodiesWhoseWaysCrossKeepApart)
{
  const AssimilationInput input = Crossing();
  const AssimilationOutput output = Assimilated(input, Small());
  const double kept = 2.0 * input.Objects[0].ClearanceRadius;
  for (int f = 0; f < Frames; ++f)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        const Vec3 apart = output.Tracks[a].Positions[f] - output.Tracks[b].Positions[f];
        EXPECT_GT(apart.norm(), 0.95 * kept) << f;
      }
    }
  }
}

TEST(AssimilationEdits, AMovedMarkLeavesTheAirAndTheOthersAsTheyWere)
{
  AssimilationState memory;
  AssimilationInput input = Crossing();
  const AssimilationOutput before = Assimilated(input, Small(), &memory);
  EXPECT_TRUE(memory.IsFinished);
  input.Constraints[1].Value += Vec3(0.1, 0.0, 0.1);
  const AssimilationOutput after = Assimilated(input, Small(), &memory);
  EXPECT_EQ(after.Tracks[1].Positions[40], input.Constraints[1].Value);
  EXPECT_EQ(before.Tracks[0].Positions, after.Tracks[0].Positions);
  EXPECT_EQ(before.Tracks[2].Positions, after.Tracks[2].Positions);
  EXPECT_EQ(before.Air->Velocity.Values, after.Air->Velocity.Values);

  // From a file, the same.
  const std::string path = testing::TempDir() + "waft-edit.state";
  AssimilationOptions options = Small();
  options.StateFile = path;
  (void)Assimilated(Crossing(), options);
  options.StateFile.clear();
  options.EditOf = path;
  const AssimilationOutput read = Assimilated(input, options);
  EXPECT_EQ(read.Tracks[1].Positions, after.Tracks[1].Positions);
  EXPECT_EQ(read.Tracks[0].Positions, after.Tracks[0].Positions);
  EXPECT_EQ(read.Warnings, after.Warnings);

  // Of another scene it is told and left.
  input.Scene.Seed += 1;
  const AssimilationOutput other = Assimilated(input, options);
  ASSERT_FALSE(other.Warnings.empty());
  EXPECT_NE(other.Warnings.front().find("is of another scene"), std::string::npos)
    << other.Warnings.front();
  EXPECT_NE(other.Air->Velocity.Values, after.Air->Velocity.Values);
  std::remove(path.c_str());
}

TEST(AssimilationEdits, ACheckpointGoesOnToTheSameBits)
{
  class StopsAt : public Monitor
  {
  public:
    explicit StopsAt(double part) : Part(part) {}
    bool Tick(double fraction, const std::string&) override { return fraction < this->Part; }

  private:
    double Part;
  };
  const AssimilationOutput whole = Assimilated(Crossing(), Small());
  AssimilationOptions options = Small();
  options.CheckpointFile = testing::TempDir() + "waft-assimilation.state";
  bool wasCorrected = false;
  for (const double part : { 0.3, 0.5, 0.6, 0.85 })
  {
    StopsAt stopping(part);
    AssimilationOutput stopped;
    EXPECT_TRUE(AssimilateAir(Crossing(), options, {}, SerialFor(), stopping, stopped).IsStopped());
    AssimilationState state;
    EXPECT_EQ(ReadState(options.CheckpointFile, state), "");
    EXPECT_FALSE(state.IsEmpty());
    wasCorrected = wasCorrected || !state.Plain->IsEmpty();
    const AssimilationOutput resumed = Assimilated(Crossing(), options);
    EXPECT_EQ(resumed.Warnings, whole.Warnings);
    for (std::size_t o = 0; o < 3; ++o)
    {
      EXPECT_EQ(whole.Tracks[o].Positions, resumed.Tracks[o].Positions) << part;
    }
    EXPECT_EQ(whole.Air->Wind.Values, resumed.Air->Wind.Values);
    EXPECT_EQ(ReadState(options.CheckpointFile, state), ""); // it is gone
    EXPECT_TRUE(state.IsEmpty());
  }
  EXPECT_TRUE(wasCorrected);
}

TEST(AssimilationStart, IsTheVelocityThatIsGiven)
{
  AssimilationInput input = Crossing();
  input.Objects[0].Velocity = Vec3(0.3, -0.2, 0.1);
  input.Objects[0].VelocityGiven = 1;
  const AssimilationOutput output = Assimilated(input, Small());
  const Vec3 begun = CentralDifferences(output.Tracks[0].Positions, 1.0 / 30.0).front();
  EXPECT_LT((begun - input.Objects[0].Velocity).norm(), 1e-12);
}

TEST(AssimilationStart, OfWhatHangsIsItsRelease)
{
  AssimilationInput input = Crossing();
  for (MotionObject& object : input.Objects)
  {
    object.Release = 10;
  }
  input.Objects[1].Velocity = Vec3(0.3, -0.2, 0.1);
  input.Objects[1].VelocityGiven = 1;
  AssimilationInput early = input;
  early.Constraints[2].Frame = 10;
  const AssimilationOutput output = Assimilated(input, Small());
  for (std::size_t o = 0; o < 3; ++o)
  {
    const std::vector<Vec3>& path = output.Tracks[o].Positions;
    EXPECT_EQ(output.Tracks[o].Release, 10);
    for (std::size_t f = 0; f <= 10; ++f)
    {
      EXPECT_EQ(path[f], input.Objects[o].Position);
      EXPECT_EQ(output.Free[o][f], f == 10 && o != 1 ? 1 : 0) << o << " " << f;
    }
    EXPECT_EQ(path[40], input.Constraints[o].Value);
    const Vec3 begun = 30.0 * (path[11] - path[10]);
    if (o == 1)
    {
      EXPECT_LT((begun - input.Objects[1].Velocity).norm(), 1e-9);
    }
    else
    {
      EXPECT_LT(begun.norm(), 0.35) << "from rest, not as the air goes by";
    }
  }
  const AssimilationOutput refused = Assimilated(early, Small());
  const ReportRow* line = FindLine(refused.Report, 2, 0);
  EXPECT_EQ(line->Status, ConstraintStatus::Infeasible);
  EXPECT_NE(line->Message.find("object 2 hangs at its start until frame 10"), std::string::npos);
}

TEST(AssimilationRows, WhatCannotBeReachedIsComeToAsThePlanDoes)
{
  AssimilationInput input = Crossing();
  input.Constraints[2].Status = ConstraintStatus::Unreachable;
  const Vec3 planned = input.Tracks[2].Positions[40] + Vec3(0.4, 0.0, 0.0);
  for (int f = 30; f < Frames; ++f)
  {
    input.Tracks[2].Positions[f] += std::min(1.0, (f - 30) / 10.0) * Vec3(0.4, 0.0, 0.0);
  }
  const AssimilationOutput output = Assimilated(input, Small());
  EXPECT_EQ(output.Tracks[2].Positions[40], planned);
}

TEST(AssimilationWho, MarksGoToWhomTheAirBringsThereAndStayWithThemInEdits)
{
  AssimilationInput input = Crossing();
  for (Constraint& row : input.Constraints)
  {
    row.Choice = ObjectChoice::AmongAll;
    row.Group = 0;
  }
  AssimilationOptions options = Small();
  options.Rounds = 0;
  AssimilationInput given = input;
  for (Constraint& row : given.Constraints)
  {
    row.Choice = ObjectChoice::Given;
  }
  AssimilationState memory;
  const AssimilationOutput chosen = Assimilated(input, options, &memory);
  EXPECT_LT(DriftControl(chosen), 0.9 * DriftControl(Assimilated(given, options)));
  int changed = 0;
  std::vector<int> ids;
  for (std::size_t i = 0; i < input.Constraints.size(); ++i)
  {
    const Constraint& row = chosen.Constraints[i];
    ids.push_back(row.ObjectId);
    changed += row.ObjectId != input.Constraints[i].ObjectId ? 1 : 0;
    const auto track = std::find_if(chosen.Tracks.begin(), chosen.Tracks.end(),
                                    [&](const Track& t) { return t.ObjectId == row.ObjectId; });
    EXPECT_EQ(track->Positions[40], row.Value);
    EXPECT_EQ(FindLine(chosen.Report, row.Row, row.Target)->ObjectId, row.ObjectId);
  }
  EXPECT_GT(changed, 0);
  std::vector<int> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());

  input.Constraints[1].Value.z() += 0.05;
  const AssimilationOutput edited = Assimilated(input, options, &memory);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    EXPECT_EQ(edited.Constraints[i].ObjectId, ids[i]);
  }
  for (std::size_t o = 0; o < edited.Tracks.size(); ++o)
  {
    const bool isEdited = edited.Tracks[o].ObjectId == ids[1];
    EXPECT_EQ(edited.Tracks[o].Positions != chosen.Tracks[o].Positions, isEdited) << o;
  }
}

TEST(AssimilationWhen, EachComesWhereItCostsLeastInItsWindowAndStaysThereInEdits)
{
  AssimilationInput input = Crossing();
  for (Constraint& row : input.Constraints)
  {
    row.FrameFrom = 12;
    row.IsOpenWindow = true;
    row.Value = input.Objects[static_cast<std::size_t>(row.ObjectId)].Position;
    row.Value.z() -= 0.2; // it sinks so far by frame 12 in still air
  }
  Constraint speed = input.Constraints[1]; // goes with its position
  speed.Kind = ConstraintKind::Velocity;
  speed.Value = Vec3(0.0, 0.0, -0.4);
  input.Constraints.push_back(speed);
  AssimilationOptions options = Small();
  options.Rounds = 0;
  AssimilationInput fixed = input;
  for (Constraint& row : fixed.Constraints)
  {
    SetArrival(row.Frame, row.Value, row);
  }
  AssimilationState memory;
  const AssimilationOutput found = Assimilated(input, options, &memory);
  EXPECT_LT(DriftControl(found), 0.9 * DriftControl(Assimilated(fixed, options)));
  std::vector<int> frames;
  for (const Constraint& row : found.Constraints)
  {
    EXPECT_FALSE(row.IsOpenWindow);
    EXPECT_EQ(row.FrameFrom, 12);
    EXPECT_GE(row.Frame, 12);
    EXPECT_LE(row.Frame, 40);
    EXPECT_EQ(row.Until, row.Frame);
    frames.push_back(row.Frame);
    const std::vector<Vec3>& path = found.Tracks[static_cast<std::size_t>(row.ObjectId)].Positions;
    const auto f = static_cast<std::size_t>(row.Frame);
    if (row.Kind == ConstraintKind::Position)
    {
      EXPECT_EQ(path[f], row.Value);
    }
    else
    {
      EXPECT_LT((15.0 * (path[f + 1] - path[f - 1]) - row.Value).norm(), 1e-9);
    }
    const ReportRow* line = FindLine(found.Report, row.Row, row.Target);
    EXPECT_EQ(line->Status, ConstraintStatus::Met) << line->Message;
    EXPECT_EQ(line->Arrival, row.Frame);
  }
  EXPECT_EQ(frames[3], frames[1]);

  input.Constraints[0].Value.z() += 0.05;
  const AssimilationOutput edited = Assimilated(input, options, &memory);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    EXPECT_EQ(edited.Constraints[i].Frame, frames[i]);
  }
  EXPECT_NE(edited.Tracks[0].Positions, found.Tracks[0].Positions);
  EXPECT_EQ(edited.Tracks[1].Positions, found.Tracks[1].Positions);
  EXPECT_EQ(edited.Tracks[2].Positions, found.Tracks[2].Positions);
}

TEST(AssimilationWhen, WhoAndWhenAreChosenTogether)
{
  AssimilationInput input = Crossing();
  for (Constraint& row : input.Constraints)
  {
    row.Choice = ObjectChoice::AmongAll;
    row.Group = 0;
    row.FrameFrom = 20;
    row.IsOpenWindow = true;
  }
  AssimilationOptions options = Small();
  options.Rounds = 0;
  const AssimilationOutput found = Assimilated(input, options);
  std::vector<int> ids;
  for (const Constraint& row : found.Constraints)
  {
    EXPECT_FALSE(row.IsOpenWindow);
    ids.push_back(row.ObjectId);
    const std::vector<Vec3>& path = found.Tracks[static_cast<std::size_t>(row.ObjectId)].Positions;
    EXPECT_EQ(path[static_cast<std::size_t>(row.Frame)], row.Value);
  }
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(ids, (std::vector<int>{ 0, 1, 2 }));
}

TEST(AssimilationWhen, ARestOfAWindowLiesFromItsFrameOn)
{
  AssimilationInput input = Crossing();
  for (Constraint& row : input.Constraints)
  {
    row.Kind = ConstraintKind::Rest;
    row.FrameFrom = 24;
    row.Until = Frames - 1;
    row.IsOpenWindow = true;
    row.Value.z() = 0.5;
  }
  for (std::size_t o = 0; o < input.Objects.size(); ++o)
  {
    input.Objects[o].Position.z() = 0.7;
    for (Vec3& x : input.Tracks[o].Positions)
    {
      x.z() *= 0.35; // down to the ground and below 0.7 m
    }
    input.Tracks[o].Positions.front() = input.Objects[o].Position;
  }
  AssimilationOptions options = Small();
  options.Rounds = 0;
  const AssimilationOutput found = Assimilated(input, options);
  for (const Constraint& row : found.Constraints)
  {
    if (row.Row == OfNoRow)
    {
      continue;
    }
    EXPECT_GE(row.Frame, 24);
    EXPECT_LE(row.Frame, 40);
    EXPECT_EQ(row.TouchDown, row.Frame) << "no spread but the window";
    EXPECT_EQ(row.LiftOff, Frames - 1);
    const std::vector<Vec3>& path = found.Tracks[static_cast<std::size_t>(row.ObjectId)].Positions;
    for (int f = row.Frame; f < Frames; ++f)
    {
      EXPECT_EQ(path[static_cast<std::size_t>(f)], path.back());
    }
  }
}

// Two bodies whose marks are crosswise, behind a wall: the exchange needs plans over it.
TEST(AssimilationWho, WithAnObstacleBetweenAPlanAroundItIsAskedFor)
{
  AssimilationInput input = Crossing();
  ObstacleMesh wall;
  wall.ObstacleId = 1;
  wall.Mesh = MakeBox({ Vec3(-0.15, -1.6, 0.0), Vec3(0.15, 1.6, 2.6) });
  input.Obstacles.push_back(wall);
  input.Objects.resize(2);
  input.Constraints.resize(2);
  input.Tracks.resize(2);
  const auto over = [](const Vec3& from, const Vec3& to)
  {
    std::vector<Vec3> path;
    for (int f = 0; f < Frames; ++f)
    {
      const double s = std::min(1.0, f / 40.0);
      path.push_back((1.0 - s) * from + s * to + Vec3(0.0, 0.0, 1.4 * std::sin(M_PI * s)));
    }
    return path;
  };
  for (std::size_t o = 0; o < 2; ++o)
  {
    const double side = o == 0 ? 0.5 : -0.5;
    input.Objects[o].Position = Vec3(-0.8, side, 2.2);
    Constraint& row = input.Constraints[o];
    row.Value = Vec3(0.8, -side, 2.0);
    row.Choice = ObjectChoice::AmongAll;
    row.Group = 0;
    input.Tracks[o].Positions = over(input.Objects[o].Position, row.Value);
  }
  AssimilationOptions options = Small();
  options.Rounds = 0;
  const auto who = [](const AssimilationOutput& output)
  {
    const auto row = std::find_if(output.Rounds.begin(), output.Rounds.end(),
                                  [](const AssimilationRound& r) { return r.Stage == "who"; });
    return row->Candidate;
  };
  const AssimilationOutput alone = Assimilated(input, options);
  EXPECT_EQ(alone.Constraints[0].ObjectId, 0);
  EXPECT_NE(who(alone).find("2 pairs with an obstacle between were left out"), std::string::npos)
    << who(alone);
  std::size_t asked = 0;
  input.PlanAround =
    [&](const std::vector<MotionObject>& objects, const std::vector<Constraint>& rows)
  {
    std::vector<std::vector<Vec3>> paths;
    for (std::size_t k = 0; k < objects.size(); ++k)
    {
      EXPECT_EQ(rows[k].ObjectId, objects[k].ObjectId);
      paths.push_back(over(objects[k].Position, rows[k].Value));
    }
    asked += objects.size();
    return paths;
  };
  const AssimilationOutput planned = Assimilated(input, options);
  EXPECT_GE(asked, 2u);
  EXPECT_EQ(planned.Constraints[0].ObjectId, 1);
  EXPECT_EQ(planned.Constraints[1].ObjectId, 0);
  EXPECT_EQ(who(planned).find("left out"), std::string::npos);
  for (const Track& track : planned.Tracks)
  {
    const Vec3& first = track.Positions.front();
    EXPECT_EQ(track.Positions[40], Vec3(0.8, first.y(), 2.0)) << track.ObjectId;
  }
}
