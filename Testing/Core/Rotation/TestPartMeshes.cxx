// SPDX-License-Identifier: BSD-3-Clause
// Bodies that would be in each other pass each other: by a turn, else by a shift, with all that is
// given as it was.
#include "Base/Random.h"
#include "Crowd.h"
#include "Refining.h"
#include "Rotation/PartMeshes.h"

#include <algorithm>
#include <map>

using namespace waft;
using namespace waft::fixtures;

namespace
{

constexpr int Frames = 91;
constexpr int Middle = 45;
const double Most = 25.0 * std::acos(-1.0) / 180.0;

Crowd Parted(const Crowd& crowd, const std::vector<Constraint>& rows, PartedMotion& parted,
             int threads = 1)
{
  Crowd after = crowd;
  RotationInput input;
  input.Scene.Time.NumberOfFrames = Frames;
  input.Scene.Bounds = Box{ Vec3::Constant(-10.0), Vec3::Constant(10.0) };
  input.Objects = crowd.Objects;
  input.Shapes = *crowd.Shapes;
  input.Constraints = rows;
  SilentMonitor silent;
  EXPECT_TRUE(
    PartMeshes(input, rows, Most, ThreadedFor(threads), silent, after.Tracks, after.Poses, parted));
  return after;
}

std::size_t Cuts(const Crowd& crowd, double depth = TouchedDepth)
{
  const PosedMotion motion = crowd.Motion();
  return FindMeshCuts(motion, KeptOf(motion, {}, 30.0), depth, SerialFor()).size();
}

/// Two leaves that come from both sides and pass at a distance, edge through face; of 0 through
/// each other's middle.
Crowd Crossing(double distance)
{
  Crowd crowd(CurledLeaf());
  crowd.Add(Vec3(0.0, -1.0, 0.0), Vec3(0.0, 1.0, 0.0), About(Vec3::UnitX(), 5.0), Frames);
  crowd.Add(Vec3(0.3 * distance, 1.0, distance), Vec3(0.3 * distance, -1.0, distance),
            About(Vec3::UnitY(), 85.0), Frames);
  return crowd;
}

Constraint PositionOf(const Crowd& crowd, int object, int frame, double radius)
{
  Constraint row;
  row.ObjectId = object;
  row.Frame = frame;
  row.Value =
    crowd.Tracks[static_cast<std::size_t>(object)].Positions[static_cast<std::size_t>(frame)];
  row.Radius = radius;
  return row;
}

double FarthestShift(const PartedMotion& parted)
{
  double farthest = 0.0;
  for (const std::vector<Vec3>& shifts : parted.Shifts)
  {
    for (const Vec3& shift : shifts)
    {
      farthest = std::max(farthest, shift.norm());
    }
  }
  return farthest;
}

void ExpectSamePose(const Crowd& one, const Crowd& other, std::size_t object, int frame)
{
  const auto f = static_cast<std::size_t>(frame);
  EXPECT_EQ(one.Poses[object].Orientations[f].coeffs(),
            other.Poses[object].Orientations[f].coeffs())
    << object << " at " << frame;
}

void ExpectSameMotion(const Crowd& one, const Crowd& other)
{
  for (std::size_t o = 0; o < one.Tracks.size(); ++o)
  {
    for (int f = 0; f < Frames; ++f)
    {
      ExpectSamePose(one, other, o, f);
      EXPECT_EQ(one.Tracks[o].Positions[static_cast<std::size_t>(f)],
                other.Tracks[o].Positions[static_cast<std::size_t>(f)]);
    }
  }
}

} // namespace

TEST(PartMeshes, ATurnIsEnoughWhereThereIsRoom)
{
  const Crowd before = Crossing(0.03);
  EXPECT_GT(Cuts(before), 0U);
  // Marks of both near their meeting: neither may leave its path.
  const std::vector<Constraint> rows = { PositionOf(before, 0, Middle, 0.0),
                                         PositionOf(before, 1, Middle, 0.0) };
  PartedMotion parted;
  const Crowd after = Parted(before, rows, parted);
  EXPECT_EQ(Cuts(after, PartedDepth), 0U);
  EXPECT_TRUE(parted.Left.empty());
  EXPECT_EQ(FarthestShift(parted), 0.0);
  int turned = 0;
  for (std::size_t o = 0; o < 2; ++o)
  {
    for (std::size_t f = 0; f < Frames; ++f)
    {
      EXPECT_EQ(after.Tracks[o].Positions[f], before.Tracks[o].Positions[f]);
      const Quat& now = after.Poses[o].Orientations[f];
      turned += now.angularDistance(before.Poses[o].Orientations[f]) > 1e-9 ? 1 : 0;
      if (f > 0)
      {
        EXPECT_LT(now.angularDistance(after.Poses[o].Orientations[f - 1]), 0.5 * Most);
      }
    }
    ExpectSamePose(before, after, o, 0);
    ExpectSamePose(before, after, o, Middle - 25);
    ExpectSamePose(before, after, o, Middle + 25);
  }
  EXPECT_GT(turned, 5);
}

TEST(PartMeshes, GivenPosesAndPlacesStayToTheBit)
{
  const Crowd before = Crossing(0.03);
  std::vector<Constraint> rows(2);
  for (int k = 0; k < 2; ++k)
  {
    rows[static_cast<std::size_t>(k)].ObjectId = k;
    rows[static_cast<std::size_t>(k)].Frame = Middle - 4 + 8 * k;
  }
  rows[0].Kind = ConstraintKind::Orientation;
  rows[1].Value = before.Tracks[1].Positions[Middle + 4];
  rows[1].Radius = 0.5;
  rows[1].Facing = Vec3::UnitX();
  PartedMotion parted;
  const Crowd after = Parted(before, rows, parted);
  ExpectSamePose(before, after, 0, Middle - 4);
  ExpectSamePose(before, after, 1, Middle + 4);
  EXPECT_LT(Cuts(after), Cuts(before));
}

TEST(PartMeshes, AShiftKeepsToTheBallsOfItsRows)
{
  // Balls, which no turn parts.
  Crowd before(Ball(0.03, 8));
  before.Add(Vec3(0.0, -0.5, 0.0), Vec3(0.0, 0.5, 0.0), Quat::Identity(), Frames);
  before.Add(Vec3(0.0, 0.5, 0.05), Vec3(0.0, -0.5, 0.05), Quat::Identity(), Frames);
  PartedMotion parted;
  const Crowd after = Parted(before, {}, parted);
  EXPECT_GT(Cuts(before), 0U);
  EXPECT_EQ(Cuts(after), 0U);
  const double free = FarthestShift(parted);
  EXPECT_GT(free, 0.004);
  const double radius = 0.5 * free;
  PartedMotion within;
  const std::vector<Constraint> rows = { PositionOf(before, 0, Middle, radius),
                                         PositionOf(before, 1, Middle, radius) };
  const Crowd held = Parted(before, rows, within);
  for (std::size_t o = 0; o < 2; ++o)
  {
    EXPECT_LE((held.Tracks[o].Positions[Middle] - before.Tracks[o].Positions[Middle]).norm(),
              radius);
    for (std::size_t f = 0; f < Frames && !within.Shifts[o].empty(); ++f)
    {
      EXPECT_LT(
        (held.Tracks[o].Positions[f] - before.Tracks[o].Positions[f] - within.Shifts[o][f]).norm(),
        1e-12);
    }
  }
}

TEST(PartMeshes, ExactMarksAtOnePlaceAreNamed)
{
  const Crowd before = Crossing(0.0);
  const std::vector<Constraint> rows = { PositionOf(before, 0, Middle, 0.0),
                                         PositionOf(before, 1, Middle, 0.0) };
  PartedMotion parted;
  const Crowd after = Parted(before, rows, parted);
  for (std::size_t o = 0; o < 2; ++o)
  {
    EXPECT_EQ(after.Tracks[o].Positions[Middle], before.Tracks[o].Positions[Middle]);
  }
  ASSERT_FALSE(parted.Left.empty());
  EXPECT_TRUE(parted.Left[0].NearMarks);
  const std::vector<std::string> warnings = WarningsOfCuts(parted.Left, after.Tracks);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].rfind("objects 0 and 1 at frame", 0), 0U) << warnings[0];
  EXPECT_NE(warnings[0].find("as their marks are nearer to each other"), std::string::npos);
}

// Ten beside whose marks there is no room are left in each other as they are, and told; of four a
// turn is tried.
TEST(PartMeshes, ACrowdOfMarksStaysAsItIs)
{
  for (const int bodies : { 4, 10 })
  {
    Crowd before(CurledLeaf());
    std::vector<Constraint> rows;
    for (int k = 0; k < bodies; ++k)
    {
      const double angle = 2.0 * M_PI * k / bodies + 0.1;
      const Vec3 way(std::cos(angle), std::sin(angle), 0.0);
      const Vec3 middle(0.0, 0.0, 0.002 * k);
      before.Add(middle - way, middle + way, About(way, 30.0 + 15.0 * k), Frames);
      rows.push_back(PositionOf(before, k, Middle, 0.0));
    }
    PartedMotion parted;
    const Crowd after = Parted(before, rows, parted);
    bool isTurned = false;
    for (std::size_t o = 0; o < before.Tracks.size(); ++o)
    {
      for (std::size_t f = 0; f < Frames; ++f)
      {
        isTurned = isTurned || after.Poses[o].Orientations[f].coeffs() !=
                                 before.Poses[o].Orientations[f].coeffs();
      }
    }
    EXPECT_EQ(isTurned, bodies == 4);
    EXPECT_TRUE(bodies == 4 || !WarningsOfCuts(parted.Left, after.Tracks).empty());
  }
}

TEST(PartMeshes, WarningsNameTheFirstFew)
{
  std::vector<Track> tracks(20);
  std::vector<MeshCut> left;
  for (std::size_t k = 0; k < 20; ++k)
  {
    tracks[k].ObjectId = static_cast<int>(k);
    tracks[k].Positions.resize(50);
  }
  for (std::size_t k = 0; k < 9; ++k)
  {
    left.push_back({ 3, k, k + 10, false });
    left.push_back({ 5, k, k + 10, false });
  }
  const std::vector<std::string> warnings = WarningsOfCuts(left, tracks);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("objects 4 and 14 at frames 3 to 5; and 4 more pairs"),
            std::string::npos)
    << warnings[0];
}

TEST(PartMeshes, ThreadsDoNotMatter)
{
  Crowd crowd(CurledLeaf());
  waft::Random random(4, 2);
  const auto place = [&]
  { return Vec3(random.Uniform(0, 0.6), random.Uniform(0, 0.6), random.Uniform(0, 0.6)); };
  for (int o = 0; o < 12; ++o)
  {
    const Vec3 from = place();
    crowd.Add(from, place(), About(Vec3::Unit(o % 3), 20.0 * o), Frames);
  }
  PartedMotion parted, again;
  const Crowd one = Parted(crowd, {}, parted, 1);
  const Crowd two = Parted(crowd, {}, again, 3);
  EXPECT_LT(Cuts(one), Cuts(crowd) / 2);
  ExpectSameMotion(one, two);
}

TEST(PartMeshes, MeetingsAtOnceAreAsOneAfterAnother)
{
  // Dense enough that changes reach the next ones, and wide enough that many do not.
  Crowd crowd(CurledLeaf());
  waft::Random random(7, 3);
  const auto place = [&]
  { return Vec3(random.Uniform(0, 1.2), random.Uniform(0, 1.2), random.Uniform(0, 0.4)); };
  for (int o = 0; o < 100; ++o)
  {
    const Vec3 from = place();
    crowd.Add(from, from + 0.5 * (place() - from), About(Vec3::Unit(o % 3), 20.0 * o), Frames);
  }
  const PosedMotion given = crowd.Motion();
  std::map<std::pair<std::size_t, std::size_t>, Meeting> pairs;
  for (const MeshCut& cut : FindMeshCuts(given, KeptOf(given, {}, 30.0), PartedDepth, SerialFor()))
  {
    Meeting& meeting =
      pairs.emplace(std::make_pair(cut.A, cut.B), Meeting{ cut.A, cut.B, cut.Frame, 0 })
        .first->second;
    meeting.Last = cut.Frame;
  }
  std::vector<Meeting> meetings;
  for (const auto& pair : pairs)
  {
    meetings.push_back(pair.second);
  }
  ASSERT_GT(meetings.size(), 20U);
  std::stable_sort(meetings.begin(), meetings.end(),
                   [](const Meeting& a, const Meeting& b) { return a.First < b.First; });

  RotationInput input;
  input.Scene.Time.NumberOfFrames = Frames;
  input.Scene.Bounds = Box{ Vec3::Constant(-10.0), Vec3::Constant(10.0) };
  input.Objects = crowd.Objects;
  input.Shapes = *crowd.Shapes;
  SilentMonitor silent;
  const auto part = [&](Crowd& motion, bool isAtOnce)
  {
    const PosedMotion posed = motion.Motion();
    PartingSearch search(input, {}, Most, posed, silent, motion.Tracks, motion.Poses);
    if (isAtOnce)
    {
      (void)search.Part(meetings, ThreadedFor(3));
      return;
    }
    for (const Meeting& meeting : meetings)
    {
      (void)search.Part({ meeting }, SerialFor());
    }
  };
  Crowd plain = crowd;
  part(plain, false);
  part(crowd, true);
  ExpectSameMotion(plain, crowd);
  int changed = 0;
  for (std::size_t o = 0; o < crowd.Tracks.size(); ++o)
  {
    changed +=
      crowd.Poses[o].Orientations[Middle].coeffs() !=
          About(Vec3::Unit(static_cast<int>(o) % 3), 20.0 * static_cast<double>(o)).coeffs()
        ? 1
        : 0;
  }
  EXPECT_GT(changed, 5);
}

TEST(PathBoxes, MissesNoneThatComesNear)
{
  waft::Random random(3, 8);
  std::vector<Track> tracks(40);
  for (Track& track : tracks)
  {
    const auto any = [&](double most)
    { return Vec3(random.Uniform(0, most), random.Uniform(0, most), random.Uniform(0, most)); };
    const Vec3 from = any(1.0);
    const Vec3 way = any(0.02);
    for (int f = 0; f < Frames; ++f)
    {
      track.Positions.push_back(from + f * way + 0.02 * any(1.0));
    }
  }
  PathBoxes boxes(tracks);
  tracks[3].Positions[40] += Vec3(0.5, 0.0, 0.0);
  boxes.Take(3);
  const double reach = 0.1;
  std::size_t said = 0;
  std::size_t asked = 0;
  for (std::size_t one = 0; one < tracks.size(); ++one)
  {
    for (const int first : { 0, 15, 16, 37, 90 })
    {
      const int last = std::min(first + 20, Frames - 1);
      std::vector<std::size_t> near;
      boxes.AddNear(one, first, last, reach, near);
      said += near.size();
      asked += tracks.size();
      for (std::size_t other = 0; other < tracks.size(); ++other)
      {
        bool comes = false;
        for (auto f = static_cast<std::size_t>(first); f <= static_cast<std::size_t>(last); ++f)
        {
          comes = comes || (tracks[one].Positions[f] - tracks[other].Positions[f]).norm() < reach;
        }
        const bool isNamed = std::find(near.begin(), near.end(), other) != near.end();
        EXPECT_TRUE(!comes || one == other || isNamed) << one << " and " << other;
        EXPECT_TRUE(!comes || boxes.MayMeet(one, other, first, last, reach));
      }
    }
  }
  EXPECT_LT(said, asked / 2);
}

TEST(PartMeshes, AStopLeavesNothingChanged)
{
  // The stage gives no poses then; the search has to end at once.
  class Stopper : public Monitor
  {
  public:
    bool Tick(double, const std::string&) override { return false; }
  };
  Crowd crowd = Crossing(0.03);
  RotationInput input;
  input.Scene.Time.NumberOfFrames = Frames;
  input.Objects = crowd.Objects;
  input.Shapes = *crowd.Shapes;
  Stopper stopper;
  PartedMotion parted;
  const Crowd before = crowd;
  EXPECT_FALSE(
    PartMeshes(input, {}, Most, SerialFor(), stopper, crowd.Tracks, crowd.Poses, parted));
  ExpectSamePose(before, crowd, 0, Middle);
}

TEST(PartMeshes, TheStageTellsWhatItChangesOfFlownPoses)
{
  // Two leaves that were turned with their paths, which then are led through each other.
  Shape leaf = CurledLeaf();
  RotationInput input =
    OneObject(leaf, StraightPath(Vec3(0.0, 0.0, 2.0), Vec3(0.0, 0.3, 0.0), 120));
  input.Objects.push_back(input.Objects[0]);
  input.Objects[1].ObjectId = 1;
  input.Tracks.push_back(input.Tracks[0]);
  input.Tracks[1].ObjectId = 1;
  input.Tracks[1].Positions = StraightPath(Vec3(0.02, 1.2, 2.01), Vec3(0.0, -0.3, 0.0), 120);
  for (MotionObject& object : input.Objects)
  {
    object.OrientationGiven = 0;
  }
  input.Scene.Bounds = Box{ Vec3::Constant(-10.0), Vec3::Constant(10.0) };
  input.Glides = true;
  const RotationOutput flown = Refine(input);
  input.Glides = false;
  for (std::size_t i = 0; i < 2; ++i)
  {
    input.Tracks[i].Slips = flown.Poses[i].Slips;
    input.Tracks[i].Orientations = flown.Poses[i].Orientations;
    input.Tracks[i].AngularVelocities = flown.Poses[i].AngularVelocities;
  }
  const RotationOutput apart = Refine(input, {}, 1, true);
  const RotationOutput through = Refine(input, {}, 1, false);
  double turned = 0.0, away = 0.0;
  for (std::size_t i = 0; i < 2; ++i)
  {
    for (std::size_t f = 0; f < 120; ++f)
    {
      turned = std::max(
        turned, apart.Poses[i].Orientations[f].angularDistance(through.Poses[i].Orientations[f]));
    }
    ASSERT_EQ(apart.Away[i].size(), through.Away[i].size());
    for (std::size_t k = 0; k < apart.Away[i].size(); ++k)
    {
      away = std::max(away, apart.Away[i][k] - through.Away[i][k]);
    }
  }
  EXPECT_GT(turned, 0.05);
  EXPECT_GT(away, 0.2 * turned) << "agreement is that of the poses in the end";
}
