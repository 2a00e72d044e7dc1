// SPDX-License-Identifier: BSD-3-Clause
// Bodies that land on level ground, on an obstacle and on a terrain, lie there and lift off again;
// meshes that pass close by.
#include "Base/Random.h"
#include "Constraints/Rest.h"
#include "Refining.h"
#include "Rotation/Contact.h"
#include "Rotation/PlaneBeside.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
constexpr double Width = 4.0; // m, of the volume
constexpr int Rest = 90;
constexpr int Until = 130;
constexpr int Frames = 200;

ObstacleMesh Slab()
{
  ObstacleMesh slab;
  slab.Mesh = MakeBox({ Vec3(-4.0, -4.0, -1.0), Vec3(4.0, 4.0, 0.0) });
  return slab;
}

/// A closed block whose upper side is z = f(x, y) over (-1, 1)^2.
template <class Height>
ObstacleMesh Terrain(int cells, Height&& f)
{
  ObstacleMesh terrain;
  terrain.ObstacleId = 1;
  TriangleMesh& mesh = terrain.Mesh;
  const auto at = [&](int layer, int i, int j)
  { return (layer * (cells + 1) + j) * (cells + 1) + i; };
  for (int layer = 0; layer < 2; ++layer)
  {
    for (int j = 0; j <= cells; ++j)
    {
      for (int i = 0; i <= cells; ++i)
      {
        const double x = 2.0 * i / cells - 1.0;
        const double y = 2.0 * j / cells - 1.0;
        mesh.Points.emplace_back(x, y, layer == 0 ? -0.5 : f(x, y));
      }
    }
  }
  const auto quad = [&](int a, int b, int c, int d)
  {
    mesh.Triangles.push_back({ a, b, c });
    mesh.Triangles.push_back({ a, c, d });
  };
  for (int j = 0; j < cells; ++j)
  {
    for (int i = 0; i < cells; ++i)
    {
      quad(at(1, i, j), at(1, i + 1, j), at(1, i + 1, j + 1), at(1, i, j + 1));
      quad(at(0, i, j), at(0, i, j + 1), at(0, i + 1, j + 1), at(0, i + 1, j));
    }
  }
  for (int i = 0; i < cells; ++i)
  {
    quad(at(0, i, 0), at(0, i + 1, 0), at(1, i + 1, 0), at(1, i, 0));
    quad(at(0, i + 1, cells), at(0, i, cells), at(1, i, cells), at(1, i + 1, cells));
    quad(at(0, 0, i + 1), at(0, 0, i), at(1, 0, i), at(1, 0, i + 1));
    quad(at(0, cells, i), at(0, cells, i + 1), at(1, cells, i + 1), at(1, cells, i));
  }
  return terrain;
}

ObstacleSet Build(std::vector<ObstacleMesh> meshes)
{
  ObstacleSet set;
  const Result result = set.Build(std::move(meshes));
  EXPECT_TRUE(result) << result.Message();
  return set;
}

struct Flown
{
  RotationInput Input;
  RotationOutput Output;

  Vec3 Center(std::size_t k) const
  {
    const auto& shifts = this->Output.Shifts[0];
    return this->Input.Tracks[0].Positions[k] + (shifts.empty() ? Vec3(Vec3::Zero()) : shifts[k]);
  }
  /// Least signed distance of a vertex to any surface.
  double Lowest(std::size_t k) const
  {
    double lowest = 1e300;
    for (const Vec3& p : this->Input.Shapes[0].Mesh.Points)
    {
      const Vec3 x = this->Center(k) + this->Output.Poses[0].Orientations[k] * p;
      lowest = std::min(lowest, this->Input.Obstacles->SignedDistance(x, double(k)));
    }
    return lowest;
  }
};

/// Lands at a place, rests from frame 90 to 130 and rises again.
Flown LandAt(const ObstacleSet& obstacles, const Vec3& target, const Quat& start, double phase)
{
  Flown flown;
  const Shape leaf = CurledLeaf();
  const double height = RestHeight(leaf);
  Vec3 place;
  SurfaceHit hit;
  EXPECT_TRUE(RestingPosition(obstacles, target, Rest, height, place, hit));
  std::vector<Vec3> path = LandingPath(place, Rest, Until + 1, phase);
  for (int k = 1; k < Frames - Until; ++k)
  {
    const double t = k / 30.0;
    path.push_back(place + Vec3(0.1 * t * t, 0.05 * t * t, 0.5 * t * t / (1.0 + t)));
  }
  for (int k = 0; k < Frames; ++k)
  {
    Vec3 least;
    SurfaceHit below;
    if ((k < Rest || k > Until) &&
        RestingPosition(obstacles, path[k] + Vec3(0.0, 0.0, 0.3), k, height, least, below))
    {
      path[k].z() = std::max(path[k].z(), least.z());
    }
  }
  flown.Input = OneObject(leaf, path);
  flown.Input.Objects[0].Orientation = start;
  flown.Input.Objects[0].AngularVelocity = Vec3(3.0, 1.0, 2.0);
  flown.Input.Obstacles = &obstacles;
  flown.Input.Constraints = { RestRow(Rest, Until, target) };
  flown.Output = Refine(flown.Input);
  return flown;
}

/// What holds on every surface; lean: how far the lying pose may be off the face's normal [rad].
void ExpectGoodRest(const Flown& flown, const ObstacleSet& obstacles, double lean)
{
  const PoseTrack& poses = flown.Output.Poses[0];
  SurfaceHit hit;
  ASSERT_TRUE(obstacles.SurfaceBelow(flown.Input.Constraints[0].Value, Rest, hit));
  const double gap = flown.Lowest(Rest);
  EXPECT_GE(gap, -1e-9);
  EXPECT_LE(gap, 1e-3 * Width);
  const Vec3 up = poses.Orientations[Rest] * Vec3::UnitZ();
  EXPECT_GT(std::abs(up.dot(hit.Normal)), std::cos(lean));
  for (int k = Rest; k <= Until; ++k)
  {
    EXPECT_EQ(poses.Orientations[k].coeffs(), poses.Orientations[Rest].coeffs());
    EXPECT_EQ(poses.AngularVelocities[k].norm(), 0.0);
    EXPECT_EQ((flown.Center(k) - flown.Center(Rest)).norm(), 0.0);
  }
  for (int k = 0; k < Frames; ++k)
  {
    EXPECT_GE(flown.Lowest(k), -1e-3 * Width) << k;
    // As it comes down the ground may hold it higher.
    const Vec3 moved = flown.Center(k) - flown.Input.Tracks[0].Positions[k];
    EXPECT_LE(std::max(moved.head<2>().norm(), -moved.z()), 1e-3 * Width + 1e-12);
    EXPECT_LE(moved.z(), k < Rest ? 0.02 : 1.5e-3 * Width);
    if (k > 0)
    {
      EXPECT_GT(poses.Orientations[k].dot(poses.Orientations[k - 1]), 0.0) << k;
    }
  }
  EXPECT_GT((flown.Center(Frames - 1) - flown.Center(Until)).z(), 0.05);
  EXPECT_GT(Angle(poses.Orientations[Frames - 1], poses.Orientations[Until]), 1e-3);
}

Quat Start(int i)
{
  return ExpMap(0.5 * i * Vec3(std::cos(1.0 * i), std::sin(1.0 * i), 0.2));
}
} // namespace

TEST(Surfaces, RestOnTheGroundAndRiseAgain)
{
  const ObstacleSet ground = Build({ Slab() });
  for (int i = 0; i < 6; ++i)
  {
    const Flown flown = LandAt(ground, Vec3(0.3, -0.2, 1.0), Start(i), 0.7 * i);
    ExpectGoodRest(flown, ground, 0.1);
    EXPECT_LT(flown.Lowest(Rest), 1e-8);
  }
}

TEST(Surfaces, RestOnAnObstacleAndRiseAgain)
{
  // The top of a box near its edge, and a round stone: there the centre sinks or rises a little.
  ObstacleMesh box;
  box.ObstacleId = 1;
  box.Mesh = MakeBox({ Vec3(-0.3, -0.3, 0.0), Vec3(0.3, 0.3, 0.5) });
  const ObstacleSet table = Build({ Slab(), box });
  ObstacleMesh stone;
  stone.ObstacleId = 1;
  stone.Mesh = MakeSphere(Vec3(0.0, 0.0, 0.1), 0.4);
  const ObstacleSet round = Build({ Slab(), stone });
  for (int i = 0; i < 4; ++i)
  {
    ExpectGoodRest(LandAt(table, Vec3(0.27, 0.1, 1.0), Start(i), 0.7 * i), table, 0.1);
    ExpectGoodRest(LandAt(round, Vec3(0.1, 0.05, 1.0), Start(i), 0.7 * i), round, 0.2);
  }
}

TEST(Surfaces, RestOnATerrainAndRiseAgain)
{
  const auto hills = [](double x, double y)
  { return 0.08 + 0.04 * std::sin(8.0 * x) * std::cos(7.0 * y) + 0.01 * std::sin(31.0 * (x + y)); };
  const ObstacleSet terrain = Build({ Terrain(60, hills) });
  for (int i = 0; i < 8; ++i)
  {
    const Vec3 target(0.5 * std::cos(1.7 * i), 0.5 * std::sin(1.7 * i), 1.0);
    ExpectGoodRest(LandAt(terrain, target, Start(i), 0.7 * i), terrain, 0.45);
  }
}

TEST(Surfaces, AMeshThatPassesOverAnEdgeDoesNotCutIt)
{
  // The centre passes a box's edge at 0.02 m, less than half the leaf's length.
  ObstacleMesh box;
  box.ObstacleId = 1;
  box.Mesh = MakeBox({ Vec3(-0.3, -0.3, 0.0), Vec3(0.3, 0.3, 0.5) });
  const ObstacleSet table = Build({ Slab(), box });
  for (int run = 0; run < 4; ++run)
  {
    std::vector<Vec3> path;
    for (int k = 0; k < 78; ++k)
    {
      const double t = (k - 45) / 30.0;
      path.emplace_back(0.3 + 0.014 + 0.4 * t, 0.1 * t,
                        0.5 + 0.014 + 0.06 * run - (t > 0.0 ? 0.4 * t : 0.0) +
                          (t < 0.0 ? 0.01 : 0.0));
    }
    Flown flown;
    flown.Input = OneObject(CurledLeaf(), path);
    flown.Input.Obstacles = &table;
    flown.Input.Objects[0].Orientation = Start(run);
    flown.Input.Objects[0].AngularVelocity = Vec3(2.0, 6.0, 0.0);
    flown.Output = Refine(flown.Input);
    for (std::size_t k = 0; k < path.size(); ++k)
    {
      EXPECT_GE(flown.Lowest(k), -1e-3 * Width) << run << " " << k;
    }
  }
}

TEST(Surfaces, WhatCannotBeClearedIsReported)
{
  // The centre itself goes below the ground.
  const ObstacleSet ground = Build({ Slab() });
  RotationInput input =
    OneObject(CurledLeaf(), StraightPath(Vec3(0.0, 0.0, 0.3), Vec3(0.1, 0.0, -0.2), 60));
  input.Obstacles = &ground;
  const RotationOutput output = Refine(input);
  ASSERT_FALSE(output.Warnings.empty());
  EXPECT_NE(output.Warnings[0].find("object 0: its mesh lies up to"), std::string::npos);
}

TEST(Surfaces, AnExactMarkHoldsTheCentre)
{
  // A mark within the rest: the centre stays where it is, and what is cut is told.
  const auto hills = [](double x, double y) { return 0.05 + 0.04 * std::sin(40.0 * (x + y)); };
  const ObstacleSet terrain = Build({ Terrain(80, hills) });
  Flown flown = LandAt(terrain, Vec3(0.2, 0.1, 1.0), Quat::Identity(), 0.0);
  EXPECT_GT((flown.Center(Rest) - flown.Input.Tracks[0].Positions[Rest]).norm(), 1e-6);
  Constraint mark = flown.Input.Constraints[0];
  mark.Kind = ConstraintKind::Position;
  mark.Frame = Rest + 5;
  flown.Input.Constraints.push_back(mark);
  flown.Output = Refine(flown.Input);
  EXPECT_EQ((flown.Center(Rest + 5) - flown.Input.Tracks[0].Positions[Rest + 5]).norm(), 0.0);
}

TEST(Surfaces, WhoTurnsOnItsOtherSideAboveTheGroundDoesNotFlip)
{
  // A sheet rises slowly, cuts the ground as it turns onto its edge, and turns over where it no
  // longer does: what lays it flat before would lay it on its other side after.
  const ObstacleSet ground = Build({ Slab() });
  const Shape sheet = Sheet(0.297, 0.21);
  for (const int leaves : { 0, 21, 24, 26 }) // frames that keep to the side on which it lay
  {
    std::vector<Vec3> places;
    std::vector<Quat> poses;
    std::vector<ContactFrame> frames;
    for (int k = 0; k < 60; ++k)
    {
      places.emplace_back(0.0, 0.0, std::min(0.16, 0.06 + 0.015 * std::max(k - 15, 0)));
      poses.push_back(ExpMap(Vec3(0.0, 0.06 * (k - 23.4) + 0.5 * std::acos(-1.0), 0.0)));
      ContactFrame frame;
      frame.Freedom = k < leaves ? PoseFreedom::Leaving : PoseFreedom::Free;
      frames.push_back(frame);
    }
    ContactInput contact;
    contact.Mesh = &sheet.Mesh;
    contact.BoundingRadius = 0.5 * std::hypot(0.297, 0.21);
    contact.Positions = &places;
    contact.Frames = &frames;
    contact.Obstacles = &ground;
    contact.MostShift = 4e-3;
    std::vector<unsigned char> changed(places.size(), 0);
    std::vector<Vec3> shifts(places.size(), Vec3::Zero());
    EXPECT_LE(KeepAboveSurfaces(contact, poses, changed, shifts), 1e-9) << leaves;
    EXPECT_NE(changed[14], 0);
    for (std::size_t k = 1; k < poses.size(); ++k)
    {
      EXPECT_LT(Angle(poses[k], poses[k - 1]), 0.5) << leaves << ", frame " << k;
    }
  }
}

TEST(Surfaces, PosesOfAPathThatTurnOverInTheGroundAreFlownAnew)
{
  // They came with a path that was higher: on edge the sheet would cut the ground, and lie on one
  // side before and on the other after.
  const ObstacleSet ground = Build({ Slab() });
  const Shape sheet = Sheet(0.297, 0.21);
  std::vector<Vec3> path;
  for (int k = 0; k < 60; ++k)
  {
    path.emplace_back(0.01 * k, 0.0, 0.13 + 1e-4 * std::pow(k - 23.4, 2));
  }
  RotationInput input = OneObject(sheet, path);
  input.Obstacles = &ground;
  Track& track = input.Tracks[0];
  for (int k = 0; k < 60; ++k)
  {
    track.Orientations.push_back(ExpMap(Vec3(0.0, 0.06 * (k - 23.4) + 0.5 * std::acos(-1.0), 0.0)));
    track.AngularVelocities.emplace_back(0.0, 1.8, 0.0);
    track.Slips.emplace_back(0.0, 0.0, -0.75);
  }
  input.Objects[0].SettlingSpeed = 0.75;
  const RotationOutput output = Refine(input);
  const std::vector<Quat>& poses = output.Poses[0].Orientations;
  EXPECT_TRUE(output.Warnings.empty()) << output.Warnings[0];
  EXPECT_LT(Angle(poses[0], track.Orientations[0]), 1e-9);
  for (std::size_t k = 1; k < poses.size(); ++k)
  {
    EXPECT_LT(Angle(poses[k], poses[k - 1]), 0.699) << k;
  }
}

TEST(Surfaces, WhoPassesUnderAnEdgeDoesNotPop)
{
  // Down beside a lintel and in below it: while the centre passes the edge at a third of the
  // sheet's length, the plane at the surface's nearest point turns by 70 degrees in two frames.
  for (const bool moves : { false, true })
  {
    ObstacleMesh lintel;
    lintel.Mesh = MakeBox({ Vec3(-0.12, -1.0, 2.0), Vec3(0.12, 1.0, 2.16) });
    std::vector<Vec3> path;
    for (int k = 0; k < 60; ++k)
    {
      const double t = (k - 30) / 30.0;
      const Vec3 offset = moves ? Vec3(0.3 * k / 30.0, 0.0, 0.0) : Vec3(Vec3::Zero());
      path.push_back(offset +
                     Vec3(-0.15 + 0.4 * t + (t < 0.0 ? -1.2 * t * t : 0.0), 0.0, 1.975 - 1.05 * t));
      lintel.Offsets.push_back(offset);
    }
    const ObstacleSet gate = Build({ lintel });
    for (int run = 0; run < 24; ++run)
    {
      Flown flown;
      flown.Input = OneObject(Sheet(0.15, 0.12), path);
      flown.Input.Obstacles = &gate;
      flown.Input.Objects[0].SettlingSpeed = 0.9;
      flown.Input.Objects[0].Orientation = ExpMap(Vec3(0.0, 0.26 * run, 0.0));
      flown.Input.Objects[0].AngularVelocity = Vec3(0.0, 8.0, 0.0);
      flown.Output = Refine(flown.Input);
      const std::vector<Quat>& poses = flown.Output.Poses[0].Orientations;
      for (std::size_t k = 1; k < path.size(); ++k)
      {
        EXPECT_GE(flown.Lowest(k), -1e-9) << run << ", frame " << k;
        EXPECT_LT(Angle(poses[k], poses[k - 1]), 0.54) << run << ", frame " << k; // 31 degrees
      }
    }
  }
}

TEST(Surfaces, APlaneBesideAnEdgeHasAllOfTheWallBelow)
{
  ObstacleMesh wall;
  wall.Mesh = MakeBox({ Vec3(-0.001, -1.0, 0.0), Vec3(0.001, 1.0, 1.0) });
  const ObstacleSet walls = Build({ wall });
  const Shape sheet = Sheet(0.15, 0.12);
  Random random(3);
  int others = 0;
  for (int i = 0; i < 500; ++i)
  {
    PassingBody body;
    body.Points = &sheet.Mesh.Points;
    body.Reach = std::hypot(0.075, 0.06);
    body.Orientation = ExpMap(3.0 * random.Direction());
    body.Center = Vec3(0.0, 0.0, 1.0) + random.Uniform(0.01, 0.09) * random.Direction();
    body.Before = body.Center;
    SurfaceHit nearest;
    if (walls.SignedDistance(body.Center, 0.0, nearest) <= 0.0)
    {
      continue;
    }
    const SurfaceHit plane = PlaneBeside(walls, nearest, body);
    others += plane.Normal != nearest.Normal ? 1 : 0;
    EXPECT_GT((body.Center - plane.Point).dot(plane.Normal), 0.0) << i;
    for (const Vec3& corner : wall.Mesh.Points)
    {
      EXPECT_LE((corner - plane.Point).dot(plane.Normal), 1e-9) << i;
    }
  }
  EXPECT_GT(others, 100);
}
