// SPDX-License-Identifier: BSD-3-Clause
// Bodies that several ranks turn: the bytes of one.
#include "Base/ThreadRanks.h"
#include "Refining.h"
#include "Rotation/BodyTurner.h"

#include <cstring>

using namespace waft;
using namespace waft::fixtures;

namespace
{

/// Leaves on one path beside each other, of which some are asked for what no turning rate can meet,
/// in a wind that ranks are not told (isBlown) or without.
RotationInput Leaves(bool isBlown)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  for (int id = 1; id < 36; ++id)
  {
    MotionObject object = input.Objects[0];
    object.ObjectId = 5 * id;
    input.Objects.push_back(object);
    Track track = input.Tracks[0];
    track.ObjectId = object.ObjectId;
    for (Vec3& place : track.Positions)
    {
      place.y() += 0.5 * id;
    }
    input.Tracks.push_back(track);
    for (const int frame : { 30, 31 + 10 * (id % 2) })
    {
      Constraint row = OrientationRow(frame, ExpMap(Vec3(frame == 30 ? 2.5 : -0.5, 0.3 * id, 0.1)));
      row.ObjectId = object.ObjectId;
      row.Row = static_cast<int>(input.Constraints.size());
      input.Constraints.push_back(row);
    }
  }
  static const FieldSeries wind = []
  {
    FieldSeries field;
    field.Meaning = FieldMeaning::Velocity;
    field.Dimensions = { 2, 2, 2 };
    field.Origin = Vec3(-10.0, -10.0, -10.0);
    field.Spacing = Vec3(20.0, 20.0, 20.0);
    field.Times = { 0.0 };
    field.Values = { FieldSeries::Field(8, { 0.5f, 0.2f, 0.1f }) };
    return field;
  }();
  input.Wind = isBlown ? &wind : nullptr;
  return input;
}

struct Turned
{
  RotationOutput Output;
  int Jobs = 0;
};

Turned TurnedBy(int size, bool isBlown)
{
  Turned turned;
  std::atomic<int> jobs{ 0 };
  EXPECT_TRUE(RunRanks(size,
                       [&](Communicator& ranks)
                       {
                         if (!ranks.IsFirst())
                         {
                           Serve(ranks,
                                 { { TurningKind, [&](ReadingStream& inputs, SharedItems& items)
                                     {
                                       ++jobs;
                                       return ServeTurning(inputs, items, 2, ThreadedFor(2));
                                     } } });
                           return;
                         }
                         RotationInput input = Leaves(isBlown);
                         input.Ranks = &ranks;
                         turned.Output = Refine(input, {}, 2, true);
                         Release(ranks);
                       }));
  turned.Jobs = jobs;
  return turned;
}

} // namespace

TEST(TurningRanks, GiveTheBytesOfOne)
{
  const RotationOutput one = TurnedBy(1, false).Output;
  EXPECT_FALSE(one.Warnings.empty());
  for (const int size : { 2, 3, 5 })
  {
    const Turned turned = TurnedBy(size, false);
    const RotationOutput& other = turned.Output;
    EXPECT_EQ(turned.Jobs, size - 1);
    EXPECT_EQ(DigestOf(one.Poses), DigestOf(other.Poses)) << size;
    EXPECT_EQ(DigestOf(one.Shifts), DigestOf(other.Shifts));
    EXPECT_EQ(DigestOf(one.Away), DigestOf(other.Away));
    EXPECT_EQ(DigestOf(one.Constraints), DigestOf(other.Constraints));
    EXPECT_EQ(DigestOf(one.Report), DigestOf(other.Report));
    EXPECT_EQ(one.Warnings, other.Warnings);
    ASSERT_EQ(one.Factors.size(), other.Factors.size());
    EXPECT_EQ(std::memcmp(one.Factors.data(), other.Factors.data(),
                          one.Factors.size() * sizeof(BodyFactors)),
              0);
  }
}

TEST(TurningRanks, AreNotAskedWhereTheyLackTheWind)
{
  const Turned one = TurnedBy(1, true);
  const Turned other = TurnedBy(3, true);
  EXPECT_EQ(other.Jobs, 0);
  EXPECT_EQ(DigestOf(one.Output.Poses), DigestOf(other.Output.Poses));
}
