// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/DistanceFrames.h"

#include "Base/Random.h"
#include "Obstacles/ObstacleSet.h"
#include "Obstacles/Shapes.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::testing;

namespace
{

std::vector<ObstacleMesh> Scene()
{
  ObstacleMesh ground, torus;
  ground.Mesh = MakeBox({ Vec3(-3, -3, -1), Vec3(3, 3, 0) });
  TriangleMesh hollow = MakeBox({ Vec3(-1.8, -1.8, 0.2), Vec3(-0.6, -0.6, 1.4) });
  Append(hollow, MakeBox({ Vec3(-1.5, -1.5, 0.5), Vec3(-0.9, -0.9, 1.1) }));
  Append(ground.Mesh, hollow);
  torus.ObstacleId = 1;
  torus.Mesh = TorusMesh(Vec3(0.5, 0.3, 0.9), 0.6, 0.3, 32, 16);
  torus.Offsets = { Vec3::Zero(), Vec3(0.2, 0.4, 0.1) };
  return { ground, torus };
}

DistanceLattice Lattice()
{
  DistanceLattice lattice;
  lattice.Dimensions = { 41, 43, 26 };
  lattice.Origin = Vec3(-2, -2.1, -0.5);
  lattice.Spacing = 0.1;
  lattice.Band = 0.35;
  return lattice;
}

} // namespace

TEST(DistanceLattice, EqualsTheTreesAtEveryPoint)
{
  ObstacleSet set;
  ASSERT_TRUE(static_cast<bool>(set.Build(Scene())));
  DistanceLattice lattice = Lattice();
  ASSERT_TRUE(static_cast<bool>(ComputeDistanceLattice(Scene(), 0.5, lattice)));
  ASSERT_EQ(lattice.Values.size(), 41u * 43u * 26u);
  std::size_t n = 0;
  int inside = 0;
  for (int k = 0; k < 26; ++k)
  {
    for (int j = 0; j < 43; ++j)
    {
      for (int i = 0; i < 41; ++i, ++n)
      {
        const Vec3 x = lattice.Origin + lattice.Spacing * Vec3(i, j, k);
        const double expected = std::clamp(set.SignedDistance(x, 0.5), -0.35, 0.35);
        inside += expected < 0.0;
        ASSERT_NEAR(lattice.Values[n], expected, 1e-6) << x.transpose();
      }
    }
  }
  EXPECT_GT(inside, 5000);
}

TEST(DistanceFrames, EachFrameIsThatOfItsOwnAndNamesTheNearest)
{
  const std::vector<ObstacleMesh> scene = Scene();
  ObstacleSet set;
  ASSERT_TRUE(static_cast<bool>(set.Build(scene)));
  DistanceFrames frames;
  std::vector<float> distances;
  EXPECT_FALSE(static_cast<bool>(frames.At(0.0, distances)));
  ASSERT_TRUE(static_cast<bool>(frames.Build(scene, Lattice())));
  for (const double frame : { 1.0, 0.0, 0.25 })
  {
    DistanceLattice alone = Lattice();
    std::vector<int> nearest;
    ASSERT_TRUE(static_cast<bool>(frames.At(frame, distances, &nearest)));
    ASSERT_TRUE(static_cast<bool>(ComputeDistanceLattice(scene, frame, alone)));
    ASSERT_EQ(distances, alone.Values);
    std::array<int, 3> counts{};
    std::size_t n = 0;
    for (int k = 0; k < 26; ++k)
    {
      for (int j = 0; j < 43; ++j)
      {
        for (int i = 0; i < 41; ++i, ++n)
        {
          ++counts[nearest[n] + 1];
          ASSERT_EQ(nearest[n] < 0, distances[n] >= 0.35F);
          const Vec3 x = alone.Origin + alone.Spacing * Vec3(i, j, k);
          SurfaceHit hit;
          const double distance = set.SignedDistance(x, frame, hit);
          if (std::abs(distance) < 0.349 && nearest[n] != hit.ObstacleId)
          {
            SurfaceHit other; // equally near
            EXPECT_NEAR(set.SignedDistanceTo(nearest[n], x, frame, other), distance, 1e-6);
          }
        }
      }
    }
    EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 500);
  }
}

TEST(DistanceFrames, AnObstacleThatLeavesTheLatticeIsNotInIt)
{
  std::vector<ObstacleMesh> scene(1);
  scene[0].Mesh = MakeBox({ Vec3(-1, -1, 0), Vec3(0, 0, 1) });
  scene[0].Offsets = { Vec3::Zero(), Vec3(50, 0, 0), Vec3(-1.2, -50, 3) };
  DistanceFrames frames;
  ASSERT_TRUE(static_cast<bool>(frames.Build(scene, Lattice())));
  std::vector<float> distances;
  ASSERT_TRUE(static_cast<bool>(frames.At(0.0, distances)));
  EXPECT_LT(*std::min_element(distances.begin(), distances.end()), 0.0F);
  for (const double frame : { 1.0, 2.0 })
  {
    ASSERT_TRUE(static_cast<bool>(frames.At(frame, distances)));
    EXPECT_EQ(*std::min_element(distances.begin(), distances.end()), 0.35F);
  }
}

TEST(DistanceLattice, SamplesLinearFieldsExactlyAndItsGradientIsTheInterpolants)
{
  DistanceLattice lattice = Lattice();
  lattice.Values.clear();
  for (int k = 0; k < 26; ++k)
  {
    for (int j = 0; j < 43; ++j)
    {
      for (int i = 0; i < 41; ++i)
      {
        const Vec3 x = lattice.Origin + lattice.Spacing * Vec3(i, j, k);
        lattice.Values.push_back(static_cast<float>(x.x() * x.y() + 0.5 * x.z() * x.x()));
      }
    }
  }
  Random random(4);
  for (int n = 0; n < 300; ++n)
  {
    const Vec3 x = random.InBox({ Vec3(-2.2, -2.3, -0.7), Vec3(2.2, 2.3, 2.2) });
    Vec3 gradient;
    const double value = lattice.Sample(x, gradient);
    EXPECT_EQ(value, lattice.Sample(x));
    const Vec3 last = lattice.Origin + lattice.Spacing * Vec3(40, 42, 25);
    const Vec3 y = x.cwiseMax(lattice.Origin).cwiseMin(last);
    EXPECT_NEAR(value, y.x() * y.y() + 0.5 * y.z() * y.x(), 1e-6);
    for (int axis = 0; axis < 3; ++axis)
    {
      Vec3 step = Vec3::Zero();
      step[axis] = 1e-6;
      const double cell = (x[axis] - lattice.Origin[axis]) / lattice.Spacing;
      if (std::abs(cell - std::round(cell)) > 1e-3)
      {
        EXPECT_NEAR(gradient[axis], (lattice.Sample(x + step) - lattice.Sample(x - step)) / 2e-6,
                    1e-6);
      }
    }
  }
}

TEST(DistanceLattice, RefusesOpenSurfacesAndEmptyLattices)
{
  std::vector<ObstacleMesh> open = Scene();
  open[1].Mesh.Triangles.pop_back();
  DistanceLattice lattice = Lattice();
  const Result result = ComputeDistanceLattice(open, 0.0, lattice);
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_NE(result.Message().find("obstacle 1: the surface is not closed"), std::string::npos);
  EXPECT_TRUE(lattice.IsEmpty());
  lattice.Spacing = 0.0;
  EXPECT_FALSE(static_cast<bool>(ComputeDistanceLattice(Scene(), 0.0, lattice)));
  lattice = Lattice();
  ASSERT_TRUE(static_cast<bool>(ComputeDistanceLattice({}, 0.0, lattice)));
  EXPECT_EQ(lattice.Sample(Vec3::Zero()), static_cast<double>(0.35F));
}
